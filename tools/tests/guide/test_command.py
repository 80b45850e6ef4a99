"""The command itself, to the end of the day."""

import json
from importlib import resources

import plumb.cli.guide
from jsonschema import Draft202012Validator
from plumb.cli.main import main
from plumb.guide.steps import STEPS
from plumb.guide.talk import Progress

SCHEMA = json.loads(resources.files("plumb.cli").joinpath("answers.schema.json").read_text("utf-8"))


def test_at_the_end_it_names_the_grid_and_what_is_known(tmp_path, monkeypatch, capsys):
    progress = Progress(tmp_path, [step.name for step in STEPS], {"motor_gap": 4.0})
    progress.save()
    monkeypatch.setattr(plumb.cli.guide, "SerialPort", lambda path: Silent())
    monkeypatch.setattr(plumb.cli.guide.Sender, "await_start", lambda sender: None)
    assert main(["guide", str(tmp_path), "--port", "any"]) == 0
    said = " ".join(capsys.readouterr().out.replace("\\", "").split())
    assert f"plumb grid --settings {tmp_path}/machine.toml" in said
    assert "--prior motor_gap=4" in said


def test_a_program_gets_what_is_done_as_an_object(tmp_path, monkeypatch, run):
    Progress(tmp_path, [step.name for step in STEPS], {"motor_gap": 4.0}).save()
    monkeypatch.setattr(plumb.cli.guide, "SerialPort", lambda path: Silent())
    monkeypatch.setattr(plumb.cli.guide.Sender, "await_start", lambda sender: None)
    code, said, aside = run("guide", tmp_path, "--port", "any", "--json")
    assert code == 0 and "Nothing moves before you say yes" in aside
    answer = json.loads(said)
    Draft202012Validator({**SCHEMA, "anyOf": [{"$ref": "#/$defs/guide"}]}).validate(answer)
    assert answer == {
        "done": [step.name for step in STEPS],
        "open": [],
        "settings": str(tmp_path / "machine.toml"),
        "sigmas": {"motor_gap": 4.0},
    }


def test_a_folder_that_is_missing_is_refused(tmp_path, capsys):
    assert main(["guide", str(tmp_path / "none"), "--port", "any"]) == 2
    assert "there is no such folder" in capsys.readouterr().err


class Silent:
    def close(self):
        pass
