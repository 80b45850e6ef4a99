"""Contents of docs/real-data.md and its pictures: the published sets."""

from __future__ import annotations

import numpy as np
from fields import Picture, drawing
from plumb.cure.add import Addition, Parameter
from plumb.fit.compare import best_pose
from plumb.fit.observations import rms
from real_sets import (
    BRACKETS,
    CUTS,
    HOLES,
    NINE,
    PAIRS,
    RealSet,
    middle_shift,
    mirrored,
    pooled,
    predicted,
    real_set,
    refusal_of,
    with_y_errors_flipped,
)
from template import filled

PAGE = "docs/real-data.md"
PICTURES = "docs/pictures/real-data"
OTHER_NAMES = {"top and bottom exchanged": (1, -1), "left and right": (-1, 1), "both": (-1, -1)}
SUNK, REACH = 2.0, 1170.0  # [mm] of a beam's tip, while the sled crosses so far from the middle


def pages() -> dict[str, str]:
    """Return the page and each picture by its name below the project's root."""
    nine = real_set(NINE, "Calibration Measurements.ini", "groundcontrol.ini")
    flipped = RealSet(nine.name, nine.settings, with_y_errors_flipped(nine.marks))
    fifteen = real_set("c0depr1sm-2019-01-03", "marks.csv", "machine.toml")
    holes = {name: real_set(name) for name in HOLES}
    together = pooled(list(holes.values()))
    swing = pooled(list(holes.values()), ("chain_pitch", "sled_swing"))
    gap = fifteen.settings.motor_gap
    text = filled(
        "real-data.md",
        holes=list(holes.values()),
        pairs=[(holes[before], holes[after]) for before, after in PAIRS],
        loud=[each.diagnosed(sigma=0.8).verdict for each in holes.values()],
        together=together,
        swing=swing,
        bit=next(each for each in swing.fitted.parameters if each.name == "sled_swing.right"),
        cuts=real_set(CUTS),
        beaten=sum(rms(together.errors[name]) < holes[name].nominal_rms for _, name in PAIRS),
        renamed={
            words: pooled([mirrored(each, *signs) for each in holes.values()]).fitted.after.fit_rms
            for words, signs in OTHER_NAMES.items()
        },
        nine={"as published": nine, "y the other way": flipped},
        fifteen=fifteen,
        tip=largest_tip_give(fifteen),
        # Moments: the tip on that side carries (gap / 2 + reach) / gap of the sled.
        sinks=SUNK / (fifteen.settings.sled_weight * 2 * REACH / gap),
        off_middle=middle_shift(fifteen.settings),
        brackets=[real_set(name, "squares.toml", "as-triangular.ini") for name in BRACKETS],
        refusal=refusal_of(BRACKETS[0]),
        pitch=pitch,
        predicted=predicted,
        rms=rms,
        mm=lambda value: f"{value + 0.0:.2f}",
        percent=lambda strain: f"{100 * strain + 0.0:.2f}",
    )
    return {
        PAGE: text,
        f"{PICTURES}/mibproj.svg": picture(nine, 3),
        f"{PICTURES}/c0depr1sm.svg": picture(fifteen, 3),
    }


def pitch(fitted: Addition) -> list[Parameter]:
    """Return how long both chains are by a fit."""
    return [each for each in fitted.parameters if each.name.startswith("chain_pitch.")]


def largest_tip_give(board: RealSet) -> float:
    """Return how far a beam's tips could give downwards [mm/N] without showing in the marks."""
    sizes = {limit.name: limit.largest for limit in board.could_hide("frame_flex").limits}
    return sizes["downward"] or 0.0


def picture(board: RealSet, rows: int) -> str:
    """Return the errors of a board as set, and their shape."""
    raw = board.raw
    sent, measured = (
        np.array([getattr(mark, which) for mark in raw.marks])
        for which in ("predicted", "measured")
    )
    pose = best_pose(sent, measured)
    assert pose, "a board of marks has a shape"
    order = np.lexsort((sent[:, 0], -np.round(np.array([mark.target[1] for mark in raw.marks]))))
    as_set = np.array([mark.error for mark in raw.marks])
    pictures = []
    for name, errors in (("as set", as_set), ("its shape", pose.errors)):
        places, arrows = (each[order].reshape(rows, -1, 2) for each in (sent, errors))
        pictures.append(Picture(f"{name}: {rms(errors):.2f} mm RMS", places, arrows))
    return drawing(f"errors of {board.name}", [(board.name, pictures)], sheet=board.settings.sheet)
