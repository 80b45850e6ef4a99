"""An equal program that this machine runs: places that it does not have, motions that are left out.

Some habits of CAM programs halt this machine, or send its bit into the wood: a retract to the home
of another machine (`G28 G91 Z0`), a place near the top of another machine's z (`G53 G0 Z-5`), a
place behind G80 without G0, holes with broken chips (G73), and pecks of no depth (Q0). Each is
written as this machine reads it, line for line. Then the dry run must cut the same as the program
itself on machines that have a home, wherever that home is.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.job.dry_run import CLEAR, GOUGES, HALTS, Finding, Moves, findings_of, pieces
from plumb.job.resume import NO_CYCLE, JobMachine, Modes, Place, Word
from plumb.job.wood import FOREIGN
from plumb.model.predict import Array
from plumb.text.answers import Internal
from plumb.text.errors import InputError
from plumb.text.values import INCH

HOME, MACHINE = (28.0, 30.0), 53.0
NO_PLACE, NO_MODE = "no place is kept for it", "no motion is in force after G80"
NO_CHIPS, NO_PECK = "this machine does no G73", "G83 needs Q"
CYCLE, PECK = re.compile(r"(?i)g0*(73|83)(?![\d.])"), re.compile(r"(?i)\s*q\s*[-+.\d]+")
AXES = "XYZ"
HOMES = ((0.0, 0.0, 0.0), (37.0, -23.0, 7.0))  # [mm] x, y, and z above all the program
SAME = 2e-3  # [mm] between two cuts that are the same
REMEDY = "change it where the program was made"


@dataclass(frozen=True)
class FixedLine:
    """A line that was changed."""

    line: int
    before: str
    after: str
    why: str
    goes_home: Internal[bool] = False  # a machine that has a home does the line as it is
    drills: Internal[bool] = False


@dataclass(frozen=True)
class Fixed:
    """A program that the machine runs."""

    lines: tuple[str, ...]
    changes: tuple[FixedLine, ...]


def fixed(
    machine: JobMachine, lines: Sequence[str], findings: Sequence[Finding], *, source: str
) -> Fixed:
    """Return an equal program; InputError at the first line for which none is known. `findings` of
    the program as it is, `source` its name.
    """
    moves = machine.after(lines).finish().moves
    top = max(CLEAR, float(moves["z_to"][moves.over_sheet].max(initial=0.0)))
    changes = tuple(_changes(lines, findings, top))
    if not changes and not _halts(findings):
        return Fixed(tuple(lines), ())
    written = _with(lines, {each.line: each.after for each in changes})
    after = machine.after(written).finish()
    for each in _halts(findings_of(after)):
        raise _unknown(source, each.line, f"{lines[each.line - 1].strip()} ({each.says})")
    _refuse_cuts_of(changes, after.moves, source)
    others = {each.line: each.after for each in changes if not each.goes_home}
    mended = _at_home(machine, written, HOMES[0], top)
    for home in HOMES:
        _refuse_other_cuts(_at_home(machine, _with(lines, others), home, top), mended, source)
    return Fixed(tuple(written), changes)


def has_habit(findings: Sequence[Finding]) -> bool:
    """Return whether fixed() knows a habit that is among the findings."""
    habits = (NO_PLACE, NO_MODE, NO_CHIPS, NO_PECK)
    known = any(each.says.startswith(habits) for each in _halts(findings))
    return known or _means_top(findings)


def _means_top(findings: Sequence[Finding]) -> bool:
    return any(each.kind == GOUGES and "Carbide Create" in each.says for each in findings)


def _unknown(source: str, line: int, why: str) -> InputError:
    """Return the refusal of a line for which no equal line is known."""
    return InputError(source, f"cannot be fixed: {why}", place=f"line {line}", remedy=REMEDY)


def _halts(findings: Sequence[Finding]) -> list[Finding]:
    return [each for each in findings if each.kind == HALTS]


def _with(lines: Sequence[str], others: dict[int, str]) -> list[str]:
    return [others.get(number, line) for number, line in enumerate(lines, start=1)]


# Which lines change, and to what.


def _changes(lines: Sequence[str], findings: Sequence[Finding], top: float) -> Iterator[FixedLine]:
    """Yield the lines to change, `top` [mm] the highest z of the program."""
    halting = {line: each.says for each in _halts(findings) for line in each.lines}
    means_top = _means_top(findings)
    modes = Modes()
    for number, line in enumerate(lines, start=1):
        words = pieces(line)
        modes.take(words)
        says = halting.get(number, "")
        change = None
        if says.startswith(NO_PLACE):
            change = _homeless(number, line, words, modes, top)
        elif means_top and FOREIGN.search(line):
            change = _from_top(number, line, words, modes, top)
        elif says.startswith(NO_MODE) and modes.motion == NO_CYCLE:
            change = _after_cycle(number, line, words, modes)
        elif says.startswith((NO_CHIPS, NO_PECK)) and CYCLE.search(line):
            change = _drilled(number, line, words)
        if change:
            yield change


def _drilled(number: int, line: str, words: Sequence[Word]) -> FixedLine:
    """Return the holes of a G73 by G83, or by G81 where a peck has no depth."""
    if any(each.get("Q", 0.0) > 0 for _, _, each in words):
        after, why = CYCLE.sub("G83", line.strip()), "this machine pecks by G83"
        return FixedLine(number, line.strip(), after, why, drills=True)
    after = PECK.sub("", CYCLE.sub("G81", line.strip()))
    why = "a peck without a depth is the whole hole: G81"
    return FixedLine(number, line.strip(), after, why, drills=True)


def _after_cycle(number: int, line: str, words: Sequence[Word], modes: Modes) -> FixedLine | None:
    """Return the line as a rapid move, if that was in force before the holes."""
    if modes.before_cycle != 0 or any(code == NO_CYCLE for _, code, _ in words):
        return None
    modes.motion = 0
    why = "behind G80 this machine wants the code of a motion; before the holes it was G0"
    return FixedLine(number, line.strip(), f"G0 {line.strip()}", why)


def _homeless(
    number: int, line: str, words: Sequence[Word], modes: Modes, top: float
) -> FixedLine | None:
    """Return a retract in place of the way home; None where the way there may cut."""
    axes = {axis: value for _, code, each in words for axis, value in each.items() if axis in AXES}
    if modes.motion > NO_CYCLE or (not modes.relative and axes.get("Z", 0.0) < 0):
        return None
    homed = "".join(axes) or AXES
    why = "this machine has no home: "
    if "Z" not in homed:
        after = _codes(words, HOME)
        return FixedLine(number, line.strip(), after, why + "the sled stays", goes_home=True)
    after = _risen(words, HOME, modes, top)
    return FixedLine(number, line.strip(), after, why + "the bit goes up instead", goes_home=True)


def _from_top(
    number: int, line: str, words: Sequence[Word], modes: Modes, top: float
) -> FixedLine | None:
    axes = {axis: value for _, _, each in words for axis, value in each.items() if axis in AXES}
    if modes.motion != 0 or set(axes) != {"Z"} or axes["Z"] >= 0:
        return None
    why = "the top of another machine's z; here z is 0 at the face of the sheet"
    after = _risen(words, (MACHINE, 0.0), modes, top)
    return FixedLine(number, line.strip(), after, why)


def _risen(words: Sequence[Word], without: Sequence[float], modes: Modes, top: float) -> str:
    """Return a line without some codes that lifts the bit, and leaves the motion in force as it
    was.
    """
    height = f"{top / INCH:.4f}" if modes.inches else f"{top:.3f}"
    # Behind G2 and G3 a place without a centre is a straight way, as in G1.
    back = {0: "", NO_CYCLE: f" G{NO_CYCLE}"}.get(modes.motion, " G1")
    return f"{_codes(words, without)} G53 G0 Z{height}{back}".lstrip()


def _codes(words: Sequence[Word], without: Sequence[float]) -> str:
    """Return a line's codes and words without some codes, and without its place."""
    kept = []
    for letter, code, each in words:
        if letter and not (letter == "G" and code in without):
            kept.append(f"{letter}{code:g}")
        kept += [f"{name}{value:g}" for name, value in each.items() if name in "FST"]
    return " ".join(kept)


