"""The calibration lab of the Maslow hanging CNC, as commands and as functions.

    import plumb

    inputs = plumb.read("groundcontrol.ini", "marks.toml")
    print(plumb.compare(inputs).rms)
    print(plumb.diagnose(inputs).verdict)

docs/lab.ipynb goes through a calibration. Lengths are mm, forces N, angles rad. The functions are
in plumb/api and load when they are first used, so that `plumb --help` comes at once.
"""

from __future__ import annotations

from importlib import import_module

# ruff: noqa: F405
__all__ = [
    "Addition",
    "Comparison",
    "Decision",
    "Diagnosis",
    "InputError",
    "Inputs",
    "Next",
    "add",
    "compare",
    "decide",
    "diagnose",
    "next",
    "read",
    "write",
]

TYPE_CHECKING = False  # typing itself takes 20 ms, and `plumb` loads this first of all

if TYPE_CHECKING:
    from plumb.api import *  # noqa: F403
else:

    def __getattr__(name: str) -> object:
        if name not in __all__:
            raise AttributeError(f"module 'plumb' has no attribute {name!r}")
        return getattr(import_module("plumb.api"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
