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
from typing import Any, NoReturn

from plumb.grid.cut_with import cut_with_lines, with_form
from plumb.grid.options import (
    GRID_OPTIONS,
    MACHINE_OPTIONS,
    Grid,
    GridError,
    PlainMachine,
    demand,
    pair,
    pairs,
)
from plumb.grid.pattern import spans_of
from plumb.grid.program import FIRST_LINE, as_ini, is_webcontrol, marks_list, preview, program

COMPLAINT = "calibration grid: {}; --help lists the options\n"


class _Parser(argparse.ArgumentParser):
    """Complains in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, COMPLAINT.format(message))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Give the parser every option of this tool; None stands for what was not given."""
    group = parser.add_argument_group("grid")
    for name, kind, meaning in GRID_OPTIONS:
        usual = Grid._field_defaults[name]
        how: dict[str, Any] = {"type": kind, "metavar": "PLACES" if kind is pairs else "N"}
        if isinstance(kind, tuple):
            how = {"choices": kind}
        if kind is pair:
            meaning += f" (--{name}=-9,9)"
        if usual not in (None, ()):
            meaning += " [{:g},{:g}]".format(*usual) if kind is pair else f" [{usual}]"
        group.add_argument("--" + name.replace("_", "-"), help=meaning, **how)
    group = parser.add_argument_group("machine")
    for name, _section, _key, meaning in MACHINE_OPTIONS:
        option, usual = "--" + name.replace("_", "-"), PlainMachine._field_defaults[name]
        group.add_argument(option, help=f"{meaning} [{usual}]", type=float, metavar="N")
    group.add_argument("--settings", metavar="FILE", help="file of settings with these numbers")
    group = parser.add_argument_group("output")
    group.add_argument("--output", metavar="FILE", help="where the program goes [the screen]")
    group.add_argument("--marks", metavar="FILE", help="also write a marks.toml to fill in")
    spans = "the form also waits for distances between the marks: sides, diagonals, halves"
    group.add_argument("--distances", action="store_true", help=spans)
    another = "the form says that its marks are on another sheet than those before"
    group.add_argument("--new-sheet", action="store_true", help=another)
    force = "replace files that this program did not write"
    group.add_argument("--force", action="store_true", help=force)
    group.add_argument("--preview", action="store_true", help="show a picture, not the program")


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
        wrong = f"{path} is not a groundcontrol.ini or webcontrol.json: give its numbers as options"
        raise GridError(wrong) from None
    numbers = {}
    for name, section, key, _ in MACHINE_OPTIONS:
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
        raise GridError(f"{path}: a machine.toml needs Python 3.11: give its numbers") from None
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
        raise GridError(f"{path} is not a machine.toml: let plumb add write it") from None


def from_arguments(arguments: argparse.Namespace) -> tuple[Grid, PlainMachine]:
    """Grid and machine of parsed options; an option outweighs the settings file."""
    kept = read_settings(arguments.settings) if arguments.settings else {}
    given = {name: value for name, value in vars(arguments).items() if value is not None}
    grid = Grid(**{name: given[name] for name in Grid._fields if name in given})
    if grid.places:
        _refuse_of_a_grid(given)
    if grid.places or grid.pattern == "benchmark":
        grid = grid._replace(repeats=0)
    numbers = {**kept, **given}
    of_machine = {name: numbers[name] for name in PlainMachine._fields if name in numbers}
    return grid, PlainMachine(**of_machine)


def _refuse_of_a_grid(given: Mapping[str, object]) -> None:
    """Refuses options that say where marks are when the places say so."""
    for name in ("pattern", "columns", "rows", "margin", "order", "repeats", "repeat_spacing"):
        option = f"--{name.replace('_', '-')}"
        demand(name not in given, f"{option} is of a grid, and --places says where marks are")


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
            files[arguments.marks] = marks_list(
                grid,
                machine,
                named,
                new_sheet=arguments.new_sheet,
                spans=spans_of(grid) if arguments.distances else (),
            )
        writing = write or (lambda contents: _write(contents, force=arguments.force))
        writing({path: said.encode("ascii") for path, said in files.items()})
    except GridError as refusal:
        print(f"{name}: {refusal}", file=sys.stderr)
        return 2
    if arguments.preview:
        sys.stdout.write(preview(grid, machine))
    elif not arguments.output:
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
