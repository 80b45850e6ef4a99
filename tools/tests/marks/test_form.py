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


def test_the_lines_before_the_first_key_are_kept_without_the_last_blank(form):
    assert form.comment == ("# Cut on a Sunday.", "", "# Blue tape.")


def test_a_reading_is_written_as_the_file_counts(form):
    # 10 inch right of the middle and 1/128 inch above it, from the top left corner.
    head = with_readings(form, {1: (254.0, 25.4 / 128)})
    assert head["mark"][1]["measured"] == [58.0, 23.99219]
    assert "unread" not in head["mark"][1] and head["mark"][2]["unread"]
    assert form.head["mark"][1]["unread"]  # the form itself stays as it was


def test_a_reading_is_taken_out_and_the_mark_waits(form):
    head = with_readings(form, {0: None})
    assert head["mark"][0] == {"name": "A", "target": [48.0, 24.0], "unread": True}


@pytest.mark.parametrize("index", [-1, 3])
def test_a_mark_that_is_not_there_is_named_as_people_count(form, index):
    with pytest.raises(ValueError, match=rf"no mark number {index + 1}$"):
        with_readings(form, {index: None})


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