# That the same is cut.


def _refuse_cuts_of(changes: Sequence[FixedLine], moves: Moves, source: str) -> None:
    """InputError if a changed line cuts."""
    numbers = [each.line for each in changes if not each.drills]
    rises = (moves["length"] == 0) & (moves["z_to"] > moves["z_from"])
    wrong = moves.cut & ~rises & np.isin(moves["line"], numbers)
    if wrong.any():
        raise _unknown(source, int(moves["line"][wrong][0]), "the bit is in the wood there")


def _at_home(machine: JobMachine, lines: Sequence[str], home: Place, top: float) -> Moves:
    """Return the moves of a program on a machine whose home is there."""
    x, y, z = home
    begin_x, begin_y, begin_z = machine.start
    place = [f"G0 Z{top + z:.3f}", f"G0 X{x:.3f} Y{y:.3f}", "G28.1", "G30.1"]
    back = [f"G0 X{begin_x:.4f} Y{begin_y:.4f}", f"G0 Z{begin_z:.4f}"]
    run = machine.after([])
    run.send([*place, *back], first=-len(place + back))
    run.send(lines)
    moves = run.finish().moves
    return moves.only(moves["line"] > 0)


def _refuse_other_cuts(before: Moves, after: Moves, source: str) -> None:
    """InputError at the first line that cuts elsewhere than it did."""
    these, those = _cuts(before), _cuts(after)
    count = min(len(these), len(those))
    differs = (np.abs(these[:count] - those[:count]) > SAME).any(axis=1)
    if differs.any() or len(these) != len(those):
        longer = these if len(these) > count else those
        line = int((these[differs.argmax()] if differs.any() else longer[count])[0])
        raise _unknown(source, line, "it would cut elsewhere than on the machine that is meant")


def _cuts(moves: Moves) -> Array:
    """Return what cuts (n, 10): line, ends, centre, turn, and depths below the face."""
    cuts = moves.only(moves.cut)
    names = ("line", "from_x", "from_y", "to_x", "to_y", "centre_x", "centre_y", "sweep")
    depths = [np.minimum(cuts[name], 0.0) for name in ("z_from", "z_to")]
    return np.column_stack([*(cuts[name] for name in names), *depths])
