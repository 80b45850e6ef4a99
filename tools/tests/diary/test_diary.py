"""The diary: its file, its fits and their history; rechecks."""

import math
import subprocess
import sys
from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from numbers_machine import NumbersMachine
from plumb.cure.add import add
from plumb.cure.decision import record_of
from plumb.diary.file import (
    FIT,
    NAME,
    Entry,
    append,
    fit_entry,
    history_of,
    keep,
    noted,
    program_entry,
    read_diary,
    write_and_keep,
)
from plumb.diary.recheck import LEFT, RIGHT, SHEET_Y, MeasuredMark, fit_of, recheck
from plumb.fit.inputs import Inputs
from plumb.hidden import MAKER
from plumb.line.memory import kept_before
from plumb.line.sender import Sender
from plumb.marks.read import Measurements
from plumb.model.predict import lengths, places
from plumb.settings import machine_toml, read_machine_toml
from plumb.text.errors import InputError
from plumb.text.values import MM
from synthetic import BELIEVED, TRUE, grid, marks_on
from systems import ON_POSIX

NOON = datetime(2026, 5, 1, 12, tzinfo=UTC)


def lines_of(folder):
    return (folder / NAME).read_bytes().splitlines(keepends=True)


def test_entries_come_back_as_they_were_written(tmp_path):
    content = {"rms_mm": 0.1 + 0.2, "marks": [[1.5, -2.0]], "said": 'a "word"\nand 5 µm'}
    append(tmp_path, "fit", content, at=NOON)
    append(tmp_path, "program", {"lines": 3})
    diary = read_diary(tmp_path)
    assert [entry.kind for entry in diary.entries] == ["fit", "program"]
    assert diary.entries[0].content == content and diary.entries[0].at == NOON
    assert diary.entries[1].at.tzinfo is not None
    assert diary.of_kind("program") == diary.entries[1:]
    assert diary.spoilt == ()


@ON_POSIX
def test_a_full_disk_leaves_the_diary_as_it_was(tmp_path):
    """A file may grow to so many bytes and no more, as on a disk that is nearly full."""
    append(tmp_path, "fit", {"rms_mm": 1.0}, at=NOON)
    script = (
        "import resource, sys\n"
        "from plumb.diary.file import append\n"
        "from plumb.text.errors import InputError\n"
        "most, folder = int(sys.argv[1]), sys.argv[2]\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))\n"
        "try: append(folder, 'fit', {'said': 'a' * 1000})\n"
        "except InputError as error: print(error)\n"
    )
    before = (tmp_path / NAME).read_bytes()
    (tmp_path / "new").mkdir()
    for folder, most in ((tmp_path, len(before) + 100), (tmp_path / "new", 100)):
        command = [sys.executable, "-c", script, str(most), folder]
        done = subprocess.run(command, capture_output=True, text=True)
        assert "diary.jsonl: cannot be written" in done.stdout, done.stderr
    assert (tmp_path / NAME).read_bytes() == before
    assert list((tmp_path / "new").iterdir()) == []


@pytest.mark.parametrize("kept", [1, 20, 40, -2, -1])
def test_a_line_cut_anywhere_is_noticed_and_spoils_no_other(tmp_path, kept):
    for number in range(3):
        append(tmp_path, "fit", {"number": number})
    lines = lines_of(tmp_path)
    (tmp_path / NAME).write_bytes(b"".join(lines[:2]) + lines[2][:kept])
    append(tmp_path, "fit", {"number": 3})
    diary = read_diary(tmp_path)
    # Of a line that lacks its end alone nothing is lost.
    whole = [0, 1, 2, 3] if kept == -1 else [0, 1, 3]
    assert [entry.content["number"] for entry in diary.entries] == whole
    assert diary.spoilt == (() if kept == -1 else (3,))


@pytest.mark.parametrize(
    "change", [(b'"number": 1', b'"number": 7'), (b'"kind": "fit"', b'"kind": "fat"')]
)
def test_an_edited_line_does_not_count(tmp_path, change):
    for number in range(3):
        append(tmp_path, "fit", {"number": number})
    lines = lines_of(tmp_path)
    (tmp_path / NAME).write_bytes(lines[0] + lines[1].replace(*change) + lines[2])
    diary = read_diary(tmp_path)
    assert [entry.content["number"] for entry in diary.entries] == [0, 2]
    assert diary.spoilt == (2,)


