"""How the error falls: the stairs, and the sheet before and after at a single scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.cure.add import Addition, Quality
from plumb.fit.compare import Comparison
from plumb.fit.fit import Fit
from plumb.fit.patch import PATCH
from plumb.model.plain import noun_of, plainly
from plumb.pictures.panel import Panel
from plumb.report.findings import Findings
from plumb.report.maps import Scale, arrow_map, small_map
from plumb.text.shown import worded

Array = np.ndarray


@dataclass(frozen=True)
class Stair:
    """A stage of the fall."""

    title: str
    rms: str
    percent: float  # of the highest
    checked: str  # RMS on marks not used; empty for the settings as they were
    picture: str  # empty: there are no marks
    good: bool


@dataclass(frozen=True)
class Pair:
    """The sheet before and after."""

    titles: tuple[str, str]
    pictures: tuple[str, str]
    factor: str


@dataclass(frozen=True)
class _Stage:
    title: str
    rms: float  # [mm]
    panel: Panel
    checked: float | None = None  # [mm]


def stairs_of(findings: Findings) -> tuple[Stair, ...]:
    """From the settings as they are to all that was added; two stairs where nothing was fitted."""
    stages = _stages(findings)
    scale = _scale(findings, [stage.panel for stage in stages])
    highest = max(max(stage.rms for stage in stages), 1e-9)
    return tuple(
        Stair(
            title=stage.title,
            rms=worded(stage.rms),
            percent=100 * stage.rms / highest,
            checked=worded(stage.checked) if stage.checked is not None else "",
            picture=small_map(stage.panel, scale, name=f"stair {i}", says=stage.title)
            if scale
            else "",
            good=stage.panel.good,
        )
        for i, stage in enumerate(stages)
    )


def pair_of(findings: Findings) -> Pair | None:
    """The first and the last stage in full size; None without marks."""
    first, *_, last = _stages(findings)
    scale = _scale(findings, [first.panel, last.panel])
    if scale is None:
        return None
    sigma = findings.diagnosis.noise.sigma
    pictures = [
        arrow_map(stage.panel, scale, sigma=sigma, name=name, says=says)
        for stage, name, says in (
            (first, "before", "errors of the settings as they are"),
            (last, "after", f"errors left: {last.title}"),
        )
    ]
    chosen = findings.auto.chosen
    done = f"With {plainly(chosen)}" if chosen else last.title
    titles = [
        f"{title}: {worded(stage.rms)} RMS" for title, stage in ((first.title, first), (done, last))
    ]
    return Pair((titles[0], titles[1]), (pictures[0], pictures[1]), f"{scale.factor:g}")


def _scale(findings: Findings, panels: Sequence[Panel]) -> Scale | None:
    return Scale.of(panels, findings.inputs.settings.sheet) if len(panels[0].errors) else None


def _stages(findings: Findings) -> list[_Stage]:
    as_set = _Stage("As set", findings.comparison.rms, _compared(findings.comparison))
    if findings.auto.addition is None:
        view = findings.framed
        slips = {slip.name for slip in findings.diagnosis.slips}
        panel = Panel("", view.places, view.errors, good=True, names=view.names)
        left = findings.frame.rms
        return [as_set, _Stage(f"Frame fitted without {_listed(slips)}", left, panel)]
    return [as_set, *_fitted(findings.auto.addition)]


def _listed(names: set[str]) -> str:
    return ", ".join(sorted(names))


def _fitted(addition: Addition) -> list[_Stage]:
    names = tuple(mark.name for mark in addition.raw.marks)

    def stage(title: str, fit: Fit, quality: Quality) -> _Stage:
        panel = Panel(title, fit.predicted, fit.errors, good=True, names=names)
        return _Stage(title, quality.fit_rms, panel, quality.left_out_rms)

    steps = [
        stage(
            f"+ {'patch' if step.effect == PATCH else noun_of(step.effect)}", step.fit, step.quality
        )
        for step in addition.steps
    ]
    return [stage("Frame fitted", addition.before_fit, addition.before), *steps]


def _compared(comparison: Comparison) -> Panel:
    predicted = np.array([mark.predicted for mark in comparison.marks]).reshape(-1, 2)
    errors = np.array([mark.error for mark in comparison.marks]).reshape(-1, 2)
    names = tuple(mark.name for mark in comparison.marks)
    return Panel("As set", predicted, errors, names=names)
