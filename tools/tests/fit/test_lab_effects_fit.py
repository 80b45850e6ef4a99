"""Lab effects in fits: found again, named with their cure, and never written into settings."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from plumb.cli.screen import in_text
from plumb.cure.add import add
from plumb.cure.decision import toml_of
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe, sighted
from plumb.marks.read import Measurements
from plumb.model.catalogue import LAB_EFFECTS
from plumb.model.predict import FOUND, known_effects, values_of
from plumb.settings.files import read_settings
from plumb.settings.machine import write_machine_toml
from plumb.text.answers import json_of
from plumb.text.errors import InputError
from plumb.words.decision import everything
from synthetic import BELIEVED, EFFECTS, TRUE, grid, marks_on

HIDDEN = {"sled_friction": {"drag": 7.0}, "tape_scale": {"strain": 0.0004}}
HIDDEN["sheet_skew"] = {"angle": -0.0012}
WIDE = {"motor_gap": 1e3, "motor_height": 1e3, "motor_center_x": 1e3, "sheet_rotation": 1.0}
SIDES = ((40.0, 0.0), (-40.0, 0.0), (0.0, 40.0), (0.0, -40.0))


def marks(hidden, *, noise=0.0, columns=7, approaches=SIDES):
    """Marks of the true machine as a maker with these lab effects would measure them."""
    sent = tuple(
        replace(mark, approach=approaches[i % len(approaches)])
        for i, mark in enumerate(marks_on(TRUE, BELIEVED, grid(columns, 5)))
    )
    rows = observe(BELIEVED, Measurements(sent))
    outside = {f"{e}.{name}": value for e, sizes in hidden.items() for name, value in sizes.items()}
    sighting = sighted(
        values_of(TRUE), outside, rows, over_top=True, usual_weight=TRUE.sled_weight, names=()
    )
    assert (sighting.outcome == FOUND).all()
    where = sighting.read.where
    where = where + noise * np.random.default_rng(3).standard_normal(where.shape)
    read = zip(sent, where.tolist(), strict=True)
    return tuple(replace(mark, measured=tuple(place)) for mark, place in read)


def test_all_are_found_at_once_beside_those_of_the_machine():
    board = Measurements(marks(HIDDEN, columns=9))
    rows = observe(BELIEVED, board)
    fitted = fit(BELIEVED, rows, effects=[*EFFECTS, *HIDDEN], priors=WIDE, sigma=0.01)
    assert fitted.settled and fitted.rms < 1e-4
    for name, parameters in HIDDEN.items():
        for parameter, value in parameters.items():
            assert fitted.lab_effects[name][parameter] == pytest.approx(value, rel=0.01)
    assert fitted.settings.effect("chain_pitch", "left") == pytest.approx(0.0021, rel=0.02)


def test_a_lab_effect_is_named_with_its_cure_and_pays():
    board = Measurements(marks({"tape_scale": {"strain": 0.001}}, noise=0.1), source="marks.toml")
    result = add(Inputs(BELIEVED, board), effects=[*EFFECTS, "tape_scale"])
    assert result.pays and result.effects_added == (*EFFECTS, "tape_scale")
    assert len(result.cures) == 1
    for said in (
        result.cures[0],
        "\n".join(in_text(everything(result, result.notes))),
        toml_of(result, source="marks.toml").decode(),
    ):
        said = " ".join(said.replace("#", " ").split())
        assert "% too long: " in said and "no firmware can cure this" in said
        assert "a length that you trust" in said
    answer = json_of(result)
    assert set(answer["lab_effects"]) == {"tape_scale"} and "tape_scale" not in answer["effects"]
    (strain,) = [each for each in result.parameters if each.name == "tape_scale.strain"]
    assert strain.low < 0.001 < strain.high and strain.unit == "1" and strain.plausible


def test_no_settings_ever_hold_a_lab_effect(tmp_path):
    board = Measurements(marks(HIDDEN, noise=0.1), source="marks.toml")
    result = add(Inputs(BELIEVED, board), effects=["chain_pitch", *HIDDEN])
    assert set(result.after_fit.lab_effects) == set(HIDDEN)
    assert set(result.settings.effects) == {"chain_pitch"}
    written = tomllib.loads(toml_of(result, source="marks.toml").decode())
    assert set(written["effects"]) == {"chain_pitch"}
    path = tmp_path / "machine.toml"
    write_machine_toml(path, result.settings)
    assert read_settings(path, known=known_effects()) == result.settings


@pytest.mark.parametrize("effect", LAB_EFFECTS, ids=lambda effect: effect.name)
def test_settings_with_a_lab_effect_are_refused(effect, tmp_path):
    path = tmp_path / "machine.toml"
    sizes = {effect.name: {effect.parameter.partition(".")[2]: 0.001}}
    write_machine_toml(path, replace(BELIEVED, effects=sizes))
    with pytest.raises(InputError, match=effect.name):
        read_settings(path, known=known_effects())


def test_one_side_only_hides_friction_behind_sag_and_two_sides_show_it():
    widths = []
    for approaches in (((40.0, 0.0),), ((40.0, 0.0), (-40.0, 0.0))):
        rows = observe(BELIEVED, Measurements(marks({}, approaches=approaches)))
        fitted = fit(BELIEVED, rows, effects=[*EFFECTS, "sled_friction"], sigma=0.5)
        (drag,) = [each for each in fitted.estimates if each.name == "sled_friction.drag"]
        widths.append(drag.high - drag.low)
    assert widths[1] < widths[0]
