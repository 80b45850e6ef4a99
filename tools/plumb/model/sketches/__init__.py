"""Sketches: effects tried in Python before they are worth a place in the firmware.

Each file here that does not begin with an underscore, and each in the folder that the environment
variable PLUMB_SKETCHES names, holds a SKETCH. It is ranked and fitted like the library's effects.
"""

from plumb.model.sketches.sketch import Sketch, SketchParameter, Strands, load_all

__all__ = ["BROKEN", "SKETCHES", "Sketch", "SketchParameter", "Strands"]

_LOADED = load_all()
SKETCHES: tuple[Sketch, ...] = _LOADED.sketches
BROKEN: tuple[str, ...] = _LOADED.broken  # a line for each file that could not be used
