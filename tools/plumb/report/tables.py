"""The report's tables: settings, rounds, readings, and where all of it is from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from plumb.diary.history import DiaryFit
from plumb.fit.compare import Comparison
from plumb.model.catalogue import parameter_words
from plumb.model.plain import plain_before, plain_size, ranked
from plumb.report.findings import Findings
from plumb.settings.toml import FitRecord
from plumb.text.values import bare, signed, worded

MOST_READINGS = 60  # rows; of more, those that are farthest off
PACKAGES = ("plumb", "numpy", "scipy", "matplotlib")


@dataclass(frozen=True)
class Setting:
    """A number of the machine, old and new."""

    said: str
    before: str
    name: str
    exact: str  # in house units, with its interval
    number: str  # of the machine's setting; empty if none holds it
    note: str


@dataclass(frozen=True)
class Round:
    """A stage in the history of the machine."""

    what: str
    rms: str
    percent: float  # of the largest


@dataclass(frozen=True)
class Reading:
    """A mark with its errors, or a distance."""

    name: str
    cells: tuple[str, ...]
    slipped: bool


@dataclass(frozen=True)
class Readings:
    """The marks, or the distances where there are none."""

    header: tuple[str, ...]
    rows: tuple[Reading, ...]
    left_out: int  # readings that are not shown


@dataclass(frozen=True)
class Source:
    """A file, and the fingerprint of what was read from it."""

    what: str
    name: str
    digest: str


def settings_of(findings: Findings) -> tuple[Setting, ...]:
    """Return each fitted number; none if nothing was fitted."""
    addition = findings.auto.addition
    if addition is None:
        return ()
    words = parameter_words()
    return tuple(
        Setting(
            said=plain_size(each.name, each.value, each.low, each.high),
            before=plain_before(each.name, each.before, each.low, each.high),
            name=each.name,
            exact=f"{each.value:.6g} {each.unit} ({each.low:.6g} to {each.high:.6g})",
            number=_number(words.get(each.name)),
            note="" if each.possible else "impossible",
        )
        for each in addition.parameters
        if not each.of_patch
    )


def _number(words: Mapping[str, object] | None) -> str:
    return f"${words['setting']}" if words and words["setting"] is not None else ""


def rounds_of(findings: Findings) -> tuple[Round, ...]:
    """Return the fits of the diary, or what the settings know of the last; then this round."""
    comparison = findings.comparison
    stages = _before_this(findings)
    stages += [
        (f"{part.name or 'marks'}{f', {part.date}' if part.date else ''}, as set", size)
        for part in comparison.rounds
        for size in (part.rms if part.rms is not None else part.distance_rms,)
        if size is not None
    ]
    stages.append(("These readings, as set", findings.as_set_rms))
    addition = findings.auto.addition
    if addition:
        stages.append(("With the new settings", addition.after.fit_rms))
        stages.append(("With the new settings, on marks not used", addition.after.left_out_rms))
    largest = max(max(size for _, size in stages), 1e-9)
    return tuple(Round(what, worded(size), 100 * size / largest) for what, size in stages)


def _before_this(findings: Findings) -> list[tuple[str, float]]:
    """Return the rounds that led to the settings."""
    record, promised = findings.inputs.settings.fitted, findings.comparison.promised
    earlier = findings.fits[:-1] if promised else findings.fits
    stages = [stage for fit in earlier for stage in _kept(fit)]
    if record and promised:
        what = f"Before these settings were fitted to {_boards(record)}"
        return [*stages, (what, record.start_rms)]
    return stages or (_earlier(record) if record else [])


def history_sentence(findings: Findings) -> str:
    """Return what the settings remember, and whether a promise was kept."""
    record, comparison = findings.inputs.settings.fitted, findings.comparison
    if record is None:
        return "The settings carry no record of an earlier fit: this is the first round."
    if comparison.promised:
        return "The settings were fitted to these same readings."
    return (
        f"The last fit promised {worded(record.left_out_rms)} RMS on marks not used; these lie "
        f"{worded(comparison.rms)} off; moving the whole sheet would leave "
        f"{worded(comparison.shape_rms)}."
        if comparison.shape_rms is not None
        else f"The last fit promised {worded(record.left_out_rms)} RMS on marks not used; these "
        f"lie {worded(comparison.rms)} off."
    )


def _earlier(record: FitRecord) -> list[tuple[str, float]]:
    boards = _boards(record)
    return [
        (f"{boards}, as set then", record.start_rms),
        (f"{boards}, fitted", record.rms),
        (f"{boards}, fitted, on marks not used", record.left_out_rms),
    ]


def _kept(fit: DiaryFit) -> list[tuple[str, float]]:
    """Return a fit of the diary."""
    readings = f"{fit.at:%Y-%m-%d}, {fit.count} readings"
    return [
        (f"{readings}, as set then", fit.before),
        (f"{readings}, fitted", fit.rms),
        (f"{readings}, fitted, on marks not used", fit.left_out),
    ]


def _boards(record: FitRecord) -> str:
    return ", ".join(board.marks for board in record.boards) or "earlier marks"


def readings_of(findings: Findings) -> Readings:
    """Return the marks with their errors as set and as fitted; the distances where there are no
    marks.
    """
    if not findings.comparison.marks:
        return _distances(findings.comparison)
    typed, slips = findings.inputs.measurements.typed, _slips(findings)
    order = range(len(findings.comparison.marks))
    shown = ranked(order, lambda i: -findings.comparison.marks[i].length)[:MOST_READINGS]
    rows = []
    for i in sorted(shown):
        mark, left = findings.comparison.marks[i], findings.framed
        cells = (
            *(bare(value, 1) for value in typed.place(mark.target)),
            *(bare(value, 1) for value in typed.place(mark.measured)),
            *(signed(value) for value in typed.shift(mark.error)),
            bare(float(np.hypot(*left.errors[i]))),
            *(signed(_known(value)) for value in left.chains[i]),
        )
        rows.append(Reading(mark.name, cells, mark.name in slips))
    header = (
        *("target x", "y", "measured x", "y", "error x", "y"),
        *("left by the frame", "left chain", "right chain"),
    )
    return Readings(header, tuple(rows), len(order) - len(rows))


def _known(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _distances(comparison: Comparison) -> Readings:
    worst = ranked(comparison.distances, lambda each: -abs(each.error))[:MOST_READINGS]
    rows = tuple(
        Reading(
            " - ".join(each.between),
            (bare(each.predicted), bare(each.measured), signed(each.error)),
            slipped=False,
        )
        for each in comparison.distances
        if each in worst
    )
    header = ("predicted", "measured", "error")
    return Readings(header, rows, len(comparison.distances) - len(rows))


def _slips(findings: Findings) -> set[str]:
    return {slip.name for slip in findings.diagnosis.outliers}


def sources_of(findings: Findings) -> tuple[Source, ...]:
    """Return the files with their fingerprints: of the settings' bytes, and of each file's
    readings.
    """
    inputs = findings.inputs
    files = [("settings", inputs.settings.file)]
    if inputs.cut_with:
        files.append(("cut with", inputs.cut_with.file))
    said = [Source(what, file.name, file.sha256) for what, file in files if file]
    rounds = [
        Source("marks", part.name or Path(inputs.measurements.source).name, part.digest)
        for part in inputs.measurements.rounds
    ]
    return (*said, *rounds)


def versions() -> str:
    """Return the programs that made the numbers."""
    return ", ".join(f"{name} {version(name)}" for name in PACKAGES)
