"""Tests of this room ask the same of the same boards."""

from asked_again import asked_again  # noqa: F401
