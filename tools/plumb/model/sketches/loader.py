"""Loads the sketches: a Python file of a folder each; a file that cannot be used is named."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import known_effects
from plumb.model.sketches.sketch import Sketch, Strands
from plumb.text.errors import load_script

VARIABLE = "PLUMB_SKETCHES"  # names a folder of the user
OWN_FILES = ("loader.py", "sketch.py")


@dataclass(frozen=True)
class Loaded:
    """The sketches, and a line for each file that holds none that can be used."""

    sketches: tuple[Sketch, ...]
    broken: tuple[str, ...]


def load_all() -> Loaded:
    """Return the sketches of this folder and of the user's."""
    folders = [Path(__file__).parent]
    if os.environ.get(VARIABLE):
        folders.append(Path(os.environ[VARIABLE]))
    return load(folders)


def load(folders: list[Path]) -> Loaded:
    """Return the sketches of these folders, in the order of their files' names."""
    sketches: dict[str, Sketch] = {}
    broken = []
    for folder in folders:
        if not folder.is_dir():
            broken.append(f"{folder}: is no folder of sketches; correct {VARIABLE}")
        for path in sorted(folder.glob("[!_]*.py")):
            if path.parent == Path(__file__).parent and path.name in OWN_FILES:
                continue
            try:
                sketch = _read(path)
                _refuse_taken(sketch, sketches)
            except Exception as error:  # a sketch is anybody's code: whatever it does is its fault
                reason = " ".join(str(error).split()) or type(error).__name__
                broken.append(f"{path}: {reason}; correct it, or set it aside as _{path.name}")
                continue
            sketches[sketch.name] = sketch
    return Loaded(tuple(sketches.values()), tuple(broken))


def _read(path: Path) -> Sketch:
    """Return the SKETCH of a file, tried on two strands."""
    module = load_script(path, name=f"plumb_sketch_{path.stem}")
    sketch = getattr(module, "SKETCH", None)
    if not isinstance(sketch, Sketch):
        raise ValueError("no SKETCH = Sketch(...) in it")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", sketch.name) or not sketch.parameters:
        raise ValueError("a sketch needs a name in small letters and at least one parameter")
    length = np.array([[1500.0, 1600.0]])
    strands = Strands(
        length, length / 2000, length / 2000, length / 25, length, length[:, ::-1] * 0.1
    )
    hooks = {"extra": sketch.extra, "push": sketch.push}
    if not any(hooks.values()):
        raise ValueError("a sketch needs extra(), the chain it adds, or push(), a force")
    zero = np.zeros(len(sketch.parameters))
    typical = np.array([parameter.typical for parameter in sketch.parameters])
    for word, hook in hooks.items():
        if hook is None:
            continue
        if np.any(np.asarray(hook(zero, strands)) != 0.0):
            raise ValueError(f"with all parameters zero {word}() must give zeros")
        felt = np.asarray(hook(typical, strands), dtype=float)
        if felt.shape != (1, 2) or not np.all(np.isfinite(felt)):
            raise ValueError(f"{word}() gave {felt.shape}, not finite numbers (n, 2)")
    return sketch


def _refuse_taken(sketch: Sketch, others: dict[str, Sketch]) -> None:
    if sketch.name in {*known_effects(), *(effect.name for effect in LAB_EFFECTS), *others}:
        raise ValueError(f"there is an effect {sketch.name} already")
