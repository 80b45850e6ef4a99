"""Chains that slipped by whole links, and the line that repairs them: `plumb recover --touch`."""

import argparse

from plumb.cli.arguments import unit_of
from plumb.cli.home import touches_of, write_program
from plumb.cli.output import say_failure
from plumb.cli.screen import headline, in_text, next_step, print_json, sentences
from plumb.diary.file import SLIP, keep
from plumb.fit.inputs import settings_in
from plumb.job.slip import CANNOT_TELL, find_slip, next_hole
from plumb.text.answers import json_of
from plumb.words.recover import KINDS, SlipAnswer, asked_signs, repair_lines


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
    say_failure(keep(arguments.settings, SLIP, json_of(answer), begin=False))
    print_json(answer) if arguments.json else print("\n\n".join(_text(answer, arguments)))
    return int(KINDS[finding.verdict] != "good")


def _text(answer: SlipAnswer, arguments: argparse.Namespace) -> list[str]:
    parts = [headline(answer.sentence, KINDS[answer.verdict]), *in_text(answer.tables)]
    parts += [sentences([answer.to_do], mark="")] if answer.to_do else []
    if answer.lines:
        parts.append(next_step("Send it:", ["send", arguments.output or answer.lines[-1]]))
    asked = asked_signs(answer.touches)
    return [*parts, sentences(asked, mark="")] if asked else parts
