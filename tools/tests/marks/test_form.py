"""A marks.toml whose readings are typed one after the other."""

import tomllib

import pytest
from plumb.marks.form import BLANK, head_of, read_form, toml_text, with_distances, with_readings

SHEET = (2438.4, 1219.2)  # 96 by 48 inch
TEXT = """# Cut on a Sunday.

# Blue tape.

frame = "sheet-top-left"
units = "inch"
tape_sigma_mm = 0.5

[[mark]]
name = "A"
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
mm = 254.25
"""


@pytest.fixture
def form(tmp_path):
    path = tmp_path / "marks.toml"
    path.write_text(TEXT)
    return read_form(path, sheet=SHEET)


def test_a_distance_that_stays_keeps_its_table_and_another_is_added(form):
    stays = (("A", "B"), 254.25)
    head = with_distances(form, [stays, (("A", "C"), 253.00004)])
    assert head["distance"] == [
        {"between": ["A", "B"], "mm": 254.25},
        {"between": ["A", "C"], "mm": 253.0},
    ]
    assert head["distance"][0] is form.head["distance"][0]
    assert with_distances(form, [])["distance"] == []


def test_the_text_reads_back_as_what_was_said(form):
    head = with_readings(form, {1: (254.0, 0.0)})
    text = toml_text({**head, "cut": {"on": "2020"}, "columns": [1, 2], "none": []}, form.comment)
    assert text.startswith("# Cut on a Sunday.\n\n# Blue tape.\nframe = ")
    assert tomllib.loads(text) == {**head, "cut": {"on": "2020"}, "columns": [1, 2], "none": []}
    assert text.count(BLANK) == 1  # for C, the only mark that waits
    assert text.endswith("\n") and not text.endswith("\n\n")


def test_measurements_of_another_form_are_written_without_what_was_not_said(form):
    head = head_of(form.measurements)
    assert head["frame"] == "machine" and head["tape_sigma_mm"] == 0.5
    assert "steered" not in head and "controller" not in head
    marks = {mark["name"]: mark for mark in head["mark"]}
    assert set(marks["B"]) == {"name", "target", "unread"}
    assert marks["A"]["measured"] == pytest.approx([12.7, 6.35])
    assert "unread" not in marks["A"]
    assert head["distance"] == [{"between": ["A", "B"], "mm": 254.25}]
