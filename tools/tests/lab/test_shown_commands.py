"""The command that a screen shows does what the screen does, with every choice made there."""

import json
import re
import shlex
import shutil
import tomllib

import pytest
from folder import (
    EXAMPLE,
    asked,
    choose,
    compared,
    finished,
    got,
    type_in,
    with_marks,
    write_correction,
)
from plumb.cli.main import build_parser, main
from plumb.words.verdict import odds_words

# A gap that is wrong, so that it changes every fit; a ring that no fit moves unless it is known.
KNOWN = {
    "motor_gap": {"value": 2984.0, "sigma": 0.5},
    "rotation_radius": {"value": 141.0, "sigma": 1.0},
    "chain_pitch.left": {"value": 0.004, "sigma": 0.0002},
}


@pytest.fixture
def client(here):
    with with_marks(here) as client:
        yield client


def said_by(command, capsys):
    """The answer in the last line of a command."""
    capsys.readouterr()
    assert main([*shlex.split(command.splitlines()[-1])[1:], "--json"]) in (0, 1)
    return json.loads(capsys.readouterr().out)


BENCHES = [
    ({"effects": []}, {}),
    ({"effects": ["chain_stretch"]}, KNOWN),
    ({"effects": ["chain_pitch", "chain_stretch"], "held": {"chain_pitch.left": 0.002}}, KNOWN),
]


@pytest.mark.parametrize(("bench", "known"), BENCHES, ids=["frame", "stretch", "held"])
def test_the_bench(client, tmp_path, capsys, bench, known):
    choose(client, known=known)
    shown = got(client.post("/api/bench/fit", json=bench))
    got(client.post("/api/bench/machine", json={**bench, "read": ""}))
    here = tomllib.loads((tmp_path / "new.toml").read_text())
    again = got(client.post("/api/bench/machine", json={**bench, "read": ""}), 409)
    assert "new.toml" in again["error"]
    (tmp_path / "new.toml").unlink()
    said = said_by(shown["command"], capsys)
    assert tomllib.loads((tmp_path / "new.toml").read_text()) == here
    assert said["after"]["fit_rms_mm"] == pytest.approx(shown["fit_rms"], rel=2e-5)
    assert said["after"]["left_out_rms_mm"] == pytest.approx(shown["left_out_rms"], rel=2e-5)
    radius = {each["name"] for each in said["parameters"]} & {"rotation_radius"}
    assert bool(radius) == bool(known)


def test_the_verdict_and_the_next_measurement(client, capsys):
    choose(client, known=KNOWN)
    shown = finished(client, "verdict")
    said = said_by(shown["command"], capsys)
    assert said["sentence"] == shown["verdict"]["sentence"]
    odds = [odds_words(each["share"]) for each in said["explanations"]]
    assert odds == [card["odds"] for card in shown["verdict"]["cards"]]
    assert got(client.get("/api/known"))["command"] == shown["command"]
    words = shlex.split(got(client.get("/api/next"))["command"])
    assert ["diagnose", *words[2:]] == shlex.split(shown["command"])[1:]


@pytest.mark.parametrize(
    "accepted",
    [
        ["motor_height", "chain_stretch.compliance"],
        ["motor_gap", "motor_height", "motor_center_x", "rotation_radius"],
        [],
    ],
)
def test_the_correction(client, tmp_path, capsys, accepted):
    choose(client, known=KNOWN, accepted=accepted)
    shown = finished(client, "correction")
    offered = [number["name"] for number in shown["correction"]["numbers"]]
    if not accepted:
        choose(client, accepted=offered)
        shown = finished(client, "correction")
    assert {*accepted} <= {*offered}
    written = write_correction(client)["files"]
    assert shown["file"] == written[0] == "machine.toml"
    here = {name: (tmp_path / name).read_text() for name in written}
    for name in written:
        (tmp_path / name).unlink()
    said = said_by(shown["command"], capsys)
    assert said["after"]["fit_rms_mm"] == pytest.approx(shown["correction"]["accepted"]["fit_rms"])
    assert sorted(said["written"]) == sorted(written)
    there = tomllib.loads((tmp_path / "machine.toml").read_text())
    assert there == tomllib.loads(here.pop("machine.toml"))
    for name, text in here.items():
        assert (tmp_path / name).read_text() == text, name


