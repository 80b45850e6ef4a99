"""Prints how other calibrations do on the judge's boards and on real sets, for docs/compare.md.

Each is a fit of its own over the published formulas: of what its program fits, to readings of the
kind that its program asks for. docs/compare.md names the programs.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from boards import PUBLISHED, measured
from joblib import Parallel, delayed  # type: ignore[import-untyped]  # it brings no types
from kinds import GRIDS, KINDS, board_of
from plumb.cli.screen import table
from plumb.cure.decision import decide
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.hidden import SLED, TrueMachine, plan, read, shape_of, sheet
from plumb.model.predict import chain_lengths, lengths, places
from plumb.settings import FRAME_FIELDS, MachineSettings, PublishedSettings, tuned_numbers
from real_data_page import HOLES, RealSet, other_boards, real_set
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import least_squares

Array = np.ndarray
Source = np.random.Generator
Way = Callable[[Array], Array]  # places that are wanted (n, 2) [mm] -> chains paid out (n, 2) [mm]
TAPE, CAMERA = 0.5, 0.25  # [mm] of a reading; of a coordinate that a camera sees
ELASTICITY = 5.17e-6  # [1/N] WebControl's default
COLUMN, ROW = 965.2, 355.6  # [mm] where the published patterns are cut
NUDGE = 0.01  # [mm] for slopes
ACROSS, UP = 76.2 * np.arange(-15, 16), 76.2 * np.arange(-7, 8)  # [mm] of a camera's pattern
NOTHING = slice(0)
EYE = np.eye(2)
BOARDS, SEED = 50, 2811  # of each kind; what draws them
KINDS_SHOWN = ("none", "one", "typical", "several", "usual", "field")

STOCK = replace(
    PUBLISHED,
    controller="stock",
    effects={},
    published=PublishedSettings(
        chain_sag_correction=tuned_numbers(PUBLISHED.effects)["chain_sag_correction"],
        chain_elasticity=ELASTICITY,
        holey_sled_weight=SLED,
    ),
)
HOLEY = replace(STOCK, controller="holey")
# What is fitted, in steps of about its usual size.
FRAME = {"motor_gap": 3.0, "motor_height": 10.0}
SCRIPT = {**FRAME, "rotation_radius": 3.0, "chain_sag_correction": 3.0}
HOLEY_FITS = {**FRAME, "left_tolerance": 0.1, "right_tolerance": 0.1}


def changed(settings: MachineSettings, numbers: Mapping[str, float]) -> MachineSettings:
    """Return settings with numbers of the frame, or of the published formulas, replaced."""
    frame: dict[str, Any] = {name: each for name, each in numbers.items() if name in FRAME_FIELDS}
    other = {name: value for name, value in numbers.items() if name not in FRAME_FIELDS}
    return replace(settings, **frame, published=replace(settings.published, **other))


def places_by(settings: MachineSettings, chains: Array) -> Array:
    """Return where a published formula believes its sled (n, 2) [mm], by Newton's method."""
    where = places(settings.as_plumb_model(), chains)[0]
    for _ in range(4):
        here = chain_lengths(settings, where)
        slopes = [(chain_lengths(settings, where + step) - here) / NUDGE for step in NUDGE * EYE]
        where = (
            where + np.linalg.solve(np.stack(slopes, axis=2), (chains - here)[..., None])[..., 0]
        )
    return where


Misses = Callable[[MachineSettings, Array], Array]  # [mm] by settings and other unknowns


@dataclass(frozen=True)
class Fitting:
    """Least squares: numbers of settings, and other unknowns that no setting keeps."""

    start: MachineSettings
    steps: Mapping[str, float]  # numbers that are fitted, with about their usual error
    misses: Misses
    others: int = 0

    def settings(self) -> MachineSettings:
        """Return the settings that fit best."""
        return self.best()[0]

    def best(self, left_out: slice = NOTHING) -> tuple[MachineSettings, Array]:
        """Return the settings that fit best and the other unknowns, some misses left out."""
        count = len(self.steps)

        def at(unknowns: Array) -> MachineSettings:
            numbers = {}
            for (name, step), size in zip(self.steps.items(), unknowns[:count], strict=True):
                holder = self.start if name in FRAME_FIELDS else self.start.published
                numbers[name] = getattr(holder, name) + step * float(size)
            return changed(self.start, numbers)

        def missed(unknowns: Array) -> Array:
            return np.delete(self.misses(at(unknowns), unknowns[count:]), left_out)

        found = least_squares(missed, np.zeros(count + self.others)).x
        return at(found), found[count:]


# The calibrations. Each cuts its pattern with a machine, and says how chains are paid out after it.


def as_bought(machine: TrueMachine, source: Source) -> Way:
    """Measure nothing."""
    return lambda wanted: chain_lengths(STOCK, wanted)


