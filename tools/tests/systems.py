"""A mark for tests of what Windows has not."""

import os

import pytest

ON_POSIX = pytest.mark.skipif(os.name == "nt", reason="Windows has no such thing")
