"""The page on the diagnosis: its marked parts, its tables and its pictures."""

import json
from pathlib import Path

import diagnosis_page
import pytest
from diagnosis_page import COMMAND, PAGE, gates_section, with_parts
from evidence_gates import Saved
from five_boards import BOARDS
from gate_records import record_of
from plumb.text.errors import InputError

ROOT = Path(__file__).resolve().parents[3]
RECORDS = [
    record_of(kind, 0, seed=3) for kind in ("known/none-15", "known/field-15", "stock/prior-15")
]


def test_a_part_is_replaced_and_all_else_stays():
    page = f"first\n<!-- {COMMAND}: gates -->\n<!-- end of gates -->\nlast\n"
    once = with_parts(page, {"gates": "| a | b \\1 |"})
    assert once.startswith("first\n") and once.endswith("\nlast\n") and "| a | b \\1 |" in once
    assert with_parts(with_parts(page, {"gates": "old"}), {"gates": "| a | b \\1 |"}) == once
    with pytest.raises(InputError, match="no marks for boards"):
        with_parts(page, {"boards": ""})


def test_tables_before_and_after_are_of_the_boards_that_both_have():
    before, after = Saved(3, RECORDS[:2]), Saved(3, RECORDS)
    section = gates_section(before, after)
    assert section.startswith("Boards of each of 2 kinds: 1, seed 3;")
    assert "### Lines to reach" in section and "before → after" in section


def test_everything_is_written_from_two_files_of_records(tmp_path):
    (tmp_path / "docs").mkdir()
    (tmp_path / PAGE).write_text((ROOT / PAGE).read_text())
    for name in ("before.json", "after.json"):
        (tmp_path / name).write_text(json.dumps(vars(Saved(3, RECORDS)), default=float))
    gates = [str(tmp_path / "before.json"), str(tmp_path / "after.json")]
    assert diagnosis_page.main(["--gates", *gates, "--folder", str(tmp_path)]) == 0
    assert "kinds: 1, seed 3; the same boards" in (tmp_path / PAGE).read_text()
    for picture in ("evidence", "reliability"):
        assert (tmp_path / diagnosis_page.PICTURES / f"{picture}.svg").read_text().count("<svg")


def test_stale_words_are_told(tmp_path, capsys):
    (tmp_path / "docs").mkdir()
    text = (ROOT / PAGE).read_text()
    (tmp_path / PAGE).write_text(text)
    assert diagnosis_page.main(["--check", "--folder", str(tmp_path)]) == 0
    (tmp_path / PAGE).write_text(text.replace("1 to 19", "1 to 9").replace("19 to 1", "9 to 1"))
    assert diagnosis_page.main(["--check", "--folder", str(tmp_path)]) == 1
    assert f"{PAGE}: stale" in capsys.readouterr().out


def test_each_of_the_five_boards_is_said_otherwise_than_before():
    assert all(board.now != board.before for board in BOARDS)
