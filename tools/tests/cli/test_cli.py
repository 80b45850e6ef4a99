"""The command line: answers, exit codes, and what `plumb diagnose` prints."""

import json
from dataclasses import replace

import numpy as np
import pytest
from example_machine import EXAMPLE, INI
from plumb.cli.main import main
from plumb.firmware.settings import firmware_numbers, machine_of
from plumb.model.catalogue import effect_names
from plumb.model.predict import lengths, library
from plumb.settings.machine import machine_toml, write_machine_toml
from plumb.text.errors import InputError
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE, csv_of, grid, marks_on

BOARD = [str(SETTINGS), str(MARKS)]
EFFECTS = ["--effect", "chain_pitch", "chain_sag"]
ADDED = ("chain_pitch", "chain_sag", "chain_stretch")


def test_the_worst_marks_stand_next_to_the_conclusion_of_compare(run):
    lengths = [float(line.split()[-1]) for line in run("compare", *BOARD)[1].splitlines()[1:9]]
    assert lengths == sorted(lengths)


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


def test_clean_marks_are_called_clean(run, file, maker):
    clean = marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.5, seed=4)
    words = ("diagnose", maker, file("clean.csv", csv_of(clean)), "--sigma", "0.5")
    code, said, _ = run(*words)
    assert code == 0 and said.startswith("The machine is as good as")
    said = run(*words, "--details")[1]
    assert "may act too" in said and "These marks say nothing of a sled that rubs" in said


def test_a_slip_is_bad_news(run, ask, file, maker):
    marks = list(marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.3, seed=4))
    marks[7] = replace(marks[7], measured=tuple(np.add(marks[7].measured, (5.1, 0.0))))
    path = file("slip.csv", csv_of(marks))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and "One reading disagrees with every explanation" in said
    assert "off to the right" in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and answer["suspects"] == [] and answer["slips"][0]["name"] == "7"
    assert np.hypot(*answer["slips"][0]["offset_mm"]) == pytest.approx(5.1, abs=1.2)


def test_suspects_come_with_size_and_remedy(run, ask, file, maker):
    path = file("m.csv", csv_of(marks_on(TRUE, BELIEVED, grid(5, 5), noise=0.2, seed=1)))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.2", "--details")
    assert code == 0 and "To be sure" in said and "over 100 to 1" in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.2")
    assert answer["sigma_mm"] == 0.2 and answer["sigma_from"] == "stated"
    assert set(answer["suspects"]) >= {"chain_pitch", "chain_sag"}


BOARDS = {"the example": (INI, EXAMPLE / "marks.toml"), "nine marks": (SETTINGS, MARKS)}


@pytest.mark.parametrize("board", BOARDS)
def test_each_size_lies_in_its_interval(ask, board):
    """Also a size that no real machine has, such as a sag below zero."""
    _, answer = ask("diagnose", *BOARDS[board])
    sizes = [size for each in answer["ranking"] for size in each["parameters"]]
    assert sizes
    for size in sizes:
        if size["low"] is not None:
            assert size["low"] <= size["value"] <= size["high"], size


FULL = replace(
    TRUE,
    effects={
        effect["name"]: {each["name"]: each["typical"] for each in effect["parameters"]}
        for effect in library()
    },
)


@pytest.mark.parametrize("machine", [TRUE, FULL], ids=["three effects", "every effect"])
def test_the_firmware_reads_the_lines_as_the_machine_that_was_fitted(machine):
    numbers = {row.number: float(row.text) for row in firmware_numbers(machine)}
    theirs = machine_of(numbers, sheet=machine.sheet)
    places = grid(7, 5)
    ours, _ = lengths(machine, places)
    paid_out, outcome = lengths(theirs, places)
    assert not outcome.any() and np.abs(ours - paid_out).max() < 0.003


def test_a_size_that_the_firmware_does_not_take_is_refused():
    wild = replace(TRUE, effects={"chain_pitch": {"left": 5.0, "right": 0.0}})
    with pytest.raises(InputError, match="firmware"):
        firmware_numbers(wild)


def test_published_settings_are_left_to_their_own_program(capsys):
    assert main(["settings", str(SETTINGS)]) == 2
    assert "machine.toml" in capsys.readouterr().err


def test_lines_can_be_sent_as_they_are(tmp_path, capsys):
    machine = tmp_path / "machine.toml"
    machine.write_text(machine_toml(TRUE))
    assert main(["settings", str(machine), "--client", "none", "-o", "-"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.startswith("$") and " " not in line for line in lines)
    assert main(["settings", str(machine), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["settings"]) == len(lines)
