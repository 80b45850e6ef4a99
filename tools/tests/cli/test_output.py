"""Where results go, how they fit a screen, and in which unit they are."""

import os
import re
import stat
import threading
import tomllib
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE, INI, MARKS, TOML
from plumb.cli import screen
from plumb.cli import send as sending
from plumb.cli.arguments import length, place
from plumb.cli.recover import touch
from plumb.cli.screen import Bar, table
from plumb.job.dry_run import TimeLeft, Timetable
from plumb.marks.read import read_marks
from synthetic import SHEET
from systems import ON_POSIX, widest

ADD = ("add", INI, MARKS, "--effect", "chain_pitch")
LINES = ("settings", TOML, "--client", "none", "-o")
GRID = ("grid", "--preset", "nine")
# Commands with the option that names their result, and the name of a file for it.
WRITERS = [
    pytest.param((*ADD, "-o"), "machine.toml", id="add"),
    pytest.param(LINES, "machine.nc", id="settings"),
    pytest.param(("compare", INI, MARKS, "--picture"), "errors.png", id="png"),
    pytest.param((*GRID, "--output"), "grid.nc", id="grid"),
]


pytestmark = pytest.mark.usefixtures("here")


@pytest.mark.parametrize(("command", "name"), WRITERS)
def test_a_second_run_replaces_its_result_and_no_other_file(command, name, run):
    assert run(*command, name)[0] == 0
    first = Path(name).read_bytes()
    assert run(*command, name)[0] == 0
    assert Path(name).read_bytes() == first
    Path(name).write_text("my notes of a year\n")
    code, said, complaint = run(*command, name)
    assert code == 2 and said == "" and "--force" in complaint and complaint.count("\n") == 1
    assert Path(name).read_text() == "my notes of a year\n"
    assert run(*command, name, "--force")[0] == 0
    assert Path(name).read_bytes() == first
    Path(name).write_text("")
    assert run(*command, name)[0] == 0


def read_from(pipe, into):
    into.append(Path(pipe).read_bytes())


def through_a_pipe(name, write):
    """The bytes that `write` sends into a new pipe of that name, and its return value."""
    os.mkfifo(name)
    got = []
    reader = threading.Thread(target=read_from, args=(name, got), daemon=True)
    reader.start()
    answer = write()
    reader.join(10)
    assert stat.S_ISFIFO(os.stat(name).st_mode)
    return got[0], answer


@ON_POSIX
@pytest.mark.parametrize(("command", "name"), WRITERS)
def test_a_pipe_stays_a_pipe_and_gets_the_bytes(command, name, run):
    got, answer = through_a_pipe(name, lambda: run(*command, name))
    Path(name).unlink()
    assert answer[0] == 0 and run(*command, name)[0] == 0
    assert got == Path(name).read_bytes()


@ON_POSIX
def test_a_link_to_a_pipe_or_a_device_is_not_replaced(run):
    os.symlink("/dev/null", "null.toml")
    os.symlink("pipe", "link.toml")
    assert run(*ADD, "-o", "null.toml")[0] == 0
    assert os.path.islink("null.toml") and stat.S_ISCHR(os.stat("/dev/null").st_mode)
    got, answer = through_a_pipe("pipe", lambda: run(*ADD, "-o", "link.toml"))
    assert answer[0] == 0 and b"[frame]" in got and os.path.islink("link.toml")


@ON_POSIX
def test_a_link_to_a_file_stays_and_its_file_is_replaced(run):
    assert run(*ADD, "-o", "machine.toml")[0] == 0
    written = Path("machine.toml").read_bytes()
    os.symlink("machine.toml", "link.toml")
    os.symlink("nothing.toml", "dangling.toml")
    assert run(*ADD, "-o", "link.toml")[0] == 0 and os.path.islink("link.toml")
    assert run(*ADD, "-o", "dangling.toml")[0] == 0
    assert Path("nothing.toml").read_bytes() == written
    Path("machine.toml").write_text("notes\n")
    assert run(*ADD, "-o", "link.toml")[0] == 2 and Path("machine.toml").read_text() == "notes\n"


