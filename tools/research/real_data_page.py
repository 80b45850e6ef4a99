"""Writes docs/real-data.md and its pictures from the published sets: `python -m
real_data_page`.

With --check nothing is written; exit 1 if the page or a picture is not as it would be written.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from plumb.cure.machine_file import MARKS, SETTINGS, with_y_errors_flipped
from plumb.diagnosis import Diagnosis
from plumb.fit.compare import Comparison, best_pose
from plumb.fit.observations import rms
from plumb.marks.read import read_marks
from plumb.model.predict import known_effects
from plumb.pictures.fingerprints import Picture, drawing
from plumb.settings.files import read_settings
from real_holes import holes_section
from real_sets import (
    BRACKETS,
    RealSet,
    middle_shift,
    real_set,
    refusal_of,
)
from tables import markdown_table, mm, percent
from writer import write_pages

PAGE = "docs/real-data.md"
PICTURES = "docs/pictures/real-data"
COMMAND = "real_data_page"

HEAD = f"""\
# Real machines

<!-- Written by `python -m {COMMAND}` from tools/plumb/examples. Do not edit this page. -->

This page shows what the lab says of every published set of measured positions that we know: what
was fitted, the verdict of `plumb diagnose`, and what the numbers cannot tell.

- The files are in [tools/plumb/examples](../tools/plumb/examples), each with its source and its
  doubts. The numbers are those of their authors.
- Nobody stated a reading error, and hardly anybody read a mark twice. Where no noise is named
  below, the lab took a tape's usual 0.5 mm.
- Errors are in mm: of marks as vectors, of holes as distances.
- *As set* is the error with the machine's settings. *Shape* is what is left of it after the best
  shift and rotation. *Left out* is the cross-validated error: each reading is predicted by a fit
  that did not see it.
- A word in capitals, LIKELY, marks what no source states."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the page and its pictures, or check them; 1 if they are stale, 2 if refused."""
    return write_pages(arguments, pages, command=COMMAND)


def pages() -> dict[str, str]:
    """Return the page and each picture by its name below the project's root."""
    settings = read_settings(SETTINGS, known=known_effects())
    nine = RealSet("mibproj", settings, read_marks(MARKS, sheet=settings.sheet))
    fifteen = real_set("c0depr1sm-2019-01-03", "marks.csv", "machine.toml")
    text = "\n\n".join(
        [
            HEAD,
            holes_section(),
            _nine_section(nine),
            _fifteen_section(fifteen),
            _brackets_section(),
            _independent_section(fifteen),
        ]
    )
    return {
        PAGE: text + "\n",
        f"{PICTURES}/mibproj.svg": _picture(nine, 3),
        f"{PICTURES}/c0depr1sm.svg": _picture(fifteen, 3),
    }


def verdict_line(diagnosis: Diagnosis) -> str:
    """Return the verdict and the sentence of the lab."""
    return f"`{diagnosis.verdict}`: {diagnosis.sentence}"


def _nine_section(nine: RealSet) -> str:
    flipped = RealSet(nine.name, nine.settings, with_y_errors_flipped(nine.marks))
    rows, said = [], []
    for board, sign in ((nine, "as published"), (flipped, "y the other way")):
        fitted = board.with_effects("chain_pitch", "chain_sag")
        rows.append(
            [
                sign,
                mm(board.raw.rms),
                mm(board.raw.shape_rms),
                mm(fitted.before.fit_rms),
                mm(fitted.after.fit_rms),
                mm(fitted.after.left_out_rms),
            ]
        )
        said.append(f"- *{sign}*: {verdict_line(board.diagnosed())}")
    header = ["sign of y", "as set", "shape", "frame fitted", "+ pitch and sag", "left out"]
    return "\n\n".join(
        [
            "## Nine marks of mibproj (2020)",
            "The set that every newcomer tries first. Two things are not known:",
            "- The settings in force are not published. Defaults replace them.\n"
            "- The sign of y is in doubt. The page's words say that the middle sags, its numbers "
            "say that it is higher. So here are both signs.",
            markdown_table(header, rows),
            "\n".join(said),
            "Without the settings in force the fitted sizes have no firm meaning: a fitted sag is "
            "the sag that *remains* under an unknown correction. `tools/demo` shows the same marks "
            "step by step.",
            "![nine marks: errors as set, and their "
            f"shape](pictures/{Path(PICTURES).name}/mibproj.svg)",
        ]
    )


def _fifteen_section(fifteen: RealSet) -> str:
    diagnosis, raw = fifteen.diagnosed(), fifteen.raw
    shift = raw.shift[1] if raw.shift else None
    stretch = next(each.mm for each in diagnosis.could_hide if each.effect == "chain_stretch")
    return "\n\n".join(
        [
            "## Fifteen marks of c0depr1sm (2019)",
            "The best tuned machine of all. Its settings are LIKELY, and physical: the owner "
            "weighed sled and chain.",
            f"- {mm(raw.rms)} mm RMS as set, most of it a shift of {mm(shift)} mm in y\n"
            f"- {mm(raw.shape_rms)} mm are shape\n"
            f"- {mm(diagnosis.rms_before)} mm are left with the frame fitted",
            verdict_line(diagnosis),
            "Fifteen single readings leave much open. Of every effect, a size up to a limit could "
            "be there unnoticed. Two examples:",
            f"- a beam whose tips give {largest_tip_give(diagnosis):.3f} mm/N\n"
            f"- chain stretch that moves marks by {mm(stretch)} mm; the frame hides nearly all of "
            "it",
            "![fifteen marks: errors as set, and their "
            f"shape](pictures/{Path(PICTURES).name}/c0depr1sm.svg)",
        ]
    )


