"""The command line refuses what cannot be used: one clear line, exit 2, nothing written."""

import pytest
from example_machine import POCKET as JOB
from plumb.settings.machine import write_machine_toml
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED

BOARD = [str(SETTINGS), str(MARKS)]
EFFECTS = ["--effect", "chain_pitch", "chain_sag"]
BAD = [
    ("no marks", ["compare", SETTINGS], "MARKS"),
    ("text for a number", ["check", JOB, SETTINGS, "--bit", "big"], "--bit"),
    ("a length below zero", ["check", JOB, SETTINGS, "--bit=-1"], "--bit"),
    ("settings are missing", ["compare", "none.ini", MARKS], "none.ini: there is no such file"),
    ("marks are missing", ["compare", SETTINGS, "none.csv"], "none.csv: there is no such file"),
    ("marks as settings", ["compare", MARKS, MARKS], "holds marks, not settings"),
    ("settings as marks", ["compare", SETTINGS, SETTINGS], "holds settings, not marks"),
    ("program as settings", ["check", SETTINGS, JOB], "a program, not settings; give JOB first"),
    ("program as marks", ["compare", SETTINGS, JOB], "holds a program, not marks; give the form"),
    ("holey needs more", ["compare", *BOARD, "--controller", "holey"], "sledWeight"),
    ("a folder", ["compare", SETTINGS.parent, MARKS], "is a folder"),
    ("unknown effect", ["add", *BOARD, "--effect", "chain_sog"], "known are "),
    ("auto", ["add", *BOARD, "--effect", "auto", "chain_sag"], "name no others with it"),
    ("no effect", ["add", *BOARD], "--effect"),
    ("bad prior", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap=near"], "NAME=SIGMA"),
    ("prior without a number", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap"], "NAME=SIGMA"),
    ("infinite prior", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap=inf"], "NAME=SIGMA"),
    ("unknown prior", ["add", *BOARD, *EFFECTS, "--prior", "gap=1"], "unknown name 'gap'"),
    ("no reading error", ["add", *BOARD, *EFFECTS, "--sigma", "0"], "--sigma"),
    ("picture of no form", ["compare", *BOARD, "--picture", "errors.gif"], ".png"),
    ("no place", ["inverse", SETTINGS], "X,Y"),
    ("a place of one", ["inverse", SETTINGS, "1;2"], "'1;2' is not X,Y"),
    ("chains of one", ["forward", SETTINGS, "1,"], "'1,' is not X,Y"),
    (
        "our board",
        ["inverse", SETTINGS, "0,0", "--float32", "--controller", "stock"],
        "--float32 is",
    ),
    ("a place off", ["grid", "--places=0,0 0,700"], "mark 2 at x 0.0 y 660.0 is outside the sheet"),
    (
        "margin of places",
        ["grid", "--places=0,0", "--margin", "3"],
        "--margin is of marks in columns",
    ),
    ("grid of text", ["grid", "--margin", "wide"], "--margin"),
]


@pytest.mark.parametrize(("arguments", "hint"), [pytest.param(*b[1:], id=b[0]) for b in BAD])
def test_unusable_input_is_refused_in_one_line(arguments, hint, run, here):
    extra = ["-o", "new.toml", "--client", "groundcontrol"] if arguments[:1] == ["add"] else []
    code, said, complaint = run(*arguments, *extra)
    assert code == 2 and said == ""
    assert complaint.startswith("plumb: ") and complaint.count("\n") == 1
    assert hint in complaint
    assert list(here.iterdir()) == []


@pytest.mark.parametrize(
    "outputs",
    [
        ("-o", "nowhere/machine.toml", "--client", "groundcontrol"),
        ("-o", "new.nc", "--client", "none"),
        ("-o", "new.toml", "--picture", "new.toml"),
        ("--client", "groundcontrol"),
        ("-o", "new.toml", "--client", "none", "--firmware", "published"),
        ("-o", "new.toml", "--original", str(SETTINGS)),
        ("-o", "new.toml", "--picture", "nowhere/fall.png"),
        ("-o", str(SETTINGS)),
        ("-o", "new.toml", "--picture", str(MARKS)),
    ],
)
def test_if_one_result_cannot_be_written_none_is_written(outputs, run, here):
    before = SETTINGS.read_bytes(), MARKS.read_bytes()
    code, said, complaint = run("add", *BOARD, "--effect", "none", *outputs)
    assert code == 2 and said == "" and complaint.count("\n") == 1
    assert list(here.iterdir()) == []
    assert (SETTINGS.read_bytes(), MARKS.read_bytes()) == before


def test_a_groundcontrol_ini_needs_an_old_one(run, tmp_path):
    machine, out = tmp_path / "machine.toml", tmp_path / "new.toml"
    write_machine_toml(machine, BELIEVED)
    options = ("-o", out, "--client", "groundcontrol")
    code, _, complaint = run("add", machine, MARKS, "--effect", "none", *options)
    assert code == 2 and "needs your groundcontrol.ini" in complaint and not out.exists()
    for given in ("--cut-with", "--original"):
        assert run("add", machine, MARKS, "--effect", "none", *options, given, SETTINGS)[0] == 0
        assert (tmp_path / "new-groundcontrol.ini").exists()
        (tmp_path / "new-groundcontrol.ini").unlink()


def test_an_effect_that_the_library_lacks_is_refused_in_settings_too(run, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, BELIEVED)
    with open(machine, "a") as text:
        text.write("\n[effects.chain_sog]\nsize = 1\n")
    code, _, complaint = run("compare", machine, MARKS)
    assert code == 2 and f"{machine}, [effects.chain_sog]" in complaint


def test_distances_cannot_be_drawn(run, tmp_path):
    marks = tmp_path / "d.toml"
    marks.write_text(
        'frame = "machine"\nmark = [{name = "a", target = [0, 0]}, {name = "b", target = [500, 0]}]'
        '\ndistance = [{between = ["a", "b"], mm = 501}]\n'
    )
    picture = tmp_path / "d.png"
    code, _, complaint = run("compare", SETTINGS, marks, "--picture", picture)
    assert code == 2 and "distances only" in complaint and not picture.exists()
