"""All that a report shows of a board, worked out by the rooms below."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.cure.add import Addition, Quality
from plumb.cure.auto import AutoAddition, add_auto
from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.diagnosis import diagnose
from plumb.diagnosis.expected_error import ExpectedError, expected_error
from plumb.diagnosis.explanation import Explanation, measured_board
from plumb.diagnosis.outliers import Doubts
from plumb.diagnosis.suspect_curves import SuspectCurves, suspect_curves, view_by
from plumb.diary.history import DiaryFit
from plumb.fit.by_hand import to_fill_in, what_to_type
from plumb.fit.compare import ChainView, Comparison, compare
from plumb.fit.covariates import PATCH, Covariate, covariates
from plumb.fit.fit import Fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations
from plumb.model.plain import noun_of, plainly
from plumb.model.reach import Survey, survey_sheet
from plumb.pictures.scale import Panel, Scale, spots_of
from plumb.plan import Next, Proposal, propose
from plumb.plan.planned_visits import Visits
from plumb.plan.proposal import headline_of, promise_of, steps_of
from plumb.report.maps import LARGE, STAIR, arrow_map, plan_map
from plumb.text.values import worded

MOST_CURVES = 3  # suspects whose curves are drawn


@dataclass(frozen=True)
class Findings:
    """A board, its diagnosis, what is added for it, and what the chains say."""

    inputs: Inputs
    rows: Observations  # all marks, slips too
    comparison: Comparison
    diagnosis: Diagnosis
    auto: AutoAddition
    advice: Next
    used: Explanation  # the frame with the effects that are added
    framed: ChainView  # what the frame alone leaves
    left: ChainView  # what the explanation in use leaves
    by_visit: tuple[Covariate, ...]
    curves: tuple[SuspectCurves, ...]
    expected: ExpectedError | None  # None for a slip: nothing is fitted to a wrong reading
    survey: Survey
    fits: tuple[DiaryFit, ...] = ()  # of the machine's diary, the oldest first

    @property
    def doubts(self) -> Doubts:
        """The slips."""
        return Doubts.of(self.diagnosis.outliers, self.comparison)

    @property
    def as_set_rms(self) -> float:
        """Error of the settings as they are, without slips [mm]."""
        return self.doubts.rms(self.comparison)

    @property
    def frame(self) -> Explanation:
        """The frame fitted alone, without slips."""
        return self.diagnosis.readings.frame


def find(
    inputs: Inputs,
    *,
    fits: tuple[DiaryFit, ...] = (),
    progress: Callable[[float], None] = lambda share: None,
) -> Findings:
    """Compare, diagnose, add and propose; InputError as these do. `fits` are of the diary."""
    comparison = compare(inputs)
    diagnosis = diagnose(inputs)
    auto = add_auto(inputs, diagnosis=diagnosis)
    frame, rows = diagnosis.readings.frame, measured_board(inputs).rows
    used = diagnosis.best if auto.chosen else frame
    framed = view_by(frame, rows)
    machine = auto.addition.settings if auto.addition else inputs.settings
    return Findings(
        inputs=inputs,
        rows=rows,
        comparison=comparison,
        diagnosis=diagnosis,
        auto=auto,
        advice=propose(diagnosis, inputs, progress=progress),
        used=used,
        framed=framed,
        left=view_by(used, rows),
        by_visit=covariates(framed.model, rows) if len(rows.measured) else (),
        curves=_curves(diagnosis, used, rows),
        expected=expected_error(used, _rivals(diagnosis, used)) if auto.addition else None,
        survey=survey_sheet(machine),
        fits=fits,
    )


def _curves(
    diagnosis: Diagnosis, used: Explanation, rows: Observations
) -> tuple[SuspectCurves, ...]:
    """Return those of the explanations, best first; of what is added where none stands."""
    if not len(rows.measured):
        return ()
    # The frame alone draws nothing beyond the frame.
    drawn = [each for each in diagnosis.fits if each.effects][:MOST_CURVES]
    if not drawn and used.effects:
        drawn = [used]
    return tuple(suspect_curves(diagnosis.readings.frame, each, rows) for each in drawn)


def _rivals(diagnosis: Diagnosis, used: Explanation) -> list[tuple[Explanation, float]]:
    """Return the other explanations with their shares."""
    both = zip(diagnosis.fits, diagnosis.explanations, strict=True)
    return [(fitted, together.share) for fitted, together in both if fitted is not used]


# The report's next step: what follows from the verdict, or what to measure.

MOST_OTHERS = 5


@dataclass(frozen=True)
class Command:
    """A command with what it is for."""

    words: str
    command: str


# Words of a command by its name, more files of marks, and more words.
Wording = Callable[[str, Sequence[str], Sequence[str]], str]


def asked_for(findings: Findings, command: Wording) -> list[Command]:
    """Return the commands that the verdict asks for."""
    verdict, is_finding = findings.diagnosis.verdict, findings.diagnosis.is_finding
    if verdict == "slip":
        return [Command("When the file is corrected:", command("calibrate", (), ()))]
    is_settled = verdict in ("one_suspect", "nothing_provable") or is_finding
    if is_settled and findings.auto.addition:
        return [Command("Write the new settings:", command("calibrate", (), ()))]
    best = findings.advice.proposals[0] if findings.advice.proposals else None
    checks = best.option.checks if best else ()
    if checks:
        settings = findings.inputs.settings
        said = [
            word
            for check in checks
            for word in ("--checked", to_fill_in(check.name, check.sigma, settings))
        ]
        typed = what_to_type([check.name for check in checks], settings)
        words = f"When that is measured: {typed}" if typed else "When that is measured:"
        return [Command(words, command("calibrate", (), said))]
    form = "more.toml"
    return [
        Command("A form for the new marks:", command("next", (), ("--marks", form))),
        Command("When they are measured:", command("calibrate", (form,), ())),
    ]


@dataclass(frozen=True)
class Other:
    """Another measurement that would help."""

    title: str
    minutes: str
    promise: str


@dataclass(frozen=True)
class NextStep:
    """What to do now, and what to measure if more is to be known."""

    headline: str
    measure: str
    steps: tuple[str, ...]
    picture: str  # of new marks; empty: none
    commands: tuple[Command, ...]
    others: tuple[Other, ...]


def next_step_of(findings: Findings, commands: Sequence[Command]) -> NextStep:
    """Return what the verdict asks for first."""
    proposals = () if findings.diagnosis.is_good else findings.advice.proposals
    best = proposals[0] if proposals else None
    return NextStep(
        headline=_headline(findings, best),
        measure=headline_of(best) if best else "",
        steps=tuple(steps_of(best)) if best else (),
        picture=_picture(findings, best.option.visits) if best else "",
        commands=tuple(commands),
        others=tuple(
            Other(each.option.title, f"{each.option.minutes:.0f}", promise_of(each))
            for each in proposals[1 : MOST_OTHERS + 1]
        ),
    )


def _headline(findings: Findings, best: Proposal | None) -> str:
    diagnosis, chosen = findings.diagnosis, findings.auto.chosen
    if diagnosis.is_good:
        return "nothing to change: cut your jobs."
    if diagnosis.verdict == "slip":
        names = ", ".join(dict.fromkeys(slip.called for slip in diagnosis.outliers))
        return f"read {names} again, and correct the file."
    if chosen and (diagnosis.verdict == "one_suspect" or diagnosis.is_finding):
        return f"add {plainly(chosen)}, then cut new marks to see that it holds."
    if diagnosis.verdict == "nothing_provable" and findings.auto.addition:
        return "use the fitted frame, then cut new marks to see that it holds."
    if best is None:
        return "nothing that can be proposed would tell more."
    return f"{headline_of(best)}."


def _picture(findings: Findings, visits: Visits) -> str:
    if not len(visits):
        return ""
    settings, old = findings.inputs.settings, np.asarray(findings.rows.targets)
    weight = settings.sled_weight
    return plan_map(visits, old, usual_weight=weight, sheet=settings.sheet, name="plan")


# How the error falls: the stairs, and the sheet before and after at a single scale.

Array = np.ndarray


@dataclass(frozen=True)
class Stair:
    """A stage of the fall."""

    title: str
    rms: str
    percent: float  # of the highest
    noise: str  # RMS that noise alone would leave of a fit
    checked: str  # RMS on marks not used; empty where nothing was added
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
    noise: float | None = None  # [mm] that noise alone would leave
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
            noise=worded(stage.noise) if stage.noise is not None else "",
            checked=worded(stage.checked) if stage.checked is not None else "",
            picture=arrow_map(stage.panel, scale, STAIR, name=f"stair {i}", says=stage.title)
            if scale
            else "",
            good=stage.panel.good,
        )
        for i, stage in enumerate(stages)
    )


def pair_of(findings: Findings) -> Pair | None:
    """Return the first and the last stage in full size; None without marks."""
    first, *_, last = _stages(findings)
    scale = _scale(findings, [first.panel, last.panel])
    if scale is None:
        return None
    sigma = findings.diagnosis.noise.sigma
    pictures = [
        arrow_map(stage.panel, scale, LARGE, sigma=sigma, name=name, says=says)
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
    if not len(panels[0].errors):
        return None
    return Scale.of([spots_of(panel) for panel in panels], findings.inputs.settings.sheet)


def _stages(findings: Findings) -> list[_Stage]:
    doubted = findings.doubts.marks
    panel = replace(_compared(findings.comparison), doubted=doubted)
    as_set = _Stage("As set", findings.as_set_rms, panel)
    if findings.auto.addition is None:
        view = findings.framed
        slips = {slip.name for slip in findings.diagnosis.outliers}
        panel = Panel("", view.places, view.errors, True, view.names, doubted)
        left = findings.frame.rms
        noise = findings.diagnosis.noise_rms
        title = f"Frame fitted without {_listed(slips)}" if slips else "Frame fitted"
        return [as_set, _Stage(title, left, panel, noise)]
    return [as_set, *_fitted(findings.auto.addition)]


def _listed(names: set[str]) -> str:
    return ", ".join(sorted(names))


def _fitted(addition: Addition) -> list[_Stage]:
    names = tuple(mark.name for mark in addition.raw.marks)

    def stage(title: str, fit: Fit, quality: Quality) -> _Stage:
        panel = Panel("", fit.predicted, fit.errors, good=True, names=names)
        return _Stage(title, quality.fit_rms, panel, quality.noise_rms, quality.left_out_rms)

    steps = [
        stage(f"+ {'patch' if step.effect == PATCH else noun_of(step.effect)}", step.fit, step)
        for step in addition.by_effect
    ]
    return [stage("Frame fitted", addition.before_fit, addition.before), *steps]


def _compared(comparison: Comparison) -> Panel:
    predicted = np.array([mark.predicted for mark in comparison.marks]).reshape(-1, 2)
    errors = np.array([mark.error for mark in comparison.marks]).reshape(-1, 2)
    names = tuple(mark.name for mark in comparison.marks)
    return Panel("", predicted, errors, names=names)
