"""`plumb next`: the most useful next measurement, with the chance that it settles the question."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from plumb.cli.checked import with_stated
from plumb.cli.diagnose import proposal_json
from plumb.cli.files import inputs_of, picture_form, settings_in
from plumb.cli.output import refuse_twins, write_outputs
from plumb.cli.screen import bar, sentences, table
from plumb.cli.steps import free_name, next_step, same_inputs
from plumb.cli.text import print_json
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.sentence import verdict_sentence
from plumb.fit.inputs import Inputs
from plumb.grid.cut_with import cut_with_lines
from plumb.model.plain import noun_of, plainly
from plumb.pictures.plan import draw_plan
from plumb.plan import Next, Proposal, propose
from plumb.plan.plan_marks import marks_file
from plumb.plan.proposal import AGAIN, CONFIRM, EXPLORE, FIND, REREAD, SETTLE
from plumb.text.errors import InputError
from plumb.text.shown import bare, worded

SHOWN, SPOKEN = 8, 3  # proposals in the table, and in whole sentences; --json has all
HEADS = {
    SETTLE: "chance to settle",
    CONFIRM: "chance to confirm",
    FIND: "could hide then",
    REREAD: "chance to show it",
    EXPLORE: "",
}


def run(arguments: argparse.Namespace) -> int:
    """Diagnose, propose, write, print, and return the exit code."""
    refuse_twins(arguments.picture, arguments.template)
    form = picture_form(arguments.picture) if arguments.picture else ""
    inputs = with_stated(inputs_of(arguments), arguments)
    diagnosis = diagnose(inputs)
    advice = propose(diagnosis, inputs, progress=bar("simulating"))
    files = _files(arguments, advice, inputs, form)
    read = [arguments.settings, *arguments.marks, *filter(None, [arguments.cut_with])]
    write_outputs(files, inputs=read)
    if arguments.json:
        print_json({**as_json(diagnosis, advice), "written": list(files)})
    else:
        print(as_text(diagnosis, advice))
        if advice.proposals:
            print(f"\n{after(advice.proposals[0], arguments)}")
    return 0


def _files(
    arguments: argparse.Namespace, advice: Next, inputs: Inputs, form: str
) -> dict[str, bytes]:
    """The files that were asked for."""
    if not (arguments.picture or arguments.template):
        if arguments.choose is not None:
            raise InputError("--choose is for --picture and --marks: add --picture or --marks")
        return {}
    place, chosen = _chosen(advice, arguments.choose)
    case, option = advice.case, chosen.option
    assert case, "what is proposed is proposed for a case"
    files: dict[str, bytes] = {}
    machine = inputs.cut_with or inputs.settings
    if arguments.picture:
        old = inputs.measurements.targets
        files[arguments.picture] = draw_plan(
            option.visits,
            np.unique(old, axis=0) if len(old) else old,
            title=f"Next: {option.title}",
            usual_weight=case.usual_weight,
            sheet=machine.sheet,
            form=form,
        )
    if arguments.template:
        text = marks_file(
            option.visits,
            sheet=machine.sheet,
            controller=case.controller,
            said=(f"Proposal {place}: {option.title}.", *option.do),
            cut_with=_cut_with(arguments, inputs),
        )
        files[arguments.template] = text.encode()
    return files


def _cut_with(arguments: argparse.Namespace, inputs: Inputs) -> str:
    """The lines that name the settings that move the machine for these marks, if a file has them.

    They are those of the marks there are: the new marks are cut before anything is changed.
    """
    in_force = inputs.measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings
    for path in (arguments.cut_with, arguments.settings):
        if path and settings_in(path) == in_force:
            return cut_with_lines(path, arguments.template)
    return ""


def _chosen(advice: Next, wanted: int | None) -> tuple[int, Proposal]:
    """The proposal to draw, with its place."""
    having = [i for i, proposal in enumerate(advice.proposals, 1) if len(proposal.option.visits)]
    if not having:
        raise InputError("nothing is proposed that has marks: leave out --picture and --marks")
    place = having[0] if wanted is None else wanted
    if place not in having:
        raise InputError(
            f"--choose {place}: the proposals that have marks are {', '.join(map(str, having))}"
        )
    return place, advice.proposals[place - 1]


def as_json(diagnosis: Diagnosis, advice: Next) -> dict[str, Any]:
    """The proposals by the names of the interface."""
    return {
        "verdict": diagnosis.verdict,
        "sentence": verdict_sentence(diagnosis),
        "suspects": diagnosis.suspects,
        "next": [proposal_json(proposal) for proposal in advice.proposals],
        "more_marks": proposal_json(advice.blind) if advice.blind else None,
        "stable": None
        if advice.stable is None
        else {"kept": advice.stable[0], "of": advice.stable[1]},
    }


def as_text(diagnosis: Diagnosis, advice: Next) -> str:
    """The proposals for people, the best first."""
    parts = [sentences([verdict_sentence(diagnosis)], mark="")]
    if not advice.proposals:
        parts.append("Nothing that can be proposed would tell more.")
        return "\n\n".join(parts)
    parts.append(first_proposal(advice.proposals[0]))
    if advice.stable and advice.stable[1]:
        parts.append(sentences([_stable(*advice.stable)], mark=""))
    if len(advice.proposals) > 1:
        parts.append(_table(advice))
        steps = [
            f"{place}. {' '.join(proposal.option.do)}"
            for place, proposal in enumerate(advice.proposals[1:SPOKEN], 2)
        ]
        parts.append(sentences(steps, mark=""))
    parts.append(sentences([_how(advice)], mark=""))
    if diagnosis.warnings:
        parts.append(sentences(diagnosis.warnings))
    return "\n\n".join(parts)


def after(best: Proposal, arguments: argparse.Namespace) -> str:
    """The commands after the measurement."""
    if best.option.checks or not len(best.option.visits):
        checks = [
            word
            for check in best.option.checks
            for word in ("--checked", f"{check.name}=VALUE+-{check.sigma:g}")
        ]
        again = ["calibrate", *same_inputs(arguments), *checks]
        return next_step("When that is measured:", again)
    written: str | None = getattr(arguments, "template", None)
    form = written or free_name("more", ".toml")
    again = ["calibrate", *same_inputs(arguments, form)]
    said = next_step("When they are measured:", again)
    if written:
        return said
    asked = ["next", *same_inputs(arguments), "--marks", form]
    return f"{next_step('A form for them:', asked)}\n{said}"


def first_proposal(best: Proposal) -> str:
    """The best proposal in sentences."""
    minutes = f"about {best.option.minutes:.0f} minutes"
    said = [*best.option.do]
    if best.parts:
        pairs = [f"{_nouns(a)} from {_nouns(b)}" for a, b in best.parts]
        said.append(f"It tells {'; '.join(pairs)}.")
    if best.option.checks:
        said.append(f"VALUE: {best.option.value}.")
    first = sentences([f"Next: {best.option.title}; {minutes}{_promise(best)}."], mark="")
    return f"{first}\n{sentences(said, mark='  ')}"


def _promise(best: Proposal) -> str:
    if best.question == FIND and best.rooms:
        first = best.rooms[0]
        noun = noun_of(first.effect)
        now, then = (worded(size, 1) for size in (first.now, first.then))
        return f". {noun[0].upper()}{noun[1:]} could hide {now} now, {then} then"
    if best.chance is None:
        return ""
    verb = {SETTLE: "settle it", CONFIRM: "confirm it", REREAD: "show it"}.get(best.question, "")
    return f", chance to {verb} {_percent(best.chance)}" if verb else ""


def _stable(kept: int, of: int) -> str:
    return f"Leaving out any single mark keeps the suspect in {kept} of {of} cases" + (
        ": it does not hang on a single reading."
        if kept == of
        else ": it hangs on single readings."
    )


def _table(advice: Next) -> str:
    question = advice.proposals[0].question
    header = ["", "other ways" if question != EXPLORE else "", "minutes", HEADS[question]]
    counted = question in (SETTLE, CONFIRM)
    rows = [
        _row(f"{i}", proposal, counted) for i, proposal in enumerate(advice.proposals[:SHOWN], 1)
    ]
    if advice.blind:
        rows.append(_row("-", advice.blind, counted))
    if counted:
        header += ["suspects left", "tells apart"]
    header[1] = "what"
    return table(header, rows, left=2)


def _row(place: str, proposal: Proposal, counted: bool) -> list[str]:
    if proposal.question == FIND and proposal.rooms:
        promise = ", ".join(
            f"{noun_of(room.effect)} {bare(room.now, 1)} -> {worded(room.then, 1)}"
            for room in proposal.rooms[:2]
            if room.then < 0.9 * room.now
        )
    else:
        promise = _percent(proposal.chance)
    row = [place, proposal.option.title, f"{proposal.option.minutes:.0f}", promise or "no change"]
    if counted:
        pairs = (
            f"{len(proposal.parts)} pair{'s' if len(proposal.parts) != 1 else ''}"
            if proposal.parts
            else ""
        )
        row += [f"{proposal.left:.1f}" if proposal.left is not None else "-", pairs or "none"]
    return row


def _percent(chance: float | None) -> str:
    """A chance in steps of five in a hundred: it is not known better."""
    if chance is None:
        return "-"
    near = 5 * round(20 * chance)
    return "below 5 %" if near < 5 else "above 95 %" if near > 95 else f"{near:.0f} %"


def _how(advice: Next) -> str:
    question = advice.proposals[0].question
    again = f"{AGAIN:.0f} minutes added for another round"
    if question == SETTLE:
        return (
            "Chances are simulated: each suspect is taken for the truth as often as it is "
            "probable, new readings are drawn with their noise, and the diagnosis is repeated. "
            f"The order is chance per minute, {again}."
        )
    if question == CONFIRM:
        return (
            "Chances are simulated as if the effects that failed their test narrowly might be the "
            "truth: confirmed means that only the true effect is left. Direct checks come first; "
            f"then the order is chance per minute, {again}."
        )
    if question == FIND:
        return f"The order is the millimetres of doubt removed per minute, {again}."
    if question == REREAD:
        return "A slip hides what else the marks could say, so nothing else is proposed yet."
    return (
        "No chance can be computed for an effect that is not known. Also fit the left and right, "
        "or the upper and lower, half of the marks by themselves: where their numbers differ, "
        "something is local."
    )


def _nouns(explanation: str) -> str:
    """An explanation, `effect + effect`, in a maker's words."""
    return plainly(explanation.split(" + "))