def test_a_full_disk_is_reported_in_one_line_and_leaves_nothing(run):
    picture = ("--picture", "fall.png")
    for command in ((*ADD, *picture, "-o"), LINES, (*GRID, "--output")):
        code, said, complaint = run(*command, "/dev/full")
        assert code == 2 and said == "" and complaint.count("\n") == 1
        assert "/dev/full" in complaint and "No space left" in complaint
        assert stat.S_ISCHR(os.stat("/dev/full").st_mode)
    assert os.listdir() == []


def test_a_dash_is_the_standard_output_and_the_report_goes_beside(run):
    code, said, report = run(*ADD, "-o", "-")
    assert code == 0 and "frame" in tomllib.loads(said) and "The error falls from" in report
    code, said, report = run(*LINES, "-")
    assert code == 0 and said.startswith("$0=2438.4\n") and "Written" in report
    code, said, _ = run(*GRID, "--output", "-")
    assert code == 0 and said == run(*GRID)[1]
    code, said, _ = run(*GRID, "--output", "grid.nc", "--marks", "-")
    assert code == 0 and "mark" in tomllib.loads(said)
    assert not Path("-").exists()


@ON_POSIX
def test_a_pipe_is_read_once(run):
    os.mkfifo("settings.ini")
    content = INI.read_bytes()
    writer = threading.Thread(target=Path("settings.ini").write_bytes, args=(content,), daemon=True)
    writer.start()
    code, said, _ = run("compare", "settings.ini", MARKS)
    # The next command names the file that was given.
    report, usual = (
        text.partition("\nWhat is missing:") for text in (said, run("compare", INI, MARKS)[1])
    )
    assert code == 0 and report[1] and report[0] == usual[0]


def test_main_forgets_the_force_of_an_earlier_run(run):
    for force, code in ((["--force"], 0), ([], 2)):
        Path("machine.nc").write_text("notes\n")
        assert run(*LINES, "machine.nc", *force)[0] == code


COLOUR = re.compile(r"\x1b\[[0-9;]*3[0-9]")
LONG = "a sentence of words that go on and on " * 4


@pytest.fixture(autouse=True)
def _no_screen(monkeypatch):
    for name in ("COLUMNS", "NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize(
    "command",
    [
        ("grid", "--settings", INI, "--details"),
        ("add", INI, MARKS, "--effect", "auto", "--patch"),
        ("effects",),
        ("reach", EXAMPLE / "machine.toml"),
    ],
    ids=lambda command: command[0],
)
def test_no_line_is_longer_than_80_columns(command, run):
    code, said, complaint = run(*command)
    assert code < 2 and complaint == ""
    assert widest(said) <= 80, said
    assert "…" not in said and "\x1b" not in said


def test_columns_of_words_wrap_and_numbers_stay_whole():
    rows = [["first", "1234.5678", LONG], ["second", "-1.0", "short"]]
    lines = table(["name", "number", "words"], rows, words=[-1]).splitlines()
    assert max(map(len, lines)) <= 80 and len(lines) == 5
    assert "first   1234.5678  a sentence" in lines[1] and "second       -1.0  short" in lines[-1]
    assert " ".join(" ".join(lines).split()).count("on and on") == 4