def triangular(machine: TrueMachine, source: Source) -> Way:
    """Fit height, radius, sag and the lower row's shift to two widths and the upper row's depth."""
    cuts = np.array([(x, y) for y in (ROW, -ROW) for x in (-COLUMN, COLUMN)])
    chains = chain_lengths(STOCK, cuts)
    where = seen(machine.read, chains, 0.0, source)
    apart = np.linalg.norm(where[[1, 3]] - where[[0, 2]], axis=1) + TAPE * source.normal(size=2)
    row = where[1, 1] + TAPE * source.normal()

    def misses(settings: MachineSettings, others: Array) -> Array:
        up = np.array([row, row - 2 * ROW + others[0]])
        here = chain_lengths(settings, np.stack([-apart / 2, up], axis=1))
        return np.ravel(here - chains[[0, 2]])

    steps = {"motor_height": 10.0, "rotation_radius": 3.0, "chain_sag_correction": 3.0}
    found = Fitting(STOCK, steps, misses, others=1).settings()
    if found.published.chain_sag_correction < 0:  # its program goes no lower, and gives up
        found = STOCK
    return lambda wanted: chain_lengths(found, wanted)


# Numbers of the holes between which distances are taped.
HOLE_PAIRS = np.transpose([(0, 1, 3, 4, 0, 1, 2, 1, 0, 2, 1), (1, 2, 4, 5, 3, 4, 5, 3, 4, 4, 5)])


def holey(machine: TrueMachine, source: Source) -> Way:
    """Fit spacing, height and two chains to eleven distances of six holes and one to the edge."""
    holes = np.array([(x, y) for y in (ROW, -ROW) for x in (-COLUMN, 0.0, COLUMN)])
    chains = chain_lengths(HOLEY, holes)

    def taped(where: Array) -> Array:
        return np.append(spans(where, HOLE_PAIRS), where[1, 1])

    by_tape = taped(seen(machine.read, chains, 0.0, source))
    by_tape = by_tape + TAPE * source.normal(size=len(by_tape))

    def misses(settings: MachineSettings, _: Array) -> Array:
        missed: Array = by_tape - taped(places_by(settings, chains))
        return missed

    found = Fitting(HOLEY, HOLEY_FITS, misses).settings()
    return lambda wanted: chain_lengths(found, wanted)


def by_script(machine: TrueMachine, source: Source) -> Way:
    """Fit spacing, height, radius, sag and where the sheet lies to nine marks."""
    targets = plan(*GRIDS[9]).targets
    chains = chain_lengths(STOCK, targets)
    where = seen(machine.read, chains, TAPE, source)
    found = Fitting(STOCK, SCRIPT, script_misses(chains, where), others=2).settings()
    return lambda wanted: chain_lengths(found, wanted)


def script_misses(chains: Array, where: Array) -> Misses:
    """Return misses of marks [mm], for a shift across [mm] and a turn [mrad], which the script
    fits as one motor's height.
    """

    def misses(settings: MachineSettings, others: Array) -> Array:
        believed = places_by(settings, chains)
        turned = believed @ (EYE + others[1] / 1000 * np.array([(0, 1), (-1, 0)]))
        return np.ravel(where - turned - np.array([others[0], 0.0]))

    return misses


def by_camera(machine: TrueMachine, source: Source) -> Array:
    """Return how far a camera sees the sled off the squares of a printed pattern (15, 31, 2)."""
    squares = np.array([(x, y) for y in UP for x in ACROSS])
    # The pattern is true, whatever the tape and the sheet's edges are.
    where = seen(machine.on_sheet, chain_lengths(STOCK, squares), CAMERA, source)
    return np.reshape(where - squares, (len(UP), len(ACROSS), 2))


def camera_curve(machine: TrueMachine, source: Source) -> Way:
    """Correct by six numbers for each axis, a quadratic, fitted to what a camera saw."""

    def powers(x: Array, y: Array) -> Array:
        return np.stack([x**0, x, y, x * y, x**2, y**2], axis=-1).reshape(-1, 6)

    errors = by_camera(machine, source).reshape(-1, 2)
    curve = np.linalg.lstsq(powers(*np.meshgrid(ACROSS, UP)), errors, rcond=None)[0]
    return lambda wanted: chain_lengths(STOCK, wanted - powers(*wanted.T) @ curve)


def camera_table(machine: TrueMachine, source: Source) -> Way:
    """Correct by what a camera saw at the nearest four squares."""
    table_of = RegularGridInterpolator((UP, ACROSS), by_camera(machine, source))

    def corrected(wanted: Array) -> Array:
        inside = np.clip(wanted, (ACROSS[0], UP[0]), (ACROSS[-1], UP[-1]))
        return chain_lengths(STOCK, wanted - table_of(inside[:, ::-1]))

    return corrected


def by_plumb(marks: int) -> Callable[[TrueMachine, Source], Way]:
    """Return `plumb calibrate` with so many marks."""

    def calibrated(machine: TrueMachine, source: Source) -> Way:
        layout = plan(*GRIDS[marks])
        board = measured(read(machine, layout, PUBLISHED), layout, source, TAPE, TAPE)
        addition = decide(Inputs(PUBLISHED, board)).addition
        settings = addition.settings if addition else PUBLISHED
        return lambda wanted: lengths(settings, wanted)[0]

    return calibrated


