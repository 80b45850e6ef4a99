"""groundcontrol.ini and webcontrol.json: read, and settings written back into them."""

import json
import re
from dataclasses import replace
from itertools import product

import pytest
from example_machine import EXAMPLE
from plumb.cli.main import main
from plumb.firmware.settings import client_numbers
from plumb.settings import (
    SOURCES,
    PublishedSettings,
    changed_client_file,
    changed_ini,
    digest_of,
    groundcontrol_changes,
    number_for_firmware,
    parse_webcontrol,
    read_settings,
)
from plumb.text.errors import InputError
from plumb.text.files import read_ini
from published_marks import SETTINGS

SAG = {"chain_sag": {"weight_ratio_squared": 8.2e-12}}


def test_unchanged_settings_change_no_byte(tmp_path):
    original = tmp_path / "groundcontrol.ini"
    text = SETTINGS.read_text()
    text = text.replace("leftchaintolerance = 0\n", "leftchaintolerance = 0.347900203615\n")
    text = text.replace("chainsagcorrection = 0", "chainsagcorrection = 27.394023")
    original.write_bytes(text.replace("\n", "\r\n").encode())
    changes = groundcontrol_changes(read_settings(original))
    assert changes.unsaid == ()
    assert changed_ini(original, changes.values) == original.read_bytes()


def test_only_the_changed_values_change():
    settings = replace(
        read_settings(SETTINGS),
        motor_gap=2981.123456,
        motor_height=609.6 + 465.5,
        controller="plumb",
        effects={**SAG, "chain_pitch": {"left": 0.001, "right": -0.0005}},
    )
    new = changed_ini(SETTINGS, groundcontrol_changes(settings).values).decode()
    # The radius is divided in the published formula: 139.1 * (1/1.001 + 1/0.9995) / 2.
    radius = 139.1 * (1 / 1.001 + 1 / 0.9995) / 2
    differing = [
        (old, now)
        for old, now in zip(SETTINGS.read_text().splitlines(), new.splitlines(), strict=True)
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


def test_numbers_that_the_file_cannot_hold_are_listed():
    settings = replace(
        read_settings(SETTINGS),
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
        changed_ini(SETTINGS, {("Maslow Settings", "motorSpacingX"): value})


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


def spoilt(tmp_path, old, new):
    text = SETTINGS.read_text()
    assert old in text
    path = tmp_path / "groundcontrol.ini"
    path.write_text(text.replace(old, new, 1))
    return path


def test_the_example():
    settings = read_settings(SETTINGS)
    assert (settings.motor_gap, settings.motor_height) == (2978.4, 609.6 + 463)
    assert (settings.sheet_width, settings.sheet_height) == (2438.4, 1219.2)
    assert (settings.rotation_radius, settings.motor_center_x) == (139.1, 0.0)
    assert settings.sprocket_radius == pytest.approx(10.1063, abs=1e-4)
    assert (settings.feed, settings.controller) == ("top", "stock")
    assert (settings.sled_weight, settings.chain_weight) == (97.9, 0.00137293)
    assert settings.published == PublishedSettings()
    assert settings.effects == {}


def test_corrections_and_the_keys_of_webcontrol(tmp_path):
    text = SETTINGS.read_text()
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
    said = PublishedSettings(27.394023, 0.3479, -0.08, 5.1685e-6, 113.68, 3360.0, 0.07)
    assert settings.published == said
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
        ("motorspacingx", "motorspacingx = 1\n[MASLOW Settings]\nmotorSpacingX", "already on"),
        ("motorspacingx = 2978.4", "motorspacingx 2978.4", "line 6: is not key = value"),
        ("motorspacingx = 2978.4", "= 2978.4", "line 6: is not key = value"),
        ("motoroffsety = 463", "motoroffsety = 18.2", "motoroffsety: 18.2 mm above .*inches"),
        ("motoroffsety = 463", "motoroffsety = -463", "motoroffsety: -463 mm above .*is possible"),
        ("chainpitch = 6.35", "chainpitch = 0.25", "chainPitch .*inches"),
        ("leftchaintolerance = 0", "leftchaintolerance = 50", "leftchaintolerance: 50 percent"),
        ("leftchaintolerance = 0", "leftchaintolerence = 0.3", "did you mean leftChainTolerance"),
        ("rotationradius = 139.1", "rotatonradius = 139.1", "line 40, .*mean rotationRadius"),
        ("chainsagcorrection = 0", "chainsagcorrection = 1e9", "chainsagcorrection: 1e.09"),
        ("sledcg = 79", "sledcg = 79\nsledweight = 22", "sledweight: 22 N .*pounds"),
        ("chainoversprocket = Top", "chainoversprocket = 1", "'1' .*write one of top, bottom"),
        ("kinematicstype = Triangular", "kinematicstype = Quadrilateral", "two brackets, which"),
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


INI = EXAMPLE / "groundcontrol.ini"
# WebControl spells the keys with capitals; the published ini has them small.
CAPITALS = {key.lower(): key for _, key in SOURCES.values()}
# What WebControl computes, and what is no setting of the machine.
OTHERS = {
    "Computed Settings": [
        {"firmwareKey": 38, "key": "chainOverSprocketComputed", "type": "string", "value": 1},
        {"default": "INCHES", "key": "units", "type": "string", "value": "INCHES"},
    ],
    "Camera Settings": [{"key": "videoSize", "type": "options", "value": "640x480"}],
}


@pytest.fixture
def webcontrol(tmp_path):
    """The machine of the example as WebControl keeps it."""
    document = dict(OTHERS)
    for entry in read_ini(INI).entries:
        option = {
            "default": 0,
            "desc": "Größe",
            "key": CAPITALS.get(entry.key, entry.key),
            "section": entry.section,
            "type": "string",
            "value": entry.value,
        }
        document.setdefault(entry.section, []).append(option)
    path = tmp_path / "webcontrol.json"
    text = json.dumps(document, sort_keys=True, indent=4, ensure_ascii=False)
    path.write_text(text, encoding="utf-8")
    return path


def test_it_is_the_same_machine_as_the_ini(webcontrol):
    ours, theirs = read_settings(webcontrol), read_settings(INI)
    assert ours.frame == theirs.frame and ours.effects == theirs.effects
    assert ours.published == theirs.published and ours.controller == "stock"
    assert client_numbers(
        parse_webcontrol(webcontrol.read_text(), source="webcontrol.json")
    ) == client_numbers(read_ini(INI))


def test_the_same_machine_has_the_same_digest(webcontrol):
    before = digest_of(webcontrol)
    assert before == digest_of(INI)
    text = webcontrol.read_text(encoding="utf-8")
    webcontrol.write_text(text.replace('"640x480"', '"320x240"'), encoding="utf-8")
    assert digest_of(webcontrol) == before
    webcontrol.write_text(text.replace('"2978.4"', '"2979"'), encoding="utf-8")
    assert digest_of(webcontrol) != before


def test_a_change_touches_nothing_else(webcontrol):
    key = ("Maslow Settings", "motorspacingx")
    before = webcontrol.read_text(encoding="utf-8")
    same = changed_client_file(str(webcontrol), {key: 2978.4})
    assert same.decode() == before
    changed = changed_client_file(str(webcontrol), {key: 2980.25}).decode()
    pairs = zip(before.splitlines(), changed.splitlines(), strict=True)
    assert [(old.strip(), new.strip()) for old, new in pairs if old != new] == [
        ('"value": "2978.4"', '"value": "2980.25"')
    ]


def test_a_number_stays_a_number_and_a_missing_key_is_added(webcontrol):
    document = json.loads(webcontrol.read_text(encoding="utf-8"))
    for option in document["Maslow Settings"]:
        if option["key"] == "bedWidth":
            option["value"] = 2438.4
    webcontrol.write_text(json.dumps(document))
    keys = {("Maslow Settings", "bedwidth"): 2400.0, ("Advanced Settings", "new"): 1.5}
    changed = json.loads(changed_client_file(str(webcontrol), keys))
    values = {each["key"]: each["value"] for each in changed["Maslow Settings"]}
    assert values["bedWidth"] == 2400.0
    assert changed["Advanced Settings"][-1] == {"key": "new", "type": "string", "value": "1.5"}


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("{", "is not valid JSON"),
        ('{"a": 1}', "is a JSON file, but not one of WebControl"),
        ("[1]", "is a JSON file, but not one of WebControl"),
        ('{"Maslow Settings": []}', "kinematicsType is missing in [Advanced Settings]"),
    ],
)
def test_another_file_is_refused(text, hint, tmp_path):
    path = tmp_path / "webcontrol.json"
    path.write_text(text)
    with pytest.raises(InputError, match=re.escape(hint)) as refused:
        read_settings(path) if text != "[1]" else parse_webcontrol(text, source="webcontrol.json")
    assert "\n" not in str(refused.value)


