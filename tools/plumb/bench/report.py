"""The bench run through: boards played side by side, and a row of rates for each kind."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import joblib  # type: ignore[import-untyped]  # it brings no types
import numpy as np

from plumb.bench.judged_board import JudgedBoard, judge_board
from plumb.bench.kinds import KINDS
from plumb.text.answers import Number, key
from plumb.text.errors import InputError

Progress = Callable[[str], None]  # called with the kind of each board that is done
Boards = dict[tuple[str, int], JudgedBoard]
SURE = 2.0  # standard errors by which a rate must change to be called another
LEAST = 1e-3
CPU = "cpu"  # no rate of the diagnosis: it hangs on the computer too
AT_ONCE = 4  # boards of a kind that a process takes


@dataclass(frozen=True)
class Wanted:
    """Which boards are played."""

    kinds: tuple[str, ...]
    boards: int  # of each kind
    marks: int
    seed: int
    rounds: int = 0  # of what `plumb next` proposes


@dataclass(frozen=True)
class Row:
    """Rates over the boards of a kind: shares, and means a board."""

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
class Change:
    """A rate that is not as it was on the same boards, by more than chance."""

    kind: str
    rate: str
    boards: int
    was: float
    now: float
    error: float  # standard error of the difference


@dataclass(frozen=True)
class Report:
    """All rates, and how to draw the same boards again."""

    rows: tuple[Row, ...]
    marks: int
    seed: int
    rounds: int
    changes: tuple[Change, ...] = ()  # against boards that were played before
    interrupted: bool = False


RATES = tuple(Row.__annotations__)[3:]


def play(
    wanted: Wanted,
    *,
    progress: Progress = lambda kind: None,
    jobs: int = 1,
    file: Path | None = None,
    against: Path | None = None,
    cluster: str = "",
) -> Report:
    """Play all boards, in `jobs` programs at once or on a Dask cluster, and count.

    Boards that `file` has are not played again; it gets those that are. `against` has the same
    boards as they were judged before. An interruption keeps what is done; with nothing done it goes
    on up.
    """
    if against and not against.exists():
        raise InputError(against, "there is no such file")
    old, done = _saved(against, wanted), _saved(file, wanted)
    tasks = [
        (kind, [index for index in some if (kind, index) not in done])
        for some in np.array_split(np.arange(wanted.boards), -(-wanted.boards // AT_ONCE))
        for kind in wanted.kinds
    ]
    interrupted = False
    try:
        with _handed_out(cluster):
            parallel = joblib.Parallel(n_jobs=-1 if cluster else jobs, return_as="generator")
            played = parallel(
                joblib.delayed(_some)(kind, [int(index) for index in some], wanted)
                for kind, some in tasks
                if len(some)
            )
            for judged in (each for several in played for each in several):
                done[judged.kind, judged.index] = judged
                _save(file, wanted, judged)
                progress(judged.kind)
    except KeyboardInterrupt:
        interrupted = True
        if not done:
            raise
    begun = {kind: [done[each] for each in done if each[0] == kind] for kind in wanted.kinds}
    return Report(
        tuple(row_of(kind, boards) for kind, boards in begun.items() if boards),
        wanted.marks,
        wanted.seed,
        wanted.rounds,
        tuple(each for kind in wanted.kinds for each in _changes(kind, old, done)),
        interrupted,
    )


def _some(kind: str, indices: Sequence[int], wanted: Wanted) -> list[JudgedBoard]:
    how = {"marks": wanted.marks, "seed": wanted.seed, "rounds": wanted.rounds}
    return [judge_board(kind, index, **how) for index in indices]


@contextmanager
def _handed_out(cluster: str) -> Iterator[None]:
    """Let joblib hand boards to programs beside this, or to the workers of a Dask cluster."""
    if not cluster:
        # Boards fill the cores; threads of numpy would only queue for them.
        with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
            yield
        return
    try:
        from distributed import Client
    except ModuleNotFoundError:
        raise InputError("--cluster needs Dask: pip install 'plumb[cluster]'") from None
    try:
        client = Client(cluster, timeout=10)  # type: ignore[no-untyped-call]  # it has no types
    except (OSError, ValueError) as error:
        raise InputError(f"--cluster {cluster}: {error}") from None
    with client, joblib.parallel_config(backend="dask"):
        yield


def row_of(kind: str, boards: Sequence[JudgedBoard]) -> Row:
    """Return the rates of a kind."""
    means = {name: float(np.mean([getattr(each, name) for each in boards])) for name in RATES}
    return Row(kind, KINDS[kind].what, len(boards), **means)


def _changes(kind: str, old: Boards, new: Boards) -> Iterator[Change]:
    """Yield what changed on boards of a kind that were played twice."""
    both = [(old[each], new[each]) for each in new if each[0] == kind and each in old]
    for rate in RATES:
        pairs = np.array([[getattr(board, rate) for board in pair] for pair in both], dtype=float)
        if rate == CPU or not len(pairs):
            continue
        apart = pairs[:, 1] - pairs[:, 0]
        error = float(np.std(apart)) / np.sqrt(len(apart))
        if abs(np.mean(apart)) > max(SURE * error, LEAST):
            was, now = np.mean(pairs, axis=0).tolist()
            yield Change(kind, rate, len(pairs), was, now, error)


# Boards in a file: a line of JSON each, with what they were drawn from.


def _drawn_from(wanted: Wanted) -> dict[str, int]:
    return {"marks": wanted.marks, "seed": wanted.seed, "rounds": wanted.rounds}


def _saved(file: Path | None, wanted: Wanted) -> Boards:
    """Return the boards of a file that are wanted."""
    boards: Boards = {}
    if not file or not file.exists():
        return boards
    for number, line in enumerate(file.read_text("utf-8").splitlines(), 1):
        try:
            words: Mapping[str, Any] = json.loads(line)
            drawn_from = {name: words[name] for name in _drawn_from(wanted)}
            board = JudgedBoard(**{name: words[name] for name in words if name not in drawn_from})
        except (ValueError, KeyError, TypeError):
            raise InputError(file, f"line {number} is no board of the bench") from None
        is_wanted = board.kind in wanted.kinds and board.index < wanted.boards
        if is_wanted and drawn_from == _drawn_from(wanted):
            boards[board.kind, board.index] = board
    return boards


def _save(file: Path | None, wanted: Wanted, board: JudgedBoard) -> None:
    if file:
        with file.open("a", encoding="utf-8") as out:
            out.write(json.dumps({**_drawn_from(wanted), **asdict(board)}) + "\n")
