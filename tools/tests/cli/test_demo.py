"""demo: the error of a real machine falls, and what is doubtful about it is said."""

from dataclasses import replace

import pytest
from plumb.cli.demo import main
from plumb.cure.machine_file import demonstrate
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings


@pytest.fixture(scope="module")
def demonstration():
    return demonstrate()


def test_the_command_ends_with_the_fall_and_what_calibrate_says(tmp_path, capsys):
    picture = tmp_path / "copy.png"
    assert main(["--real", "--folder", str(tmp_path / "demo"), "--picture", str(picture)]) == 0
    said = capsys.readouterr().out
    fall, verdict = said.split("\n\n")[-2:]
    for doubt in ("settings are assumed", "sign of y is doubtful", "NEGATIVE", "NOT kept"):
        assert doubt in " ".join(said.split())
    assert fall == "The error falls from 7.3 mm RMS (4.1 of it shape) to 0.64 mm, below 0.9."
    words = " ".join(verdict.split())
    # It knows nothing of what was chosen by hand, and finds most of it.
    assert words.startswith("plumb calibrate says of them: Most of it is chains too long or too")
    assert words.endswith("a pattern of 0.86 mm stays that no effect draws.")
    assert (tmp_path / "demo" / "error-falls.png").read_bytes() == picture.read_bytes()
    new = read_settings(tmp_path / "demo" / "machine.toml", known=known_effects())
    assert set(new.effects) == {"chain_pitch", "chain_sag"}
    client = read_settings(tmp_path / "demo" / "machine-groundcontrol.ini")
    assert client.motor_gap == pytest.approx(new.motor_gap, abs=1e-4)
    assert client.published.chain_sag_correction == 0
    assert "$160=-" in (tmp_path / "demo" / "machine.nc").read_text()


def test_the_command_fails_when_the_error_does_not_fall(
    tmp_path, capsys, monkeypatch, demonstration
):
    worse = replace(demonstration, chosen=demonstration.flipped)
    monkeypatch.setattr("plumb.cli.demo.demonstrate", lambda: worse)
    assert main(["--real", "--folder", str(tmp_path)]) == 1
    assert "not below 0.9" in capsys.readouterr().out.split("\n\n")[-2]


def test_a_folder_that_cannot_be_made_is_refused_in_one_line(tmp_path, capsys):
    (tmp_path / "file").write_text("no folder")
    assert main(["--real", "--folder", str(tmp_path / "file" / "demo")]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.startswith("demo: ") and said.err.count("\n") == 1


def test_mega_alone_runs_the_program_that_was_built(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("plumb.cli.demo.BUILT", "absent.elf")
    assert main(["--folder", str(tmp_path), "--mega"]) == 2
    said = capsys.readouterr().err
    assert said == "demo: cannot read absent.elf; build it with pio run\n"