def seen(measured_by: Callable[..., Array], chains: Array, noise: float, source: Source) -> Array:
    """Return where the sled is seen (n, 2) [mm]; it comes from the left and the right in turns."""
    side = np.where(np.arange(len(chains)) % 2, 1.0, -1.0)
    approaches = np.stack([side, 0 * side], axis=1)
    where = measured_by(chains, approaches=approaches, weights=np.full(len(chains), SLED))
    return where + noise * source.normal(size=where.shape)


def spans(where: Array, pairs: Array) -> Array:
    """Return distances [mm] between places (n, 2)."""
    first, second = pairs.T
    apart: Array = np.linalg.norm(where[first] - where[second], axis=1)
    return apart


# Each with its name and how many numbers it reads.
CALIBRATIONS: tuple[tuple[str, int, Callable[[TrueMachine, Source], Way]], ...] = (
    ("as bought", 0, as_bought),
    ("published", 3, triangular),
    ("holey", 12, holey),
    ("refine script", 18, by_script),
    ("camera, curve", 930, camera_curve),
    ("camera, table", 930, camera_table),
    ("Plumb", 18, by_plumb(9)),
    ("Plumb", 50, by_plumb(25)),
)


def errors_on(kind: str) -> Array:
    """Return the sled's error over the sheet [mm RMS] (boards, calibrations)."""
    errors = np.zeros((BOARDS, len(CALIBRATIONS)))
    for i in range(BOARDS):
        machine = board_of(KINDS[f"stock/{kind}"], i, marks=25, seed=SEED).board.machine
        for j, (_, _, calibrate) in enumerate(CALIBRATIONS):
            way = calibrate(machine, np.random.default_rng([SEED, i, j]))
            errors[i, j] = shape_of(machine.sleds(way(sheet())))
    return errors


# Real sets: what a fit leaves, and how far a reading that took no part is off.


def on_real_set(board: RealSet) -> list[str]:
    """Return the cells of a set: errors [mm RMS] as set, and fitted / left out by the other
    calibration that takes such readings, and by Plumb.
    """
    name, fitting = of_holes(board) if board.inputs.measurements.distances else of_marks(board)
    after_fit = fitting.misses(*fitting.best())
    width = 1 if name == "holey" else 2
    readings = [slice(i, i + width) for i in range(0, len(after_fit), width)]
    left_out = [fitting.misses(*fitting.best(each))[each] for each in readings]
    theirs = [rms(np.reshape(each, (-1, width))) for each in (after_fit, left_out)]
    addition = board.decision.addition
    ours = (addition.after.fit_rms, addition.after.left_out_rms) if addition else None
    cells = [
        " / ".join(f"{error:.2f}" for error in errors) if errors else "stays as set"
        for errors in (theirs, ours)
    ]
    return [board.name, f"{board.raw.rms:.2f}", name, *cells]


def of_holes(board: RealSet) -> tuple[str, Fitting]:
    """Return holey calibration's fit to distances; none of them feels the height."""
    _, rows = board.inputs.model_and_observations()
    start = changed(board.inputs.settings, {"chain_elasticity": ELASTICITY})
    steps = {name: step for name, step in HOLEY_FITS.items() if name != "motor_height"}

    def misses(settings: MachineSettings, _: Array) -> Array:
        believed = spans(places_by(settings, rows.chains), rows.distance_rows)
        missed: Array = rows.distances - believed
        return missed

    return "holey", Fitting(replace(start, controller="holey"), steps, misses)


def of_marks(board: RealSet) -> tuple[str, Fitting]:
    """Return the script's fit to marks."""
    _, rows = board.inputs.model_and_observations()
    start = board.inputs.settings
    if start.controller == "plumb":
        said = PublishedSettings(**tuned_numbers(start.effects))
        start = replace(start, controller="stock", effects={}, published=said)
    misses = script_misses(rows.chains[rows.mark_rows], rows.measured)
    return "refine script", Fitting(start, SCRIPT, misses, others=2)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(prog="other_calibrations.py", description=__doc__)
    parser.add_argument("--jobs", type=int, default=1, help="processes at once [%(default)s]")
    asked = parser.parse_args(arguments)
    tasks = (delayed(errors_on)(kind) for kind in KINDS_SHOWN)
    means = np.array([errors.mean(axis=0) for errors in Parallel(n_jobs=asked.jobs)(tasks)])
    rows = [
        [name, str(count), *(f"{error:.2f}" for error in means[:, j])]
        for j, (name, count, _) in enumerate(CALIBRATIONS)
    ]
    print(table(("calibration", "readings", *KINDS_SHOWN), rows, gap=2), end="\n\n")
    boards = [*map(real_set, HOLES), *other_boards()]
    heads = ("set", "as set", "by", "fitted / left out", "Plumb")
    print(table(heads, [on_real_set(board) for board in boards], gap=2))


if __name__ == "__main__":
    main()