def test_two_writers_lose_nothing(tmp_path):
    # Entries longer than what a pipe or a file system writes in one go.
    program = (
        "import sys; from plumb.diary.file import append\n"
        "for i in range(25): append(sys.argv[1], 'fit', {'of': sys.argv[2], 'i': i, "
        "'long': 'x' * 100_000})"
    )
    writers = [
        subprocess.Popen([sys.executable, "-c", program, tmp_path, name]) for name in ("a", "b")
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    diary = read_diary(tmp_path)
    for name in ("a", "b"):
        mine = [entry.content["i"] for entry in diary.entries if entry.content["of"] == name]
        assert mine == list(range(25))
    assert diary.spoilt == ()


def test_a_folder_that_takes_no_file_is_named(tmp_path):
    why = r"diary\.jsonl: cannot be written \(.*\); check the rights"
    with pytest.raises(InputError, match=why):
        append(tmp_path / "none", "fit", {})
    (tmp_path / NAME).mkdir()
    with pytest.raises(InputError, match=r"diary\.jsonl: cannot be read"):
        read_diary(tmp_path)


def written(tmp_path, machine, *lines, back=False):
    path = tmp_path / "machine.toml"
    return write_and_keep(Sender(machine), path, list(lines), back=back)


def test_a_machine_that_took_only_some_numbers_can_have_the_old_back(tmp_path):
    machine = NumbersMachine(forgets=(38,))
    (tmp_path / "machine.toml").touch()
    with pytest.raises(InputError, match=r"holds \$38=0\.0 .*The old numbers are in .*before"):
        written(tmp_path, machine, "$12=2970", "$38=15.5")
    assert machine.numbers[12] == 2970
    lines = kept_before(tmp_path / "machine.toml")
    written(tmp_path, machine, *lines, back=True)
    assert machine.numbers[12] == 2978.4
    noted = read_diary(tmp_path).entries[-1].content
    assert noted["changed"]["$12"] == [2970, 2978.4] and noted["lines"] == lines
    assert kept_before(tmp_path / "machine.toml") == lines


FIRST, SECOND = (datetime(2026, month, 1, tzinfo=UTC) for month in (5, 6))


def fitted(gap_mm=0.0, seed=1):
    true = replace(TRUE, motor_gap=TRUE.motor_gap + gap_mm)
    board = Measurements(marks_on(true, BELIEVED, grid(5, 3), noise=0.3, seed=seed))
    inputs = Inputs(BELIEVED, board)
    return add(inputs, effects=["chain_pitch"]), inputs


def entry_of(result, inputs):
    text = machine_toml(result.settings)
    return fit_entry(result, inputs, machine="machine.toml", settings=text)


@pytest.fixture(scope="module")
def first():
    return fitted()


def test_an_entry_holds_settings_marks_and_errors(first, tmp_path):
    result, inputs = first
    append(tmp_path, FIT, entry_of(result, inputs))
    content = read_diary(tmp_path).entries[0].content
    (tmp_path / "machine.toml").write_text(content["settings"])
    assert read_machine_toml(tmp_path / "machine.toml") == result.settings
    assert content["firmware"] == "plumb" and content["machine"] == "machine.toml"
    assert content["rms_mm"] == result.after.fit_rms
    assert content["left_out_mm"] == result.after.left_out_rms
    for mark, (known, measured) in zip(content["marks"], inputs.measurements.readings, strict=True):
        assert mark["name"] == known.name and mark["target"] == list(known.target)
        assert np.subtract(measured, mark["predicted"]) == pytest.approx(mark["error"])


def test_an_entry_holds_how_well_the_numbers_are_known_together(first):
    result, inputs = first
    content = entry_of(result, inputs)
    deviations = dict(
        zip(content["unknowns"], np.sqrt(np.diag(content["covariance"])), strict=True)
    )
    half = {each.name: (each.high - each.low) / 2 for each in result.parameters}
    wider = {name: half[name] / deviations[name] for name in half}
    # All are as many deviations wide; Student's factor for these few marks.
    assert len(wider) >= 5 and min(wider.values()) == pytest.approx(max(wider.values()))
    assert 1.95 < wider["motor_gap"] < 2.2
    # Gap and pitch draw nearly the same: what is known of them is known together.
    names = content["unknowns"]
    pair = names.index("motor_gap"), names.index("chain_pitch.left")
    apart = content["covariance"][pair[0]][pair[1]]
    assert abs(apart) > 0.3 * deviations["motor_gap"] * deviations["chain_pitch.left"]


def test_the_history_shows_errors_and_numbers_over_time(first, tmp_path):
    append(tmp_path, FIT, entry_of(*first), at=FIRST)
    append(tmp_path, "program", program_entry("grid.nc", ["G0 X0"], whole=True))
    append(tmp_path, FIT, entry_of(*fitted(gap_mm=6.0, seed=2)), at=SECOND)
    fits, courses = history_of(read_diary(tmp_path), MM)
    assert [fit.at for fit in fits] == [FIRST, SECOND]
    assert [fit.count for fit in fits] == [15, 15]
    assert fits[0].rms == first[0].after.fit_rms
    assert fits[0].before == first[0].raw.rms
    assert fits[1].effects == ("chain_pitch",)
    gap = {course.name: course for course in courses}["motor_gap"]
    assert gap.unit == "mm" and len(gap.points) == 2
    assert gap.points[0].low < gap.points[0].value < gap.points[0].high


def points(*ends):
    return [
        {"name": "motor_gap", "value": (low + high) / 2, "low": low, "high": high, "unit": "mm"}
        for low, high in ends
    ]


@pytest.mark.parametrize(
    ("ends", "moved"),
    [
        ([(1, 3)], False),
        ([(1, 3), (2.9, 4)], False),
        ([(1, 3), (3.1, 4)], True),
        ([(1, 3), (0, 0.9)], True),
        ([(1, 3), (0, 1.1)], False),
        ([(1, 3), (0, 1)], False),
        ([(1, 3), (3, 4)], False),
        ([(1, 3), (5, 6), (5.5, 7)], False),
    ],
)
def test_a_number_has_moved_if_its_intervals_have_nothing_in_common(ends, moved, tmp_path):
    for number in points(*ends):
        append(tmp_path, FIT, entry_with(numbers=[number]))
    _, (course,) = history_of(read_diary(tmp_path), MM)
    assert course.has_moved is moved


def entry_with(**content):
    errors = dict.fromkeys(("before_mm", "rms_mm", "left_out_mm"))
    empty = {"machine": "m", "marks": [], "distances": [], "effects": [], "numbers": []}
    return {**empty, **errors, **content}


@pytest.mark.parametrize(
    ("kind", "content", "said"),
    [
        ("program", {"program": "a.nc", "whole": True}, "sent a.nc"),
        ("program", {"program": "a.nc", "whole": False}, "sent a.nc, not to its end"),
        ("numbers", {"changed": {"$2": [1, 2]}, "machine": "m"}, "1 number changed by m"),
        ("home", {"mark": "left", "kept": True}, "home mark left kept"),
        ("home", {"mark": "left", "kept": False}, "home mark left used"),
        ("slip", {"sentence": "No chain slipped."}, "No chain slipped."),
    ],
)
def test_each_kind_of_entry_has_its_words(kind, content, said):
    assert noted(Entry(kind, FIRST, content)) == said


def test_programs_keep_what_was_sent():
    left, right = (program_entry("a.nc", [line], whole=False) for line in ("G0 X1", "G0 X2"))
    assert left["sha256"] != right["sha256"] and left["lines"] == 1 and not left["whole"]


def test_an_entry_is_kept_next_to_the_file_of_a_machine(tmp_path):
    machine = tmp_path / "machine.toml"
    machine.write_text("")
    assert keep(str(machine), "home", {}, begin=False) == "" and not (tmp_path / NAME).exists()
    assert keep(str(machine), "home", {}) == ""
    assert keep(str(machine), "home", {}, begin=False) == ""
    assert len(read_diary(tmp_path).entries) == 2


def test_a_diary_that_cannot_be_written_is_a_warning(tmp_path):
    machine = tmp_path / "machine.toml"
    machine.write_text("")
    (tmp_path / NAME).mkdir()
    assert "nothing was added to the diary" in keep(str(machine), "home", {})


AT = np.array([(-900.0, 250.0), (900.0, -250.0)])
NOISE = 0.5  # [mm] of a coordinate, as the board was read


def fitted_to(seed, folder, *, turn=0.0):
    """The settings fitted to a board of the true machine, with their diary in a folder.

    `turn` [rad] of the sheet.
    """
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=NOISE, seed=seed, rotation=turn)
    board = Measurements(marks)
    inputs = Inputs(BELIEVED, board, sigma=NOISE)
    result = add(inputs, effects=["chain_pitch", "chain_sag"])
    text = machine_toml(result.settings)
    record = record_of(result, inputs)
    append(folder, FIT, fit_entry(result, inputs, machine="machine.toml", settings=text))
    return replace(result.settings, fitted=record)


