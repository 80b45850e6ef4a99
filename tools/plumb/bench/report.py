"""The bench run through: boards played side by side, and a row of rates for each kind."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import joblib  # type: ignore[import-untyped]  # it brings no types
import numpy as np

from plumb.bench.judged_board import JudgedBoard, judge_board
from plumb.bench.kinds import KINDS, Kind
from plumb.text.answers import Number, key

Progress = Callable[[str], None]  # called with the kind of each board that is done
AT_ONCE = 4  # boards of one kind that a process takes


@dataclass(frozen=True)
class WantedBoards:
    """The boards to play."""

    kinds: tuple[str, ...]
    boards: int  # of each kind
    marks: int
    seed: int
    noise: float | None = None  # [mm] of a coordinate; None: what the kind has
    is_stated: bool = True  # whether the file of marks says so

    def kind(self, name: str) -> Kind:
        """Return a kind, read with the noise that is wanted."""
        kind = KINDS[name]
        return replace(kind, noise=self.noise or kind.noise, is_stated=self.is_stated)


@dataclass(frozen=True)
class Promises:
    """The error over the sheet that was promised, and what came true; means over some boards."""

    boards: int
    promised: Annotated[Number, key("promised_mm")]
    came_true: Annotated[Number, key("came_true_mm")]


@dataclass(frozen=True)
class Row:
    """Rates over the boards of one kind: shares, and means per board."""

    kind: str
    hidden: str
    boards: int
    named: float
    exact: float
    holds: Annotated[float, key("truth_in_best")]
    needless: float
    unknown: Annotated[float, key("not_in_library")]
    readings: Annotated[float, key("readings_right")]
    before: Annotated[Number, key("before_mm")]
    after: Annotated[Number, key("after_mm")]
    fitted: Annotated[Number, key("truth_fitted_mm")]
    worse: float
    cpu: Annotated[float, key("cpu_s")]


@dataclass(frozen=True)
class Report:
    """All rates, and how to draw the same boards again."""

    rows: tuple[Row, ...]
    promises: Promises | None  # None: on no board was anything promised
    marks: int
    seed: int
    noise: Annotated[float | None, key("noise_mm", "Null: what each kind has.")]
    is_stated: Annotated[bool, key("noise_stated")]
    interrupted: bool


RATES = tuple(Row.__annotations__)[3:]


def play(
    wanted: WantedBoards,
    *,
    progress: Progress = lambda kind: None,
    jobs: int = 1,
) -> Report:
    """Play all boards, in `jobs` programs at once, and count.

    An interruption keeps what is done; with nothing done it goes on up.
    """
    tasks = [
        (kind, some)
        for some in np.array_split(np.arange(wanted.boards), -(-wanted.boards // AT_ONCE))
        for kind in wanted.kinds
    ]
    done: dict[str, list[JudgedBoard]] = {kind: [] for kind in wanted.kinds}
    interrupted = False
    try:
        # Boards fill the cores; threads of numpy would only queue for them.
        with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
            parallel = joblib.Parallel(n_jobs=jobs, return_as="generator")
            played = parallel(
                joblib.delayed(_some)(kind, some.tolist(), wanted) for kind, some in tasks
            )
            for judged in (each for several in played for each in several):
                done[judged.kind].append(judged)
                progress(judged.kind)
    except KeyboardInterrupt:
        interrupted = True
        if not any(done.values()):
            raise
    rows = tuple(row_of(kind, boards) for kind, boards in done.items() if boards)
    every = [each for boards in done.values() for each in boards]
    return Report(
        rows=rows,
        promises=_promises(every),
        marks=wanted.marks,
        seed=wanted.seed,
        noise=wanted.noise,
        is_stated=wanted.is_stated,
        interrupted=interrupted,
    )


def _promises(boards: Sequence[JudgedBoard]) -> Promises | None:
    both = [(each.promised, each.after) for each in boards if each.promised is not None]
    return Promises(len(both), *np.mean(both, axis=0).tolist()) if both else None


def _some(kind: str, indices: Sequence[int], wanted: WantedBoards) -> list[JudgedBoard]:
    return [
        judge_board(wanted.kind(kind), each, marks=wanted.marks, seed=wanted.seed)
        for each in indices
    ]


def row_of(kind: str, boards: Sequence[JudgedBoard]) -> Row:
    """Return the rates of one kind."""
    means = {name: float(np.mean([getattr(each, name) for each in boards])) for name in RATES}
    return Row(kind, KINDS[kind].what, len(boards), **means)
