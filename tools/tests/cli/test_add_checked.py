"""`plumb add --checked` counts or is refused; the error that a fit promised can be seen again."""

import contextlib
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from example_machine import EXAMPLE, checked
from plumb import api
from plumb.cli.main import main
from plumb.settings.files import read_settings
from plumb.settings.machine import write_machine_toml
from synthetic import BELIEVED, csv_of, grid, marks_on
from systems import words_of

BOARD = (str(EXAMPLE / "groundcontrol.ini"), str(EXAMPLE / "marks.toml"))
PITCH = (*BOARD, "--effect", "chain_pitch")
COMMAND = re.compile(r"^  plumb (?:.*\\\n)*.*", re.MULTILINE)


def next_command(said):
    return words_of(COMMAND.findall(said)[-1])[1:]


def test_auto_uses_checked_numbers(ask, run):
    _, free = ask("add", *BOARD, "--effect", "auto")
    _, taken = ask("add", *BOARD, "--effect", "auto", *checked())
    assert free["auto"]["verdict"] == "cannot_tell" and free["auto"]["rivals"]
    assert taken["auto"]["verdict"] == "one_suspect" and not taken["auto"]["rivals"]
    assert taken["effects_added"] == ["chain_pitch", "chain_stretch"]


def test_a_choice_states_whether_it_matters(run, ask):
    apart = ask("add", *BOARD, "--effect", "auto")[1]["auto"]["apart"]
    assert apart["mm"] == pytest.approx(2.1, abs=0.1)
    for words in (("add", *BOARD, "--effect", "auto"), ("calibrate", *BOARD, "--details")):
        assert apart["sentence"] in " ".join(run(*words)[1].split())
    # Rivals that cut alike are no reason to wait.
    alike = ("add", *BOARD, "--effect", "auto", *checked("tape_scale.strain"))
    assert ask(*alike)[1]["auto"]["apart"] is None and ask(*alike)[1]["auto"]["rivals"]
    said = " ".join(run(*alike, "--details")[1].split())
    assert "Added: chains too long or too short and chain stretch, the likeliest of several" in said
    assert "For cutting it hardly matters" in said and "(chain_" not in said[: said.index("To be")]


def test_usual_effects_are_added_with_a_note_and_no_doubt(run, ask, tmp_path):
    clean = tmp_path / "clean.csv"
    stretch = {"chain_stretch": {"compliance": 5.2e-6}}
    machine = replace(BELIEVED, effects=stretch)
    clean.write_text(csv_of(marks_on(machine, BELIEVED, grid(3, 3), noise=0.9, seed=5)))
    settings = tmp_path / "machine.toml"
    sag = {"chain_sag": {"weight_ratio_squared": 8.2e-12}}
    write_machine_toml(settings, replace(BELIEVED, effects=sag))
    words = ("add", settings, clean, "--effect", "auto")
    said = " ".join(run(*words, "--details")[1].split())
    assert "Every machine has chain stretch, and these settings leave it out." in said
    assert "this may be zero" not in said and "do not keep it" not in said
    assert "this may be zero" in run("add", settings, clean, "--effect", "chain_stretch")[1]
    _, answer = ask(*words)
    fitted = next(n for n in answer["parameters"] if n["name"] == "chain_stretch.compliance")
    assert 0 < fitted["value"] < 1e-5 and fitted["low"] < 0


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["tape_scale.strain=0+-0.0001"], "tape_scale is not fitted here; name it with --effect"),
        (["nonsense=1+-1"], "nonsense"),
        (["rotation_radius=139+-1"], "no such number is fitted"),
        (["motor_gap=2980+-1", "--prior", "motor_gap=0"], "no such number is fitted"),
        (["motor_gap=2980+-1", "--checked", "motor_gap=2981+-1"], "twice"),
        (["tape_scale.strain=0.1+-0.0001"], "0.1 mm per metre is 0.0001"),
        (["tape_scale.strain=-0.0096+-0.0001"], "real machines have -0.003 to 0.003"),
        (["frame_flex.inward=8+-0.1"], "write it in mm/N"),
        (["motor_gap=298+-1"], "far from the 2978.4 of the settings"),
        (["motor_gap=29784+-1"], "far from the 2978.4 of the settings"),
        (["tape_scale.strain=0,0001+-0.0001"], "write a point, not a comma"),
        (["motor_gap=5+-1kg"], "it is read in mm, not in kg"),
        (["motor_height=1069.6+-1mm"], "far from the 1072.6 of the settings"),
        (["frame_lean.tangent_squared=1/0+-1in"], "not like"),
        (["motor_gap=VALUE+-1"], "put your number in place of VALUE"),
        (["chain_pitch.left=0.002+-0.001", "--hold", "chain_pitch.left=0.002"], "--hold keeps it"),
    ],
)
def test_checks_that_cannot_count_are_refused_in_one_line(run, options, complaint):
    code, said, refused = run("add", *PITCH, "--checked", *options)
    assert code == 2 and said == "" and complaint in refused and refused.count("\n") == 1


