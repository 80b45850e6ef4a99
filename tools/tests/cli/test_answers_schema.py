"""The output of --json fits the schema in the package."""

import json
from importlib import resources
from pathlib import Path

import plumb.cli.read as read_command
import pytest
from jsonschema import Draft202012Validator as Validator
from numbers_machine import NumbersMachine
from plumb.cli.main import COMMANDS, build_parser, main
from plumb.diary.file import append
from plumb.vm.practice import Secret

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
SCHEMA = json.loads(resources.files("plumb.cli").joinpath("answers.schema.json").read_text("utf-8"))
INI, TOML = EXAMPLE / "groundcontrol.ini", EXAMPLE / "machine.toml"
BOARD = (INI, EXAMPLE / "marks.toml")
SLIPPED = (INI, "slipped.toml")  # a reading of BOARD is wrong by 40 mm
SPANS = (INI, "spans.toml")
TAPE = ("--checked", "tape_scale.strain=0.0001+-0.0001")
GRID = ("--preset", "nine")
CLIENT = ("--client", "groundcontrol", "-o", "new.toml")
# Each command, and each shape that its answer has.
QUESTIONS = (
    ("add", *BOARD, "--effect", "chain_pitch", "chain_stretch", "--patch", *CLIENT),
    ("add", *BOARD, "--effect", "auto"),
    ("add", *SLIPPED, "--effect", "auto"),
    ("bench", "--kinds", "none", "one", "--marks", "9", "--boards", "1"),
    ("calibrate", *BOARD),
    ("calibrate", *BOARD, *TAPE, *CLIENT),
    ("calibrate", "kept/machine.toml", "kept/check.toml"),
    ("check", EXAMPLE / "pocket.nc", INI),
    ("check", EXAMPLE / "pocket.nc", INI, "--marks", EXAMPLE / "marks.toml"),
    ("compare", *BOARD),
    ("compare", *SPANS),
    ("diagnose", *BOARD),
    ("diagnose", *SLIPPED),
    ("effects",),
    ("forward", INI, "1695.8,1699", "100,100"),
    ("inverse", INI, "0,0", "0,9000"),
    ("grid", *GRID),
    ("grid", *GRID, "--settings", INI, "--details"),
    ("grid", *GRID, "--output", "grid.nc", "--marks", "form.toml"),
    ("recover", "kept.toml", "--keep=low=0,-400", "-o", "hole.nc"),
    ("recover", "kept.toml", "--at", "left", "--touch=right:903,-250"),
    ("next", *BOARD),
    ("next", *SLIPPED),
    ("next", *BOARD, "--sigma", "5", "--marks", "form.toml"),
    ("practice", "reveal", ".", TOML),
    ("reach", INI),
    ("read",),
    ("report", *BOARD, "-o", "report.html"),
    ("settings", TOML),
    ("recover", TOML, "--touch=-900,250:-895.4,253.7", "--touch=900,-250:897.9,-246.5"),
    ("recover", TOML, "--touch=0,0:5,5"),
)

HOME = (
    "[mark.left]\nplace = [-900.0, 250.0]\nchains = [876.851, 2387.777]\n"
    "[mark.right]\nplace = [900.0, -250.0]\nchains = [2589.437, 1315.760]\n"
)

FIT = {
    **{"machine": "machine.toml", "effects": ["chain_pitch"], "marks": [], "distances": []},
    **{"before_mm": 5.0, "rms_mm": 0.5, "left_out_mm": None},
    "numbers": [
        {"name": "motor_gap", "unit": "mm", "value": 2978.0, "low": 2977.0, "high": 2979.0}
    ],
    **{"unknowns": ["motor_gap"], "covariance": [[0.25]]},
}


TELEMETRY = (
    b"[Telemetry|error:0,0,0|dry:0|tick:1|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual"
    b"|events:0,0,0,0|last:none,0|slips:0,1|slipped:right,-31,12,341]\r\n"
)


