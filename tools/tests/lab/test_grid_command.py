"""The files that the lab writes for marks to be cut are those of the command that it shows."""

import json
import shlex
import shutil

import pytest
from folder import EXAMPLE, asked, got
from plumb.cli.main import main

# Marks by hand: in no order, and with more decimals than a program has.
PLACES = [[300.12345, -20.0], [-900.0, 400.0], [899.99, 420.5], [0.1, -400.0]]
WAYS = ["nine", "fifteen", "twenty-five", "distances", "own"]
ROUNDS = {"first": ("", False), "next": ("-2", False), "another-sheet": ("-2", True)}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("groundcontrol.ini", "machine.toml"):
        shutil.copy(EXAMPLE / name, tmp_path)
    return tmp_path


def lab(folder, **choices):
    (folder / "lab.json").write_text(json.dumps({"settings": "groundcontrol.ini", **choices}))
    return asked(folder)


def run(command):
    """Run a line that a screen shows."""
    assert main(shlex.split(command)[1:]) == 0, command


@pytest.mark.parametrize("number, new_sheet", ROUNDS.values(), ids=ROUNDS)
@pytest.mark.parametrize("layout", WAYS)
def test_each_way_to_measure(folder, layout, number, new_sheet):
    choices = {"layout": layout, "planned": PLACES, "new_sheet": new_sheet}
    if number:
        shutil.copy(EXAMPLE / "marks.toml", folder)
        choices["marks"] = ["marks.toml"]
    client = lab(folder, **choices)
    planned = got(client.post("/api/preview", json={"layout": layout, "places": PLACES}))
    shown = got(client.get("/api/grid"))
    names = [shown["form"], shown["program"]]
    assert names == [f"marks{number}.toml", f"grid{number}.nc"]
    made = shown["command"].splitlines()[0]
    assert made in planned["command"].splitlines()
    got(client.post("/api/grid"))
    here = {name: (folder / name).read_text() for name in names}
    assert ("new_sheet = true" in here[names[0]]) is new_sheet
    assert ("[[distance]]" in here[names[0]]) is (layout == "distances")
    for name in names:
        (folder / name).unlink()
    run(made)
    assert {name: (folder / name).read_text() for name in names} == here


def test_the_command_replaces_a_form_without_readings_as_the_lab_does(folder):
    client = lab(folder, layout="nine")
    got(client.post("/api/grid"))
    client = lab(folder, layout="fifteen")
    run(got(client.get("/api/grid"))["command"].splitlines()[0])
    assert got(client.get("/api/grid"))["is_saved"]


def test_check_marks(folder):
    shutil.copy(EXAMPLE / "marks.toml", folder)
    client = lab(folder, settings="machine.toml", marks=["marks.toml"])
    made, *_ = got(client.get("/api/check"))["command"].splitlines()
    got(client.post("/api/check"))
    here = {name: (folder / name).read_text() for name in ("check.toml", "check.nc")}
    for name in here:
        (folder / name).unlink()
    run(made)
    assert {name: (folder / name).read_text() for name in here} == here
