"""The page of the report: all its words and pictures in one file, escaped by the template."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2
import numpy as np

from plumb.diagnosis.answer import odds_words
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.unseen import Unseen, unseen_by
from plumb.model.plain import plainly
from plumb.model.predict import REACH_WORDS, USABLE
from plumb.model.reach import percent
from plumb.report.cards import Card, cards_of
from plumb.report.covariate_plots import CovariateSheet, covariate_sheet
from plumb.report.findings import (
    Command,
    Findings,
    NextStep,
    Pair,
    Stair,
    next_step_of,
    pair_of,
    stairs_of,
)
from plumb.report.maps import SUSPECTS, chain_map, expected_map, reach_maps, style
from plumb.report.noise_plots import NoisePlot, noise_plots
from plumb.report.tables import (
    Readings,
    Round,
    Setting,
    Source,
    history_sentence,
    readings_of,
    rounds_of,
    settings_of,
    sources_of,
    versions,
)
from plumb.text.values import unit, worded

SIDES = ("Left chain", "Right chain")
MOST_UNSEEN = 10
# By verdict: a sign, and what it means in few words.
VERDICTS = {
    "nothing_provable": ("○", "No cause shown"),
    "one_suspect": ("●", "One explanation"),
    "cannot_tell": ("◐", "Cannot tell yet"),
    "not_in_library": ("▲", "Not in the library"),
    "slip": ("!", "A reading to look at"),
}


@dataclass(frozen=True)
class Verdict:
    """The verdict line."""

    kind: str
    sign: str
    label: str
    sentence: str
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Figure:
    """A number that everybody looks for first."""

    what: str
    size: str


@dataclass(frozen=True)
class Legend:
    """The colour of an explanation."""

    colour: str
    words: str


@dataclass(frozen=True)
class Account:
    """An explanation in the table of them."""

    words: str
    odds: str
    rms: str
    noise: str  # what noise alone would leave


@dataclass(frozen=True)
class Expected:
    """The error to expect over the sheet."""

    sentence: str
    picture: str


@dataclass(frozen=True)
class Reach:
    """What of the sheet can be used."""

    sentence: str
    maps: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Page:
    """All that the template fills in."""

    title: str
    subtitle: str
    unit: str
    verdict: Verdict
    figures: tuple[Figure, ...]
    stairs: tuple[Stair, ...]
    counted: str  # of which an RMS is
    fall_note: str
    pair: Pair | None
    chains: tuple[tuple[str, str], ...]
    covariates: CovariateSheet | None
    legend: tuple[Legend, ...]
    against_noise: tuple[NoisePlot, ...]
    slips: tuple[Outlier, ...]
    cards_title: str
    accounts: tuple[Account, ...]
    cards: tuple[Card, ...]
    next: NextStep
    settings: tuple[Setting, ...]
    settings_note: str
    remarks: tuple[str, ...]
    history_sentence: str
    history: tuple[Round, ...]
    new_stages: int  # of the history, at its end: what the new settings leave
    expected: Expected | None
    reach: Reach
    unseen: Unseen
    readings: Readings
    readings_note: str
    sources: tuple[Source, ...]
    noise: str
    versions: str
    again: str


def report(findings: Findings, *, commands: Sequence[Command], again: str) -> bytes:
    """Return the page as a file; `commands` go on from here, `again` makes the same report."""
    here = resources.files("plumb.report")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["sentence"] = _sentence
    environment.filters["worded"] = worded
    template = environment.from_string(here.joinpath("page.html").read_text("utf-8"))
    css = here.joinpath("page.css").read_text("utf-8")
    page = page_of(findings, commands=commands, again=again)
    return template.render(page=page, style=f"{style()}\n{css}").encode()


def _sentence(words: str) -> str:
    """Return the words with a capital letter and a full stop."""
    return f"{words[:1].upper()}{words[1:]}{'' if words.endswith('.') else '.'}"


def page_of(findings: Findings, *, commands: Sequence[Command], again: str) -> Page:
    """Return the words and pictures of a board."""
    diagnosis, auto = findings.diagnosis, findings.auto
    return Page(
        title=f"{_name_of_settings(findings)} with {_names_of_marks(findings)}",
        subtitle=_subtitle(findings),
        unit=unit(),
        verdict=_verdict(findings),
        figures=_figures(findings),
        stairs=stairs_of(findings),
        counted="marks" if findings.comparison.marks else "distances",
        fall_note=_fall_note(findings),
        pair=pair_of(findings),
        chains=_chain_maps(findings),
        covariates=_covariates(findings),
        legend=tuple(
            Legend(colour, plainly(each.effects))
            for each, colour in zip(findings.curves, SUSPECTS, strict=False)
        ),
        against_noise=_against_noise(findings),
        slips=diagnosis.outliers,
        cards_title="Suspects" if diagnosis.suspects else "What was added",
        accounts=_accounts(findings),
        cards=() if diagnosis.outliers else cards_of(findings),
        next=next_step_of(findings, commands),
        settings=settings_of(findings),
        settings_note=_settings_note(findings),
        remarks=_remarks(findings),
        history_sentence=history_sentence(findings),
        history=rounds_of(findings),
        new_stages=2 if auto.addition else 0,
        expected=_expected(findings),
        reach=_reach(findings),
        unseen=unseen_by(findings.diagnosis, MOST_UNSEEN),
        readings=readings_of(findings),
        readings_note=_readings_note(findings),
        sources=sources_of(findings),
        noise=diagnosis.noise.sentence,
        versions=versions(),
        again=again,
    )


def _name_of_settings(findings: Findings) -> str:
    file = findings.inputs.settings.file
    return file.name if file else "settings"


def _names_of_marks(findings: Findings) -> str:
    measurements = findings.inputs.measurements
    names = [part.name or Path(measurements.source).name for part in measurements.rounds]
    return " and ".join(names)


def _subtitle(findings: Findings) -> str:
    measurements = findings.inputs.measurements
    counts = [(len(measurements.measured_marks), "mark"), (len(measurements.distances), "distance")]
    said = [f"{count} {noun}{'s' if count != 1 else ''}" for count, noun in counts if count]
    width, height = (worded(length, 0) for length in findings.inputs.settings.sheet)
    dates = [part.date for part in measurements.rounds if part.date]
    measured = f", measured {', '.join(dict.fromkeys(dates))}" if dates else ""
    return f"{' and '.join(said)} on a sheet of {width} by {height}{measured}"


def _verdict(findings: Findings) -> Verdict:
    diagnosis = findings.diagnosis
    kind = "one_suspect" if diagnosis.is_finding else diagnosis.verdict
    sign, label = VERDICTS[kind]
    notes = [] if diagnosis.outliers else [*diagnosis.disagreements, *diagnosis.warnings]
    return Verdict(
        kind=kind,
        sign=sign,
        label=label,
        sentence=diagnosis.sentence,
        notes=tuple(notes),
    )


def _figures(findings: Findings) -> tuple[Figure, ...]:
    comparison = findings.comparison
    figures = [Figure("as set, RMS", worded(findings.as_set_rms))]
    if comparison.marks and comparison.distances:
        figures.append(Figure("their distances, as set", worded(comparison.distance_rms)))
    addition = findings.auto.addition
    if addition:
        figures.append(Figure("frame fitted", worded(addition.before.fit_rms)))
        if addition.by_effect:
            figures.append(Figure("effects fitted", worded(addition.after.fit_rms)))
        figures.append(Figure("noise alone leaves", worded(addition.after.noise_rms)))
        figures.append(Figure("on marks not used", worded(addition.after.left_out_rms)))
    return (*figures, Figure("noise of a reading", worded(findings.diagnosis.noise.sigma)))


def _fall_note(findings: Findings) -> str:
    chosen = findings.auto.chosen
    if findings.auto.addition is None and not findings.diagnosis.outliers:
        return " ".join(findings.auto.said)
    if findings.auto.rivals and chosen:
        return f"Shown is the most likely explanation, {plainly(chosen)}: it is not settled yet."
    return ""


def _chain_maps(findings: Findings) -> tuple[tuple[str, str], ...]:
    view = findings.framed
    known = np.abs(view.chains[np.isfinite(view.chains)])
    if not len(known):
        return ()
    sheet, largest = findings.inputs.settings.sheet, float(known.max())
    return tuple(
        (
            side,
            chain_map(
                view, i, sheet=sheet, largest=largest, name=f"chain {i}", says=f"{side}, by mark"
            ),
        )
        for i, side in enumerate(SIDES)
    )


def _covariates(findings: Findings) -> CovariateSheet | None:
    if not len(findings.rows.measured):
        return None
    return covariate_sheet(
        findings.framed,
        findings.by_visit,
        findings.rows.mark_rows,
        findings.curves,
        sigma=findings.diagnosis.noise.sigma,
    )


def _against_noise(findings: Findings) -> tuple[NoisePlot, ...]:
    """Return the frame's residuals, and those of all that was added."""
    addition = findings.auto.addition
    if addition is None:
        return ()
    fits = {"Frame fitted": addition.before_fit}
    if addition.by_effect:
        fits[f"With {plainly(addition.effects_added)}"] = addition.after_fit
    return noise_plots(fits)