def touched(settings, *, longer=(0.0, 0.0), true=TRUE, noise=(0, 0), turn=0.0):
    """Marks made by the settings on the true machine, with chains that became longer, on a sheet
    that is turned [rad]."""
    where = places(true, lengths(settings, AT)[0] + np.array(longer))[0] + noise
    where = where @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return [
        MeasuredMark(str(i), tuple(hole), tuple(target))
        for i, (hole, target) in enumerate(zip(where.tolist(), AT.tolist(), strict=True))
    ]


@pytest.mark.parametrize("turn", [0.004, -0.004])
def test_a_turned_sheet_is_no_change_of_the_machine(tmp_path, turn):
    settings = fitted_to(1, tmp_path, turn=turn)
    fit = fit_of(read_diary(tmp_path), settings)
    still = recheck(fit, settings, touched(settings, turn=turn))
    assert still.holds and still.turn == pytest.approx(turn, abs=0.001)
    # The lab says how far to raise its right end; somebody did.
    straight = recheck(fit, settings, touched(settings))
    assert straight.holds and straight.turn == 0
    for now in (turn, 0.0):
        slipped = recheck(fit, settings, touched(settings, turn=now, longer=(4.0, 0)))
        assert not slipped.holds and slipped.changes[0].name == LEFT
    # Turned the other way it is another sheet.
    assert not recheck(fit, settings, touched(settings, turn=-turn)).holds