def test_a_number_that_cannot_be_is_coloured(monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    said = table(["number", ""], [["a", "impossible: b"], ["c", "d"]], words=[-1])
    assert len(COLOUR.findall(said)) == 1


class Terminal:
    """A standard error that is a terminal."""

    def __init__(self, *, watched):
        self.said, self._watched = "", watched

    def write(self, text):
        self.said += text
        return len(text)

    def flush(self):
        """Nothing is kept back."""

    def isatty(self):
        return self._watched


@pytest.mark.parametrize(
    ("watched", "patience", "shown"), [(True, 0.0, True), (True, 60.0, False), (False, 0.0, False)]
)
def test_a_bar_is_shown_on_a_terminal_if_the_work_takes_long(watched, patience, shown, monkeypatch):
    terminal = Terminal(watched=watched)
    monkeypatch.setattr(screen.sys, "stderr", terminal)
    bar = Bar("boards", patience=patience)
    bar.show(0.5, "half of them")
    bar.show(1.0)
    assert ("half of them" in terminal.said) == shown
    assert bool(terminal.said) == shown


TEXT = ["(a job)", "G0 X1", "", *(f"G1 X{x} F100" for x in range(8000))]
WHOLE = 2.0 * len(TEXT)


@pytest.fixture
def clock(monkeypatch):
    now = [1000.0]
    monkeypatch.setattr(sending, "monotonic", lambda: now[0])
    return now


def follow(clock, *, seconds, step=0.25, pauses=False):
    """A job whose lines take 2 s each, followed for a while."""
    job = sending.Followed(TEXT, TimeLeft(Timetable(np.arange(len(TEXT) + 1) * 2.0), ahead=1.0))
    every = int(2 / step)
    for tick in range(int(seconds / step)):
        clock[0] += step
        if tick % every == every - 1:
            job.answered(tick // every + 1)
        job.look(pauses=pauses)
    job.clear()


def test_without_a_terminal_a_line_is_printed_each_minute(clock, monkeypatch):
    screen = Terminal(watched=False)
    monkeypatch.setattr(sending.sys, "stderr", screen)
    follow(clock, seconds=185)
    lines = screen.said.splitlines()
    assert len(lines) == 3
    assert lines[0] == "line 32 of 8003, 4 h 15 min left, 0 % done"


def test_a_terminal_has_a_line_that_fits(clock, monkeypatch):
    shown = []
    monkeypatch.setattr(sending.sys, "stderr", Terminal(watched=True))
    monkeypatch.setattr(sending.Bar, "show", lambda self, share, what: shown.append((share, what)))
    follow(clock, seconds=4000, step=0.5)
    assert len(shown) > 7000
    shares = [share for share, _ in shown]
    assert np.diff(shares).min() > -1e-4 and shares[-1] == pytest.approx(4000 / WHOLE, rel=0.01)
    # Behind the words stand a bar of 20 and a percent of 4, a space before each.
    assert max(len(what) for _, what in shown) + 26 <= 80


INCHES = ("--units", "inch")


def row_of(said, name="1"):
    return next(line.split() for line in said.splitlines() if line.split()[:1] == [name])


def test_places_from_the_corner_are_shown_from_the_corner(run):
    said = run("compare", INI, MARKS, "--details")[1]
    # The file says target = [100.00, 100.00] and measured = [98.0, 106.0], y down.
    assert row_of(said)[1:5] == ["100.0", "100.0", "98.0", "106.0"]
    assert row_of(said)[5:7] == ["-1.98", "+5.99"]
    assert "from the sheet's top left corner, x right, y down" in " ".join(said.split())


def test_values_typed_in_inches_are_shown_in_inches_unless_mm_are_asked_for(run, tmp_path):
    marks = tmp_path / "marks.toml"
    places = [(5, 5), (48, 24), (90, 40)]
    text = "".join(
        f'[[mark]]\ntarget = [{x}, {y}]\nmeasured = ["{x} 1/10", {y}]\n' for x, y in places
    )
    marks.write_text(f'frame = "sheet-top-left"\nunits = "inch"\n{text}')
    assert row_of(run("compare", INI, marks)[1])[1:5] == ["5.00", "5.00", "5.10", "5.00"]
    said = run("compare", INI, marks, "--units", "mm")[1]
    assert row_of(said)[1:5] == ["127.0", "127.0", "129.5", "127.0"]


MILLIMETRES = re.compile(r"[\d.]+ mm\b")


def lengths_shown(said, unit):
    """The sizes that stand before a unit."""
    return [float(size) for size in re.findall(rf"([\d.]+)\s+{unit}\b", said)]


@pytest.mark.parametrize(
    "words",
    [
        ["diagnose", INI, MARKS],
        ["add", INI, MARKS, "--effect", "chain_sag", "sled_swing"],
        ["reach", INI],
        ["next", INI, MARKS],
        ["calibrate", INI, MARKS, "--details"],
    ],
    ids=lambda words: words[0],
)
def test_every_command_speaks_inches_on_request(words, run):
    metric, imperial = (run(*words, "--units", unit)[1] for unit in ("mm", "inch"))
    sizes = lengths_shown(metric, "mm"), lengths_shown(imperial, "inch")
    assert len(sizes[0]) >= len(sizes[1]) > 0
    in_inches = [size / 25.4 for size in sizes[0]]
    for size in sizes[1]:
        assert min(abs(size - each) for each in in_inches) < 0.02 + 0.05 * size  # two digits
    # What stays in mm is drawn by eye: the last 100 mm of a way, and what a plan is read to.
    said = re.sub(r"(to|last) [\d.]+ mm", "", " ".join(imperial.split()))
    assert MILLIMETRES.findall(said) == [] and "metre" not in said and " in mm" not in said


def test_json_and_files_stay_in_mm(ask, run, tmp_path):
    machine = tmp_path / "machine.toml"
    added = ["add", INI, MARKS, "--effect", "sled_swing"]
    _, metric = ask(*added)
    assert ask(*added, "--units", "inch")[1] == metric
    assert run(*added, "--units", "inch", "-o", machine)[0] == 0
    assert "8.91 mm before" in machine.read_text()


def test_feeds_and_places_of_a_job_are_in_inches_on_request(run, tmp_path):
    job = tmp_path / "job.nc"
    job.write_text("G20 G90\nG0 Z0.2\nG0 X2 Y1\nG1 Z-0.1 F10\nG1 X4 F30\nG0 Z0.2\n")
    said = run("check", job, INI, *INCHES)[1]
    assert "asks for 10.0 inch/min and gets 2." in " ".join(said.split()) and "mm" not in said
    assert "asks for 254 mm/min and gets 5" in " ".join(run("check", job, INI)[1].split())
    resume = ("resume", job, INI, "--line", "5", "-o", tmp_path / "rest.nc")
    assert "from X2.000 Y1.000 inch, where" in " ".join(run(*resume, *INCHES)[1].split())
    assert "from X50.80 Y25.40, where" in " ".join(run(*resume, "--force")[1].split())


def test_a_number_that_moved_too_far_is_shown_in_the_chosen_unit(run, tmp_path):
    marks = tmp_path / "marks.csv"
    places = [(x, y) for x in (-1000, 0, 1000) for y in (450, -450)]
    rows = [f"{x},{y},{x * 1.01},{y * 1.01}" for x, y in places]
    marks.write_text("\n".join(["target_x_mm,target_y_mm,measured_x_mm,measured_y_mm", *rows]))
    said = " ".join(run("add", INI, marks, "--effect", "none", *INCHES)[1].split())
    moved = re.search(r"gap between the motors: the marks say ([\d.]+) inch, ([\d.]+) inch", said)
    assert moved and float(moved[2]) > 0.236
    assert abs(float(moved[1]) - 117.26) == pytest.approx(float(moved[2]), abs=0.002)


def test_a_form_in_inches_is_filled_in_inches_and_read(run, here):
    words = ("grid", "--settings", INI, "--preset", "nine", *INCHES, "--output", "grid.nc")
    assert run(*words, "--marks", "marks.toml")[0] == 0
    text = Path("marks.toml").read_text()
    assert "inch from the sheet's top left corner" in text
    text = re.sub(r"^target = (.*)", r"target = \1\nmeasured = \1", text, flags=re.MULTILINE)
    text = text.replace("measured = [3.9370, 3.9370]", "measured = [3 7/8, 4 3/16]")
    Path("marks.toml").write_text(text)
    read = read_marks("marks.toml", sheet=SHEET)
    first = read.marks[0]
    assert first.target == pytest.approx((100 - 1219.2, 609.6 - 100), abs=0.002)
    assert first.measured == pytest.approx((3.875 * 25.4 - 1219.2, 609.6 - 4.1875 * 25.4))
    assert read.typed.unit == "inch"


def test_a_grid_is_the_same_in_inches(run):
    inches = ("--margin=5in", '--depth=1/8"', "--safe-height=1/4in")
    said = run("grid", *inches)
    assert said[0] == 0 and said == run(
        "grid", "--margin=127", "--depth=3.175", "--safe-height=6.35"
    )
    cut = run("grid", "--places=-30-1/2in,4in 0,100")[1]
    assert "G1 X-774.7 Y101.6 F700" in cut and "G1 X0 Y100 F700" in cut


def test_places_and_lengths_of_a_command_are_the_same_in_inches():
    assert place("4in,-2 1/2in") == pytest.approx((101.6, -63.5))
    assert length('1/32"') == pytest.approx(0.79375)
    name, shown = touch("left:-35 7/8in,254")
    assert name == "left" and shown == pytest.approx((-911.225, 254))
