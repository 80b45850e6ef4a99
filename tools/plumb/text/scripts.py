"""Python files outside the package: the scripts in tools/ and the sketches of users."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType


def load_script(path: Path, *, name: str) -> ModuleType:
    """The module that a Python file makes when it runs; `name` is the module's."""
    specification = importlib.util.spec_from_file_location(name, path)
    if specification is None or specification.loader is None:
        raise ImportError(f"{path} is not a Python file")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module
