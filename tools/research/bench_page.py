"""Writes docs/bench.md: what `plumb bench` hides, its rates, and what they mean."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from plumb.bench.report import (
    CURE_HEADER,
    HEADER,
    LOOP_HEADER,
    Report,
    cells,
    cure_cells,
    line_words,
    loop_cells,
    value_words,
)
from plumb.bench.report import (
    run as run_bench,
)
from plumb.bench.scenarios import CURE, LOOP, SCENARIOS
from plumb.cli.arguments import add_force, count
from plumb.cli.bench import counted
from plumb.cli.output import INTERRUPTED, ended, refuse_early, results_of, write_outputs
from tables import markdown_table

INTRODUCTION = """# How often the diagnosis is right

Written by `tools/research/bench_page.py --boards 40 --seed 4242 --write docs/bench.md`; run it to
see the same with other boards (`--seed`).

The settings that cut each board know the frame, chain sag and stretch. The judge (tools/judge,
exact elastic catenaries that share no formula with the model) says where the sled really went, with
something hidden. In every board the frame is off by chance: spacing 3 mm, height and middle 5 mm,
sheet turned by 2 mrad (standard deviations). Every reading has its noise.

- *Effects take turns*, and so do the directions of their parameters (the left chain long, both
  long, ...). `mm` is the RMS by which marks would move before anything is refitted.
- A tilt of both motors and the chains' zeros *are* the frame: marks cannot show them, so they
  appear among usual sizes only. No real machine moves marks by 3 mm with frame lean or runout:
  they have a separate scenario (`huge-25`). Friction of 3 mm would leave marks in the lower
  corners centimetres behind; it appears with up to 1.5 usual sizes.
- *Right class first*: the first explanation is the truth, or draws the same arrows (|cosine| >
  0.98 with the frame refitted; here that is chain_pitch of both chains and tape_scale, chain_sag
  and frame_lean).
- *Suspects*: mean number of effects named, over the boards where the lab named any. *Truth
  inside*: the truth is one of the explanations, or its size is below what "could hide" where
  nothing is provable.
- *Unknown*: a bump as wide as 0.35 half sheets, a field of second and third degree, a sled that
  tips over an edge. *Flagged*: not in the library, or a reading to look at again.
- *Pairs*: 6 mm each of two effects; *both*: both are among the suspects.
- *Slips* (`slips-`): of 5, 10 and 30 mm, at marks that are read once and at marks that are read
  again. *Large* is 10 mm and more. *False slip*: a reading was named that is right.
- *Usual machines* (`usual-`): published settings, which know nothing of the chain's stretch; a
  chain that stretches 0.6 to 1.6 times as usual, friction, backlash, and one or two effects of
  usual size.
  *Truth covered*: an explanation has all of the truth but what could hide, and nothing else.
  *Invented*: all explanations share an effect that is not there.
- *Loops* (`loop-`): the rates after two rounds in which what `plumb next` puts first was measured.
- *Judged*: `open` means that the line is not reached, but these boards are too few to tell.
"""
CURES = """
## At the sled

The error of the judge's sled over the whole sheet [mm]: RMS of its shape (the sheet laid at its
best), mean over boards; with the settings as they were, with the frame refitted, with the best
explanation added, and with the truth added. Where nothing is provable the lab adds nothing;
where nothing fits, it adds the effect that stands out most.
"""

LOOPS = """
## After two rounds of proposals

The same where the owner twice measures what `plumb next` puts first (marks on the same sheet, or a
direct check of a number), with the mean number of marks read and numbers checked for it. The truth
is known to a fit of the same marks and checks. Pairs of 6 mm need chains up to three times as heavy
as usual. There the law of sag is a tenth off, so a direct check of the chain contradicts the marks;
the lab then asks for a reading again and adds nothing.
"""


def page(report: Report) -> str:
    """Return the whole page."""
    parts = [INTRODUCTION, _boards(report)]
    parts += [markdown_table(HEADER, cells(report)), ""]
    if report.cures:
        parts.append(CURES)
        parts += [markdown_table(CURE_HEADER, cure_cells(report.cures)), ""]
        parts.append(f"\nLine for the ratio of all: {line_words(CURE)}, {report.cure_judged}.\n")
    if report.loops:
        parts.append(LOOPS)
        parts += [markdown_table(LOOP_HEADER, loop_cells(report.loops)), ""]
        parts.append(f"\nLine for the ratio of all: {line_words(LOOP)}, {report.loop_judged}.\n")
    if report.by_kind:
        rows = [
            [rate.scenario, rate.hidden, rate.name, value_words(rate)] for rate in report.by_kind
        ]
        parts.append("\n## By what was hidden\n")
        parts += [markdown_table(("scenario", "hidden", "rate", "seen"), rows), ""]
    return "\n".join(parts)


def _boards(report: Report) -> str:
    """Return how many boards there are, and which."""
    fewer = sorted({loop.boards for loop in report.loops[:-1] or report.loops} - {report.boards})
    loops = f" ({' or '.join(map(str, fewer))} of each loop)" if fewer else ""
    return f"{report.boards} boards of each scenario{loops}, seed {report.seed}.\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the bench, write the page, and return the exit code."""
    words = argparse.ArgumentParser(
        description=__doc__,
        epilog="Exit: 0 done, whatever the rates; 2 it cannot run; 130 interrupted, what is done "
        "is written.",
    )
    words.add_argument("--boards", metavar="N", type=count, default=200, help="of each [200]")
    words.add_argument("--seed", metavar="S", type=int, default=1, help="other boards [1]")
    words.add_argument("--jobs", metavar="N", type=count, default=1, help="processes at once [1]")
    words.add_argument("--write", metavar="FILE", required=True, help="the page")
    add_force(words)
    wanted = words.parse_args(arguments)
    return ended(lambda: _run(wanted), name="bench_page.py")


def _run(wanted: argparse.Namespace) -> int:
    with results_of(wanted):
        refuse_early(wanted.write)
        report = run_bench(
            SCENARIOS,
            boards=wanted.boards,
            seed=wanted.seed,
            progress=counted(len(SCENARIOS) * wanted.boards),
            jobs=wanted.jobs,
        )
        write_outputs({wanted.write: page(report).encode()}, inputs=[])
    return INTERRUPTED if report.interrupted else 0


if __name__ == "__main__":
    sys.exit(main())
