"""Tests of numbers that are measured by hand: the questions, and absurd answers."""

import math

import pytest
from folder import choose, got, with_marks
from plumb.fit.inputs import readings
from plumb.hidden import MAKER
from plumb.plan.proposal import FRAME_CHECKS, effect_checks
from plumb.settings import GRAVITY
from plumb.vm.garage import true_value

WEIGHT = 98.1  # [N]
EACH = readings(MAKER, WEIGHT)


def shown(client):
    return {number["name"]: number for number in got(client.get("/api/known"))["numbers"]}


def test_the_page_asks_for_each_number_that_can_be_measured_directly(client):
    parts = {
        f"{effect}.{part}" for effect, check in effect_checks().items() for part in check.sigmas
    }
    assert {*shown(client)} == {*FRAME_CHECKS, "sled_weight", *parts}
    assert {*EACH} == {*shown(client)}


# What is read, the number by the words of its check, and the check's steps.
READ = [
    ("chain_pitch.left", 635.635, (635.635 - 635) / 635),
    ("chain_zero.right", -1.5, -1.5),
    ("chain_sag.weight_ratio_squared", 420, (0.420 / 3000 / 10.0) ** 2 / 24),
    ("chain_stretch.compliance", 1.5, 1.5 / 3000 / 98.1),
    ("motor_level.height_difference", -4, -4),
    ("frame_flex.inward", 0.4, 0.4 / 50),
    ("frame_flex.downward", 1.0, 1.0 / 50),
    ("chain_plane.gap_squared", 40, 1600),
    ("frame_lean.tangent_squared", 15, math.tan(math.radians(15)) ** 2),
    ("sled_swing.right", -2, -2),
    ("sled_swing.up", 2, 2),
    ("tape_scale.strain", 0.3, (1000.3 - 1000) / 1000),
]


@pytest.mark.parametrize(("name", "read", "value"), READ)
def test_a_number_follows_from_its_readings(name, read, value):
    assert EACH[name].value(read) == pytest.approx(value, rel=1e-9)
    assert EACH[name].read(value) == pytest.approx(read, rel=1e-9)


def test_the_angle_of_a_sheet_follows_from_how_much_its_diagonals_differ():
    width, height = MAKER.sheet
    angle = 0.002
    long, short = (math.hypot(width + sign * height * angle, height) for sign in (1, -1))
    by_words = (long**2 - short**2) / (4 * width * height)
    assert EACH["sheet_skew.angle"].value(long - short) == pytest.approx(by_words, rel=1e-4)


@pytest.mark.parametrize("name", [name for name in EACH if "." in name])
def test_a_careful_reading_is_as_sure_as_its_check(name):
    """At the size that is met in workshops."""
    effect, _, part = name.partition(".")
    reading, sigma = EACH[name], effect_checks()[effect].sigmas[part]
    usual = next(read for each, read, _ in [*READ, *MORE] if each == name)
    spread = reading.value(usual + reading.usual) - reading.value(usual)
    assert spread == pytest.approx(sigma, rel=0.2)


MORE = [("chain_pitch.right", 635.0, 0), ("chain_zero.left", 0.0, 0), ("sheet_skew.angle", 4.0, 0)]


def test_a_chain_is_weighed_against_the_sled_that_the_owner_weighed(client):
    name = "chain_sag.weight_ratio_squared"
    before = shown(client)[name]
    choose(client, known={"sled_weight": {"value": 2 * WEIGHT, "sigma": 2.0}})
    after = shown(client)[name]
    assert after["by"] == "sled_weight"
    per_gram = math.sqrt(24 * after["factor"])
    assert per_gram == pytest.approx(1 / 3e6 / 20.0)
    assert before["factor"] != after["factor"]


def test_a_virtual_machine_is_measured_by_hand_as_well_as_a_careful_owner_can(client):
    body = {"name": "motor_gap"}
    refused = client.post("/api/known/measured", json=body)
    assert refused.status_code == 422 and "type what you measured" in refused.json()["error"]
    got(client.post("/api/machine/virtual", json={"hides": "nothing"}))
    asked = {**shown(client)}
    owner = client.app.app.state.line.virtual
    for name, number in asked.items():
        project = got(client.post("/api/known/measured", json={"name": name}))
        measured = project["choices"]["known"][name]
        true = true_value(owner.garage, name)
        assert abs(measured["value"] - true) < 5 * measured["sigma"]
        if number["curve"] == "straight":
            usual = number["usual"] * abs(number["factor"])
            assert measured["sigma"] == pytest.approx(usual, rel=0.1)
    unknown = client.post("/api/known/measured", json={"name": "sled_colour"})
    assert unknown.status_code == 422
    client.post("/api/machine/disconnect")


MARKS = "marks.toml"
ABSURD = [
    ("motor_gap", 298.0, 1.0, "298.0 mm is far from the 2978.4 mm of the settings"),
    # Read from the sheet's top edge up to the motors.
    ("motor_height", 463.0, 1.0, "-146.6 mm is far from the 463.0 mm of the settings"),
    ("sled_weight", GRAVITY, 2.0, "1.0 kg is far from the 10.0 kg of the settings"),
    ("tape_scale.strain", 0.5, 0.001, "500.00 mm cannot be: real machines have -3.00 mm to 3"),
    ("frame_lean.tangent_squared", 1.0, 0.001, "45.0 degrees cannot be: real machines have"),
]


@pytest.fixture
def client(tmp_path):
    with with_marks(tmp_path) as client:
        yield client


def state(client, **known):
    """State numbers, each with how far it may be off; what is typed for each is refused by."""
    stated = {name: {"value": value, "sigma": sigma} for name, (value, sigma) in known.items()}
    choose(client, marks=[MARKS], known=stated)
    numbers = client.get("/api/known").json()["numbers"]
    return {number["name"]: number["refused"] for number in numbers if number["refused"]}


@pytest.mark.parametrize(("name", "value", "sigma", "line"), ABSURD)
def test_an_absurd_number_is_refused_in_its_own_words(client, name, value, sigma, line):
    refused = state(client, **{name: (value, sigma)})
    assert [*refused] == [name] and line in refused[name], refused
    assert refused[name].endswith("Check the number and its unit.")


def test_nothing_goes_by_an_absurd_number(client):
    def preview():
        plan = {"layout": "nine", "places": []}
        return client.post("/api/preview", json=plan).json(), client.get("/api/reach").json()

    before = preview()
    state(client, motor_gap=(298.0, 0.1))
    for path in ("bench", "verdict", "next", "correction", f"doubts?file={MARKS}"):
        answer = client.get(f"/api/{path}")
        assert answer.status_code == 422, path
        line = answer.json()["error"]
        assert line.startswith("The gap between the motors: 298.0 mm is far from the 2978.4 mm")
        assert line.endswith('You typed it under "What you know".') and len(line.split()) <= 40
    assert preview() == before, "a plan is made without it"
    state(client, **{"motor_center_x": (900.0, 1.0)})
    line = client.get("/api/verdict").json()["error"]
    assert "known motor_center_x=900: that is far from" in line, "no field asks for it"
