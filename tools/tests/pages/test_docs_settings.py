"""The page of settings, and the table against what the lab knows of files and numbers."""

import math
import re

import pytest
from plumb.firmware.settings import every_setting, format_value
from plumb.model.predict import frame_words, library
from plumb.settings import (
    FRAME_LIMITS,
    PUBLISHED_LIMITS,
    SOURCES,
    MachineSettings,
    groundcontrol_changes,
)
from settings_page import page

SETTINGS = {setting.number: setting for setting in every_setting()}
BY_NAME = {setting.name: setting for setting in SETTINGS.values()}
TEXT = page(list(SETTINGS.values()))
# The lab's name of a setting, and the firmware's where it is another.
OTHER_NAMES = {"chain_sag_correction": "sag_correction"}
# Keys whose numbers the clients compute from others, and those that no number of ours answers to.
NOT_OWN_KEYS = {"gear_teeth", "link_pitch", "kinematics", "feed"}
OF_OTHER_FIRMWARE = {"chain_elasticity", "holey_sled_weight", "top_beam_tilt"}
# Settings of ours begin here; 60 and 61 mean what they mean in the published beta.
FIRST_OWN = 60
# Published settings to which a value was added.
EXTENDED = {17: "4 is new"}
# Number, type, default, as the published firmware has them.
PUBLISHED = """
0 float 2438.4, 1 float 1219.2, 2 float 2978.4, 3 float 463, 4 float 310, 5 float 139, 6 float 79,
7 u8 1, 8 float 250, 9 u16 2000, 10 u16 3360, 11 u16 1651, 12 float 8113.73, 13 float 63.5,
15 u16 900, 16 bool 1, 17 u8 0, 18 float 12.6, 19 float 3.17, 20 float 7560, 21 float 1300,
22 float 0, 23 float 34, 24 float 1, 25 float 5, 26 float 0, 27 float 0.28, 28 float 1, 29 float 0,
30 float 0, 31 float 34, 32 float 1, 33 float 5, 34 float 0, 35 float 0.28, 36 float 1, 37 float 0,
38 u8 1, 39 u8 3, 40 float 0, 41 float 0, 42 float 2
"""
# With the published default nothing would watch z until a client sends its number.
OTHER_DEFAULTS = {"29": "1300"}


def test_published_numbers_types_and_defaults():
    published = [row.split() for row in PUBLISHED.replace("\n", " ").split(",")]
    expected = [
        (number, kind, OTHER_DEFAULTS.get(number, usual)) for number, kind, usual in published
    ]
    listed = [
        setting
        for setting in SETTINGS.values()
        if setting.access == "listed" and setting.number < FIRST_OWN
    ]
    assert [(str(o.number), o.kind, format_value(o.usual)) for o in listed] == expected


def test_the_dump_is_in_the_order_of_numbers():
    numbers = [setting.number for setting in every_setting()]
    assert numbers == sorted({*numbers}), "each number stands once"


@pytest.mark.parametrize("name", sorted(set(SOURCES) - NOT_OWN_KEYS - OF_OTHER_FIRMWARE))
def test_lab_and_firmware_mean_the_same_key(name):
    section, key = SOURCES[name]
    setting = BY_NAME[OTHER_NAMES.get(name, name)]
    assert setting.key == f"{section.removesuffix(' Settings')}: {key}"


def test_every_groundcontrol_key_that_the_lab_writes_has_a_number():
    machine = MachineSettings(2978.4, 1072.6, 139.1, 2438.4, 1219.2, "top")
    keys = {setting.key for setting in SETTINGS.values()}
    for section, key in groundcontrol_changes(machine).values:
        assert f"{section.removesuffix(' Settings')}: {key}" in keys


def test_every_effect_parameter_has_its_number():
    for effect in library():
        for parameter in effect["parameters"]:
            setting = SETTINGS[parameter["setting"]]
            assert setting.name == f"{effect['name']}.{parameter['name']}"
            span = parameter["high"] - parameter["low"]
            assert setting.low == pytest.approx(parameter["low"] - span, rel=1e-6)
            assert setting.high == pytest.approx(parameter["high"] + span, rel=1e-6)
            assert setting.low <= parameter["typical"] <= setting.high and setting.usual == 0


@pytest.mark.parametrize("name", sorted(PUBLISHED_LIMITS))
def test_the_firmware_takes_what_the_lab_takes(name):
    if name in OF_OTHER_FIRMWARE:
        return
    limit, setting = PUBLISHED_LIMITS[name], BY_NAME[OTHER_NAMES.get(name, name)]
    assert setting.low <= limit.low and limit.high <= setting.high


def test_the_firmware_takes_every_frame_that_the_lab_takes():
    for name, limit in FRAME_LIMITS.items():
        if name in BY_NAME:
            assert BY_NAME[name].low <= (0 if limit.zero else limit.low), name
            assert BY_NAME[name].high >= limit.high * (1 - 1e-7), name
    # The other two are computed: height from $1 and $3, radius from $13.
    names = {setting["name"] for setting in frame_words()} - set(BY_NAME)
    assert names == {"motor_height", "sprocket_radius"}
    assert BY_NAME["chain_per_turn"].high >= 2 * math.pi * FRAME_LIMITS["sprocket_radius"].high


def test_no_setting_uses_a_number_of_another_program():
    for number in [14, *range(45, FIRST_OWN), *range(85, 99), 144]:
        assert number not in SETTINGS
    assert all(SETTINGS[number].access != "listed" for number in (43, 44, 99))


def is_effect(number: int) -> bool:
    """Whether a number is an effect's, which docs/effects.md describes."""
    return 100 <= number < 230


def cells_of(number: int) -> list[str]:
    """The cells of a setting's row, which may stand for several."""
    for cells in (row.strip("| ").split(" | ") for row in TEXT.splitlines() if row[:2] == "| "):
        numbers = [int(each) for each in re.findall(r"\d+", cells[0])]
        if re.fullmatch(r"\d+(( to |, )\d+)*", cells[0]) and numbers[0] <= number <= numbers[-1]:
            return cells
    raise AssertionError(f"${number} has no row")


@pytest.mark.parametrize("number", [number for number in SETTINGS if not is_effect(number)])
def test_every_setting_has_a_row_and_a_sentence(number):
    cells = cells_of(number)
    setting = SETTINGS[number]
    assert f"`{setting.name}`" in cells[1] or " to " in cells[1]
    assert format_value(setting.usual) in re.split(r",? ", cells[2])
    assert cells[-1].endswith((".", ".*")) and len(cells[-1]) > 10
    is_own = number >= FIRST_OWN and number != 99
    assert (
        (setting.change == EXTENDED[number])
        if number in EXTENDED
        else (("new" in setting.change) == is_own)
    )


def test_every_row_says_when_it_takes_effect():
    assert cells_of(9)[4] == "at once" and cells_of(69)[4] == "after a restart"
    assert cells_of(13)[4] == "scale, geometry, limits"
    touches = {word for setting in SETTINGS.values() for word in setting.touches}
    assert touches == {"scale", "geometry", "loops", "limits", "drives", "cutter", "restart"}
    explained = TEXT.split("## Published")[0]
    assert all(re.search(rf"^\| .*{word}.* \|", explained, re.MULTILINE) for word in touches)
