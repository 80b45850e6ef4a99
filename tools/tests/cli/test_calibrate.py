"""plumb calibrate: from marks to files in one go, a second round, and a machine fitted before."""

import re
import shutil
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE, TRUE_NUMBERS, checked
from plumb.cli.main import build_parser
from plumb.diary.file import read_diary
from plumb.marks.form import marks_toml
from plumb.marks.read import Mark, Measurements
from plumb.settings import read_settings, write_machine_toml
from synthetic import BELIEVED, EFFECTS, TRUE, csv_of, grid, marks_on
from systems import widest, words_of

INI = "groundcontrol.ini"
COMMAND = re.compile(r"^  plumb (?:.*\\\n)*.*", re.MULTILINE)


@pytest.fixture(autouse=True)
def _shop(here):
    """A folder with the example's files."""
    for name in (INI, "marks.toml"):
        shutil.copy(EXAMPLE / name, here)


def printed(said):
    """The commands that an answer ends with."""
    commands = [words_of(text) for text in COMMAND.findall(said)]
    return [words[1:] for words in commands]


# Of the height it is read how far the motors are above the sheet's top edge.
READ = {**TRUE_NUMBERS, "motor_height": TRUE_NUMBERS["motor_height"] - 1219.2 / 2}


def with_value(word):
    """A word of a command, with what the owner measures in place of VALUE."""
    name, _, _ = word.partition("=")
    return word.replace("VALUE", f"{READ[name]}") if "VALUE" in word else word


def measure_on_target(form, *, off=0.0):
    """Fill in the form as on a machine as it was fitted; `off` [mm] along x: or as it was not."""
    noise = np.random.default_rng(2)

    def filled(line):
        x, y = (float(number) + 0.3 * noise.standard_normal() for number in line[1].split(","))
        return f"{line[0]}\nmeasured = [{x + off:.1f}, {y:.1f}]"

    text = re.sub(r"\nmeasured = .*", "", Path(form).read_text())
    Path(form).write_text(re.sub(r"^target = \[(.*)\]", filled, text, flags=re.MULTILINE))


KNOWN = ("--sigma", "0.2", "--checked", "tape_scale.strain=0+-0.0001")


def without_pitch():
    """The settings of a machine whose chains are longer than they say, in first.toml."""
    known = {name: sizes for name, sizes in EFFECTS.items() if name != "chain_pitch"}
    believed = replace(BELIEVED, effects=known)
    write_machine_toml("first.toml", believed)
    return believed


@pytest.mark.usefixtures("tried_in_full")
def test_an_open_question_names_a_measurement_and_writes_nothing(run):
    before = set(Path().iterdir())
    code, said, _ = run("calibrate", INI, "marks.toml")
    assert code == 1 and set(Path().iterdir()) == before
    assert "Not yet: first measure the tape against a certified length" in said
    assert said.startswith("Untested: a tape that reads wrong and chain stretch, right with odds")
    assert "The error falls from 8.91 to" in said
    assert "VALUE: how much too much the tape reads over a metre, in mm." in said
    (first,) = printed(said)
    assert first == ["calibrate", INI, "marks.toml", "--checked", "tape_scale.strain=VALUE+-0.1mm"]
    _, other = printed(run("calibrate", INI, "marks.toml", "--details")[1])
    assert other[:5] == ["add", INI, "marks.toml", "--effect", "auto"]
    assert widest(said) <= 80