def test_a_wrong_value_is_named_with_its_line(webcontrol):
    text = webcontrol.read_text(encoding="utf-8").replace('"139.1"', '"wide"')
    webcontrol.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_settings(webcontrol)
    entry = next(e for e in parse_webcontrol(text, source="").entries if e.value == "wide")
    assert f"line {entry.line}, [Advanced Settings]" in str(refused.value)
    assert '"key"' in text.splitlines()[entry.line - 1]


def test_a_calibration_with_webcontrol_needs_nothing_else(webcontrol, here, capsys):
    marks = str(EXAMPLE / "marks.toml")
    known = (
        "tape_scale.strain=0+-0.0001",
        "chain_pitch.left=0.0019+-0.0003",
        "chain_pitch.right=0.0019+-0.0003",
        "chain_stretch.compliance=4.8e-6+-7e-7",
    )
    checked = [word for each in known for word in ("--checked", each)]
    assert main(["calibrate", "webcontrol.json", marks, *checked]) == 0
    said = capsys.readouterr().out
    assert "put machine-webcontrol.json in place of its webcontrol.json" in " ".join(said.split())
    # The next round finds the client's file next to machine.toml.
    assert said.endswith("plumb calibrate machine.toml marks.toml\n")
    kept = read_settings("machine-webcontrol.json")
    assert kept.published.chain_sag_correction == 0 == kept.published.left_tolerance
    assert kept.motor_gap == pytest.approx(read_settings("machine.toml").motor_gap, abs=1e-4)
    # A second run may replace what the first wrote.
    assert main(["calibrate", "webcontrol.json", marks, *checked, "-o", "machine.toml"]) == 0
