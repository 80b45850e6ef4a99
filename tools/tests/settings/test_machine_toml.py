"""machine.toml: strict in, exact out; limits of its numbers, and what they mean in our model."""

import math
from dataclasses import fields, replace

import pytest
from plumb.model.predict import chain_lengths
from plumb.settings import (
    FRAME_LIMITS,
    PUBLISHED_LIMITS,
    MachineSettings,
    PublishedSettings,
    find_fault,
    machine_toml,
    read_settings,
    write_machine_toml,
)
from plumb.text.errors import InputError

KNOWN = {"chain_sag": ["weight_ratio_squared"], "chain_pitch": ["left", "right"]}
SETTINGS = MachineSettings(
    motor_gap=3602.71093,
    motor_height=0.1 + 1078.2,
    motor_center_x=-1 / 3,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="bottom",
    sprocket_radius=math.pi * 3.2,
    sled_weight=113.7,
    chain_weight=1.37293e-3,
    effects={
        "chain_sag": {"weight_ratio_squared": 8.2e-12 / 3},
        "chain_pitch": {"left": 0.1 + 0.2e-3, "right": 0.0},
    },
)


@pytest.mark.parametrize(
    "settings",
    [
        SETTINGS,
        replace(SETTINGS, effects={}),
        replace(SETTINGS, controller="stock", published=PublishedSettings(7.4, top_beam_tilt=0.07)),
        replace(SETTINGS, controller="holey", published=PublishedSettings(0, 0.1, 0, 5.1e-6, 97)),
    ],
)
def test_every_number_comes_back_bit_for_bit(tmp_path, settings):
    path = tmp_path / "machine.toml"
    path.write_text(machine_toml(settings, comment="fitted to nine marks\n= not a setting"))
    assert read_settings(path, known=KNOWN) == settings
    assert "# fitted to nine marks\n# = not a setting\n" in path.read_text()


def test_optional_keys_have_defaults(tmp_path):
    path = tmp_path / "machine.toml"
    path.write_text(
        'feed = "top"\n[sheet]\nwidth = 2438\nheight = 1219\n'
        "[frame]\nmotor_gap = 3000\nmotor_height = 1072\nrotation_radius = 139\n"
    )
    settings = read_settings(path)
    assert settings == MachineSettings(3000.0, 1072.0, 139.0, 2438.0, 1219.0, "top")
    assert settings.controller == "plumb"


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        ('feed = "bottom"', "", "feed is missing"),
        ('feed = "bottom"', 'feed = "left"', "feed: 'left' is not known"),
        ('"plumb"', '"grbl"', "controller: 'grbl' is not known"),
        ('controller = "plumb"', 'controler = "plumb"', "did you mean controller"),
        ("motor_gap = 3602.71093", "", "frame.: motor_gap is missing"),
        ("motor_gap = 3602.71093", "motor_gap = 141.8", "frame. motor_gap: 141.8 mm .*inches"),
        ("motor_gap = 3602.71093", 'motor_gap = "3602"', "motor_gap: a number is needed, not '36"),
        ("motor_gap = 3602.71093", "motor_gap = 3602,7", "not valid TOML"),
        ("motor_gap = ", "motor_gab = ", "unknown name 'motor_gab'; did you mean motor_gap"),
        ("motor_height = 1078.3", "motor_height = 463.0", "minus half of .sheet. height: -146.6"),
        ("sled_weight = 113.7", "sled_weight = 11.6", "sled_weight: 11.6 N .*kilograms"),
        ("chain_weight = 0.00137293", "chain_weight = 0.14", "chain_weight: .*kg/m"),
        ("height = 1219.2", "", "sheet.: height is missing"),
        ("[effects.chain_sag]", "[effects.chain_sagg]", "'chain_sagg'; did you mean chain_sag"),
        ("left = ", "lefd = ", "effects.chain_pitch.: unknown name 'lefd'; did you mean left"),
        ("left = 0.1002", "left = inf #", "effects.chain_pitch. left: inf"),
        ("[effects.chain_sag]", "[effects]\nsag = 3\n[effects.chain_sag]", "sag: is not a table"),
        ("[sheet]", "[[mark]]\n[sheet]", "holds marks"),
        ("[frame]", "[[frame]]", "frame: is not a table"),
    ],
)
def test_bad_files_are_refused_with_the_place(tmp_path, old, new, hint):
    text = machine_toml(SETTINGS)
    assert old in text
    path = tmp_path / "machine.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(InputError, match=hint) as caught:
        read_settings(path, known=KNOWN)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_without_a_list_any_effect_passes(tmp_path):
    path = tmp_path / "machine.toml"
    settings = replace(SETTINGS, effects={"my_effect": {"size": 1.0}, "a b": {"c": 2.0}})
    write_machine_toml(path, settings)
    assert read_settings(path) == settings
    with pytest.raises(InputError, match="my_effect"):
        read_settings(path, known=KNOWN)


