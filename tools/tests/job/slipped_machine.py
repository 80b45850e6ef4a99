"""Machines of the judge that their owner has calibrated, and what he touches after a mishap."""

from functools import cache

import numpy as np
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER
from plumb.bench.hiding import as_bought, usual_machine
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.job.home import HomeTouch
from plumb.job.slip import LINK, NO_LINKS
from plumb.model.predict import lengths, places

HOLES = np.array([(-900.0, 250.0), (900.0, -250.0)])  # [mm] that the machine made
HAND = 0.3  # [mm] of a coordinate: how well a bit sits in its hole


@cache
def fitted_machine(number):
    """The judge's machine of this number and its settings, after a calibration on 15 marks."""
    sites, source = plan(5, 3), np.random.default_rng(number)
    board = cut(as_bought(usual_machine(source, number, sites), source), sites, seed=source)
    model, rows = Inputs(MAKER, board.measurements).model_and_observations()
    done = fit(model, rows, effects=("chain_pitch", "chain_stretch"), sigma=0.5)
    return board.machine, done.settings


def touched(number, *, links=NO_LINKS, moved=(0.0, 0.0), seed, holes=HOLES):
    """The touches that the owner of a machine writes down; moved: one sigma of the
    sheet's shift [mm] and turn [rad].
    """
    (true, settings), source = fitted_machine(number), np.random.default_rng(seed)
    made = true.sleds(lengths(settings, holes)[0])
    shift, turn = moved[0] * source.standard_normal(2), moved[1] * source.standard_normal()
    turned = made @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    sleds = turned + shift + HAND * source.standard_normal(holes.shape)
    chains = aimed = lengths(settings, sleds)[0]
    for _ in range(6):  # until the judge's sled hangs there
        chains = chains + aimed - lengths(settings, true.sleds(chains))[0]
    assert np.abs(true.sleds(chains) - sleds).max() < 1e-3
    shown = places(settings, chains - LINK * np.array(links))[0]
    return [
        HomeTouch("1", tuple(h), tuple(s))
        for h, s in zip(holes.tolist(), shown.tolist(), strict=True)
    ]
