"""A number that no measurement gives is refused where it was typed, and nothing goes by it."""

import pytest
from folder import choose, with_marks
from plumb.fit.by_hand import readings
from plumb.settings.machine import GRAVITY
from synthetic import BELIEVED

MARKS = "marks.toml"
ABSURD = [
    ("motor_gap", 298.0, 1.0, "298.0 mm is far from the 2978.4 mm of the settings"),
    # Read from the sheet's top edge up to the motors.
    ("motor_height", 463.0, 1.0, "-146.6 mm is far from the 463.0 mm of the settings"),
    ("sled_weight", GRAVITY, 2.0, "1.0 kg is far from the 10.0 kg of the settings"),
    (
        "tape_scale.strain",
        0.5,
        0.001,
        "500.00 mm cannot be: real machines have -3.00 mm to 3.00 mm",
    ),
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


def test_what_can_be_is_taken(client):
    said = {"motor_gap": (2990.0, 1.0), "sled_weight": (130.0, 2.0), "chain_pitch.left": (1e-3, 0)}
    assert state(client, **said) == {}
    assert client.get("/api/bench").status_code == 200


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


def test_lengths_are_refused_in_the_chosen_unit(client):
    choose(client, units="inch")
    refused = state(client, motor_gap=(298.0, 1.0))
    assert "11.73 inch is far from the 117.26 inch of the settings" in refused["motor_gap"]


def test_what_rests_on_an_absurd_weight_is_not_judged(client):
    sag = "chain_sag.weight_ratio_squared"
    # A usual chain of 420 g, as it is against a sled of a kilogram.
    heavy = readings(BELIEVED, GRAVITY)[sag].value(420.0)
    both = {"sled_weight": (GRAVITY, 0.1), sag: (heavy, heavy / 100)}
    assert [*state(client, **both)] == ["sled_weight"]
    assert [*state(client, **{sag: (heavy, heavy / 100)})] == [sag]
