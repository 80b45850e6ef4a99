"""webcontrol.json is read and written like a groundcontrol.ini: the same machine and chains."""

import json
import re

import pytest
from example_machine import EXAMPLE
from plumb.cli.main import main
from plumb.firmware.client_files import client_numbers
from plumb.settings.files import (
    SOURCES,
    changed_client_file,
    digest_of,
    parse_webcontrol,
    read_settings,
)
from plumb.text.errors import InputError
from plumb.text.ini import read_ini

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
