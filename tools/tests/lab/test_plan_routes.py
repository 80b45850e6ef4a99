"""Before and at the cut: what is known, the reach, what a plan could tell, program and form."""

import json
import tomllib
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import plumb.lab.routes.plan as plan_routes
import pytest
from folder import EXAMPLE, asked, choose, got
from plumb.bench.causes import MAKER
from plumb.cli.main import main
from plumb.fit.compare import best_pose
from plumb.fit.expected import expected_error
from plumb.fit.observations import rms
from plumb.fit.problem import PRIORS
from plumb.grid import Grid, GridError, PlainMachine, program
from plumb.lab.known import stated
from plumb.lab.project import Choices, Number, Project
from plumb.lab.rounds import in_turn, inputs_of, planned
from plumb.line.sender import cleaned
from plumb.model.predict import lengths, places
from plumb.plan.preview import as_read


def test_without_settings_a_line_says_what_is_missing(tmp_path):
    with asked(tmp_path) as client:
        for path in ("known", "reach", "layouts", "grid"):
            assert "open the settings" in got(client.get(f"/api/{path}"), 422)["error"]


def test_known_numbers_are_asked_as_they_are_measured(client):
    known = {number["name"]: number for number in got(client.get("/api/known"))["numbers"]}
    frame = got(client.get("/api/project"))["machine"]["frame"]
    height = known["motor_height"]
    edge = got(client.get("/api/project"))["machine"]["sheet"][1] / 2
    assert height["believed"] == pytest.approx(frame["motor_height"] - edge)
    for name in ("motor_gap", "motor_height", "rotation_radius", "sled_weight"):
        number = known[name]
        value = (number["believed"] - number["zero"]) * number["scale"]
        assert value == pytest.approx(frame[name])
    links = known["chain_pitch.left"]
    assert (635.635 - links["zero"]) * links["scale"] == pytest.approx(0.001)


def test_what_is_known_goes_into_the_fit(tmp_path):
    choices = Choices(
        known={
            "motor_gap": Number(value=2980.0, sigma=1.0),
            "rotation_radius": Number(value=140.0, sigma=0.5),
            "sled_weight": Number(value=100.0, sigma=0.0),
        }
    )
    statements = stated(choices)
    assert {check.name: (check.value, check.sigma) for check in statements.checked} == {
        "motor_gap": (2980.0, 1.0),
        "rotation_radius": (140.0, 0.5),
    }
    assert statements.priors == {**PRIORS, "rotation_radius": 5.0}


def test_the_verdict_goes_by_what_is_known(client, tmp_path):
    (tmp_path / "marks.toml").write_bytes((EXAMPLE / "marks.toml").read_bytes())
    choose(client, marks=["marks.toml"], known={"motor_gap": {"value": 2990.0, "sigma": 0.5}})
    inputs = inputs_of(Project(tmp_path))
    assert [(check.name, check.value) for check in inputs.checked] == [("motor_gap", 2990.0)]


