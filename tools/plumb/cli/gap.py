"""`plumb gap`: the motor gap from a chain that was pulled tight from motor to motor."""

from __future__ import annotations

import argparse

from plumb.cli.arguments import add_json, add_settings, add_units, length
from plumb.cli.screen import headline, print_json, sentences
from plumb.fit.inputs import settings_in
from plumb.model.predict import BEYOND, MotorGap, motor_gap
from plumb.text.errors import InputError
from plumb.text.values import brief, worded

MISREAD = 5.0  # [mm] of spread: no two pulls of a machine differ so much
USUAL_PULLS = (60.0, 105.0)  # [N] of B11
POSSIBLE_PULLS = (25.0, 250.0)  # [N] of a drop that can be meant
LEAST_GAP, MOST_GAP = 1000.0, 6000.0  # [mm]


def run(arguments: argparse.Namespace) -> int:
    """Work the gap out, print it, and return the exit code."""
    settings = settings_in(arguments.settings)
    lengths = arguments.length
    if not all(LEAST_GAP < each < MOST_GAP for each in lengths):
        raise InputError(
            f"--length {min(lengths):g}: a chain from motor to motor has {LEAST_GAP:g} to "
            f"{MOST_GAP:g} mm; send B10 L after B11 and take what the machine says"
        )
    if settings.chain_weight <= 0:
        raise InputError("the settings lack the chain's weight: add chain_weight = 0.00137293")
    if arguments.drop is not None and arguments.drop < 1:
        raise InputError("--drop is at least 1 mm: a tighter chain bends the frame")
    if arguments.flex is not None and arguments.flex < 0:
        raise InputError("--flex cannot be negative: a pull brings the motors closer")
    measured = motor_gap(
        lengths,
        chain_weight=settings.chain_weight,
        drop=arguments.drop,
        flex=arguments.flex,
    )
    _refuse_misread(arguments, measured)
    if arguments.json:
        print_json(measured)
    else:
        print(headline(f"Motor gap {worded(measured.gap)} ± {worded(measured.interval)}."))
        print()
        print(sentences(_reasons(arguments, measured)))
    return 0


def _refuse_misread(arguments: argparse.Namespace, measured: MotorGap) -> None:
    """Raise InputError for lengths, or a drop, that no machine gives."""
    if measured.spread > MISREAD:
        raise InputError(
            f"--length: the lengths differ by {worded(measured.spread)}, and pulls differ by "
            f"{worded(MISREAD, 0)} at most: a length was misread, or the chain skipped; pull again"
        )
    drop = arguments.drop
    if drop is None or _is_in(measured.pull, POSSIBLE_PULLS):
        return
    shifted = (drop / 10, 10 * drop)  # the point in another place
    meant = [each for each in shifted if _is_in(measured.pull * drop / each, USUAL_PULLS)]
    asked = f"is it {_number(meant[0])}?" if meant else "measure it again"
    usual, possible = (f"{low:.0f} to {high:.0f} N" for low, high in (USUAL_PULLS, POSSIBLE_PULLS))
    raise InputError(
        f"--drop {_number(drop)}: that means a pull of {measured.pull:.0f} N, and B11 pulls with "
        f"{usual} (from a drop {possible} are taken): {asked}"
    )


def _is_in(pull: float, limits: tuple[float, float]) -> bool:
    """Return whether a pull [N] is within limits."""
    return limits[0] <= pull <= limits[1]


def _number(length: float) -> str:
    """Return a length [mm] as it was typed, without its unit."""
    return brief(length).partition(" ")[0]


def _reasons(arguments: argparse.Namespace, measured: MotorGap) -> list[str]:
    by = "the drop says" if arguments.drop is not None else "B11 states"
    lines = [
        f"The chain less {worded(BEYOND)} of links past the sprocket and {worded(measured.sag)} of "
        f"sag, plus {worded(measured.stretch)} of stretch and {worded(measured.flex)} of flex, "
        f"with the {measured.pull:.0f} N that {by}.",
        f"It counts links of true pitch: a chain that is 0.1 % long makes it "
        f"{worded(measured.gap / 1000, 1)} too small. Check it with a tape, or let marks find the "
        "pitch.",
    ]
    if arguments.drop is None:
        lines.append("A ruler at the middle of the tight chain makes it better: --drop.")
    if arguments.flex is None:
        lines.append("Nobody measured how much the frame bends: --flex makes it better.")
    if measured.pull_again:
        lines.append(f"The lengths differ by {worded(measured.spread)}: pull again with B11.")
    return lines


# The arguments of `plumb gap`.

EXAMPLES = (
    "plumb gap machine.toml --length 2989.29",
    "plumb gap machine.toml --length 2989.29 2990.10 --flex 1 --drop 18.3",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb gap`."""
    add_settings(parser)
    parser.add_argument(
        "--length",
        metavar="L",
        type=length,
        nargs="+",
        required=True,
        help="what the machine says to B10 after B11, once or several times",
    )
    parser.add_argument(
        "--flex",
        metavar="MM",
        type=length,
        help="by how much the motors come closer when 100 N pull on them (an untold flex counts "
        "as 0.5 mm, give or take 0.5)",
    )
    parser.add_argument(
        "--drop",
        metavar="MM",
        type=length,
        help="how far the middle of the tight chain hangs below a string from end to end: it says "
        "the pull better than the motor does",
    )
    add_units(parser)
    add_json(parser)
