"""The bench run through, and the tables of its rates next to the lines to be reached."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

import joblib  # type: ignore[import-untyped]  # it brings no types
import numpy as np
from pydantic import computed_field

from plumb.bench.judged_board import JudgedBoard, judge_board
from plumb.bench.outcome import JUDGED, Line, Outcome, Rate, rate_of
from plumb.bench.scenarios import CURE, LOOP, SCENARIOS, Scenario
from plumb.text.answers import Internal, Number, among, key

Progress = Callable[[str, int], None]  # called with each scenario and how many more boards are done
AT_ONCE = 4  # boards between two steps of the progress


@dataclass(frozen=True)
class Row(Rate):
    """One rate of one scenario; line and judged are None where there is nothing to reach."""

    scenario: str
    hidden: str
    marks: int
    noise: Annotated[float, key("noise_mm")]
    least: float | None
    most: float | None
    judged: Annotated[str | None, among((*JUDGED, None))]
    kind: Internal[Scenario]
    line: Internal[Line | None]


@dataclass(frozen=True)
class RateOfCause(Rate):
    """The share that was right of the boards with a cause."""

    scenario: str
    hidden: str


@dataclass(frozen=True)
class Cured:
    """Mean errors [mm] of the judge's sled over the sheet, over the boards of a scenario."""

    scenario: str
    boards: int
    before: Number
    frame: Number
    after: Number
    known: Number
    error: Annotated[Number, key("ratio_error")]
    # mean number of marks that were proposed and read
    readings: Annotated[float, key("readings_more")] = 0.0
    checks: float = 0.0  # mean number of direct measurements

    @computed_field(alias="ratio")
    @property
    def ratio_value(self) -> Number:
        """The ratio alone."""
        return self.ratio.value

    @property
    def ratio(self) -> Rate:
        """Error with what was named over that with the truth known."""
        return Rate(CURE.name, self.after / self.known, self.error, self.boards)


@dataclass(frozen=True)
class Report:
    """All rates."""

    rows: Annotated[tuple[Row, ...], key("rates")]
    by_kind: tuple[RateOfCause, ...]
    cures: Internal[tuple[Cured, ...]]  # the last is that of all boards together
    loops: Internal[tuple[Cured, ...]]  # the same after rounds of proposals
    boards: int  # of each scenario
    seed: int
    counted: int  # boards of all scenarios; fewer than asked for if the bench was interrupted
    interrupted: bool = False

    @property
    def missed(self) -> tuple[Row, ...]:
        """Rates that miss their lines by more than chance."""
        return tuple(row for row in self.rows if row.judged == "missed")

    @property
    def cure_judged(self) -> str:
        """How all cures together stand against their line; empty if none was measured."""
        return CURE.judge(self.cures[-1].ratio) if self.cures else ""

    @property
    def loop_judged(self) -> str:
        """The same after rounds of proposals."""
        return LOOP.judge(self.loops[-1].ratio) if self.loops else ""

    @computed_field
    @property
    def errors_mm(self) -> tuple[Cured, ...]:
        """Errors at the sled, before and after rounds of proposals."""
        return (*self.cures, *self.loops)

    @computed_field(alias="missed")
    @property
    def missed_words(self) -> list[str]:
        """The rates that miss their lines, in words."""
        return (
            [f"{row.scenario}: {row.name}" for row in self.missed]
            + ["error at the sled"] * (self.cure_judged == "missed")
            + ["error at the sled after two rounds"] * (self.loop_judged == "missed")
        )


def run(
    scenarios: Sequence[Scenario], *, boards: int, seed: int, progress: Progress, jobs: int = 1
) -> Report:
    """Diagnose boards of each scenario, in `jobs` programs at once.

    joblib carries the boards, so a backend that the caller sets (a Dask cluster) carries them too.
    An interruption keeps what is done; with nothing done it goes on up.
    """
    tasks = [
        (scenario.name, tuple(range(start, min(start + AT_ONCE, boards))), seed)
        for start in range(0, boards, AT_ONCE)
        for scenario in scenarios
    ]
    trials: dict[str, list[JudgedBoard]] = {scenario.name: [] for scenario in scenarios}
    interrupted = False
    try:
        parallel = joblib.Parallel(n_jobs=jobs, return_as="generator")
        done = parallel(joblib.delayed(_some)(task) for task in tasks)
        for (name, indices, _), trials_done in zip(tasks, done, strict=True):
            trials[name] += trials_done
            progress(name, len(indices))
    except KeyboardInterrupt:
        interrupted = True
        if not any(trials.values()):
            raise
    begun = [scenario for scenario in scenarios if trials[scenario.name]]
    return _report(begun, trials, boards, seed, interrupted=interrupted)


def _some(task: tuple[str, tuple[int, ...], int]) -> list[JudgedBoard]:
    """Return some boards of the scenario of a name."""
    name, indices, seed = task
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == name)
    return [judge_board(scenario, index, seed=seed) for index in indices]


