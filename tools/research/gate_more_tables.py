"""Tables of a round more and of real sets, before and after."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from gate_rounds import RealAnswer, Round
from tables import markdown_table, mm

SIDES = ("before", "after")
GROUPS: Mapping[str, Callable[[Round], bool]] = {
    "all": lambda each: True,
    "direct measurements": lambda each: each.has_checks,
    "marks": lambda each: not each.has_checks,
    "the best for a board": lambda each: each.is_best,
    "to settle": lambda each: each.question == "settle",
    "to confirm": lambda each: each.question == "confirm",
    "settings that know": lambda each: each.kind.startswith("known/"),
    "settings as they are": lambda each: each.kind.startswith("stock/"),
    "promised below 50 %": lambda each: (each.chance or 0.0) < 0.5,
    "promised 50 to 90 %": lambda each: 0.5 <= (each.chance or 0.0) < 0.9,
    "promised above 90 %": lambda each: (each.chance or 0.0) >= 0.9,
}


def round_tables(sides: Sequence[Sequence[Mapping[str, Any]]]) -> str:
    """Return what proposals promised and what came true, and the sled's error after a round."""
    several = [[Round(**each) for each in side] for side in sides]
    header = ("proposals", "", "promised %", "came true %", "of")
    rows = [
        [name, side, *cells]
        for name, chosen in GROUPS.items()
        for side, rounds in _named(several)
        for cells in _promises([each for each in rounds if each.is_promised and chosen(each)])
    ]
    parts = ["## What proposals promise", markdown_table(header, rows)]
    header = ("boards", "", "error over that of the truth", "of", "CPU s of proposals")
    rows = [
        [name, side, *cells]
        for name in ("9", "15", "25")
        for side, rounds in _named(several)
        for cells in _cures([each for each in rounds if each.kind.endswith(f"-{name}")])
    ]
    named = [[f"{name} marks", *cells] for name, *cells in rows]
    return "\n\n".join([*parts, "## After the best proposal", markdown_table(header, named)])


def _named(several: Sequence[Any]) -> Iterator[tuple[str, Any]]:
    yield from zip(SIDES if len(several) > 1 else ("now",), several, strict=True)


def _promises(rounds: Sequence[Round]) -> Iterator[list[str]]:
    if rounds:
        chances = np.array([each.chance for each in rounds], dtype=float)
        seen = float(np.mean([each.is_settled for each in rounds]))
        error = float(np.sqrt(max(np.sum(chances * (1 - chances)), 0.25))) / len(rounds)
        yield [
            f"{100 * chances.mean():.1f}",
            f"{100 * seen:.1f}±{100 * error:.1f}",
            str(len(rounds)),
        ]


def _cures(rounds: Sequence[Round]) -> Iterator[list[str]]:
    best = [each for each in rounds if each.is_best and each.cure]
    if best:
        after, known = (np.array([each.cure[name] for each in best]) for name in ("after", "known"))
        ratio = float(after.sum() / known.sum())
        error = float(np.sqrt(np.sum((after - ratio * known) ** 2)) / known.sum())
        seconds = float(np.mean([each.seconds for each in best]))
        yield [f"{ratio:.2f}±{error:.2f}", str(len(best)), f"{seconds:.2f}"]


def real_tables(sides: Sequence[Sequence[Mapping[str, Any]]]) -> str:
    """Return what is made of each real set, and how well it predicts the others [mm RMS]."""
    rows: list[list[str]] = []
    several = [{each["name"]: RealAnswer(**each) for each in side} for side in sides]
    for name in dict.fromkeys(name for side in several for name in side):
        for side, answers in _named(several):
            answer = answers.get(name)
            if answer:
                rows.append([name, side, *_cells(answer)])
    header = ("set", "", "verdict", "added", "fit", "left out", "predicted", "CPU s")
    return "## Real sets\n\n" + markdown_table(header, rows)


def _cells(answer: RealAnswer) -> list[str]:
    ahead = (
        f"{name.removeprefix('madgrizzle-')} {mm(rms)}" for name, rms in answer.predicted.items()
    )
    return [
        answer.verdict,
        ", ".join(answer.chosen) or "-",
        mm(answer.fit),
        mm(answer.left_out),
        "; ".join(ahead),
        f"{answer.seconds:.2f}",
    ]
