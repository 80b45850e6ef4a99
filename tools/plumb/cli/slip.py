"""Chains that slipped by whole links, and the line that repairs them: `plumb recover --touch`."""

import argparse
from dataclasses import dataclass

import numpy as np

from plumb.cli.arguments import unit_of
from plumb.cli.home import asked_signs, touches_of, write_program
from plumb.cli.output import say_failure
from plumb.cli.screen import BAD, GOOD, OPEN, headline, next_step, print_json, sentences, table
from plumb.diary.file import SLIP as SLIP_ENTRY
from plumb.diary.file import keep
from plumb.fit.inputs import settings_in
from plumb.job.home import HomeTouch, Point
from plumb.job.slip import (
    CANNOT_TELL,
    LINK,
    NOTHING,
    OTHER,
    SHEET,
    SLIP,
    SlipAccount,
    SlipFinding,
    find_slip,
    next_hole,
    repair_program,
)
from plumb.text.answers import Internal, in_json, json_of, part
from plumb.text.values import Unit

SIDES = ("left", "right")
SHOWN = 4  # accounts
SURE = 0.999  # odds beyond which no more digits are said


@dataclass(frozen=True)
class SlipTouch(HomeTouch):
    """A touched mark, its errors and the chains that the machine believes there [mm]."""

    error: list[float]  # of the hole, by the machine's chains
    left: list[float]  # of it after the likeliest account
    chains: list[float]


@dataclass(frozen=True)
class SlipAnswer:
    """Verdict on the chains, and the repair."""

    finding: Internal[SlipFinding]
    written: list[str]
    touch_next: Point | None  # where a hole would tell most
    unit: Internal[Unit]

    verdict = part("finding.verdict", str)
    accounts = part("finding.accounts", tuple[SlipAccount, ...], "The likeliest first.")
    sigma_mm = part("finding.sigma", float)

    @in_json
    def sentence(self) -> str:
        """The verdict in a sentence."""
        return sentence(self.finding, self.unit)

    @in_json
    def touches(self) -> list[SlipTouch]:
        """The touched marks."""
        found = self.finding
        numbers = (each.tolist() for each in (found.errors, found.left, found.believed))
        return [
            SlipTouch(**vars(touch), error=error, left=left, chains=chains)
            for touch, error, left, chains in zip(found.touches, *numbers, strict=True)
        ]

    @in_json
    def lines(self) -> list[str]:
        """The repair, if there is something to repair."""
        return repair_lines(self.finding)


def run(arguments: argparse.Namespace) -> int:
    """Weigh, write, print, and return the exit code."""
    settings = settings_in(arguments.settings)
    finding = find_slip(
        settings,
        touches_of(arguments),
        sigma=arguments.sigma,
        fixed=arguments.fixed,
        taped=arguments.taped,
    )
    lines = repair_lines(finding) if arguments.output else []
    answer = SlipAnswer(
        finding=finding,
        written=write_program(arguments, lines) if lines else [],
        touch_next=next_hole(settings, finding) if finding.verdict == CANNOT_TELL else None,
        unit=unit_of(arguments),
    )
    say_failure(keep(arguments.settings, SLIP_ENTRY, json_of(answer), begin=False))
    print_json(answer) if arguments.json else print(_text(answer, arguments))
    return int(finding.verdict not in (NOTHING, SHEET))


def repair_lines(finding: SlipFinding) -> list[str]:
    """Return the repair, if there is something to repair."""
    if finding.verdict != SLIP:
        return []
    where = f"the hole of touch {finding.touches[-1].name}"
    return repair_program(finding.true_chains, where=where)


