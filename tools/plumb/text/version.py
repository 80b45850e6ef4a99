"""The version of the package, which is that of the firmware too."""

from importlib.metadata import version as _version

PACKAGE = "plumb-maslow"


def version() -> str:
    """Return the version of the package that is installed."""
    return _version(PACKAGE)