@pytest.mark.parametrize(
    ("how", "name", "size"),
    [
        ({"longer": (0, -4.0)}, RIGHT, -4.0),
        ({"true": replace(TRUE, motor_gap=TRUE.motor_gap + 8.0)}, "motor_gap", 8.0),
    ],
)
def test_what_changed_is_among_what_explains_the_marks_with_its_size(tmp_path, how, name, size):
    settings = fitted_to(1, tmp_path)
    checked = recheck(fit_of(read_diary(tmp_path), settings), settings, touched(settings, **how))
    change = next(each for each in checked.changes if each.name == name)
    assert checked.state == "changed" and change.explains
    assert change.size == pytest.approx(size, abs=3 * change.sigma) and change.sigma < 2


SIGMA = 0.1  # [mm] of a coordinate
SURE_OF = {2: 9.210, 3: 11.345, 4: 13.277}  # chi-square, 99 %, by degrees of freedom


@pytest.fixture
def checked(tmp_path):
    def check(errors, *, known=None, sigma=SIGMA):
        """A recheck with these errors (n, 2) [mm]; known: sigmas of what the fit did not know."""
        names = list(known or {})
        covariance = np.diag([known[name] ** 2 for name in names]).tolist() if names else [[0.0]]
        entry = {"unknowns": names or ["motor_gap"], "covariance": covariance}
        entry["settings"] = machine_toml(MAKER)
        fit = append(tmp_path, FIT, entry)
        touches = [
            MeasuredMark(str(i), tuple(hole), tuple(at))
            for i, (hole, at) in enumerate(zip((AT + errors).tolist(), AT.tolist(), strict=True))
        ]
        return recheck(fit, MAKER, touches, sigma=sigma)

    return check


def expected(checked):
    return [mark.expected_mm for mark in checked.marks]


@pytest.mark.parametrize(("share", "holds"), [(0.99, True), (1.01, False)])
def test_marks_hold_up_to_the_99_percent_of_chi_square(checked, share, holds):
    size = SIGMA * math.sqrt(share * SURE_OF[4] / 4)
    assert checked(np.full((2, 2), size) * [[1, -1], [-1, 1]]).holds is holds


def test_a_mark_is_expected_as_far_off_as_touch_and_fit_allow(checked):
    plain = checked(np.zeros((2, 2)))
    assert expected(plain) == pytest.approx([SIGMA * math.sqrt(SURE_OF[2])] * 2, rel=1e-3)
    turned = checked(np.zeros((2, 2)), known={"sheet_rotation": 0.002})
    far = 0.002 * np.hypot(*AT[0])
    wide = math.sqrt(SURE_OF[2] * (SIGMA**2 + far**2))
    assert expected(turned) == pytest.approx([wide] * 2, rel=1e-3)


@pytest.mark.parametrize(("share", "explains"), [(0.99, True), (1.01, False)])
def test_a_change_explains_what_it_leaves_within_the_99_percent(checked, share, explains):
    # One of four numbers is spent on the change; what is left is across it.
    across = np.array([[1.0, 0.0], [-1.0, 0.0]]) * SIGMA * math.sqrt(share * SURE_OF[3] / 2)
    again = checked(np.array([[0.0, 3.0], [0.0, 3.0]]) + across)
    change = next(each for each in again.changes if each.name == SHEET_Y)
    assert again.state == ("sheet_moved" if explains else "beyond_these_marks")
    assert change.explains is explains and change.size == pytest.approx(3.0)
    assert change.chi_square == pytest.approx(share * SURE_OF[3], rel=1e-3)