def _brackets_section() -> str:
    rows = []
    for name in BRACKETS:
        squares = real_set(name, "squares.toml", "as-triangular.ini")
        diagnosis = squares.diagnosed()
        rows.append(
            [name, len(squares.marks.distances), mm(squares.raw.rms), f"`{diagnosis.verdict}`"]
        )
    header = ["set", "widths and heights", "as set", "verdict"]
    return "\n\n".join(
        [
            "## Not this machine: sleds on two brackets",
            "Three sets come from the older sled with two brackets (quadrilateral kinematics). The "
            "lab's effects are those of a sled on a ring or linkage. So the lab refuses a "
            "groundcontrol.ini of such a machine:",
            f"> {refusal_of(BRACKETS[0])}",
            "If the file calls the machine triangular nevertheless, squares that were measured by "
            "caliper (0.2 mm) give it away:",
            markdown_table(header, rows),
            "Two more sets hold too little:",
            "- gero also read eleven spacings with a ruler. They are too few and too coarse for a "
            "verdict. The lab asks to measure the spacing of 495 mm again. Its owner had put a box "
            "around the same spacing.\n"
            "- Bar's two straight cuts (domed by 1.0 and 2.4 mm over 2 m) are heights above a "
            "chord. There are no marks and no settings, so there is nothing to fit.",
        ]
    )


def _independent_section(fifteen: RealSet) -> str:
    """Single published numbers against what is fitted here."""
    gap, reach = fifteen.settings.motor_gap, 1170.0
    # Moments: the tip on that side carries (gap / 2 + x) / gap of the sled.
    load = fifteen.settings.sled_weight * 2 * reach / gap
    down = largest_tip_give(fifteen.diagnosed())
    short = [percent(by_tape / by_chain - 1) for by_tape, by_chain in PULLED]
    rows = [
        [
            "beam tip, c0depr1sm",
            "sinks 2 mm while the sled crosses (laser, forum topic 7374)",
            f"{2 / load:.3f} mm/N; his marks allow up to {down:.3f} mm/N",
            "agrees" if 2 / load <= down else "does not agree",
        ],
        [
            "bit off the middle, c0depr1sm",
            "about 1.5 mm to the right with zero chain tolerance (forum topic 8349)",
            f"{middle_shift(fifteen.settings):.1f} mm by his two chain lengths",
            "right side, not the size",
        ],
        [
            "gap by pulled chain against tape, other machines",
            "3102.13 for 3111 (topic 3145), 3710.6 for 3719.6 (WebControl issue 64)",
            f"{short[0]} and {short[1]} % short",
            "what long links, sag and bent arms do together: more than the pitch fitted above",
        ],
    ]
    header = ["what", "published", "here", ""]
    return "\n\n".join(
        [
            "## Numbers measured in another way",
            "Only a gauge, a scale or a level on the same machine proves a fitted size. There are "
            "few such numbers:",
            markdown_table(header, rows),
            "Other single numbers were published too: calibration results and test cuts. The "
            "settings or marks of those machines were not, so these numbers check nothing.",
        ]
    )


def largest_tip_give(diagnosis: Diagnosis) -> float:
    """Return how far a beam's tips could give downwards [mm/N] without showing in the marks."""
    limits = next(each.limits for each in diagnosis.could_hide if each.effect == "frame_flex")
    sizes = {limit.name: limit.largest for limit in limits}
    return sizes["downward"] or 0.0


PULLED = ((3111.0, 3102.13), (3719.6, 3710.57))  # [mm] gap by tape, and by a pulled chain


def _picture(board: RealSet, rows: int) -> str:
    raw: Comparison = board.raw
    sent = np.array([mark.predicted for mark in raw.marks])
    errors = np.array([mark.error for mark in raw.marks])
    order = np.lexsort((sent[:, 0], -np.round(np.array([m.target[1] for m in raw.marks]))))
    shape = (rows, len(sent) // rows, 2)
    left = _shape_errors(raw)
    pictures = (
        Picture(
            f"as set: {mm(raw.rms)} mm RMS",
            sent[order].reshape(shape),
            errors[order].reshape(shape),
        ),
        Picture(
            f"its shape: {mm(rms(left))} mm RMS",
            sent[order].reshape(shape),
            left[order].reshape(shape),
        ),
    )
    return drawing(f"errors of {board.name}", [(board.name, pictures)], sheet=board.settings.sheet)


def _shape_errors(raw: Comparison) -> np.ndarray:
    """Errors (n, 2) [mm] after the best shift and turn of all marks."""
    pose = best_pose(
        np.array([mark.predicted for mark in raw.marks]),
        np.array([mark.measured for mark in raw.marks]),
    )
    assert pose, "a board of marks has a shape"
    return pose.errors


if __name__ == "__main__":
    sys.exit(main())