def test_the_printed_commands_lead_to_the_files_and_to_a_second_round(run):
    # The gap and the tape are measured already.
    code, said = 1, ""
    words = ["calibrate", INI, "marks.toml", *checked("motor_gap", "tape_scale.strain")]
    while code == 1 and "VALUE" not in words[-1]:
        code, said, _ = run(*words)
        # What is asked for is measured, as the README of the example's machine says it is.
        words = [with_value(word) for word in printed(said)[0]]
    assert code == 0 and words[0] == "grid"
    assert "With chains too long or too short and chain stretch added, the error" in (
        " ".join(said.split())
    )
    written = ("machine.toml", "machine.nc", "machine-groundcontrol.ini")
    assert f"Written: {', '.join(written)}" in said
    assert all(Path(name).exists() for name in written)
    cut, again = printed(said)
    # The client's file next to the machine says which client it is.
    assert again == ["calibrate", "machine.toml", "marks-2.toml"] and run(*cut)[0] == 0
    settings = read_settings("machine.toml")
    measure_on_target("marks-2.toml")
    code, said, _ = run(*again)
    assert code == 0 and "The machine is as it was fitted" in said
    assert not Path("machine-2.toml").exists()
    measure_on_target("marks-2.toml", off=5.0)
    code, said, _ = run(*again)
    assert code == 0 and "With the frame fitted, the error falls" in said and "(chain_" not in said
    assert Path("machine-2.toml").exists() and Path("machine-2-groundcontrol.ini").exists()
    # What was read is never written.
    assert read_settings("machine.toml") == settings


def test_a_hidden_effect_is_added_and_the_second_round_starts_from_the_new_machine(run, ask):
    believed = without_pitch()
    Path("a.csv").write_text(csv_of(marks_on(TRUE, believed, grid(7, 5), noise=0.2, seed=3)))
    code, answer = ask("calibrate", "first.toml", "a.csv", *KNOWN, "-o", "second.toml")
    assert code == 0 and answer["done"] and answer["written"] == ["second.toml"]
    assert set(answer["addition"]["effects_added"]) >= {"chain_pitch"}
    believed = read_settings("second.toml")
    Path("b.csv").write_text(csv_of(marks_on(TRUE, believed, grid(7, 5), noise=0.2, seed=4)))
    options = ("--cut-with", "second.toml", "--sigma", "0.2")
    _, again = ask("calibrate", "second.toml", "b.csv", *options)
    assert answer["comparison"]["rms_mm"] > 3.0 and again["holds"]


def test_a_turned_sheet_is_named_beside_the_promised_error(run):
    believed = without_pitch()
    turn = 4.9 / 2438.4
    turned = [
        replace(
            mark,
            measured=(
                mark.measured[0] + turn * mark.measured[1],
                mark.measured[1] - turn * mark.measured[0],
            ),
        )
        for mark in marks_on(TRUE, believed, grid(7, 5), noise=0.2, seed=3)
    ]
    Path("a.csv").write_text(csv_of(turned))
    for command in ("calibrate", "add --effect auto"):
        name, *more = command.split()
        said = " ".join(run(name, "first.toml", "a.csv", *more, *KNOWN)[1].split())
        assert re.search(r"lower the right end of the next sheet by 4\.\d+ mm", said), said


def test_numbers_of_a_machine_without_a_client_go_there_before_new_marks_are_cut(run):
    believed = without_pitch()
    Path("a.csv").write_text(csv_of(marks_on(TRUE, believed, grid(7, 5), noise=0.2, seed=3)))
    code, said, _ = run("calibrate", "first.toml", "a.csv", *KNOWN)
    assert code == 0 and [words[0] for words in printed(said)] == ["send", "grid", "calibrate"]
    assert printed(said)[0] == ["send", "machine.toml"] and "give --client" in said
    code, said, _ = run("calibrate", "first.toml", "a.csv", *KNOWN, "--client", "none")
    assert code == 0 and "Open machine-2.nc" in said and printed(said)[0][0] == "grid"
    _, said, _ = run("add", "first.toml", "a.csv", *KNOWN, "--effect", "auto", "-o", "b.toml")
    assert [words[0] for words in printed(said)] == ["send", "grid", "calibrate"]
    published = ("--effect", "auto", "--firmware", "published", "-o", "c.toml")
    _, said, _ = run("add", "first.toml", "a.csv", *KNOWN, *published)
    assert printed(said) == [] and "Give --client" in said


