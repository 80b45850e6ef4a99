"""The output of --json fits the schema of the answers."""

import json

import plumb.cli.read as read_command
import pytest
from example_machine import EXAMPLE, INI, TOML
from jsonschema import Draft202012Validator as Validator
from numbers_machine import NumbersMachine
from plumb.cli.answers import schema
from plumb.cli.main import COMMANDS, build_parser, main
from plumb.marks.form import marks_toml
from plumb.marks.read import Distance, Mark, Measurements
from plumb.vm.practice import Secret

SCHEMA = schema()
BOARD = (INI, EXAMPLE / "marks.toml")
SLIPPED = (INI, "slipped.toml")  # a reading of BOARD is wrong by 40 mm
SPANS = (INI, "spans.toml")
GRID = ("--preset", "nine")
CLIENT = ("--client", "groundcontrol", "-o", "new.toml")
# Answers of a shape that no other test asks for; the fixture `ask` holds each to the schema.
QUESTIONS = (
    ("add", *SLIPPED, "--effect", "auto"),
    ("compare", *SPANS),
    ("effects",),
    ("grid", *GRID, "--output", "grid.nc", "--marks", "form.toml"),
    ("recover", "kept.toml", "--keep=low=0,-400", "-o", "hole.nc"),
    ("recover", "kept.toml", "--at", "left", "--touch=right:903,-250"),
    ("next", *SLIPPED),
    ("practice", "reveal", ".", TOML),
    ("reach", INI),
    ("read",),
    ("report", *BOARD, "-o", "report.html"),
    ("settings", TOML),
)
HOME = (
    "[mark.left]\nplace = [-900.0, 250.0]\nchains = [876.851, 2387.777]\n"
    "[mark.right]\nplace = [900.0, -250.0]\nchains = [2589.437, 1315.760]\n"
)

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
def folder(here, monkeypatch):
    """A folder with the files of the questions, and a machine on its line."""
    good = BOARD[1].read_text()
    reading = next(line for line in good.splitlines() if line.startswith("measured"))
    first = reading.split("[")[1].split(",")[0]
    wrong = reading.replace(first, str(float(first) + 40))
    (here / "slipped.toml").write_text(good.replace(reading, wrong, 1))
    ends = Mark("a", (0.0, 0.0)), Mark("b", (500.0, 0.0))
    spans = Measurements(ends, (Distance(("a", "b"), 501.5),))
    (here / "spans.toml").write_text(marks_toml(spans))
    (here / "practice.json").write_text(Secret(3).text)
    (here / "kept.toml").write_text(TOML.read_text())
    (here / "home.toml").write_text(HOME)
    monkeypatch.setattr(read_command, "port_for", str)
    monkeypatch.setattr(read_command, "SerialPort", Board)


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


def test_the_schema_leaves_no_key_and_no_type_open():
    Validator.check_schema(SCHEMA)
    objects = [each for each in SCHEMA["$defs"].values() if "properties" in each]
    assert len(objects) > 60
    for each in objects:
        assert each["additionalProperties"] is False
        assert {*each["properties"]} - {*each["required"]} <= {"auto"}
        shown = {"type", "$ref", "anyOf", "const", "enum"}
        assert all(shown & {*value} for value in each["properties"].values())


ASKED_ELSEWHERE = {"calibrate", "check", "diagnose", "forward", "inverse"}
ASKED_ELSEWHERE |= {"send", "resume"}


def test_every_command_with_json_is_asked():
    subparsers = build_parser()._subparsers._group_actions[0].choices
    answering = {name for name in COMMANDS if "--json" in subparsers[name].format_help()}
    assert {question[0] for question in QUESTIONS} | ASKED_ELSEWHERE == answering
    assert {each["$ref"] for each in SCHEMA["anyOf"]} == {
        f"#/$defs/{name}" for name in answering | {"refusal"}
    }


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question[0])
def test_the_answer_fits_the_schema(question, ask):
    assert ask(*question)[0] in (0, 1)


def test_a_refusal_fits_the_schema(run):
    code, said, _ = run("compare", "none.ini", "none.toml", "--json")
    assert code == 2
    validator_of("refusal").validate(json.loads(said))
    assert not validator_of("refusal").is_valid({"error": None})
    assert not validator_of("compare").is_valid(json.loads(said))


def test_effects_are_listed_in_the_order_they_were_added(ask):
    """The steps of the fit do not share a key with the steps that the owner takes."""
    _, answer = ask("add", *BOARD, "--effect", "chain_pitch", "chain_stretch", "--patch", *CLIENT)
    assert [step["effect"] for step in answer["by_effect"]] == ["chain_pitch", "chain_stretch"]
    assert answer["steps"] and all(isinstance(step, str) for step in answer["steps"])
