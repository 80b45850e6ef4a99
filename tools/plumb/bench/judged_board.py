"""One board of a scenario: made, diagnosed, and judged."""

from __future__ import annotations

from dataclasses import dataclass
from zlib import crc32

import numpy as np

from plumb.bench.boards import cut
from plumb.bench.cure import Cure, cure_of
from plumb.bench.hiding import slip
from plumb.bench.loop import followed
from plumb.bench.outcome import Outcome, look_alikes, outcome_of
from plumb.bench.owner import BoardOwner
from plumb.bench.scenarios import Scenario

MOST_ALIKE = 3  # causes of a board whose look-alikes are asked for
LARGE_SLIP = 10.0  # [mm]
SEEDS = 1_000_003  # boards of one seed before those of the next


@dataclass(frozen=True)
class JudgedBoard:
    """What came of a board."""

    outcome: Outcome
    cure: Cure | None  # where the sled was measured too
    readings: int = 0  # of marks that were proposed, beyond those of the board
    checks: int = 0  # numbers that were measured directly


def judge_board(scenario: Scenario, index: int, *, seed: int) -> JudgedBoard:
    """Board number `index` of a scenario."""
    plan = scenario.plan
    hidden = scenario.hide(index, plan)
    # Each scenario draws by itself, or one odd board would show in all of them.
    number = SEEDS * seed + crc32(scenario.name.encode()) + index
    board = cut(
        hidden,
        plan,
        seed=number,
        noise=scenario.noise,
        tape_sigma=scenario.stated,
        settings=scenario.settings,
    )
    slipped: tuple[str, ...] = ()
    kind = scenario.slips[index % len(scenario.slips)] if scenario.slips else None
    if kind:
        board, slipped = slip(board, kind, np.random.default_rng(number + 17))
    owner = BoardOwner(np.random.default_rng(number + 29), scenario.noise)
    loop = followed(board, scenario.settings, owner, rounds=scenario.rounds)
    board, diagnosis = loop.board, loop.diagnosis
    alike = frozenset[str]().union(
        *(look_alikes(*cause, plan, scenario.noise) for cause in hidden.causes[:MOST_ALIKE])
    )
    cure = None
    if scenario.cured:
        inputs, sigma = loop.inputs(scenario.settings), diagnosis.noise.sigma
        cure = cure_of(board.machine, inputs, diagnosis.to_add, sigma=sigma)
    small = kind is not None and kind.millimetres < LARGE_SLIP
    outcome = outcome_of(diagnosis, board, alike=alike, slipped=slipped, small_slip=small)
    return JudgedBoard(outcome, cure, loop.readings, len(loop.checked))
