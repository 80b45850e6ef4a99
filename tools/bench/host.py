"""Times on the computer at hand: the kinematics by a C++ loop, the lab's work by Python."""

import json
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from board import BENCH, BUILD, INCLUDES, sources
from commands import compiled, output
from plan_times import plan_times
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.diagnosis import diagnose
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import read_marks
from plumb.model import predict
from plumb.settings.files import read_settings

EXAMPLE = BENCH.parent / "plumb/examples/mibproj"
ROUNDS = 7  # the best of these counts in a record


def measure(rounds: int) -> tuple[dict[str, float], float]:
    """Return times [ns] by name, the best of some rounds, and the time of one multiply-add [ns] on
    the same computer.
    """
    program = BUILD / "host_times"
    options = ["-O2", "-ffp-contract=off", *INCLUDES]
    compiled(program, sources("host_times.cpp"), options=options)
    times = json.loads(output(program))
    unit = times.pop("multiply-add")
    return {**times, **lab_times(rounds)}, unit


def lab_times(rounds: int) -> dict[str, float]:
    """Return the lab's work, on the example of nine marks and on a hundred places [ns]."""
    settings = read_settings(EXAMPLE / "groundcontrol.ini", known=predict.known_effects())
    sheet = (settings.sheet_width, settings.sheet_height)
    marks = read_marks(EXAMPLE / "Calibration Measurements.ini", sheet=sheet)
    rows = observe(settings, marks)
    x, y = np.meshgrid(np.linspace(-1200, 1200, 10), np.linspace(-600, 600, 10))
    places = np.stack([x.ravel(), y.ravel()], axis=1)
    values = predict.values_of(settings)
    chains, _ = predict.lengths(settings, places)
    board = cut(Hidden(((causes_of("chain_pitch")[0], 1.5),)), plan(6, 6), seed=1).measurements
    best = partial(best_of, rounds)
    return {
        "lab: verdict on 36 marks, the whole library": best(lambda: diagnose(Inputs(MAKER, board))),
        "lab: lengths of 100 places": best(lambda: predict.lengths(settings, places)),
        "lab: exact slopes of 100 places": best(
            lambda: predict.places_with_slopes(values, over_top=True, chains=chains)
        ),
        f"lab: fit of {len(rows.measured)} marks, frame alone": best(lambda: fit(settings, rows)),
        f"lab: fit of {len(rows.measured)} marks, with sag and stretch": best(
            lambda: fit(settings, rows, effects=["chain_sag", "chain_stretch"])
        ),
        **plan_times(partial(best_of, min(rounds, 2))),
    }


def best_of(rounds: int, work: Callable[[], object]) -> float:
    """Nanoseconds of the fastest of some rounds."""
    taken = []
    for _ in range(rounds):
        start = time.perf_counter_ns()
        work()
        taken.append(time.perf_counter_ns() - start)
    return float(min(taken))