def test_the_next_command_repeats_a_check_with_all_its_digits(run, here):
    check = ("--checked", "motor_gap=2978.4375+-0.3", "--checked", "chain_pitch.left=0.0018+-0.001")
    code, said, _ = run("add", *PITCH, *check, "--prior", "motor_height=12.3456789")
    again = next_command(said)
    assert code == 0 and again[-2:] == ["-o", "machine.toml"]
    for words in (check[:2], check[2:], ("--prior", "motor_height=12.3456789")):
        assert " ".join(words) in " ".join(again)
    assert main(again) == 0


def test_the_frame_alone_can_be_fitted(ask, run):
    code, answer = ask("add", *BOARD, "--effect", "none")
    wanted = api.add(api.read(*BOARD))
    assert code == 0 and answer["after"]["fit_rms_mm"] == wanted.after.fit_rms
    assert answer["effects_added"] == []
    assert "--effect none" in run("add", *BOARD, "--effect", "none")[1]
    code, _, refused = run("add", *BOARD, "--effect", "none", "chain_pitch")
    assert code == 2 and "name no effects with it" in refused


def test_diagnose_hands_its_checks_to_the_command_that_adds(run):
    words = next_command(run("diagnose", *BOARD, *checked())[1])
    assert words[0] == "add" and words[words.index("--effect") + 1] == "auto"
    given = [words[i + 1] for i, word in enumerate(words) if word == "--checked"]
    assert given == checked()[1::2]


def with_readings(text, moved):
    """The text of a marks.toml with each reading moved."""

    def replaced(match):
        x, y = moved(float(match[1]), float(match[2]))
        return f"measured = [{x:.3f}, {y:.3f}]"

    return re.sub(r"measured = \[(\S+), (\S+)\]", replaced, text)


def filled_in(form):
    """The text of a form with every reading at its target."""
    return re.sub(r"target = (.*)\n(.*\n)# measured.*", r"target = \1\n\2measured = \1", form)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a machine fitted to the example's marks."""
    folder = tmp_path_factory.mktemp("fitted")
    shutil.copy(EXAMPLE / "groundcontrol.ini", folder)
    # A sheet that hangs askew by 12 mm over its width: no setting holds that.
    text = (EXAMPLE / "marks.toml").read_text()
    turned = with_readings(text, lambda x, y: (x - 0.005 * y, y + 0.005 * x))
    (folder / "marks.toml").write_text(turned)
    with contextlib.chdir(folder):
        files = ["groundcontrol.ini", "marks.toml", "-o", "machine.toml"]
        assert main(["add", *files, "--effect", "chain_pitch"]) == 0
    return folder


@pytest.fixture
def fitted(folder, here):
    """A copy of it as the current folder; the error that the fit promised [mm]."""
    shutil.copytree(folder, here, dirs_exist_ok=True)
    return round(read_settings("machine.toml").fitted.rms, 2)


def test_compare_finds_the_error_that_add_promised(fitted, ask, run):
    _, answer = ask("compare", "machine.toml", "marks.toml")
    assert answer["rms_mm"] == pytest.approx(answer["promised_rms_mm"], abs=1e-9)
    assert round(answer["rms_mm"], 2) == fitted
    assert abs(answer["rotation"]) < 1e-4
    _, same = ask("compare", "machine.toml", "marks.toml", "--cut-with", "groundcontrol.ini")
    assert same["rms_mm"] == pytest.approx(answer["rms_mm"], abs=1e-9)
    residuals = [mark["left_chain_residual"] for mark in answer["marks"]]
    assert max(map(abs, residuals)) < 2
    said = run("compare", "machine.toml", "marks.toml", "--details")[1]
    assert "cut with groundcontrol.ini" in said and "turned by" in said
    _, old = ask("compare", "groundcontrol.ini", "marks.toml")
    assert old["promised_rms_mm"] is None and old["rms_mm"] > 5


def test_marks_that_took_no_part_are_named(fitted, run):
    options = ("--effect", "chain_pitch", "--without", "13", "--without", "7")
    assert run("add", "groundcontrol.ini", "marks.toml", *options, "-o", "less.toml")[0] == 0
    said = " ".join(run("compare", "less.toml", "marks.toml", "--details")[1].split())
    assert "RMS was left, without 13, 7" in said


def test_diagnose_finds_no_more_to_add(fitted, ask):
    both = ("--effect", "chain_pitch", "chain_stretch", "-o", "both.toml")
    ask("add", "groundcontrol.ini", "marks.toml", *both)
    _, answer = ask("diagnose", "both.toml", "marks.toml")
    assert answer["verdict"] == "nothing_provable" and not answer["explanations"]


