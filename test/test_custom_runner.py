"""PlatformIO's GoogleTest runner, with the GoogleTest that env:native names."""

from platformio.test.runners.googletest import GoogletestTestRunner


class CustomTestRunner(GoogletestTestRunner):
    """Reads GoogleTest's output; the library comes from lib_deps."""

    EXTRA_LIB_DEPS = None
