"""What `plumb add` says to people."""

from __future__ import annotations

from plumb.cli.text import millimetres, number, sentences, table
from plumb.cure.add import Addition
from plumb.cure.auto import AutoAddition
from plumb.diagnose.noise import origin_words
from plumb.diagnose.sentence import verdict_sentence
from plumb.fit.patch import PATCH


def auto_text(result: AutoAddition) -> str:
    """The diagnosis and the choice for people, then the addition."""
    said = [sentences([verdict_sentence(result.diagnosis)], mark="")]
    said += (
        [sentences([slip.sentence for slip in result.diagnosis.slips])]
        if result.diagnosis.slips
        else []
    )
    reason = result.reason[0].upper() + result.reason[1:] + "."
    said.append(sentences([reason], mark=""))
    if result.settled_by:
        said.append("To be sure which it is:\n" + sentences(result.settled_by))
    if result.offer:
        added = result.addition is not None and PATCH in result.addition.effects_added
        said.append(sentences([_offer_sentence(*result.offer, added=added)], mark=""))
    if result.addition:
        said.append(as_text(result.addition))
    return "\n\n".join(said)


def _offer_sentence(without: float, with_patch: float, *, added: bool) -> str:
    """What a residual patch would buy, or has bought."""
    if with_patch >= without:
        return f"A residual patch would buy nothing ({without:.2f} mm for marks left out)."
    bought = f"{without:.2f} to {with_patch:.2f} mm for marks left out"
    if added:
        return f"The residual patch bought {bought}."
    return f"A residual patch (--patch) would buy {bought}. {PATCH_WARNING}"


PATCH_WARNING = (
    "It is no physics: a smooth map that holds for this machine, sled and sheet as they are, and "
    "only where marks were measured."
)


def as_text(result: Addition, *, asked_patch: bool = False) -> str:
    """The addition for people, its conclusion first."""
    raw, before, after = result.raw, result.before, result.after
    verdict = "better" if result.pays else "NOT better"
    first = f"From {raw.rms:.2f} to {after.fit_rms:.2f} mm RMS"
    if result.steps:
        first += (
            f"; marks left out of the fit are predicted {verdict} with the effects "
            f"({before.left_out_rms:.2f} to {after.left_out_rms:.2f} mm)"
        )
    first += "."
    parts = [sentences([first], mark=""), _quality_table(result), _parameter_table(result)]
    if result.benchmark_after:
        parts.insert(1, _benchmark_sentence(result))
    parts.append(
        "Priced: scaled up for the numbers the fit took from the data. Left out: each mark "
        "predicted\nby a fit that did not see it. Intervals: 95 %, for a reading error of "
        f"{result.after_fit.sigma:.2f} mm ({origin_words(result.sigma_from)})."
    )
    said = [turn_sentence(result), *result.cures, *result.warnings]
    if PATCH in result.effects_added:
        said.append(PATCH_WARNING)
    elif asked_patch:
        said.append("a residual patch would predict marks left out no better, so none was added")
    parts.append(sentences(said))
    return "\n\n".join(parts)


def _benchmark_sentence(result: Addition) -> str:
    """The community's score before, and what to expect of the next cut."""
    said = (
        f"Calibration Benchmark Score: {result.raw.benchmark} as cut; {result.benchmark_after} to "
        "expect when it is cut again with the new settings, if nothing else changes."
    )
    return sentences([said], mark="")


def turn_sentence(result: Addition) -> str:
    """What to do about the sheet's rotation."""
    rise = result.sheet_rise
    which = "raise" if rise > 0 else "lower"
    return (
        f"no setting holds the sheet's rotation: {which} its right end by {abs(rise):.2f} mm over "
        f"its width of {result.settings.sheet_width:.0f} mm"
    )


def _quality_table(result: Addition) -> str:
    raw = result.raw
    start = (raw.rms, None, None, raw.worst, raw.shape_rms)
    rows = [["as the settings are", *map(millimetres, start)]]
    named = [("frame fitted", result.before)]
    named += [(f"+ {step.effect}", step.quality) for step in result.steps]
    for name, quality in named:
        errors = (
            quality.fit_rms,
            quality.priced_rms,
            quality.left_out_rms,
            quality.worst,
            quality.shape_rms,
        )
        rows.append([name, *map(millimetres, errors)])
    return table(["error in mm", "RMS", "priced", "left out", "worst", "shape"], rows)


def _parameter_table(result: Addition) -> str:
    rows = []
    for parameter in result.parameters:
        if parameter.of_patch:
            continue
        trusted = "free" if parameter.prior_sigma is None else number(parameter.prior_sigma)
        rows.append(
            [
                parameter.name,
                number(parameter.value),
                f"{number(parameter.low)} .. {number(parameter.high)}",
                number(parameter.before),
                trusted,
                parameter.unit,
                "" if parameter.plausible else "impossible",
            ]
        )
    return table(["number", "value", "interval", "before", "trusted to", "unit", ""], rows)
