"""Settings back into a groundcontrol.ini."""

from dataclasses import replace
from pathlib import Path

import plumb
import pytest
from plumb.settings.files import read_settings
from plumb.settings.ini import changed_ini, groundcontrol_changes, number_for_firmware
from plumb.text.errors import InputError

EXAMPLE = Path(plumb.__file__).parent / "examples" / "mibproj" / "groundcontrol.ini"


def test_unchanged_settings_change_no_byte(tmp_path):
    original = tmp_path / "groundcontrol.ini"
    text = EXAMPLE.read_text().replace(
        "leftchaintolerance = 0\n", "leftchaintolerance = 0.347900203615\n"
    )
    text = text.replace("chainsagcorrection = 0", "chainsagcorrection = 27.394023")
    original.write_bytes(text.replace("\n", "\r\n").encode())
    changes = groundcontrol_changes(read_settings(original))
    assert changes.unsaid == ()
    assert changed_ini(original, changes.values) == original.read_bytes()


def test_only_the_changed_values_change():
    settings = replace(
        read_settings(EXAMPLE),
        motor_gap=2981.123456,
        motor_height=609.6 + 465.5,
        controller="plumb",
        effects={
            "chain_sag": {"weight_ratio_squared": 8.2e-12},
            "chain_pitch": {"left": 0.001, "right": -0.0005},
        },
    )
    new = changed_ini(EXAMPLE, groundcontrol_changes(settings).values).decode()
    # The radius is divided in the published formula: 139.1 * (1/1.001 + 1/0.9995) / 2.
    radius = 139.1 * (1 / 1.001 + 1 / 0.9995) / 2
    differing = [
        (old, now)
        for old, now in zip(EXAMPLE.read_text().splitlines(), new.splitlines(), strict=True)
        if old != now
    ]
    assert differing == [
        ("motorspacingx = 2978.4", "motorspacingx = 2981.12346"),
        ("motoroffsety = 463", "motoroffsety = 465.5"),
        ("leftchaintolerance = 0", "leftchaintolerance = 0.1"),
        ("rightchaintolerance = 0", "rightchaintolerance = -0.05"),
        ("rotationradius = 139.1", f"rotationradius = {radius:.6f}"),
        ("chainsagcorrection = 0", "chainsagcorrection = 8.2"),
    ]


def test_a_written_file_reads_back_as_the_same_machine(tmp_path):
    settings = replace(
        read_settings(EXAMPLE),
        controller="plumb",
        effects={
            "chain_sag": {"weight_ratio_squared": 8.2e-12},
            "chain_pitch": {"left": 0.001, "right": 0.002},
        },
    )
    path = tmp_path / "new.ini"
    path.write_bytes(changed_ini(EXAMPLE, groundcontrol_changes(settings).values))
    back = read_settings(path).as_plumb_model()
    assert back.frame == pytest.approx(settings.frame, abs=1e-5)
    assert back.effects["chain_sag"] == pytest.approx(settings.effects["chain_sag"])
    assert back.effects["chain_pitch"] == pytest.approx(settings.effects["chain_pitch"])


def test_numbers_that_the_file_cannot_hold_are_listed():
    settings = replace(
        read_settings(EXAMPLE),
        motor_center_x=2.0,
        controller="plumb",
        effects={
            "chain_stretch": {"compliance": 5e-6},
            "frame_flex": {"inward": 0.0},
            "chain_sag": {"weight_ratio_squared": 1e-12},
        },
    )
    middle, stretch = groundcontrol_changes(settings).unsaid
    assert "2 mm off the middle" in middle and "chain_stretch compliance = 5e-06" in stretch


@pytest.mark.parametrize("value", [float("nan"), float("inf"), "3000\nbedwidth = 1"])
def test_unusable_values_are_refused(value):
    with pytest.raises(InputError, match="motorSpacingX"):
        changed_ini(EXAMPLE, {("Maslow Settings", "motorSpacingX"): value})


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (3602.7109312345, "3602.71093"),
        (2978.4, "2978.4"),
        (-0.0, "0"),
        (1e-16, "0"),
        (5.1685e-6, "0.0000051685"),
        (999.9999999999, "1000"),
        (123456789.0, "123456789"),
    ],
)
def test_numbers_fit_the_firmware(value, text):
    assert number_for_firmware(value) == text
    # All digits together are one signed 32-bit integer there.
    assert int(text.replace(".", "").replace("-", "")) < 2**31


def test_a_number_too_long_for_the_firmware_is_refused():
    with pytest.raises(ValueError, match="more digits"):
        number_for_firmware(1e10)
