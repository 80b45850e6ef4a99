"""Sketches: what an effect on trial is, which makes chains longer or pushes the sled, and how it is
loaded.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import known_effects
from plumb.model.python_effect import PythonEffect, PythonParameter
from plumb.text.errors import load_script

Array = NDArray[np.float64]
SketchParameter = PythonParameter


@dataclass(frozen=True)
class Strands:
    """Both strands of each visit as a sketch sees them; columns are left and right."""

    span: Array  # (n, 2) [mm] free chain between sprocket and ring
    across: Array  # (n, 2) [1] cosine of the strand's angle below the horizontal
    down: Array  # (n, 2) [1] its sine
    tension: Array  # (n, 2) [N]
    length: Array  # (n, 2) [mm] chain beyond the sprocket by all effects of the machine
    places: Array  # (n, 2) [mm] x and y of the sled


@dataclass(frozen=True, kw_only=True)
class Sketch(PythonEffect):
    """One physical cause on trial: chain that it adds, or a push on the sled, or both."""

    where: ClassVar[str] = "sketch"

    extra: Callable[[Array, Strands], Array] | None = None  # of parameters (p,): chain (n, 2) [mm]
    push: Callable[[Array, Strands], Array] | None = None  # force on the sled (n, 2) [N], x and y


# Loads the sketches: a Python file of a folder each; a file that cannot be used is named.

VARIABLE = "PLUMB_SKETCHES"  # names a folder of the user


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
            if path.parent == Path(__file__).parent and path.name == Path(__file__).name:
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
