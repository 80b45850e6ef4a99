"""The part of a machine.toml that says how its numbers were fitted: [fit] and a [[board]] each."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

from plumb.settings.fit_record import FitRecord, FittedBoard
from plumb.settings.machine import MachineSettings, SettingsFile
from plumb.settings.machine_tables import (
    MACHINE_KEYS,
    Tables,
    key_text,
    machine_in,
    machine_lines,
    table_lines,
)
from plumb.text.errors import naming, refusal
from plumb.text.readers import to_do
from plumb.text.values import numbers, refuse_unknown, text_of, texts

FIT_KEYS = ("fit", "board")
NUMBER_KEYS = ("start_rms", "rms", "priced_rms", "left_out_rms", "sheet_rotation")
WORD_KEYS = ("effects", "without")
BOARD_KEYS = ("marks", "digest", "sheet", "zeros", "cut_with")
CUT_KEYS = ("file", "sha256", *MACHINE_KEYS)
INTRODUCTION = """
# How these numbers were fitted, in mm and rad; no part of the machine. The lab compares the same
# marks with it, and knows with which settings they were cut."""


def read_fit_record(
    path: str | PathLike[str],
    head: dict[str, Any],
    *,
    known: Mapping[str, Sequence[str]] | None,
) -> FitRecord | None:
    """What the file says of its fit; None if it says nothing."""
    if "fit" not in head and "board" not in head:
        return None
    tables = Tables(path, head, "")
    fit = tables.table("fit", "write a line [fit]")
    boards = head.get("board", [])
    if not isinstance(boards, list) or not all(isinstance(board, dict) for board in boards):
        raise refusal(path, "board is not a list of tables", remedy="write a line [[board]]")
    with naming(path, "[fit]"):
        refuse_unknown(fit, (*NUMBER_KEYS, *WORD_KEYS, "lab_effects"))
        words = {key: texts(fit.get(key, [])) for key in WORD_KEYS}
        for key in NUMBER_KEYS:
            if key not in fit:
                remedy = to_do("let plumb add write the file", page="let Correct write the file")
                raise ValueError(f"{key} is missing; {remedy}")
    lab = Tables(path, {"effects": fit.get("lab_effects", {})}, "fit.lab_")
    left = tables.numbers_in({key: fit[key] for key in NUMBER_KEYS}, "[fit]")
    return FitRecord(
        start_rms=left["start_rms"],
        rms=left["rms"],
        priced_rms=left["priced_rms"],
        left_out_rms=left["left_out_rms"],
        sheet_rotation=left["sheet_rotation"],
        effects=words["effects"],
        without=words["without"],
        lab_effects=lab.effects(),
        boards=tuple(_board(path, board, known) for board in boards),
    )


def _board(
    path: str | PathLike[str], board: dict[str, Any], known: Mapping[str, Sequence[str]] | None
) -> FittedBoard:
    with naming(path, "[[board]]"):
        refuse_unknown(board, BOARD_KEYS)
        marks, digest = text_of(board.get("marks")), text_of(board.get("digest"))
        sheet = numbers(board.get("sheet", [0, 0, 0]), 3)
        zeros = numbers(board.get("zeros", [0, 0]), 2)
    cut_with = Tables(path, board, "board.").table("cut_with", "write a line [board.cut_with]")
    with naming(path, "[board.cut_with]"):
        refuse_unknown(cut_with, CUT_KEYS)
        file = SettingsFile(text_of(cut_with.get("file", "")), text_of(cut_with.get("sha256", "")))
    machine = machine_in(path, cut_with, place="board.cut_with.", known=known, file=file)
    return FittedBoard(
        marks=marks,
        digest=digest,
        cut_with=machine,
        sheet=(sheet[0], sheet[1], sheet[2]),
        zeros=(zeros[0], zeros[1]),
    )


def fit_record_lines(record: FitRecord) -> list[str]:
    """The lines of a record, which reading gives back bit for bit."""
    lines = [INTRODUCTION, *table_lines("fit", {key: getattr(record, key) for key in NUMBER_KEYS})]
    lines += [f"{key} = {json.dumps(getattr(record, key))}" for key in WORD_KEYS]
    for name, sizes in record.lab_effects.items():
        lines += table_lines(f"fit.lab_effects.{key_text(name)}", sizes)
    for board in record.boards:
        lines += [
            "\n[[board]]",
            f"marks = {json.dumps(board.marks)}",
            f'digest = "{board.digest}"',
            f"sheet = {list(board.sheet)}  # x, y in mm and rotation in rad, to the first sheet",
            f"zeros = {list(board.zeros)}  # mm more chain, left and right, than at the first",
            "\n[board.cut_with]",
            *_file_lines(board.cut_with),
            *machine_lines(board.cut_with, place="board.cut_with."),
        ]
    return lines


def _file_lines(machine: MachineSettings) -> list[str]:
    if machine.file is None:
        return []
    return [f"file = {json.dumps(machine.file.name)}", f'sha256 = "{machine.file.sha256}"']