def test_a_slip_comes_first_and_the_mark_can_be_left_out(run):
    marks = list(marks_on(TRUE, TRUE, grid(7, 5), noise=0.2, seed=5))
    x, y = marks[11].measured
    marks[11] = replace(marks[11], measured=(x + 30.0, y))
    write_machine_toml("first.toml", TRUE)
    Path("a.csv").write_text(csv_of(marks))
    code, said, _ = run("calibrate", "first.toml", "a.csv", "--sigma", "0.2")
    assert code == 1 and "look at mark 11 again before anything else" in " ".join(said.split())
    assert not Path("machine.toml").exists()
    corrected, without = printed(said)
    assert corrected == ["calibrate", "first.toml", "a.csv", "--sigma", "0.2"]
    assert without == [*corrected, "--without", "11"]
    code, said, _ = run(*without)
    assert code == 0 and "Nothing to change" in said


MADGRIZZLE = resources.files("plumb") / "examples/madgrizzle-2018-09-04/groundcontrol.ini"
ROW = """name,target_x_mm,target_y_mm,measured_x_mm,measured_y_mm
a,-1000,500,-1002.8,500.2
b,0,500,-0.2,497.4
c,1000,500,1000.8,502.1
"""
CORNERS = """d,-1000,-450,-1001.6,-450.9
e,1000,-450,1001,-448
"""


def test_marks_in_a_row_are_too_few_and_more_are_asked_for(run, file):
    row = file("row.csv", ROW)
    code, said, _ = run("calibrate", MADGRIZZLE, row)
    assert code == 1 and not Path("machine.toml").exists()
    text = " ".join(said.split())
    assert "they leave 1.1 mm open" in text
    assert re.search(r"Not yet: first measure \d+ more marks, about \d+ minutes; nothing", text)
    cut, again = printed(said)
    assert cut[0] == "next" and "--output" in cut and again[0] == "calibrate"
    code, said, _ = run("add", MADGRIZZLE, row, "--effect", "auto", "-o", "machine.toml")
    assert code == 1 and not Path("machine.toml").exists()
    assert printed(said)[0][0] == "next"
    assert printed(run("diagnose", MADGRIZZLE, row)[1])[-1][0] == "next"
    assert run("report", MADGRIZZLE, row, "-o", "report.html")[0] == 0
    page = " ".join(Path("report.html").read_text().split())
    assert (
        "Nothing was added. These marks do not reach over the sheet" in page
        and "Write the new settings" not in page
    )
    assert "use the fitted frame" not in page
    # Two more, near the lower corners, are enough.
    code, said, _ = run("calibrate", MADGRIZZLE, file("more.csv", ROW + CORNERS))
    assert "mm open;" not in " ".join(said.split())


def test_too_few_marks_for_an_effect_are_no_refusal_where_nobody_named_it(run, monkeypatch):
    monkeypatch.setattr("plumb.cure.add.different_numbers", lambda *_: 5)
    code, said, complaint = run("calibrate", INI, "marks.toml")
    assert (code, complaint) == (1, "") and "5 measured numbers cannot settle" in said
    assert "Not yet: first measure " in said and not Path("machine.toml").exists()


def test_the_client_that_was_named_counts(run):
    options = (*checked(), "--client", "webcontrol")
    code, said, _ = run("calibrate", INI, "marks.toml", *options)
    assert code == 0 and not Path("machine-groundcontrol.ini").exists()
    assert "type these numbers into WebControl" in said.replace("Type", "type")
    assert "--client webcontrol" in said


