"""`plumb add --checked`: a number that was measured directly counts in the fit, or is refused."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from example_machine import checked
from plumb import api
from plumb.cli.main import main
from plumb.settings.toml import write_machine_toml
from synthetic import BELIEVED, csv_of, grid, marks_on
from systems import words_of

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
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
    assert "A choice: the likeliest is chains too long or too short and chain stretch, but" in said
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
    assert "may as well be zero" not in said and "do not keep it" not in said
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


def test_the_next_command_repeats_a_check_with_all_its_digits(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
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
