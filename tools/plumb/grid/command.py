"""Writes the G-code for a grid of calibration marks, each approached in the same direction.

It needs only Python 3.9; tools/calibration_grid.py runs it without an installation.
"""

from __future__ import annotations

import argparse
import configparser
import importlib
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import NoReturn

from plumb.grid.cut_with import cut_with_lines, with_form
from plumb.grid.options import (
    MACHINE_KEYS,
    NUMBERS,
    PRESETS,
    UNITS,
    Grid,
    GridError,
    PlainMachine,
    demand,
    pairs,
)
from plumb.grid.program import FIRST_LINE, as_ini, is_webcontrol, marks_list, program
from plumb.text.values import typed_length

COMPLAINT = "calibration grid: {}; --help lists the options\n"


class _Parser(argparse.ArgumentParser):
    """Complains in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, COMPLAINT.format(message))


def add_arguments(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    """Give the parser every option of this tool; returns the group of those that name files."""
    group = parser.add_argument_group("which marks [15, and 8 of them again 20 mm further in]")
    either = group.add_mutually_exclusive_group()
    either.add_argument("--preset", choices=PRESETS, help="a way to measure, without repeats")
    places = "marks there, in this order: from the sheet's middle (--places='-900,400 0,4in')"
    either.add_argument("--places", type=pairs, metavar="PLACES", help=places)
    _add_number(group, "margin")
    group = parser.add_argument_group("how they are made")
    for name in ("depth", "safe_height", "feed"):
        _add_number(group, name)
    group = parser.add_argument_group("files")
    settings = "groundcontrol.ini, webcontrol.json or machine.toml: the machine and its sheet"
    group.add_argument("--settings", metavar="FILE", help=settings)
    group.add_argument("--output", metavar="FILE", help="where the program goes [the screen]")
    group.add_argument("--marks", metavar="FILE", help="also write a marks.toml to fill in")
    group.add_argument(
        "--units", choices=UNITS, default="mm", help="of your tape, for the form [%(default)s]"
    )
    another = "the form says that its marks are on another sheet than those before"
    group.add_argument("--new-sheet", action="store_true", help=another)
    force = "replace files that this program did not write"
    group.add_argument("--force", action="store_true", help=force)
    return group


def _add_number(group: argparse._ArgumentGroup, name: str) -> None:
    meaning = f"{NUMBERS[name].meaning} [{Grid._field_defaults[name]:g}]"
    kind = float if name == "feed" else _length
    group.add_argument(f"--{name.replace('_', '-')}", help=meaning, type=kind, metavar="N")


def _length(text: str) -> float:
    """Return a length [mm], typed in mm or with its unit."""
    try:
        return typed_length(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a length, like 100 or 4in") from None


def read_settings(path: str) -> dict[str, float]:
    """Return the numbers [mm, N] in a file of settings, by their names in PlainMachine."""
    if path.lower().endswith(".toml"):
        return _numbers_in_toml(path)
    parser = configparser.RawConfigParser(strict=False)
    try:
        with open(path, encoding="utf-8-sig") as file:
            text = file.read()
        if is_webcontrol(text):
            parser = as_ini(text)
        else:
            parser.read_string(text)
    except OSError as error:
        raise GridError(f"{path}: {error.strerror}: check the name after --settings") from None
    except (configparser.Error, ValueError, LookupError, TypeError, AttributeError):
        wrong = (
            f"{path} is not a groundcontrol.ini or webcontrol.json: check the name after --settings"
        )
        raise GridError(wrong) from None
    numbers = {}
    for name, section, key in MACHINE_KEYS:
        text = parser.get(section, key, fallback="")
        try:
            numbers[name] = float(text)
        except ValueError:
            # GroundControl itself does not know the sled's weight.
            if text or key != "sledWeight":
                wrong = f"{path}: {key} in [{section}] is {text!r}: give a number there"
                raise GridError(wrong) from None
    return numbers


def _numbers_in_toml(path: str) -> dict[str, float]:
    """Return the numbers [mm, N] in a machine.toml."""
    try:
        loaded = importlib.import_module("tomllib").loads
    except ImportError:
        wrong = f"{path}: a machine.toml needs Python 3.11: give a groundcontrol.ini"
        raise GridError(wrong) from None
    try:
        with open(path, encoding="utf-8-sig") as file:
            machine = loaded(file.read())
        sheet, frame = machine["sheet"], machine["frame"]
        return {
            "sheet_width": float(sheet["width"]),
            "sheet_height": float(sheet["height"]),
            "motor_spacing": float(frame["motor_gap"]),
            "motor_offset": float(frame["motor_height"]) - float(sheet["height"]) / 2,
            "rotation_radius": float(frame["rotation_radius"]),
            **({"sled_weight_n": float(frame["sled_weight"])} if "sled_weight" in frame else {}),
        }
    except OSError as error:
        raise GridError(f"{path}: {error.strerror}: check the name after --settings") from None
    except (ValueError, TypeError, LookupError):
        wrong = f"{path} is not a machine.toml: plumb read writes it, and plumb add"
        raise GridError(wrong) from None


def from_arguments(arguments: argparse.Namespace) -> tuple[Grid, PlainMachine]:
    """Grid and machine of parsed options."""
    grid = PRESETS[arguments.preset] if arguments.preset else Grid()
    if arguments.places:
        grid = Grid(repeats=False, places=arguments.places)
    given = {name: value for name in NUMBERS if (value := getattr(arguments, name)) is not None}
    demand("margin" not in given or not grid.places, "--margin is of marks in columns and rows")
    kept = read_settings(arguments.settings) if arguments.settings else {}
    return grid._replace(**given), PlainMachine(**kept)


def run(
    arguments: argparse.Namespace,
    name: str = "calibration grid",
    write: Callable[[Mapping[str, bytes]], None] | None = None,
) -> int:
    """Do what the parsed options ask; 0 done, 2 refused with one line of that name on stderr."""
    try:
        grid, machine = from_arguments(arguments)
        text = program(grid, machine)
        files = {arguments.output: text} if arguments.output else {}
        if arguments.marks:
            demand(arguments.marks != arguments.output, "--marks and --output are the same file")
            # Readings that took an hour must not be lost to a second run.
            kept = f"{arguments.marks} exists: move it away or give --marks another name"
            free = arguments.force or not os.path.isfile(arguments.marks)
            demand(free, kept)
            named = cut_with_lines(arguments.settings, arguments.marks)
            if arguments.output:
                files[arguments.output] = with_form(text, arguments.marks, arguments.output)
            form = marks_list(
                grid, machine, named, new_sheet=arguments.new_sheet, units=arguments.units
            )
            files[arguments.marks] = form
        writing = write or (lambda contents: _write(contents, force=arguments.force))
        writing({path: said.encode("ascii") for path, said in files.items()})
    except GridError as refusal:
        print(f"{name}: {refusal}", file=sys.stderr)
        return 2
    if not arguments.output:
        sys.stdout.write(text)
    return 0


def _write(files: Mapping[str, bytes], force: bool) -> None:
    """Write all texts or none: each goes next to its place first and is moved there last.

    Devices and pipes stay what they are and get the bytes; `-` is the standard output.
    """
    path, parts = "", {}
    try:
        for path in files:
            demand(force or _is_free(path), f"{path} exists: give another name, or --force")
            if not _is_poured_into(path):
                parts[path] = f"{os.path.realpath(path)}.part"
                with open(parts[path], "wb") as file:
                    file.write(files[path])
        for path in files.keys() - parts.keys():
            if path == "-":
                sys.stdout.write(files[path].decode("ascii"))
                continue
            with open(path, "wb") as file:
                file.write(files[path])
        for path, part in parts.items():
            os.replace(part, os.path.realpath(path))
    except OSError as error:
        raise GridError(f"cannot write {path}: {error.strerror}: give another name") from None
    finally:
        for part in filter(os.path.exists, parts.values()):
            os.remove(part)


def _is_free(path: str) -> bool:
    """Return whether there is no file of that name, or an empty file, or a program of this tool."""
    if not os.path.isfile(path):
        return True
    with open(path, "rb") as file:
        beginning = file.read(len(FIRST_LINE))
    return beginning in (b"", FIRST_LINE.encode())


def _is_poured_into(path: str) -> bool:
    """Return whether it is the standard output, a device or a pipe."""
    return path == "-" or (os.path.exists(path) and not os.path.isfile(path))


def main(arguments: Sequence[str] | None = None) -> int:
    """Return the command line; returns the exit code."""
    parser = _Parser(description=__doc__.splitlines()[0])
    add_arguments(parser)
    return run(parser.parse_args(arguments))