@pytest.mark.parametrize(
    "change",
    [
        {"motor_gap": math.nan},
        {"motor_height": 10.0},
        {"feed": "left"},
        {"controller": "grbl"},
        {"effects": {"chain_sag": {"weight_ratio_squared": math.inf}}},
    ],
)
def test_impossible_settings_are_not_written(tmp_path, change):
    path = tmp_path / "machine.toml"
    path.write_text("old")
    with pytest.raises(InputError):
        write_machine_toml(path, replace(SETTINGS, **change))
    assert path.read_text() == "old"


STOCK = MachineSettings(
    motor_gap=3602.6,
    motor_height=1078.0,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="top",
    controller="stock",
)


def test_holey_settings_become_effects():
    holey = replace(
        STOCK,
        controller="holey",
        published=PublishedSettings(33.0, chain_elasticity=5.1685e-6, holey_sled_weight=113.68),
    )
    model = holey.as_plumb_model()
    assert model.sled_weight == 113.68
    assert model.chain_weight == 0.001372
    # 0.001372^2 / (24 * 113.68^2) = 6.069e-12, whatever $37 says.
    assert model.effects["chain_sag"]["weight_ratio_squared"] == pytest.approx(6.069e-12, rel=1e-4)
    assert model.effects["chain_stretch"] == {"compliance": 5.1685e-6}
    stock = holey.as_plumb_model(controller="stock")
    assert stock.effects == {"chain_sag": {"weight_ratio_squared": pytest.approx(33e-12)}}


@pytest.mark.parametrize(
    ("published", "key"),
    [
        (PublishedSettings(chain_elasticity=5e-6), "sledWeight"),
        (PublishedSettings(holey_sled_weight=97.9), "chainElasticity"),
    ],
)
def test_holey_does_not_guess(published, key):
    holey = replace(STOCK, controller="holey", published=published)
    with pytest.raises(InputError, match=key):
        holey.as_plumb_model()
    with pytest.raises(InputError, match=key):
        chain_lengths(holey, [[0.0, 0.0]])


GOOD = MachineSettings(2978.4, 1072.6, 139.1, 2438.4, 1219.2, "top")


def test_every_number_has_a_limit():
    numbers = {field.name for field in fields(MachineSettings)} - {
        "motor_height",
        "feed",
        "controller",
        "effects",
        "published",
        "file",
        "fitted",
    }
    assert set(FRAME_LIMITS) == numbers | {"motor_offset"}
    assert set(PUBLISHED_LIMITS) == {field.name for field in fields(PublishedSettings)}


@pytest.mark.parametrize("gap", [2978.4, 3719.6])
@pytest.mark.parametrize("offset", [422, 463, 1063.2])
@pytest.mark.parametrize("radius", [0, 100, 250])
def test_machines_that_exist_are_accepted(gap, offset, radius):
    real = replace(GOOD, motor_gap=gap, motor_height=609.6 + offset, rotation_radius=radius)
    assert find_fault(real) is None


@pytest.mark.parametrize("name", sorted(set(FRAME_LIMITS) - {"motor_offset"}))
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1e9])
def test_impossible_numbers_are_named(name, value):
    faulty, sentence = find_fault(replace(GOOD, **{name: value}))
    assert faulty == name or name == "sheet_height"
    assert sentence