def test_marks_of_unknown_settings_are_asked_about(fitted, ask, run):
    text = Path("marks.toml").read_text()
    Path("second.toml").write_text(with_readings(text, lambda x, y: (x + 0.1, y)))
    code, _, complaint = run("compare", "machine.toml", "second.toml")
    assert code == 2 and complaint.count("\n") == 1
    assert "machine.toml was fitted to marks that were cut with groundcontrol.ini" in complaint
    for command in (["diagnose"], ["next"], ["add", "--effect", "chain_pitch"]):
        assert run(*command[:1], "machine.toml", "second.toml", *command[1:])[0] == 2
    for cut_with, least, most in (("groundcontrol.ini", 0, 8), ("machine.toml", 8, 20)):
        _, answer = ask("compare", "machine.toml", "second.toml", "--cut-with", cut_with)
        assert least < answer["rms_mm"] < most
    # Reported chains need no settings, and settings that were never fitted ask nothing.
    chains = re.sub(r"(approach = .*)", r"\1\nchains = [1700, 1700]", text)
    Path("chains.toml").write_text(chains)
    assert run("compare", "machine.toml", "chains.toml")[0] == 0
    assert run("compare", "groundcontrol.ini", "second.toml")[0] == 0


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        (r"^rms = .*", "", "[fit]: rms is missing"),
        (r"^sheet = .*", "sheet = [1, 2]", "[[board]] number 1 sheet: an array of 3 numbers"),
        (r"^\[board.cut_with.frame\]", "[board.cut_with.fram]", "unknown name 'fram'"),
        (r"^\[\[board\]\]", "[board]", "[board]: needs double brackets; write [[board]]"),
    ],
)
def test_a_damaged_record_is_refused_with_its_place(old, new, hint, fitted, run):
    text = Path("machine.toml").read_text()
    Path("machine.toml").write_text(re.sub(old, new, text, count=1, flags=re.MULTILINE))
    code, _, complaint = run("compare", "machine.toml", "marks.toml")
    assert code == 2 and complaint.startswith("plumb: machine.toml") and hint in complaint


def test_two_sheets_keep_their_poses_and_zeros(run, ask, fitted):
    text = Path("marks.toml").read_text()
    moved = with_readings(text, lambda x, y: (x + 6, y - 4))
    Path("second.toml").write_text(f"new_sheet = true\nchains_rezeroed = true\n{moved}")
    both = ("marks.toml", "second.toml")
    options = ("--effect", "chain_pitch", "-o", "two.toml")
    assert run("add", "groundcontrol.ini", *both, *options)[0] == 0
    _, answer = ask("compare", "two.toml", *both)
    assert answer["rms_mm"] == pytest.approx(answer["promised_rms_mm"], abs=1e-9)
    assert answer["rms_mm"] < 2
    # Either sheet alone lies where it lay.
    for name in both:
        _, alone = ask("compare", "two.toml", name)
        assert alone["rms_mm"] < 2 and alone["promised_rms_mm"] is None
        assert max(map(abs, alone["shift"])) < 0.5


def test_settings_that_changed_since_the_cut_are_noticed(run, ask, fitted):
    grid = ("grid", "--settings", "groundcontrol.ini", "--marks", "f.toml", "--output", "g")
    assert run(*grid)[0] == 0
    Path("f.toml").write_text(filled_in(Path("f.toml").read_text()))
    assert run("compare", "groundcontrol.ini", "f.toml")[0] == 0
    old = Path("groundcontrol.ini").read_text()
    # GroundControl keeps its windows in the same file, and writes numbers as it likes.
    kept = old.replace("viewscale = .45", "viewscale = .5").replace("= 463", "= 463.0")
    Path("groundcontrol.ini").write_text(kept)
    assert run("compare", "groundcontrol.ini", "f.toml")[0] == 0
    Path("groundcontrol.ini").write_text(old.replace("= 463", "= 460"))
    code, _, complaint = run("compare", "groundcontrol.ini", "f.toml")
    assert code == 2 and "groundcontrol.ini, which has changed since" in complaint
    assert run("compare", "groundcontrol.ini", "f.toml", "--cut-with", "machine.toml")[0] == 0


def test_effects_of_the_lab_are_named_where_the_error_counts_them(run, fitted):
    add = ("add", "groundcontrol.ini", "marks.toml", "--effect", "tape_scale", "-o", "tape.toml")
    assert run(*add)[0] == 0
    counted = "The error counts what the fit found: tape reads 0.1"
    for command in ("compare", "calibrate"):
        assert counted in " ".join(run(command, "tape.toml", "marks.toml")[1].split())
        assert "counts what" not in run(command, "machine.toml", "marks.toml")[1]
