"""All that a report shows of a board, worked out by the rooms below."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from plumb.board.observations import Observations
from plumb.cure.auto import AutoAddition, add_auto
from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.diagnosis import Examined, examine
from plumb.diagnosis.expected_error import ExpectedError, expected_error
from plumb.diagnosis.explanation import Explanation, explain
from plumb.diagnosis.measured import measured_board
from plumb.diagnosis.suspect_curves import SuspectCurves, suspect_curves, view_by
from plumb.diary.history import DiaryFit
from plumb.fit.chain_view import ChainView
from plumb.fit.compare import Comparison, compare
from plumb.fit.covariates import Covariate, covariates
from plumb.fit.inputs import Inputs
from plumb.model.reach import Survey, survey_sheet
from plumb.plan import Next, propose

MOST_CURVES = 3  # suspects whose curves are drawn


@dataclass(frozen=True)
class Findings:
    """A board, its diagnosis, what is added for it, and what the chains say."""

    inputs: Inputs
    rows: Observations  # all marks, slips too
    comparison: Comparison
    examined: Examined
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
    def diagnosis(self) -> Diagnosis:
        """What the marks prove."""
        return self.examined.diagnosis

    @property
    def frame(self) -> Explanation:
        """The frame fitted alone, without slips."""
        return self.examined.readings.frame


def find(
    inputs: Inputs,
    *,
    fits: tuple[DiaryFit, ...] = (),
    progress: Callable[[float], None] = lambda share: None,
) -> Findings:
    """Compare, diagnose, add and propose; InputError as these do. `fits` are of the diary."""
    comparison = compare(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=inputs.controller,
    )
    examined = examine(inputs)
    auto = add_auto(inputs, diagnosis=examined.diagnosis)
    frame, rows = examined.readings.frame, measured_board(inputs).rows
    used = _explanation(examined, auto.chosen)
    framed = view_by(frame, rows)
    machine = auto.addition.settings if auto.addition else inputs.settings
    return Findings(
        inputs=inputs,
        rows=rows,
        comparison=comparison,
        examined=examined,
        auto=auto,
        advice=propose(examined.diagnosis, inputs, progress=progress),
        used=used,
        framed=framed,
        left=view_by(used, rows),
        by_visit=covariates(framed.model, rows) if len(rows.measured) else (),
        curves=_curves(examined, used, rows),
        expected=expected_error(used, _rivals(examined, used)) if auto.addition else None,
        survey=survey_sheet(machine),
        fits=fits,
    )


def _explanation(examined: Examined, effects: tuple[str, ...]) -> Explanation:
    """The explanation by these effects, in any order; fitted if it is none of the diagnosis."""
    for explanation in examined.explanations:
        if set(explanation.effects) == set(effects):
            return explanation
    frame = examined.readings.frame
    return explain(frame.board, effects, start=frame) if effects else frame


def _curves(examined: Examined, used: Explanation, rows: Observations) -> tuple[SuspectCurves, ...]:
    """Those of the explanations, best first; of what is added where none stands."""
    if not len(rows.measured):
        return ()
    # The frame alone draws nothing beyond the frame.
    drawn = [each for each in examined.explanations if each.effects][:MOST_CURVES]
    if not drawn and used.effects:
        drawn = [used]
    return tuple(suspect_curves(examined.readings.frame, each, rows) for each in drawn)


def _rivals(examined: Examined, used: Explanation) -> list[tuple[Explanation, float]]:
    """The other explanations that a real machine can have, with their shares; where they were not
    weighed, all count alike."""
    both = zip(examined.explanations, examined.diagnosis.explanations, strict=True)
    possible = [(fitted, together.share) for fitted, together in both if together.possible]
    weighed = [1.0 if share is None else share for _, share in possible]
    return [
        (fitted, weight / sum(weighed))
        for (fitted, _), weight in zip(possible, weighed, strict=True)
        if fitted is not used
    ]
