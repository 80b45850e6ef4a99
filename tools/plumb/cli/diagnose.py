"""`plumb diagnose`: which effect the settings miss, as far as the marks can prove it."""

from __future__ import annotations

import argparse
from typing import Any

from plumb.cli.checked import add_checked, usable_checks
from plumb.cli.files import add_json, add_marks, add_prior, add_sigma, inputs_of
from plumb.cli.text import millimetres, number, print_json, sentences, table
from plumb.cure.add import priors_with
from plumb.diagnose import Diagnosis, diagnose
from plumb.diagnose.diagnosis import Ranked, Together
from plumb.diagnose.sentence import SHOWN, verdict_sentence
from plumb.diagnose.sizes import Size
from plumb.model.catalogue import every_effect, label, place_of
from plumb.plan import Proposal, propose

HELP = "which effect the settings miss, as far as the marks can prove it"
EXIT = (
    "Exit: 0 done; 1 done, but a mark should be measured again or no effect of the library "
    "explains the marks; 2 an input cannot be used."
)
BAD_NEWS = ("slip", "not_in_library")
UNKNOWN_ADVICE = (
    "is it such a machine? The library is that of a sled on one ring or linkage; on two brackets "
    "(quadrilateral) it leans and draws another pattern",
    "were these settings in force when the marks were cut? If not, name those by --cut-with, or as "
    "cut_with in the marks.toml",
    "does y run the way the file says, and are all numbers of one kind? Measure one mark again",
    "if all that is so, look where the errors are: plumb compare ... --picture errors.png",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb diagnose`."""
    add_marks(parser)
    add_prior(parser)
    add_sigma(parser, usual="repeats, else tape_sigma_mm of MARKS, else 0.5")
    add_checked(parser)
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Diagnose, print, and return the exit code."""
    inputs = inputs_of(arguments)
    priors = priors_with(arguments.prior)
    told = {
        "cut_with": inputs.cut_with,
        "controller": arguments.controller,
        "priors": priors,
        "checked": usable_checks(arguments.checked, priors),
    }
    found = diagnose(inputs.settings, inputs.measurements, sigma=arguments.sigma, **told)
    if arguments.json:
        answer = propose(found, inputs.settings, inputs.measurements, **told)
        print_json({**as_json(found), "next": [proposal_json(one) for one in answer.proposals]})
    else:
        print(as_text(found))
    return int(found.verdict in BAD_NEWS)


def as_json(found: Diagnosis) -> dict[str, Any]:
    """The diagnosis by the names of the interface."""
    return {
        "verdict": found.verdict,
        "sentence": verdict_sentence(found),
        "sigma_mm": found.noise.sigma,
        "sigma_from": found.noise.source,
        "sigma_degrees": found.noise.degrees,  # null: it was not estimated
        "rms_mm": found.rms_before,
        "suspects": found.suspects,
        "to_add": found.to_add,
        "chance": found.chance,  # that so many effects explain what none of them made
        "explanations": [
            {
                "effects": one.effects,
                "rms_after_mm": one.rms_after,
                "parameters": [
                    {"effect": name, **_size_json(size)}
                    for name in one.effects
                    for size in one.sizes[name]
                ],
            }
            for one in found.explanations
        ],
        "ranking": [_ranked_json(one) for one in found.ranking],
        "slips": [
            {
                "name": one.name,
                "offset_mm": one.offset,
                "sigma_mm": one.sigma,
                "read": one.read,
                "expected": one.expected,
                "guess": one.guess,
                "sentence": one.sentence,
            }
            for one in found.slips
        ],
        "could_hide": [
            {
                "effect": one.effect,
                "mm": one.mm,
                "parameters": [
                    {"name": name, "largest": largest, "unit": unit}
                    for name, largest, unit in one.limits
                ],
            }
            for one in found.could_hide
        ],
        "disagreements": found.disagreements,
        "warnings": found.warnings,
    }


def _ranked_json(one: Ranked) -> dict[str, Any]:
    return {
        "effect": one.effect,
        "where": place_of(one.effect),
        "gain": one.gain,
        "surprise": one.surprise,
        "parameters": [_size_json(size) for size in one.sizes],
        "rms_after_mm": one.rms_after,
        "hidden_share": one.hidden_share,
        "plausible": one.plausible,
    }


def _size_json(one: Size) -> dict[str, Any]:
    return {
        "name": one.name,
        "value": one.value,
        "low": one.low,
        "high": one.high,
        "unit": one.unit,
        "plausible": one.plausible,
    }


def proposal_json(one: Proposal) -> dict[str, Any]:
    """One proposal for the next measurement by the names of the interface."""
    visits = one.option.visits
    return {
        "kind": one.option.kind,
        "title": one.option.title,
        "do": one.option.do,
        "minutes": one.option.minutes,
        "chance": one.chance,
        "chance_to": one.question,
        "suspects_left": one.left,
        "parts": one.parts,
        "could_hide": [
            {"effect": own.effect, "now_mm": own.now, "then_mm": own.then} for own in one.rooms
        ],
        "marks": [
            {
                "name": visits.names[i],
                "target": visits.targets[i],
                "sled_weight_n": visits.sled_weights[i],
                "approach": visits.approaches[i] if visits.approaches[i].any() else None,
                "chains_swapped": bool(visits.swapped[i]),
            }
            for i in range(len(visits))
        ],
        "checks": [{"name": own.name, "sigma": own.sigma} for own in one.option.checks],
    }


def as_text(found: Diagnosis) -> str:
    """The diagnosis for people, its verdict first."""
    parts = [sentences([verdict_sentence(found)], mark="")]
    if found.slips:
        parts.append(sentences([one.sentence for one in found.slips]))
    if found.disagreements:
        parts.append(sentences(found.disagreements))
    elif found.verdict == "not_in_library":
        parts.append(sentences(_unknown_advice(found)))
    if found.explanations:
        parts.append(_explanation_table(found))
        if found.verdict == "cannot_tell":
            parts.append(_reasons(found))
        parts.append(_remedies(found))
    parts.append(_noise_sentence(found))
    parts.append(_hiding(found))
    if found.warnings:
        parts.append(sentences(found.warnings))
    parts.append("What to measure next: plumb next, with the same files.")
    return "\n\n".join(parts)


def _unknown_advice(found: Diagnosis) -> list[str]:
    """What to look at when nothing in the library fits."""
    if found.noise.source != "default":
        return list(UNKNOWN_ADVICE)
    doubt = (
        f"are the readings good to {found.noise.sigma:.1f} mm? Nothing says so; holes that wander "
        "and a coarse tape look just like this. Read some marks again, or state what you trust "
        "them to by --sigma"
    )
    return [doubt, *UNKNOWN_ADVICE]


def _explanation_table(found: Diagnosis) -> str:
    rows = []
    for one in found.explanations[:SHOWN]:
        rows += [["or"] + [""] * 5] if rows else []
        for name in one.effects:
            rows += _size_rows(one, name)
    header = ["suspect", "size", "interval", "unit", "error falls to", ""]
    return table(header, rows)


def _size_rows(one: Together, name: str) -> list[list[str]]:
    rows = []
    for i, size in enumerate(one.sizes[name]):
        first = i == 0 and name == one.effects[0]
        interval = "-" if size.low is None else f"{number(size.low)} .. {number(size.high)}"
        rows.append(
            [
                f"{'' if name == one.effects[0] else '+ '}{name}.{size.name}",
                number(size.value),
                interval,
                size.unit,
                f"{millimetres(one.rms_after)} mm" if first else "",
                "" if size.plausible else "impossible: a stand-in for something else",
            ]
        )
    return rows


def _reasons(found: Diagnosis) -> str:
    """Why suspects cannot be told apart: how little their arrows differ."""
    said = []
    for (i, j), apart in sorted(found.differences.items(), key=lambda one: one[1]):
        if j >= SHOWN or len(said) == 3:
            continue
        names = [" + ".join(found.explanations[k].effects) for k in (i, j)]
        said.append(
            f"{names[0]} and {names[1]} draw nearly the same arrows on these marks: they differ by "
            f"{apart:.2f} mm RMS, the noise is {found.noise.sigma:.2f} mm"
        )
    return sentences(said)


def _remedies(found: Diagnosis) -> str:
    words = {one["name"]: one for one in every_effect()}
    said = [
        f"{label(name)}: {words[name]['summary']}. To be sure: {words[name]['remedy']}"
        for name in found.suspects[:SHOWN]
    ]
    return sentences(said)


def _noise_sentence(found: Diagnosis) -> str:
    noise = found.noise
    origin = {
        "stated": "as stated",
        "repeats": f"from repeats, {noise.degrees:.0f} degrees of freedom",
        "scatter": "from the marks' own scatter",
        "default": "a tape's usual one",
    }[noise.source]
    return f"Noise of one reading: {noise.sigma:.2f} mm ({origin}). Intervals: 95 %."


def _hiding(found: Diagnosis) -> str:
    """How large effects that are not proved could still be."""
    unproved = [one for one in found.could_hide if one.effect not in found.suspects]
    hiding = sorted((one for one in unproved if one.mm), key=lambda one: -one.mm)
    shares = {one.effect: one.hidden_share for one in found.ranking}
    rows = [
        [
            one.effect,
            f"{millimetres(one.mm, 1)} mm",
            "-" if shares[one.effect] is None else f"{100 * shares[one.effect]:.0f} %",
            ", ".join(_limit(name, largest, unit) for name, largest, unit in one.limits),
        ]
        for one in hiding[:SHOWN]
    ]
    blind = [one.effect for one in unproved if one.mm is None]
    parts = []
    if rows:
        header = ["could still hide", "up to", "in the frame", "each at most"]
        parts.append(table(header, rows))
    if blind:
        parts.append(sentences([f"these marks say nothing of {', '.join(blind)}"]))
    return "\n".join(parts)


def _limit(name: str, largest: float | None, unit: str) -> str:
    return f"{name} {number(largest)} {unit}".removesuffix(" 1") if largest is not None else name
