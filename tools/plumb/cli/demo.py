"""`tools/demo`: an effect is hidden in a virtual machine, found and cured."""

import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from plumb.cli.add import heading_of, stair_title, stairs_of
from plumb.cli.compare import panel_of
from plumb.cli.main import Parser
from plumb.cli.output import ended, write_outputs
from plumb.cli.screen import bar, headline, sentences, table
from plumb.cure.machine_file import toml_of
from plumb.fit.compare import Comparison
from plumb.grid.options import Grid
from plumb.model.plain import plainly
from plumb.pictures.drawing import draw
from plumb.text.files import DEMO_MARKS
from plumb.text.values import bare
from plumb.vm.garage import RANDOM, described, hide, random_garage
from plumb.vm.loop import Loop, closed_loop
from plumb.vm.owner import VirtualOwner

BUILT = str(Path(__file__).resolve().parents[3] / ".pio/build/megaatmega2560/firmware.elf")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the demo; 0 if the error falls below the goal, else 1; 2 if a file cannot be written."""
    return ended(lambda: _run(arguments), name="demo")


def _run(arguments: Sequence[str] | None) -> int:
    parsed = _parser().parse_args(arguments)
    Path(parsed.folder).mkdir(parents=True, exist_ok=True)
    loop, files = shown(parsed.folder, seed=parsed.seed, elf=parsed.mega)
    write_outputs(files, inputs=[])
    print(loop_text(loop))
    print("\nWritten:")
    print(sentences([*files], mark="  "))
    print(f"\n{reveal(loop)}")
    return int(loop.left is None or loop.left > FALLEN * loop.before.rms)


def _parser() -> Parser:
    parser = Parser(
        prog="demo", description="Show how the error of a machine falls.", allow_abbrev=False
    )
    parser.add_argument(
        "--folder",
        metavar="FOLDER",
        default="build/demo",
        help="where the results go [%(default)s]",
    )
    parser.add_argument(
        "--seed", metavar="N", type=int, default=1, help="another machine, another effect [1]"
    )
    parser.add_argument(
        "--mega",
        metavar="ELF",
        nargs="?",
        const=BUILT,
        help="run a flashed program on a simulated Mega, ten minutes; without a name the program "
        "that pio run has built",
    )
    return parser


GRID = Grid(columns=5, rows=5)
MILLIMETRES = 3.0  # RMS by which what is hidden moves the marks
FALLEN = 0.5  # of the error before, at most, for the demo to have worked


def shown(folder: str, *, seed: int, elf: str | None) -> tuple[Loop, dict[str, bytes]]:
    """Hide something, go round once, and make the files."""
    print(sentences([INTRODUCTION.format(seed=seed)], mark=""))
    hidden = hide([RANDOM], millimetres=MILLIMETRES, seed=seed)
    owner = VirtualOwner(random_garage(hidden, seed), elf=elf)
    loop = closed_loop(owner, grid=GRID, progress=bar("the machine cuts"))
    named = {"error-falls.png": _picture(loop), **_texts(loop)}
    files = {os.path.join(folder, name): content for name, content in named.items()}
    return loop, files


INTRODUCTION = (
    "A virtual machine (seed {seed}): Plumb's own firmware drives simulated motors, and exact "
    "mechanics hang the sled. One physical effect is hidden in it, its frame and its sheet are off "
    "by a few millimetres, and its sled rubs. The lab sees settings and marks, nothing else."
)


def loop_text(loop: Loop) -> str:
    """Step by step what happened."""
    steps = [
        f"The machine cut {len(loop.before.marks)} marks, and a tape read them. They lie "
        f"{loop.before.rms:.2f} mm RMS from their targets.",
        f"plumb diagnose: {loop.first.sentence}",
    ]
    steps += [f"plumb next: {proposal.option.title}. The owner did it." for proposal in loop.done]
    return "\n\n".join(
        [
            sentences([*steps, *_cure(loop)]),
            _numbers(loop),
        ]
    )


def _cure(loop: Loop) -> list[str]:
    """Return what was added, and what the owner did with it."""
    if loop.auto.addition is None:
        return [f"plumb add: nothing was added: {loop.auto.reason}."]
    rise = loop.addition.sheet_rise
    return [
        f"plumb add: {plainly(loop.auto.chosen)}. It promises {loop.promised:.2f} mm RMS at marks "
        "that it did not see.",
        f"The new numbers went to the machine. The owner {'raised' if rise > 0 else 'lowered'} the "
        f"sheet's right end by {abs(rise):.1f} mm, as told, and cut the grid on a new sheet.",
    ]


def _numbers(loop: Loop) -> str:
    """Return the three numbers: before, promised, and measured at marks that took no part."""
    rows = [_row("before", loop.before)]
    if loop.after:
        rows += [
            ["promised", bare(None), bare(loop.promised), bare(None)],
            _row("measured on the new sheet", loop.after),
        ]
    return table(["error in mm", "RMS", "sheet laid at its best", "worst"], rows)


def _row(name: str, comparison: Comparison) -> list[str]:
    errors = (comparison.rms, comparison.shape_rms, comparison.worst)
    return [name, *map(bare, errors)]


def reveal(loop: Loop) -> str:
    """Return the last line: what it was, and whether the lab was right."""
    hidden = loop.owner.garage.hidden
    right = set(loop.auto.named) == set(hidden.effects)
    verdict = "The lab named it" if right else "The lab named something else"
    return headline(f"Hidden was {described(hidden)}. {verdict}.")


def _picture(loop: Loop) -> bytes:
    sheet = loop.owner.settings.sheet
    if not loop.after:
        return draw([panel_of(loop.before)], sheet=sheet)
    stairs = stairs_of(loop.addition, raw=loop.before)
    title = stair_title("On a new sheet", loop.after.rms)
    stairs.append(replace(panel_of(loop.after, good=True), title=title))
    heading = heading_of(loop.addition, loop.before.rms, loop.after.rms)
    return draw(stairs, heading=heading, sheet=sheet)


def _signed(form: str) -> bytes:
    """Return a form that the demo filled in, so that the next demo may replace it."""
    return DEMO_MARKS + form.encode()


def _texts(loop: Loop) -> dict[str, bytes]:
    files = {"marks.toml": _signed(loop.forms[0])}
    if loop.auto.addition:
        files["marks-2.toml"] = _signed(loop.forms[-1])
        files["machine.toml"] = toml_of(loop.addition, source="marks.toml")
    return files


if __name__ == "__main__":
    sys.exit(main())