def test_reach_says_what_the_command_says_and_how_far_off_is_normal(
    client, tmp_path, capsys, monkeypatch
):
    answer = got(client.get("/api/reach"))
    assert len(answer["verdicts"]) == answer["columns"] * answer["rows"]
    assert main(["reach", str(tmp_path / "groundcontrol.ini")]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert answer["conclusion"] in printed and answer["normal"] in printed
    usable = answer["verdicts"].count(0) / len(answer["verdicts"])
    assert usable == pytest.approx(float(answer["shares"]["usable"].rstrip(" %")) / 100, abs=0.05)
    expected = answer["expected"]
    assert 1 < expected["among_marks_mm"] < expected["whole_mm"] < 50
    choose(client, known={"motor_gap": {"value": 2990.0, "sigma": 0.5}}, units="inch")
    better = got(client.get("/api/reach"))
    assert better["expected"]["among_marks_mm"] < expected["among_marks_mm"]
    assert "--prior motor_gap=0.5" in better["command"]
    monkeypatch.chdir(tmp_path)
    assert main(better["command"].split()[1:]) == 0
    assert better["normal"] in " ".join(capsys.readouterr().out.split())
    assert main([*better["command"].split()[1:], "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["expected"] == pytest.approx(better["expected"])


def test_the_expected_error_is_what_wrong_numbers_make():
    """Machines drawn from the priors put their marks that far off."""
    priors = {"motor_gap": 3.0, "motor_height": 4.0}
    expected = expected_error(MAKER, {**priors, "motor_center_x": 0.0, "sheet_rotation": 0.0})
    x = np.linspace(-1119.2, 1119.2, 7)
    y = np.linspace(509.6, -509.6, 5)
    targets = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    chains, _ = lengths(MAKER, targets)
    source = np.random.default_rng(5)
    whole, shape = [], []
    for gap, height in source.standard_normal((400, 2)):
        true = replace(
            MAKER,
            motor_gap=MAKER.motor_gap + 3.0 * gap,
            motor_height=MAKER.motor_height + 4.0 * height,
        )
        moved, _ = places(true, chains)
        whole.append(rms(moved - targets) ** 2)
        shape.append(rms(best_pose(targets, moved).errors) ** 2)
    assert expected.frame == pytest.approx(np.sqrt(np.mean(whole)), rel=0.1)
    assert expected.shape == pytest.approx(np.sqrt(np.mean(shape)), rel=0.1)


def test_layouts_have_their_marks_and_minutes(client):
    layouts = {layout["id"]: layout for layout in got(client.get("/api/layouts"))}
    assert [layouts[name]["marks"] for name in ("nine", "fifteen", "twenty-five")] == [9, 15, 25]
    minutes = [layouts[name]["minutes"] for name in ("nine", "distances", "fifteen", "twenty-five")]
    assert minutes == sorted(minutes)
    assert layouts["distances"]["distances"] == len(layouts["distances"]["spans"]) == 12
    assert layouts["nine"]["places"][0][0] < 0 < layouts["nine"]["places"][0][1]


def test_a_plan_says_which_causes_its_marks_would_show(client):
    answer = got(client.post("/api/preview", json={"layout": "fifteen"}))
    seen = [effect["name"] for effect in answer["effects"] if effect["is_seen"]]
    named = [effect for effect in answer["effects"] if effect["is_seen"] and effect["is_distinct"]]
    assert answer["marks"] == 15 and answer["trouble"] == ""
    assert 0 < len(named) == answer["named"] <= len(seen) == answer["seen"]
    assert answer["seen"] < len(answer["effects"])
    assert "motor_level" not in seen, "the frame takes it up"


def test_more_marks_tell_more(client):
    few, many = (
        got(client.post("/api/preview", json={"layout": layout}))
        for layout in ("nine", "twenty-five")
    )
    assert many["seen"] > few["seen"] and many["minutes"] > few["minutes"]
    assert many["named"] >= few["named"]
    places = [[-900, 400], [900, 400], [0, -400]]
    mine = got(client.post("/api/preview", json={"layout": "own", "places": places}))
    assert mine["marks"] == 3 and mine["named"] <= few["named"]


@pytest.mark.parametrize("fineness", [0.25, 1.0, 3.0])
def test_the_plan_that_names_most_causes_is_recommended(client, fineness):
    choose(client, fineness=fineness)
    advice = got(client.get("/api/layouts/advice"))
    plans = {
        each["id"]: got(client.post("/api/preview", json={"layout": each["id"]}))
        for each in got(client.get("/api/layouts"))
    }
    worth = {name: (plan["named"], plan["seen"], -plan["minutes"]) for name, plan in plans.items()}
    assert worth[advice["layout"]] == max(worth.values())
    best, few = plans[advice["layout"]], plans["nine"]
    said = f"{best['seen']} would show and {best['named']} could be named"
    assert (said in advice["sentence"]) == (best["seen"] > 0)
    instead = f"instead of {few['seen']} and {few['named']} with nine marks"
    assert (instead in advice["sentence"]) == (advice["layout"] != "nine")
    for plan in plans.values():
        assert plan["seen"] == sum(each["is_seen"] for each in plan["effects"])


@pytest.mark.parametrize(
    ("worth", "best"),
    [
        ({"nine": (1, 9), "fifteen": (2, 3), "twenty-five": (2, 3)}, "fifteen"),  # the quicker
        ({"nine": (1, 9), "fifteen": (2, 3), "twenty-five": (2, 4)}, "twenty-five"),
        ({"nine": (2, 4), "fifteen": (1, 9), "twenty-five": (2, 4)}, "nine"),
        ({}, "nine"),  # nothing shows with any
    ],
)
def test_causes_that_are_named_count_before_those_that_show(client, monkeypatch, worth, best):
    def looked(settings, choices, request, *, is_quick):
        named, seen = worth.get(request.layout, (0, 0))
        return SimpleNamespace(named=named, seen=seen, effects=range(13), sigma=0.5)

    monkeypatch.setattr(plan_routes, "_looked", looked)
    assert got(client.get("/api/layouts/advice"))["layout"] == best


def test_what_cannot_be_planned_is_said(client):
    places = [[-900, 400], [5000, 400], [0, -400]]
    asked = {"layout": "own", "places": places}
    answer = client.post("/api/preview", json=asked)
    assert "outside the sheet" in answer.json().get("trouble", "") + answer.json().get("error", "")
    two = got(client.post("/api/preview", json={"layout": "own", "places": places[:1]}), 422)
    assert "too few marks" in two["error"]


def test_additions_come_best_first(client):
    before = got(client.post("/api/preview", json={"layout": "nine"}))
    best, *_ = got(client.post("/api/preview/additions", json={"layout": "nine"}))
    assert best["named"] > before["named"] and best["do"] and best["minutes"] > 0


def test_places_are_taken_in_bands_there_and_back():
    assert in_turn([(0, 0), (500, 400), (-500, 420), (300, -20), (-300, 10)]) == [
        (-500, 420),
        (500, 400),
        (300, -20),
        (0, 0),
        (-300, 10),
    ]


def test_places_of_a_grid_are_checked_and_cut_in_their_order():
    grid = Grid(repeats=False, places=((-900.0, 300.0), (800.0, -200.0)))
    text = program(grid, PlainMachine())
    assert "(pattern: places, 2 marks with repeats)" in text
    assert text.index("G1 X-900 Y300 F700") < text.index("G1 X800 Y-200 F700")
    with pytest.raises(GridError, match="outside the sheet"):
        program(grid._replace(places=((0.0, 700.0),)), PlainMachine())


def test_program_and_form_are_written_and_no_reading_is_overwritten(client, tmp_path):
    before = got(client.get("/api/grid"))
    assert not before["is_saved"] and before["trouble"] == ""
    assert (before["form"], before["program"]) == ("marks.toml", "grid.nc")
    lines = list(cleaned(before["text"].splitlines()))
    for mark in before["marks"]:
        x, y = mark["place"]
        assert lines[mark["lines"] - 3] == f"G1 X{x:g} Y{y:g} F700"
        assert lines[mark["lines"] - 2].startswith("G1 Z-0.5")
    assert [mark["name"] for mark in before["marks"]] == list("123654789")
    got(client.post("/api/grid"))
    after = got(client.get("/api/grid"))
    assert after["is_saved"] and after["waits"] == 9
    form_line = "(form: marks.toml)\n"
    assert (tmp_path / "grid.nc").read_text().replace(form_line, "") == after["text"]
    form = tomllib.loads((tmp_path / "marks.toml").read_text())
    assert form["cut_with"] == "groundcontrol.ini" and len(form["mark"]) == 9
    choose(client, layout="fifteen")
    assert got(client.get("/api/grid"))["form"] == "marks.toml"  # nothing was read yet
    text = (tmp_path / "marks.toml").read_text()
    read = text.replace("# measured = [ , ]", "measured = [101.0, 102.0]", 1)
    (tmp_path / "marks.toml").write_text(read)
    got(client.post("/api/grid"))
    assert (tmp_path / "marks.toml").read_text() == read
    form = tomllib.loads((tmp_path / "marks-2.toml").read_text())
    assert len(form["mark"]) == 15 and (tmp_path / "grid-2.nc").exists()


def test_a_form_of_distances_names_them(client, tmp_path):
    choose(client, layout="distances")
    got(client.post("/api/grid"))
    text = (tmp_path / "marks.toml").read_text()
    assert text.count("# [[distance]]") == 12 and '# between = ["1", "9"]' in text
    plan = planned(MAKER, "distances", ())
    taped = {each.between: each.length for each in as_read(plan.touches, plan.spans).distances}
    assert taped["1", "3"] == pytest.approx(2238.4)


def test_a_grid_is_not_cut_without_a_machine(client, tmp_path):
    assert "connect it first" in got(client.post("/api/grid/cut"), 422)["error"]
    assert (
        "of a virtual machine"
        in got(client.post("/api/machine/readings", json={"form": "marks.toml"}), 422)["error"]
    )
