# The types of the compiled module: tools/core/binding.cpp says what the functions do.
# tools/tests/project/test_core_types.py holds this file against the module.
from collections.abc import Mapping
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from plumb.model.effect_words import EffectWords

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

class SettingRow(TypedDict):
    number: int
    name: str
    unit: str
    kind: str
    access: str
    usual: float
    low: float
    high: float
    touches: list[str]
    step: int
    key: str
    sentence: str
    change: str

class Effective(TypedDict):
    frame: dict[str, float]
    effects: dict[str, float]
    over_top: bool

class Reach(TypedDict):
    verdict: Answers
    tension: Numbers
    compliance: Numbers

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
    values: Numbers,
    over_top: bool,
    points: Numbers,
    *,
    most_tension: float = ...,
    least_tension: float = ...,
    least_free: float = ...,
    most_give: float = ...,
) -> Reach: ...
def reach_limits() -> dict[str, float]: ...
def settings_table() -> list[SettingRow]: ...
def effective(settings: Mapping[int, float]) -> Effective: ...
def carried_twice(settings: dict[int, float]) -> list[tuple[int, int]]: ...
def format_value(value: float) -> str: ...
