"""Tests of this room ask the same of the same boards."""

from asked_again import tried_less  # noqa: F401