def _accounts(findings: Findings) -> tuple[Account, ...]:
    """Return the explanations, if there are several."""
    explanations = findings.diagnosis.explanations
    if len(explanations) < 2:
        return ()
    return tuple(
        Account(
            findings.diagnosis.called(each),
            odds_words(each.share),
            worded(each.rms_after),
            worded(each.noise_rms),
        )
        for each in explanations
    )


def _settings_note(findings: Findings) -> str:
    addition = findings.auto.addition
    said = [f"In brackets: 95 % interval. {addition.intervals_said}"] if addition else []
    if findings.auto.rivals:
        said.append("These are the numbers of the most likely explanation; the marks allow others.")
    return " ".join(said)


def _remarks(findings: Findings) -> tuple[str, ...]:
    addition = findings.auto.addition
    if addition is None:
        return ()
    remarks = (*findings.auto.said, *addition.cures, *addition.warnings)
    return tuple(dict.fromkeys(remarks))


def _expected(findings: Findings) -> Expected | None:
    expected = findings.expected
    if expected is None:
        return None
    sheet = findings.inputs.settings.sheet
    rivals = " The rivals of the explanation count by their share." if findings.auto.rivals else ""
    place = " Distances do not tell where on the sheet the sled is, and that counts too."
    place = "" if findings.comparison.marks else place
    return Expected(
        f"With the new settings expect {worded(expected.rms)} RMS over the sheet, and "
        f"{worded(expected.worst)} at the worst place: so well do these readings settle the "
        f"numbers.{rivals}{place} What may act unseen is not counted.",
        expected_map(expected, sheet=sheet, name="expected"),
    )


def _reach(findings: Findings) -> Reach:
    shares = findings.survey.shares
    usable = f"{percent(shares[REACH_WORDS[USABLE]])} of the sheet is usable"
    rest = [f"{percent(shares[word])} {word}" for word in REACH_WORDS[1:] if shares[word]]
    give, pulls = reach_maps(findings.survey, name="reach")
    return Reach(
        f"{usable}{'; ' if rest else ''}{', '.join(rest)}. Heavy lines are limits; shaded is what "
        f"lies beyond. {' '.join(findings.survey.assumed)}".strip(),
        (
            ("How far the bit gives sideways, mm per N", give),
            ("How hard the chains pull, N (red the tighter, blue the slacker)", pulls),
        ),
    )


def _readings_note(findings: Findings) -> str:
    if not findings.comparison.marks:
        return f"All in {unit()}; predicted by the settings as they are."
    typed = findings.inputs.measurements.typed
    counted = "from the sheet's top left corner, y down" if typed.sheet else "from the middle, y up"
    return (
        f"All in {unit()}, {counted}. Error: measured - predicted by the settings as they are. The "
        "last three: what the fitted frame leaves, on the sheet and of each chain."
    )