def _report(
    scenarios: Sequence[Scenario],
    trials: Mapping[str, Sequence[JudgedBoard]],
    boards: int,
    seed: int,
    *,
    interrupted: bool,
) -> Report:
    rows: list[Row] = []
    kinds: list[RateOfCause] = []
    for scenario in scenarios:
        outcomes = [trial.outcome for trial in trials[scenario.name]]
        rows += rows_of(scenario, outcomes)
        kinds += _by_kind(scenario, outcomes)
    return Report(
        tuple(rows),
        tuple(kinds),
        _all_cured([each for each in scenarios if each.cured and not each.rounds], trials),
        _all_cured([each for each in scenarios if each.cured and each.rounds], trials),
        boards,
        seed,
        sum(map(len, trials.values())),
        interrupted,
    )


def rows_of(scenario: Scenario, outcomes: Sequence[Outcome]) -> list[Row]:
    """Return the rates of a scenario, those with a line first."""
    rows = []
    for line in scenario.lines:
        rate = rate_of(line.name, outcomes)
        rows.append(_row(scenario, rate, line))
    return rows + [_row(scenario, rate_of(name, outcomes), None) for name in scenario.shown]


def _row(scenario: Scenario, rate: Rate, line: Line | None) -> Row:
    """Return the rate, as it stands against its line."""
    return Row(
        **vars(rate),
        scenario=scenario.name,
        hidden=scenario.what,
        marks=scenario.marks,
        noise=scenario.noise,
        least=line.least if line else None,
        most=line.most if line else None,
        judged=line.judge(rate) if line else None,
        kind=scenario,
        line=line,
    )


def _by_kind(scenario: Scenario, outcomes: Sequence[Outcome]) -> list[RateOfCause]:
    """Return the first rate with a line, by what was hidden."""
    causes = dict.fromkeys(outcome.cause.partition(",")[0] for outcome in outcomes)
    if not scenario.lines or len(causes) < 2 or scenario.name.startswith("pairs"):
        return []
    rates = {
        cause: rate_of(
            scenario.lines[0].name,
            [outcome for outcome in outcomes if outcome.cause.partition(",")[0] == cause],
        )
        for cause in causes
    }
    return [
        RateOfCause(**vars(rate), scenario=scenario.name, hidden=cause)
        for cause, rate in rates.items()
    ]


def _all_cured(
    scenarios: Sequence[Scenario], trials: Mapping[str, Sequence[JudgedBoard]]
) -> tuple[Cured, ...]:
    """Return the errors at the sled of each scenario, and of all together where there are
    several.
    """
    each = [(scenario.name, trials[scenario.name]) for scenario in scenarios]
    if len(each) > 1:
        each.append(("all of these", [trial for _, of_scenario in each for trial in of_scenario]))
    return tuple(_cured(name, of_scenario) for name, of_scenario in each)


def _cured(name: str, trials: Sequence[JudgedBoard]) -> Cured:
    cures = [trial.cure for trial in trials if trial.cure]
    errors = np.array([(cure.before, cure.frame, cure.after, cure.known) for cure in cures])
    before, frame, after, known = errors.mean(axis=0).tolist()
    apart = errors[:, 2] - after / known * errors[:, 3]
    error = float(np.sqrt(np.sum(apart**2))) / (len(errors) * known)
    more = np.array([(trial.readings, trial.checks) for trial in trials]).mean(axis=0).tolist()
    return Cured(name, len(errors), before, frame, after, known, error, *more)


def value_words(rate: Rate) -> str:
    """Return a rate with its uncertainty."""
    if not rate.count:
        return "-"
    if rate.name in ("suspects", CURE.name):
        return f"{rate.value:.2f} +- {rate.error:.2f}"
    return f"{100 * rate.value:.1f} +- {100 * rate.error:.1f} %"


def line_words(line: Line | None) -> str:
    """Return a line to be reached."""
    if line is None:
        return ""
    if line.name in ("suspects", CURE.name):
        return line.words
    ends = [(">=", line.least), ("<=", line.most)]
    given = [f"{sign} {100 * end:g} %" for sign, end in ends if end is not None]
    return ", ".join(given)


HEADER = ("scenario", "hidden", "marks", "noise", "rate", "seen", "line", "")
CURE_HEADER = ("scenario", "boards", "before", "frame only", "after", "truth known", "ratio")
LOOP_HEADER = (*CURE_HEADER, "marks more", "checks")


def cells(report: Report) -> list[list[str]]:
    """Return the rows of the table."""
    return [
        [
            row.scenario,
            row.hidden,
            f"{row.marks}{' spans' if row.kind.spans else ''}",
            row.kind.noise_words,
            row.name,
            value_words(row),
            line_words(row.line),
            row.judged or "",
        ]
        for row in report.rows
    ]


def cure_cells(cures: Sequence[Cured]) -> list[list[str]]:
    """Return the rows of the table of errors at the sled."""
    return [
        [
            cured.scenario,
            str(cured.boards),
            *(f"{value:.2f} mm" for value in (cured.before, cured.frame, cured.after, cured.known)),
            value_words(cured.ratio),
        ]
        for cured in cures
    ]


def loop_cells(loops: Sequence[Cured]) -> list[list[str]]:
    """Return the same after rounds of proposals, with what was measured for it."""
    rows = cure_cells(loops)
    return [
        [*row, f"{cured.readings:.1f}", f"{cured.checks:.1f}"]
        for row, cured in zip(rows, loops, strict=True)
    ]