@pytest.mark.parametrize(
    "command",
    [
        ("grid", "--settings", INI, "--output", "grid.nc", "--marks", "cut.toml"),
        ("compare", INI, "marks.toml", "--cut-with", INI),
        ("diagnose", INI, "marks.toml", "--sigma", "0.5", "--prior", "motor_gap=2"),
        ("next", INI, "marks.toml"),
        ("add", INI, "marks.toml", "--effect", "chain_pitch"),
        ("add", INI, "marks.toml", "--effect", "chain_pitch", "-o", "new.toml"),
        ("add", INI, "marks.toml", "--patch", "-o", "new.toml", "--client", "groundcontrol"),
        ("effects",),
        ("settings", EXAMPLE / "machine.toml"),
        ("reach", EXAMPLE / "machine.toml"),
    ],
    ids=lambda command: "-".join(map(str, command[:1])),
)
def test_a_command_ends_with_a_next_command_that_runs(command, run):
    code, said, _ = run(*command)
    assert code < 2
    following = printed(said)
    assert following and said.rstrip().endswith(said.splitlines()[-1])
    assert COMMAND.findall(said)[-1] in said[-400:]
    for words in following:
        for word in words:
            if word.endswith((".toml", ".ini")):
                Path(word).touch()
        parsed = build_parser().parse_args([word.replace("VALUE", "0") for word in words])
        assert parsed.command == words[0] != "next" or command[0] in ("diagnose", "next")


NEAR = {(-900, 250): (-900.4, 250.3), (900, -250): (900.6, -249.8)}
FAR = {(-900, 250): (-897.8, 243.7), (900, -250): (905.8, -252.6)}


@pytest.fixture
def calibrated(run):
    """Calibrates a fitted machine with marks by their targets."""
    run("add", "groundcontrol.ini", "marks.toml", "--effect", "chain_pitch", "-o", "machine.toml")

    def calibrate(marks, by=run, cut_with="machine.toml"):
        read = (Mark(str(i), *mark) for i, mark in enumerate(marks.items(), 1))
        form = marks_toml(Measurements(tuple(read)))
        Path("check.toml").write_text(f'cut_with = "{cut_with}"\n{form}')
        return by("calibrate", "machine.toml", "check.toml")

    return calibrate


def files():
    return sorted(each.name for each in Path().iterdir())


def test_a_machine_is_as_it_was_fitted_or_what_changed_is_named(calibrated, ask):
    code, said, _ = calibrated(NEAR)
    kept = files()
    assert code == 0 and "The machine is as it was fitted: by the fit of" in said
    assert "Nothing was written." in said and "a single change" not in said
    rows = [line.split() for line in said.splitlines() if line.startswith(("1 ", "2 "))]
    assert rows[0][:4] == ["1", "-900.4,", "250.3", "-0.40,"]
    assert rows[1][:4] == ["2", "900.6,", "-249.8", "+0.60,"]
    code, answer = calibrated(FAR, ask)
    assert code == 1 and not answer["holds"] and "Something changed since" in answer["sentence"]
    assert answer["changes"][0]["name"] == "left chain"
    assert answer["changes"][0]["size"] == pytest.approx(6.35, abs=1.0)
    code, said, _ = calibrated(FAR)
    assert code == 1 and "The likeliest: the left chain is" in " ".join(said.split())
    shown = said[said.index("a single change") :]
    assert sum(line.rstrip().endswith((" yes", " no")) for line in shown.splitlines()) == 4
    assert max(map(len, said.splitlines())) <= 80
    assert files() == kept
    kinds = [entry.kind for entry in read_diary(".").entries]
    assert kinds == ["fit", "recheck", "recheck", "recheck"]


def test_a_machine_that_no_longer_holds_is_fitted_again_where_the_marks_are_enough(calibrated):
    grid = {(x, y): (x + 5.0, y) for x in (-900, 0, 900) for y in (-400, 0, 400)}
    code, said, _ = calibrated(grid)
    assert code in (0, 1) and "as it was fitted" not in said and "single change" not in said
    code, said, _ = calibrated({target: target for target in grid})
    assert code == 0 and "The machine is as it was fitted" in said


@pytest.mark.parametrize("unlike", ["other settings", "no diary", "one place"])
def test_two_marks_that_no_fit_can_judge_are_too_few(calibrated, unlike):
    marks = {(0, 0): (0, 0), (30, 39): (30, 39)} if unlike == "one place" else NEAR
    if unlike == "no diary":
        Path("diary.jsonl").unlink()
    cut_with = "groundcontrol.ini" if unlike == "other settings" else "machine.toml"
    code, said, refused = calibrated(marks, cut_with=cut_with)
    assert code == 2 and said == "" and "too few for a diagnosis" in refused
