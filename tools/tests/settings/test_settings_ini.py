"""Reading groundcontrol.ini."""

from itertools import product
from pathlib import Path

import plumb
import pytest
from plumb.settings.files import read_settings
from plumb.settings.machine import PublishedSettings
from plumb.text.errors import InputError

EXAMPLE = Path(plumb.__file__).parent / "examples" / "mibproj" / "groundcontrol.ini"


def spoilt(tmp_path, old, new):
    text = EXAMPLE.read_text()
    assert old in text
    path = tmp_path / "groundcontrol.ini"
    path.write_text(text.replace(old, new, 1))
    return path


def test_the_example():
    settings = read_settings(EXAMPLE)
    assert (settings.motor_gap, settings.motor_height) == (2978.4, 609.6 + 463)
    assert (settings.sheet_width, settings.sheet_height) == (2438.4, 1219.2)
    assert (settings.rotation_radius, settings.motor_center_x) == (139.1, 0.0)
    assert settings.sprocket_radius == pytest.approx(10.1063, abs=1e-4)
    assert (settings.feed, settings.controller) == ("top", "stock")
    assert (settings.sled_weight, settings.chain_weight) == (97.9, 0.00137293)
    assert settings.published == PublishedSettings()
    assert settings.effects == {}


def test_corrections_and_the_keys_of_webcontrol(tmp_path):
    text = EXAMPLE.read_text()
    for old, new in (
        ("leftchaintolerance = 0", "leftChainTolerance = 0.3479"),
        ("rightchaintolerance = 0", "RIGHTCHAINTOLERANCE : -0.08\ntopBeamTilt = 0.07"),
        ("chainsagcorrection = 0", "chainsagcorrection = 27.394023\nchainElasticity = 5.1685e-06"),
        ("sledcg = 79", "sledcg = 79\nsledWeight = 113.68"),
        ("chainoversprocket = Top", "chainoversprocket = Bottom"),
        ("macro1 = ", "macro1 = 100% {x} $PATH\n\tG0 X0"),
    ):
        assert old in text
        text = text.replace(old, new, 1)
    path = tmp_path / "anything.txt"
    path.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    settings = read_settings(path)
    assert settings.published == PublishedSettings(
        27.394023, 0.3479, -0.08, 5.1685e-6, 113.68, 3360.0, 0.07
    )
    assert (settings.sled_weight, settings.feed) == (113.68, "bottom")


def test_a_sled_weight_of_zero_is_a_switch(tmp_path):
    settings = read_settings(spoilt(tmp_path, "sledcg = 79", "sledcg = 79\nsledweight = 0"))
    assert (settings.sled_weight, settings.published.holey_sled_weight) == (97.9, 0.0)


NEEDED = [
    *product(["Maslow"], ["motorspacingx", "bedwidth", "bedheight", "motoroffsety"]),
    *product(["Advanced"], ["gearteeth", "chainpitch", "rotationradius", "chainsagcorrection"]),
    *product(["Advanced"], ["chainoversprocket", "kinematicstype"]),
]


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        *(
            (f"{key} = ", f"{key[:3]} = ", f"(?i){key} is missing in .{part}")
            for part, key in NEEDED
        ),
        ("motorspacingx = 2978.4", "motorspacingx = 117.26", "motorspacingx: 117.26 .*inches"),
        ("motorspacingx = 2978.4", "motorspacingx = 2978,4", "motorspacingx: .*decimal comma"),
        ("motorspacingx = 2978.4", "motorspacingx = ", "motorspacingx: a number is missing"),
        ("motorspacingx = 2978.4", "motorspacingx = nan", "motorspacingx: 'nan'"),
        ("motorspacingx = 2978.4", "motorspacingx = 29784", "motorspacingx: 29784 mm is out"),
        ("motorspacingx = 2978.4", "motorspacingx = 1\nmotorSpacingX = 2", "already on line"),
        ("motorspacingx = 2978.4", "motorspacingx 2978.4", "line 6: is not key = value"),
        ("motoroffsety = 463", "motoroffsety = 18.2", "motoroffsety: 18.2 mm above .*inches"),
        ("motoroffsety = 463", "motoroffsety = -463", "motoroffsety: -463 mm above .*is possible"),
        ("chainpitch = 6.35", "chainpitch = 0.25", "chainPitch .*inches"),
        ("leftchaintolerance = 0", "leftchaintolerance = 50", "leftchaintolerance: 50 percent"),
        ("leftchaintolerance = 0", "leftchaintolerence = 0.3", "did you mean leftChainTolerance"),
        ("rotationradius = 139.1", "rotatonradius = 139.1", "line 40, .*mean rotationRadius"),
        ("chainsagcorrection = 0", "chainsagcorrection = 1e9", "chainsagcorrection: 1e.09"),
        ("sledcg = 79", "sledcg = 79\nsledweight = 22", "sledweight: 22 N .*pounds"),
        ("chainoversprocket = Top", "chainoversprocket = 1", "'1' .*write one of top, bottom"),
        (
            "kinematicstype = Triangular",
            "kinematicstype = Quadrilateral",
            "two brackets, which the lab does not know",
        ),
        ("kinematicstype = Triangular", "kinematicstype = Tri", "write one of triangular"),
        ("[Maslow Settings]\n", "", "line 4: a value comes before the first .section."),
    ],
)
def test_bad_files_are_refused_with_the_place(tmp_path, old, new, hint):
    path = spoilt(tmp_path, old, new)
    with pytest.raises(InputError, match=hint) as caught:
        read_settings(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "text", "hint"),
    [
        ("a.ini", "[global]\nnumpositions = 9\n", "holds marks"),
        ("a.ini", "[other]\na = 1\n", "has no section .Maslow Settings"),
        ("webcontrol.json", '{"Maslow Settings": []}', "kinematicsType is missing"),
    ],
)
def test_other_files_are_refused(tmp_path, name, text, hint):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(InputError, match=hint):
        read_settings(path)
