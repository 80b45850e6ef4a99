"""Boards diagnosed, cured, and compared with what is hidden in them."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import joblib  # type: ignore[import-untyped]  # it brings no types
import numpy as np
from kinds import KINDS, SMALLEST, HiddenBoard, Kind, board_of
from plumb.cure.decision import decide
from plumb.diagnosis import Diagnosis, diagnose
from plumb.fit.fit import PRIORS, Problem, fit
from plumb.fit.inputs import Inputs
from plumb.hidden import Hidden, read, shape_error
from plumb.model.catalogue import effect_names, parameter_names
from plumb.model.predict import Array
from plumb.settings import MachineSettings

# Hidden effects that the marks of a board can show, without any noise.


ALIKE = 0.98  # |cosine| after the refit above which two causes draw the same arrows
LEAST_GAIN, GAIN_PER_PARAMETER = 9.0, 2.0  # of chi-square, from which marks can show an effect
LEAST = 1e-5  # share of a column's length below which its rest is rounding
FRAME = "frame"


@dataclass(frozen=True)
class Truth:
    """Knowledge that a diagnosis could have."""

    effects: tuple[str, ...]  # that were hidden
    usual: tuple[str, ...]  # what else the machine has and the settings leave out
    gains: Mapping[str, float]  # of chi-square by each effect, beyond the frame and all others
    alike: Mapping[str, frozenset[str]]  # effects that draw the same arrows as each alone

    def shows(self, effect: str) -> bool:
        """Return whether the marks can show an effect that is there."""
        return self.gains[effect] >= LEAST_GAIN + GAIN_PER_PARAMETER * len(parameter_names(effect))

    @property
    def allowed(self) -> frozenset[str]:
        """Effects that may be named: all that are there, and look-alikes that the marks show."""
        shown = [name for name in self.usual if self.shows(name)]
        alike = (self.alike[name] for name in (*self.effects, *shown))
        return frozenset[str]().union(self.effects, self.usual, *alike)

    def is_held_by(self, named: set[str]) -> bool:
        """Return whether these have all hidden effects that the marks can show, or look-alikes."""
        return all(named & {name, *self.alike[name]} for name in self.effects if self.shows(name))


def truth_of(board: HiddenBoard) -> Truth:
    """Return what is hidden in a board, and what of it its marks can show."""
    hidden = board.hidden
    several = {cause.effect: (cause, size) for cause, size in (*hidden.usual, *hidden.causes)}
    usual = tuple(dict.fromkeys(cause.effect for cause, _ in hidden.usual))
    slopes, gains, alike = _slopes(board), {}, {}
    for name, cause in several.items():
        drawn = [slopes[other] for other in several if other != name]
        moved = _moved(board, hidden, _without(hidden, name), len(slopes[FRAME]))
        left = _beyond(moved, np.hstack([slopes[FRAME], *drawn]))
        gains[name] = float(left @ left)
        alone = _moved(board, Hidden((cause,)), Hidden(), len(slopes[FRAME]))
        left = _beyond(alone, slopes[FRAME])
        alike[name] = frozenset(
            other
            for other in effect_names()
            if other != name and _cosine(left, slopes[other], slopes[FRAME]) > ALIKE
        )
    return Truth(hidden.effects, usual, gains, alike)


def _without(hidden: Hidden, effect: str) -> Hidden:
    """Return what is left to hide without an effect."""
    causes, usual = (
        tuple(each for each in several if each[0].effect != effect)
        for several in (hidden.causes, hidden.usual)
    )
    return replace(hidden, causes=causes, usual=usual)


def _slopes(board: HiddenBoard) -> dict[str, Array]:
    """Return the slopes of readings and priors, whitened, by the frame and by each effect."""
    inputs = Inputs(board.kind.settings, board.board.measurements)
    model, rows = inputs.model_and_observations()
    problem = Problem.of(model, rows, effect_names(), PRIORS, board.kind.noise)
    at = problem.at(np.zeros(len(problem.names)))
    if at is None:
        raise ValueError("with these settings the sled cannot hang where the marks were sent")
    columns = {FRAME: at.slopes[:, problem.held]}
    for effect in effect_names():
        names = parameter_names(effect)
        columns[effect] = at.slopes[:, [problem.names.index(name) for name in names]]
    return columns


def _moved(board: HiddenBoard, there: Hidden, without: Hidden, rows: int) -> Array:
    """Return how far the readings are moved by what is not in both, whitened; by the judge."""
    with_it, bare = (
        read(replace(board.board.machine, hidden=each), board.plan, board.kind.settings)
        for each in (there, without)
    )
    order = [*range(len(bare)), *board.plan.again]
    moved = np.zeros(rows)
    moved[: 2 * len(order)] = (with_it - bare)[order].ravel() / board.kind.noise
    return moved


def _beyond(columns: Array, fitted: Array) -> Array:
    """Return columns without what fitted columns can imitate."""
    basis = _basis(fitted, fitted)
    beyond: Array = columns - basis @ (basis.T @ columns)
    return beyond


def _cosine(left: Array, effect: Array, frame: Array) -> float:
    """Return the cosine of the angle between what a cause leaves and the nearest of an effect."""
    if not np.any(effect):
        return 0.0
    basis = _basis(_beyond(effect, frame), effect)
    return float(np.linalg.norm(basis.T @ left)) / max(float(np.linalg.norm(left)), 1e-9)


def _basis(columns: Array, against: Array) -> Array:
    """Return an orthonormal basis; what is tiny against the columns `against` is rounding."""
    lengths = np.linalg.norm(against, axis=0)
    felt = columns[:, lengths > 0] / lengths[lengths > 0]
    left, sizes, _ = np.linalg.svd(felt, full_matrices=False)
    return np.asarray(left[:, sizes > LEAST])


# One board: made, diagnosed, cured, and compared with what is hidden in it.


NAMED = ("one_suspect", "cannot_tell")
WORSE = 0.05  # [mm] by which the error must grow to be called worse


@dataclass(frozen=True)
class JudgedBoard:
    """A board, what was said of it, and what the sled is worth with what was written."""

    kind: str
    index: int
    effects: tuple[str, ...]  # hidden
    verdict: str
    said: tuple[str, ...]  # effects named in the first explanation
    outliers: tuple[str, ...]  # readings set aside
    named: bool  # an effect is named
    exact: bool  # named is all that the marks can show, and nothing that is not there
    holds: bool  # the best explanation has all that the marks can show
    needless: int  # effects named that are not there
    unknown: bool  # it is said that the machine does what the library does not know
    readings: bool  # the readings set aside are those that are wrong
    # RMS [mm] of the shape of the sled's errors all over the sheet:
    before: float  # by the settings as they were
    after: float  # by those that `plumb add --effect auto` leaves
    fitted: float  # by a fit of what is there
    worse: bool
    promised: float | None  # that the sled errs then [mm]; None: nothing is promised
    cpu: float  # [s] of diagnosing and adding


def judge_board(kind: Kind, index: int, *, marks: int, seed: int) -> JudgedBoard:
    """Return the result of board number `index` of one kind."""
    hidden = board_of(kind, index, marks=marks, seed=seed)
    settings, truth = hidden.kind.settings, truth_of(hidden)
    inputs = Inputs(settings, hidden.board.measurements)
    start = time.process_time()
    diagnosis = diagnose(inputs)
    decision = decide(inputs, diagnosis=diagnosis)
    cpu = time.process_time() - start
    best = set(diagnosis.explanations[0].effects) if diagnosis.explanations else set[str]()
    said = best if diagnosis.verdict in NAMED or diagnosis.is_finding else set[str]()
    outliers = tuple(outlier.name for outlier in diagnosis.outliers)
    sleds = hidden.board.machine.sleds
    before = shape_error(settings, sleds)
    addition = decision.addition
    after = shape_error(addition.settings, sleds) if addition else before
    return JudgedBoard(
        kind=kind.name,
        index=index,
        effects=truth.effects,
        verdict=diagnosis.verdict,
        said=tuple(sorted(said)),
        outliers=outliers,
        named=bool(said),
        exact=truth.is_held_by(said) and said <= truth.allowed,
        holds=truth.is_held_by(best),
        needless=len(said - truth.allowed),
        unknown=diagnosis.verdict == "not_in_library",
        readings=set(outliers) == set(hidden.slipped),
        before=before,
        after=after,
        fitted=shape_error(_with_what_is_there(inputs, diagnosis, truth), sleds),
        worse=after > before + WORSE,
        promised=decision.expected_mm,
        cpu=cpu,
    )


def _with_what_is_there(inputs: Inputs, diagnosis: Diagnosis, truth: Truth) -> MachineSettings:
    """Return the settings with the frame and all that is there fitted, as `plumb add` does it."""
    usual = (name for name in truth.usual if name != SMALLEST)
    there = tuple(dict.fromkeys([*usual, *truth.effects]))
    model, rows = inputs.model_and_observations()
    return fit(model, rows, effects=there, sigma=diagnosis.noise.sigma).settings


# Boards played side by side, and a row of rates for each kind.


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
    promised: float
    came_true: float


@dataclass(frozen=True)
class Row:
    """Rates over the boards of one kind: shares, and means per board."""

    kind: str
    hidden: str
    boards: int
    named: float
    exact: float
    holds: float
    needless: float
    unknown: float
    readings: float
    before: float
    after: float
    fitted: float
    worse: float
    cpu: float


@dataclass(frozen=True)
class Report:
    """All rates, and how to draw the same boards again."""

    rows: tuple[Row, ...]
    promises: Promises | None  # None: on no board was anything promised
    marks: int
    seed: int
    noise: float | None
    is_stated: bool
    interrupted: bool


RATES = tuple(Row.__annotations__)[3:]


def play(wanted: WantedBoards, *, progress: Progress = lambda kind: None, jobs: int = 1) -> Report:
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
