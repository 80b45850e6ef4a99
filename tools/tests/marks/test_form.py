"""A marks.toml whose readings are typed one after the other."""

import tomllib

import pytest
from plumb.marks.form import (
    BLANK,
    marks_toml,
    read_form,
    with_distances,
    with_readings,
    with_tape_sigma,
)

SHEET = (2438.4, 1219.2)  # 96 by 48 inch
TEXT = """# Cut on a Sunday.

# Blue tape.

frame = "sheet-top-left"
units = "inch"
tape_sigma_mm = 0.5

[[mark]]
name = "A"  # the corner
target = [48.0, 24.0]
measured = [48.5, 23.75]

[[mark]]
name = "B"
target = [58.0, 24.0]
unread = true
# measured = [ , ]

[[mark]]
name = "C"
target = [48.0, 14.0]
unread = true

[[distance]]
between = ["A", "B"]
mm = 254.25  # hook at A
"""


def form_in(folder, text):
    path = folder / "marks.toml"
    path.write_bytes(text.encode())
    return read_form(path, sheet=SHEET)


@pytest.fixture
def form(tmp_path):
    return form_in(tmp_path, TEXT)


def test_a_distance_that_stays_keeps_its_table_and_another_is_added(form):
    stays = (("A", "B"), 254.25)
    text = with_distances(form, [stays, (("A", "C"), 253.00004)])
    assert tomllib.loads(text)["distance"] == [
        {"between": ["A", "B"], "mm": 254.25},
        {"between": ["A", "C"], "mm": 253.0},
    ]
    assert "mm = 254.25  # hook at A\n" in text
    assert "distance" not in tomllib.loads(with_distances(form, []))


def test_only_the_edited_values_change(form):
    assert with_readings(form, {}) == TEXT.replace(
        "[48.0, 14.0]\nunread = true\n", f"[48.0, 14.0]\nunread = true\n{BLANK}\n"
    )
    text = with_readings(form, {0: None, 1: (254.0, 0.0)})
    said = tomllib.loads(text)
    assert [mark.get("measured") for mark in said["mark"]] == [None, [58.0, 24.0], None]
    changed = "# measured", "measured", "unread", ""
    kept = [line for line in TEXT.splitlines() if not line.startswith(changed)]
    assert [line for line in text.splitlines() if not line.startswith(changed)] == kept
    assert text.count(BLANK) == 2  # for A and C, the marks that wait
    assert text.endswith("\n") and not text.endswith("\n\n")


def test_line_ends_stay(form, tmp_path):
    windows = with_readings(form, {}).replace("\n", "\r\n")
    assert with_readings(form_in(tmp_path, windows), {}) == windows


def test_the_tape_is_stated_and_forgotten(form):
    assert with_tape_sigma(form, 0.4) == with_readings(form, {}).replace("= 0.5", "= 0.4")
    assert "tape_sigma_mm" not in with_tape_sigma(form, None)


def test_measurements_of_another_form_are_written_without_defaults(form):
    said = tomllib.loads(marks_toml(form.measurements))
    assert said["frame"] == "machine" and said["tape_sigma_mm"] == 0.5
    assert "steered" not in said and "controller" not in said
    marks = {mark["name"]: mark for mark in said["mark"]}
    assert set(marks["B"]) == {"name", "target", "unread"}
    assert marks["A"]["measured"] == pytest.approx([12.7, 6.35])
    assert "unread" not in marks["A"]
    assert said["distance"] == [{"between": ["A", "B"], "mm": 254.25}]