def test_the_readings(client, capsys, tmp_path):
    choose(client, known=KNOWN)
    arrows, doubts = got(client.get("/api/readings"))["command"].splitlines()
    assert said_by(arrows, capsys)["rms_mm"] == pytest.approx(compared(tmp_path).rms)
    assert doubts == finished(client, "verdict")["command"]


def in_inches(text):
    """A form as it would have been typed in inches."""
    numbers = re.sub(r"-?\d+\.?\d*(?=[],])", lambda m: f"{float(m[0]) / 25.4:.4f}", text)
    return f'units = "inch"\n{numbers}'


@pytest.mark.parametrize(("units", "typed"), [("inch", "mm"), ("mm", "inch")])
def test_every_command_is_understood_and_shows_the_chosen_unit(client, tmp_path, units, typed):
    if typed == "inch":
        (tmp_path / "marks.toml").write_text(in_inches((tmp_path / "marks.toml").read_text()))
    choose(client, units=units, known=KNOWN)
    marks = ("verdict", "next", "correction", "readings")
    of_marks = [got(client.get(f"/api/{path}"))["command"] for path in marks]
    bench = got(client.post("/api/bench/fit", json={"effects": ["chain_stretch"]}))
    of_marks.append(bench["command"])
    others = [got(client.get(f"/api/{path}"))["command"] for path in ("reach",)]
    of_marks = "\n".join(of_marks).splitlines()
    for command in "\n".join([*of_marks, *others]).splitlines():
        asked = build_parser().parse_args(shlex.split(command)[1:])
        assert (asked.units or (typed if command in of_marks else "mm")) == units, command


def test_the_check(client):
    fitted = ["groundcontrol.ini", "marks.toml", "--effect", "chain_pitch", "-o", "machine.toml"]
    assert main(["add", *fitted]) == 0
    choose(client, settings="machine.toml", units="inch")
    got(client.post("/api/rounds/proof"))
    type_in(client, "proof.toml", (0, 4.0))
    shown = got(client.get("/api/proof"))
    assert shown["checked"]["state"] == "sheet_moved"
    assert shown["command"] == "plumb calibrate machine.toml proof.toml --units inch"
    assert main(shlex.split(shown["command"])[1:]) == 1


# Marks by hand: in no order, and with more decimals than a program has.
PLACES = [[300.12345, -20.0], [-900.0, 400.0], [899.99, 420.5], [0.1, -400.0]]
FIRST, NEXT, ANOTHER_SHEET = ("", False), ("-2", False), ("-2", True)
WAYS = [("nine", *FIRST), ("fifteen", *NEXT), ("own", *ANOTHER_SHEET)]


@pytest.fixture
def folder(here):
    for name in ("groundcontrol.ini", "machine.toml"):
        shutil.copy(EXAMPLE / name, here)
    return here


def lab(folder, **choices):
    (folder / "lab.json").write_text(json.dumps({"settings": "groundcontrol.ini", **choices}))
    return asked(folder)


def run(command):
    """Run a line that a screen shows."""
    assert main(shlex.split(command)[1:]) == 0, command


@pytest.mark.parametrize(("layout", "number", "new_sheet"), WAYS)
def test_each_way_to_measure(folder, layout, number, new_sheet):
    choices = {"layout": layout, "planned": PLACES, "new_sheet": new_sheet}
    if number:
        shutil.copy(EXAMPLE / "marks.toml", folder)
        choices["marks"] = ["marks.toml"]
    client = lab(folder, **choices)
    planned = got(client.post("/api/preview", json={"layout": layout, "places": PLACES}))
    shown = got(client.get("/api/rounds/marks"))
    names = [shown["form"], shown["program"]]
    assert names == [f"marks{number}.toml", f"grid{number}.nc"]
    made = shown["command"].splitlines()[0]
    assert made in planned["command"].splitlines()
    got(client.post("/api/rounds/marks"))
    here = {name: (folder / name).read_text() for name in names}
    assert ("new_sheet = true" in here[names[0]]) is new_sheet
    for name in names:
        (folder / name).unlink()
    run(made)
    assert {name: (folder / name).read_text() for name in names} == here


def test_the_command_replaces_a_form_without_readings_as_the_lab_does(folder):
    client = lab(folder, layout="nine")
    got(client.post("/api/rounds/marks"))
    client = lab(folder, layout="fifteen")
    run(got(client.get("/api/rounds/marks"))["command"].splitlines()[0])
    assert got(client.get("/api/rounds/marks"))["is_saved"]