class Board(NumbersMachine):
    """A machine that reports, lists numbers, and tells how it is doing."""

    def __init__(self, _path):
        super().__init__()

    def answer(self, line):
        return [TELEMETRY.decode().strip()] if line == "B30" else super().answer(line)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A folder with the files of the questions, and a machine on its line."""
    good = BOARD[1].read_text()
    reading = next(line for line in good.splitlines() if line.startswith("measured"))
    first = reading.split("[")[1].split(",")[0]
    wrong = reading.replace(first, str(float(first) + 40))
    (tmp_path / "slipped.toml").write_text(good.replace(reading, wrong, 1))
    (tmp_path / "spans.toml").write_text(
        'frame = "machine"\n[[mark]]\nname = "a"\ntarget = [0, 0]\n[[mark]]\nname = "b"\n'
        'target = [500, 0]\n[[distance]]\nbetween = ["a", "b"]\nmm = 501.5\n'
    )
    (tmp_path / "practice.json").write_text(Secret(3).text)
    (tmp_path / "kept.toml").write_text(TOML.read_text())
    (tmp_path / "home.toml").write_text(HOME)
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept/machine.toml").write_text(TOML.read_text())
    (tmp_path / "kept/check.toml").write_text(
        'frame = "machine"\ncut_with = "machine.toml"\n'
        '[[mark]]\nname = "1"\ntarget = [-900, 250]\nmeasured = [-900, 250]\n'
        '[[mark]]\nname = "2"\ntarget = [900, -250]\nmeasured = [905, -250]\n'
    )
    append(tmp_path / "kept", "fit", {**FIT, "settings": TOML.read_text()})
    monkeypatch.setattr(read_command, "port_for", str)
    monkeypatch.setattr(read_command, "SerialPort", Board)
    monkeypatch.chdir(tmp_path)


def test_plumb_read_says_which_chain_may_have_slipped(monkeypatch, capsys):
    assert main(["read"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Look at the right chain" in said and "near x -31, y 12 mm, 5 minutes ago" in said
    assert main(["read", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["suspicion"].startswith("Look at the right chain")
    for silent in (b"", TELEMETRY.replace(b"right,-31,12,341", b"none,0,0,0")):
        monkeypatch.setattr(f"{__name__}.TELEMETRY", silent)
        assert main(["read", "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["suspicion"] is None


def validator_of(name):
    """A check of a command's answers against the schema."""
    return Validator({**SCHEMA, "anyOf": [{"$ref": f"#/$defs/{name}"}]})


def spoiled(answer):
    """The answer without a key, with another key, and with a value of another type."""
    yield {**answer, "more": 1}
    for key in answer:
        yield {**answer, key: [[{}]]}
        if key != "auto":
            yield {other: answer[other] for other in answer if other != key}


def test_the_schema_is_a_schema():
    Validator.check_schema(SCHEMA)


# They write a file, serve, or talk; the tests of their rooms hold their answers to the schema.
ASKED_ELSEWHERE = {"send", "resume"}


def test_every_command_with_json_is_asked():
    subparsers = build_parser()._subparsers._group_actions[0].choices
    answering = {name for name in COMMANDS if "--json" in subparsers[name].format_help()}
    assert {question[0] for question in QUESTIONS} | ASKED_ELSEWHERE == answering
    assert {each["$ref"] for each in SCHEMA["anyOf"]} == {
        f"#/$defs/{name}" for name in answering | {"refusal"}
    }


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question[0])
def test_the_answer_fits_the_schema(question, ask):
    code, answer = ask(*question)
    assert code in (0, 1)
    validator_of(question[0]).validate(answer)
    Validator(SCHEMA).validate(answer)
    for bad in spoiled(answer):
        assert not validator_of(question[0]).is_valid(bad), bad.keys()


def test_a_refusal_fits_the_schema(run):
    code, said, _ = run("compare", "none.ini", "none.toml", "--json")
    assert code == 2
    validator_of("refusal").validate(json.loads(said))
    assert not validator_of("refusal").is_valid({"error": None})
    assert not validator_of("compare").is_valid(json.loads(said))


def test_effects_are_listed_in_the_order_they_were_added(ask):
    """The steps of the fit do not share a key with the steps that the owner takes."""
    _, answer = ask("add", *BOARD, "--effect", "chain_pitch", "chain_stretch", *CLIENT)
    assert [step["effect"] for step in answer["by_effect"]] == ["chain_pitch", "chain_stretch"]
    assert answer["steps"] and all(isinstance(step, str) for step in answer["steps"])