def _text(answer: SlipAnswer, arguments: argparse.Namespace) -> str:
    unit = answer.unit
    good = GOOD if answer.verdict in (NOTHING, SHEET) else BAD
    kind = OPEN if answer.verdict == CANNOT_TELL else good
    parts = [headline(answer.sentence, kind), _touch_table(answer), _odds(answer)]
    if lines := answer.lines:
        there = answer.touches[-1]
        said = (
            f"Leave the bit in the hole of touch {there.name}, where the machine shows "
            f"{unit.bare(there.shown[0])}, {unit.bare(there.shown[1])}, and send the line that "
            f"says how long the chains are: {lines[-1]}. Then look why the chain could slip: a "
            "worn sprocket, a slack chain, a sled that hung."
        )
        parts.append(sentences([said], mark=""))
        repair = [arguments.output] if arguments.output else [lines[-1]]
        parts.append(next_step("Send it:", ["send", *repair]))
    elif answer.verdict == CANNOT_TELL:
        said = "Touch another hole far from these, and give all touches."
        if further := answer.touch_next:
            said = (
                f"Touch another hole near {unit.bare(further[0], 0)}, {unit.bare(further[1], 0)}, "
                "where the likeliest accounts differ most, and give all touches."
            )
        parts.append(sentences([said], mark=""))
    asked = asked_signs(answer.touches)
    return "\n\n".join([*parts, sentences(asked, mark="")] if asked else parts)


def sentence(finding: SlipFinding, unit: Unit) -> str:
    """Return the verdict in a sentence."""
    if finding.verdict == SLIP:
        both = 0 not in finding.best.links
        slipped = "both slipped on their sprockets" if both else "it slipped on its sprocket"
        return f"{_longer(finding.best, unit)}: {slipped}."
    worst = unit.worded(float(np.hypot(*finding.errors.T).max()))
    says = {
        NOTHING: f"No chain slipped: each hole is within {worst} of where the machine shows it.",
        SHEET: "No chain slipped: the sheet has moved, or another sheet is on the machine.",
        OTHER: f"No slip and no moved sheet explains errors of up to {worst}: check that each hole "
        "is the hole that you mean, the settings, and whether a motor or a beam has moved.",
        CANNOT_TELL: f"These touches cannot tell; the likeliest is: {_account(finding.best)}.",
    }
    return says[finding.verdict]


def _longer(account: SlipAccount, unit: Unit) -> str:
    """Return which chain is how much longer or shorter."""
    said = [
        f"the {side} chain is {abs(count)} link{'s' if abs(count) > 1 else ''} "
        f"({unit.worded(abs(count) * LINK)}) {'longer' if count > 0 else 'shorter'}"
        for side, count in zip(SIDES, account.links, strict=True)
        if count
    ]
    joined = " and ".join(said)
    return f"{joined[0].upper()}{joined[1:]} than the machine believes"


def _account(account: SlipAccount) -> str:
    """Return an account in a few words."""
    if account.kind == SLIP:
        said = [
            f"{side} {count:+d}" for side, count in zip(SIDES, account.links, strict=True) if count
        ]
        return f"a slip, links: {', '.join(said)}"
    return {
        NOTHING: "nothing but noise",
        SHEET: "the sheet has moved",
        OTHER: "something else",
    }[account.kind]


def _touch_table(answer: SlipAnswer) -> str:
    unit = answer.unit
    rows = [
        [
            touch.name,
            f"{unit.bare(touch.hole[0], 1)}, {unit.bare(touch.hole[1], 1)}",
            f"{unit.bare(touch.shown[0], 1)}, {unit.bare(touch.shown[1], 1)}",
            f"{unit.signed(touch.error[0])}, {unit.signed(touch.error[1])}",
            f"{unit.signed(touch.left[0])}, {unit.signed(touch.left[1])}",
        ]
        for touch in answer.touches
    ]
    heads = ["touch", f"hole [{unit.name}]", "shown", "error", "left by the likeliest"]
    return table(heads, rows)


def _odds(answer: SlipAnswer) -> str:
    rows = [
        [_account(account), _percent(account.odds)]
        for account in answer.accounts[:SHOWN]
        if account.odds >= 1e-4
    ]
    return table(["what may have happened", "odds"], rows)


def _percent(odds: float) -> str:
    """Odds for people; what is not quite certain does not look it."""
    return f"{100 * odds:.3g} %" if odds < SURE else f"> {100 * SURE:g} %"
