"""One board of a scenario: made, diagnosed, and judged."""

from __future__ import annotations

from dataclasses import dataclass
from zlib import crc32

import numpy as np

from plumb.bench.boards import cut
from plumb.bench.cure import Cure, cure_of
from plumb.bench.hiding import slip
from plumb.bench.outcome import Outcome, look_alikes, outcome_of
from plumb.bench.scenarios import Scenario
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs

MOST_ALIKE = 3  # causes of a board whose look-alikes are asked for
LARGE_SLIP = 10.0  # [mm]
SEEDS = 1_000_003  # boards of one seed before those of the next


@dataclass(frozen=True)
class JudgedBoard:
    """What came of a board."""

    outcome: Outcome
    cure: Cure | None  # where the sled was measured too


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
    diagnosis = diagnose(Inputs(scenario.settings, board.measurements))
    alike = frozenset[str]().union(
        *(look_alikes(*cause, plan, scenario.noise) for cause in hidden.causes[:MOST_ALIKE])
    )
    cure = None
    if scenario.cured:
        cure = cure_of(
            board, diagnosis.to_add, sigma=diagnosis.noise.sigma, settings=scenario.settings
        )
    small = kind is not None and kind.millimetres < LARGE_SLIP
    outcome = outcome_of(diagnosis, board, alike=alike, slipped=slipped, small_slip=small)
    return JudgedBoard(outcome, cure)
