"""What `plumb add` says to people."""

from __future__ import annotations

from plumb.cli.screen import sentences, table
from plumb.cure.add import Addition
from plumb.cure.auto import AutoAddition
from plumb.cure.machine_file import PATCH_WARNING, turn_sentences
from plumb.diagnosis.noise import origin_words
from plumb.fit.covariates import PATCH
from plumb.model.plain import noun_of, plain_before, plain_size
from plumb.text.values import bare, unit, worded

NONE = "none"  # as an effect: the frame alone


def auto_text(result: AutoAddition) -> str:
    """Return the diagnosis and the choice for people, then the addition."""
    said = [sentences([result.diagnosis.sentence], mark="")]
    said += (
        [sentences([slip.sentence for slip in result.diagnosis.outliers])]
        if result.diagnosis.outliers
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
    """Return what a residual patch would buy, or has bought."""
    if with_patch >= without:
        return f"A residual patch would buy nothing ({worded(without)} on marks not used)."
    bought = f"{bare(without)} to {worded(with_patch)} on marks not used"
    if added:
        return f"The residual patch bought {bought}."
    return f"A residual patch (--patch) would buy {bought}. {PATCH_WARNING}"


# What the columns of the tables of errors mean, one family of words for all commands.
COLUMNS = (
    "Counted: the RMS, counted for the numbers fitted. Checked: on marks not used, each predicted "
    "by a fit without it."
)


def as_text(result: Addition, *, asked_patch: bool = False) -> str:
    """Return the addition for people, its conclusion first."""
    raw, before, after = result.raw, result.before, result.after
    verdict = "better" if result.pays else "NOT better"
    first = f"From {bare(raw.rms)} to {worded(after.fit_rms)} RMS"
    if result.by_effect:
        first += (
            f"; checked on marks not used, it is {verdict} with the effects "
            f"({bare(before.left_out_rms)} to {worded(after.left_out_rms)})"
        )
    first += "."
    parts = [sentences([first], mark=""), quality_table(result), parameter_table(result)]
    if result.benchmark_after:
        parts.insert(1, _benchmark_sentence(result))
    note = (
        f"{COLUMNS} Intervals hold for a reading error of {worded(result.after_fit.sigma)} "
        f"({origin_words(result.sigma_from)})."
    )
    parts.append(sentences([note], mark=""))
    said = [*turn_sentences(result), *result.cures, *result.warnings]
    if PATCH in result.effects_added:
        said.append(PATCH_WARNING)
    elif asked_patch:
        said.append("a residual patch would predict marks not used no better, so none was added")
    parts += [sentences(said)] if said else []
    return "\n\n".join(parts)


def _benchmark_sentence(result: Addition) -> str:
    """Return the community's score before, and what to expect of the next cut."""
    said = (
        f"Calibration Benchmark Score: {result.raw.benchmark} as cut; {result.benchmark_after} to "
        "expect when it is cut again with the new settings, if nothing else changes."
    )
    return sentences([said], mark="")


def quality_table(result: Addition) -> str:
    raw = result.raw
    start = (raw.rms, None, None, raw.worst, raw.shape_rms)
    rows = [["raw: the settings as they are", *map(bare, start)]]
    named = [("fitted: the frame", result.before)]
    named += [(f"fitted: + {noun_of(step.effect)}", step) for step in result.by_effect]
    for name, quality in named:
        errors = (
            quality.fit_rms,
            quality.corrected_rms,
            quality.left_out_rms,
            quality.worst,
            quality.shape_rms,
        )
        rows.append([name, *map(bare, errors)])
    return table([f"error in {unit()}", "RMS", "counted", "checked", "worst", "shape"], rows)


def parameter_table(result: Addition) -> str:
    rows = []
    for parameter in result.parameters:
        if parameter.of_patch:
            continue
        rows.append(
            [
                plain_size(parameter.name, parameter.value, parameter.low, parameter.high),
                plain_before(parameter.name, parameter.before, parameter.low, parameter.high),
                "" if parameter.plausible else "impossible",
            ]
        )
    return table(["fitted, with its 95 % interval", "before", ""], rows, words=[-1])
