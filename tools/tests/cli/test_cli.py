"""The command line: answers, exit codes, and one clear line for whatever cannot be used."""

import pytest
from plumb.model.catalogue import effect_names
from plumb.settings.toml import write_machine_toml
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, csv_of, grid, marks_on

BOARD = [str(SETTINGS), str(MARKS)]
EFFECTS = ["--effect", "chain_pitch", "chain_sag"]
ADDED = ("chain_pitch", "chain_sag", "chain_stretch")


def test_compare_ends_with_its_conclusion(run):
    code, said, _ = run("compare", *BOARD)
    assert code == 0
    assert "The marks lie 7.29 mm RMS from where the settings put them" in said[-600:]
    # The worst is next to the conclusion.
    lengths = [float(line.split()[-1]) for line in said.splitlines()[1:9]]
    assert lengths == sorted(lengths)
    said = run("compare", *BOARD, "--details")[1]
    assert len([line for line in said.splitlines() if line[:1].isdigit()]) >= 9
    assert "error x y length" in " ".join(said.split())


def test_add_writes_settings_that_explain_the_marks(ask, tmp_path):
    new, ini = tmp_path / "machine.toml", tmp_path / "machine-groundcontrol.ini"
    options = ("--client", "groundcontrol", "--firmware", "published")
    # These marks ask for a sag below zero, which only --force writes.
    code, answer = ask("add", *BOARD, *EFFECTS, "-o", new, *options)
    assert (code, answer["written"], list(tmp_path.iterdir())) == (1, [], [])
    code, answer = ask("add", *BOARD, *EFFECTS, "-o", new, *options, "--force")
    assert code == 1 and answer["written"] == [str(new), str(ini)]
    assert answer["effects_added"] == ["chain_pitch", "chain_sag"]
    assert answer["raw"]["rms_mm"] > answer["before"]["fit_rms_mm"] > answer["after"]["fit_rms_mm"]
    assert answer["after"]["fit_rms_mm"] < answer["after"]["priced_rms_mm"] < 0.9
    sag = answer["parameters"][-1]
    assert sag["name"] == "chain_sag.weight_ratio_squared" and sag["unit"] == "1/mm^2"
    assert sag["low"] < sag["value"] < sag["high"] < 0 and sag["plausible"] is False
    assert any("off the middle" in line for line in answer["unsaid"])
    _, again = ask("compare", new, MARKS, "--cut-with", SETTINGS)
    # All but the sheet's rotation is in the settings.
    assert again["shape_rms_mm"] == pytest.approx(answer["after"]["shape_rms_mm"], abs=1e-3)
    assert again["rms_mm"] < 0.75
    _, published = ask("compare", ini, MARKS, "--cut-with", SETTINGS)
    assert published["shape_rms_mm"] < 0.9


def test_add_prints_the_fall_the_doubts_and_the_files(run, tmp_path):
    new, picture = tmp_path / "machine.toml", tmp_path / "fall.png"
    written = ("-o", new, "--picture", picture)
    code, said, _ = run("add", *BOARD, *EFFECTS, *written)
    assert code == 1 and "Do not set the machine by" in said and "Nothing is written" in said
    code, said, _ = run("add", *BOARD, *EFFECTS, *written, "--details", "--force")
    assert code == 1 and "The error falls from 7.29 to 0.6" in " ".join(said.split())
    assert "impossible" in said and "measure it again" in said
    assert str(new) in said and picture.read_bytes().startswith(b"\x89PNG")


def test_add_of_an_effect_that_does_not_pay_is_bad_news(run, tmp_path):
    settings, marks = tmp_path / "machine.toml", tmp_path / "marks.csv"
    write_machine_toml(settings, BELIEVED)
    marks.write_text(csv_of(marks_on(BELIEVED, BELIEVED, grid(3, 3), noise=0.5, seed=5)))
    code, said, _ = run("add", settings, marks, "--effect", *ADDED, "--details")
    assert code == 1 and "NOT better" in said and "do not keep" in said


def test_effects_names_every_effect_with_its_look_alikes(run):
    code, said, _ = run("effects")
    assert code == 0
    assert all(name in said for name in effect_names())
    assert said.count("looks like") == len(effect_names())
