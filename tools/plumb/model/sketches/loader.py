"""Finding sketches: one in each Python file of a folder; a file that cannot be used is named."""

from __future__ import annotations

import importlib.util
import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import known_effects
from plumb.model.sketches.sketch import Sketch, Strands

VARIABLE = "PLUMB_SKETCHES"  # names a folder of the owner's own
OWN_FILES = ("loader.py", "sketch.py")


@dataclass(frozen=True)
class Loaded:
    """The sketches, and a line for each file that holds none that can be used."""

    sketches: tuple[Sketch, ...]
    broken: tuple[str, ...]


def load_all() -> Loaded:
    """The sketches of this folder and of the owner's."""
    folders = [Path(__file__).parent]
    if os.environ.get(VARIABLE):
        folders.append(Path(os.environ[VARIABLE]))
    return load(folders)


def load(folders: list[Path]) -> Loaded:
    """The sketches of these folders, in the order of their files' names."""
    sketches: dict[str, Sketch] = {}
    broken = []
    for folder in folders:
        if not folder.is_dir():
            broken.append(f"{folder}: is no folder of sketches; correct {VARIABLE}")
        for path in sorted(folder.glob("[!_]*.py")):
            if path.parent == Path(__file__).parent and path.name in OWN_FILES:
                continue
            try:
                own = _read(path)
                _refuse_taken(own, sketches)
            except Exception as error:  # a sketch is anybody's code: whatever it does is its fault
                reason = " ".join(str(error).split()) or type(error).__name__
                broken.append(f"{path}: {reason}; correct it, or set it aside as _{path.name}")
                continue
            sketches[own.name] = own
    return Loaded(tuple(sketches.values()), tuple(broken))


def _read(path: Path) -> Sketch:
    """The SKETCH of one file, tried on two strands."""
    spec = importlib.util.spec_from_file_location(f"plumb_sketch_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    own = getattr(module, "SKETCH", None)
    if not isinstance(own, Sketch):
        raise ValueError("no SKETCH = Sketch(...) in it")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", own.name) or not own.parameters:
        raise ValueError("a sketch needs a name in small letters and at least one parameter")
    one = np.array([[1500.0, 1600.0]])
    strands = Strands(one, one / 2000, one / 2000, one / 25, one, one[:, ::-1] * 0.1)
    zero, typical = np.zeros(len(own.parameters)), [each.typical for each in own.parameters]
    if np.any(np.asarray(own.extra(zero, strands)) != 0.0):
        raise ValueError("with all parameters zero it must add no chain")
    felt = np.asarray(own.extra(np.array(typical), strands), dtype=float)
    if felt.shape != (1, 2) or not np.all(np.isfinite(felt)):
        raise ValueError(f"extra() gave {felt.shape}, not finite numbers (n, 2)")
    return own


def _refuse_taken(own: Sketch, others: dict[str, Sketch]) -> None:
    if own.name in {*known_effects(), *(one.name for one in LAB_EFFECTS), *others}:
        raise ValueError(f"there is an effect {own.name} already")
