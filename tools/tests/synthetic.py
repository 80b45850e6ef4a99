"""Machines and marks made up for tests: what a true machine does with what another believed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from plumb.fit.observations import loaded
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import FOUND, lengths, places, settings_of, values_of
from plumb.settings import MachineSettings

SHEET = (2438.4, 1219.2)
BELIEVED = MachineSettings(
    motor_gap=2978.4,
    motor_height=1072.6,
    rotation_radius=139.1,
    sheet_width=SHEET[0],
    sheet_height=SHEET[1],
    feed="top",
)
EFFECTS = {
    "chain_sag": {"weight_ratio_squared": 8.2e-12},
    "chain_stretch": {"compliance": 5.2e-6},
    "chain_pitch": {"left": 0.0021, "right": 0.0008},
}
TRUE = replace(BELIEVED, motor_gap=2981.0, motor_height=1075.0, motor_center_x=1.5, effects=EFFECTS)


def grid(columns: int, rows: int) -> np.ndarray:
    """Targets (n, 2) [mm] spread over the sheet."""
    across, up = np.linspace(-1100, 1100, columns), np.linspace(500, -500, rows)
    return np.array([(x, y) for y in up for x in across])


def marks_on(
    true: MachineSettings,
    believed: MachineSettings,
    targets: np.ndarray,
    *,
    sled_weight: float | None = None,
    rotation: float = 0.0,
    noise: float = 0.0,
    seed: int = 1,
    prefix: str = "",
) -> tuple[Mark, ...]:
    """Marks that the true machine makes, on a sheet turned by `rotation` [rad] against it."""
    chains, outcome = lengths(believed, targets)
    assert (outcome == FOUND).all()
    weight = sled_weight or true.sled_weight
    settings = settings_of(loaded(values_of(true), weight, true.sled_weight)[0], like=true)
    where, outcome = places(settings, chains)
    assert (outcome == FOUND).all()
    cosine, sine = np.cos(rotation), np.sin(rotation)
    where = where @ np.array([[cosine, sine], [-sine, cosine]])
    where = where + noise * np.random.default_rng(seed).standard_normal(where.shape)
    return tuple(
        Mark(f"{prefix}{i}", tuple(target), tuple(place), sled_weight=sled_weight)
        for i, (target, place) in enumerate(zip(targets.tolist(), where.tolist(), strict=True))
    )


def distances_between(marks: tuple[Mark, ...]) -> Measurements:
    """All distances between the marks, their places themselves unknown."""
    spans = tuple(
        Distance((a.name, b.name), float(np.hypot(*np.subtract(a.measured, b.measured))))
        for i, a in enumerate(marks)
        for b in marks[:i]
    )
    return Measurements(tuple(replace(mark, measured=None) for mark in marks), spans, source="d")


def csv_of(marks: Iterable[Mark]) -> str:
    """Marks as a file."""
    rows = [(mark.name, *mark.target, *mark.measured) for mark in marks]
    head = "name,target_x_mm,target_y_mm,measured_x_mm,measured_y_mm"
    return "\n".join([head, *(",".join(map(str, row)) for row in rows)]) + "\n"


def read_elsewhere(measurements, index, by):
    """The measurements with one reading off by some millimetres."""
    marks = list(measurements.marks)
    marks[index] = replace(marks[index], measured=tuple(np.add(marks[index].measured, by)))
    return replace(measurements, marks=tuple(marks))
