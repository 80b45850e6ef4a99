# The types of the compiled module: tools/core/binding.cpp says what the functions do.
from collections.abc import Mapping
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from plumb.model.predict import EffectWords

Numbers = NDArray[np.float64]
Answers = NDArray[np.uint8]

class FrameWords(TypedDict):
    name: str
    unit: str
    usual: float
    low: float
    high: float
    summary: str
    noun: str

class Effective(TypedDict):
    frame: dict[str, float]
    effects: dict[str, float]
    over_top: bool

def frame() -> list[FrameWords]: ...
def effects() -> list[EffectWords]: ...
def settings() -> list[str]: ...
def lengths(
    values: Numbers, over_top: bool, points: Numbers, float32: bool = False
) -> tuple[Numbers, Answers]: ...
def places(values: Numbers, over_top: bool, chains: Numbers) -> tuple[Numbers, Answers]: ...
def judged(values: Numbers, over_top: bool) -> dict[str, float]: ...
def usual(values: Numbers, over_top: bool) -> dict[str, float]: ...
def slopes(
    values: Numbers, over_top: bool, points: Numbers
) -> tuple[Numbers, Numbers, Answers]: ...
def strands(values: Numbers, over_top: bool, points: Numbers) -> dict[str, Numbers]: ...
def reach(
    values: Numbers, over_top: bool, points: Numbers, *, least_free: float = ...
) -> dict[str, NDArray[Any]]: ...  # the fields of Reached in plumb/model
def reach_limits() -> dict[str, float]: ...
def settings_table() -> list[dict[str, Any]]: ...  # rows of Setting in plumb/firmware
def effective(settings: Mapping[int, float]) -> Effective: ...
def carried_twice(settings: dict[int, float]) -> list[tuple[int, int]]: ...
def format_value(value: float) -> str: ...
