"""A round more on boards of the gates, and real sets: what was promised, and what came of it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any
from zlib import crc32

import numpy as np
from gate_boards import HiddenBoard, board_of
from gate_kinds import KINDS
from gate_records import FAILURES, SMALL, Truth, truth_of
from plumb.bench.boards import BoardCut
from plumb.bench.judged_board import BoardOwner, refitted, shape_error
from plumb.cure.add import add
from plumb.cure.auto import add_auto
from plumb.cure.machine_file import MARKS, SETTINGS, with_y_errors_flipped
from plumb.diagnosis import Diagnosis, Inputs, diagnose
from plumb.marks.read import join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.plan import Proposal, propose
from plumb.settings.files import read_settings
from real_sets import BRACKETS, CUTS, HOLES, RealSet, predicted, real_set

# Boards on which something is asked for next, in turns.
ASKED = (
    "known/one-9",
    "stock/usual-one-25",
    "known/typical-9",
    "stock/typical-25",
    "known/prior-15",
    "stock/prior-25",
    "known/two-25",
    "stock/one-9",
)
PROMISED = ("settle", "confirm")  # questions whose chance is that the truth is left alone
OWNER = 29  # of seeds


@dataclass
class Round:
    """A proposal that was carried out, and what the next diagnosis said."""

    kind: str
    index: int
    title: str
    option: str
    question: str
    chance: float | None
    is_best: bool  # the first that can be carried out
    has_checks: bool
    minutes: float
    is_settled: bool = False  # on the truth alone
    verdict: str = "failed"
    effects: list[str] = field(default_factory=list)  # of the first explanation
    cure: dict[str, float] = field(default_factory=dict)
    seconds: float = 0.0  # of CPU for all proposals of the board

    @property
    def is_promised(self) -> bool:
        """Whether its chance is that of a settled question."""
        return self.chance is not None and self.question in PROMISED


def rounds_of(kind: str, index: int, seed: int) -> list[dict[str, Any]]:
    """Return what came of the best proposal for a board, and of another."""
    hidden = board_of(KINDS[kind], index, seed=seed)
    if hidden.hidden.outside or hidden.slipped:
        return []
    settings, truth = hidden.kind.settings, truth_of(hidden)
    inputs = Inputs(settings, hidden.board.measurements)
    source = np.random.default_rng([seed, crc32(kind.encode()), index, OWNER])
    owner = BoardOwner(source, hidden.kind.noise)
    start = time.process_time()
    try:
        proposals = propose(diagnose(inputs), inputs).proposals
    except FAILURES:
        return []
    seconds = time.process_time() - start
    rounds: list[dict[str, Any]] = []
    for proposal, board in _chosen(proposals, hidden.board, owner):
        checked = tuple(owner.checked(board, proposal.checks))
        more = Inputs(settings, board.measurements, checked=checked)
        said = Round(
            kind,
            index,
            proposal.title,
            proposal.kind,
            proposal.question,
            proposal.chance,
            is_best=not rounds,
            has_checks=bool(proposal.checks),
            minutes=proposal.minutes,
            seconds=seconds,
        )
        _write_answer(said, more, truth, replace(hidden, board=board))
        rounds.append(asdict(said))
    return rounds


def _chosen(
    proposals: Sequence[Proposal], board: BoardCut, owner: BoardOwner
) -> Iterator[tuple[Proposal, BoardCut]]:
    """Yield the best proposal that can be carried out, then another by chance, each with the board
    after it.
    """
    order = [0, *(1 + owner.source.permutation(max(len(proposals) - 1, 0))).tolist()]
    done = 0
    for place in order[: len(proposals)]:
        visits = proposals[place].option.visits
        if not len(visits) and not proposals[place].checks:
            continue
        try:
            more = owner.with_marks(board, visits)
        except ValueError:
            continue
        yield proposals[place], more
        done += 1
        if done == 2:
            return


def _write_answer(said: Round, inputs: Inputs, truth: Truth, hidden: HiddenBoard) -> None:
    """Write down what is said after a round, and what the sled is worth then."""
    try:
        diagnosis = diagnose(inputs)
    except FAILURES:
        return
    said.verdict = diagnosis.verdict
    said.effects = list(diagnosis.explanations[0].effects) if diagnosis.explanations else []
    said.is_settled = is_settled(diagnosis, truth)
    usual = [name for name in truth.usual if name != SMALL]
    there = tuple(dict.fromkeys([*usual, *truth.effects]))
    said.cure = {
        name: shape_error(hidden.board.machine, refitted(inputs, effects, diagnosis.noise.sigma))
        for name, effects in (("after", diagnosis.to_add), ("known", there))
    }


def is_settled(diagnosis: Diagnosis, truth: Truth) -> bool:
    """Return whether a single explanation is left, which has all that could be shown and nothing
    that is not there; after a round a look-alike is no excuse.
    """
    if diagnosis.verdict != "one_suspect" or not diagnosis.explanations:
        return False
    effects = set(diagnosis.explanations[0].effects)
    return set(truth.provable) <= effects <= {*truth.effects, *truth.usual}


# Real sets: what is added by itself, and how well that predicts what was left out.


@dataclass
class RealAnswer:
    """What the lab makes of a published set, or of several together."""

    name: str
    verdict: str
    chosen: list[str]  # effects that were added
    fit: float  # [mm] RMS
    left_out: float  # [mm] RMS of readings that a fit did not see
    predicted: dict[str, float]  # [mm] RMS of other sets of the machine
    seconds: float  # of CPU for the diagnosis


def real_answers() -> list[dict[str, Any]]:
    """Return what is made of each set in examples/, and of the holes one after the other."""
    holes = [real_set(name) for name in HOLES]
    cuts = real_set(CUTS)
    answers = [_answer(each, [*holes, cuts]) for each in holes]
    for count in range(2, len(holes) + 1):
        marks = join_measurements([each.marks for each in holes[:count]])
        several = RealSet(f"the first {count} of these", holes[0].settings, marks)
        answers.append(_answer(several, [*holes[count:], cuts]))
    answers += [_answer(each) for each in _other_sets()]
    return [asdict(each) for each in answers]


def _other_sets() -> Iterator[RealSet]:
    settings = read_settings(SETTINGS, known=known_effects())
    nine = RealSet("mibproj", settings, read_marks(MARKS, sheet=settings.sheet))
    yield nine
    yield RealSet("mibproj, y the other way", settings, with_y_errors_flipped(nine.marks))
    yield real_set("c0depr1sm-2019-01-03", "marks.csv", "machine.toml")
    for name in BRACKETS:
        yield real_set(name, "squares.toml", "as-triangular.ini")


def _answer(board: RealSet, others: Sequence[RealSet] = ()) -> RealAnswer:
    inputs = Inputs(board.settings, board.marks)
    start = time.process_time()
    diagnosis = diagnose(inputs)
    seconds = time.process_time() - start
    auto = add_auto(inputs, diagnosis=diagnosis)
    # Where a reading is wrong nothing is added; the frame is what is left then.
    addition = auto.addition or add(inputs, effects=())
    return RealAnswer(
        name=board.name,
        verdict=diagnosis.verdict,
        chosen=list(auto.chosen),
        fit=addition.after.fit_rms,
        left_out=addition.after.left_out_rms,
        predicted={
            other.name: predicted(addition.settings, other).rms
            for other in others
            if other.name != board.name
        },
        seconds=seconds,
    )
