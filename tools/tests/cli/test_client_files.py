"""Files for a machine and its client: whatever is sent when, the firmware hangs the sled as fitted.

The client is imitated here by what the clients are known to do: on each connection they compare the
firmware's dump with their file, and send what differs.
"""

import configparser
import re
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE
from plumb import _core
from plumb.firmware.settings import every_setting, machine_of
from plumb.model.predict import chain_lengths, lengths
from plumb.settings.files import read_settings
from synthetic import grid

OLD, MARKS = EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml"
ADD = ("add", OLD, MARKS, "--effect", "chain_pitch")
WORDS = {"Triangular": 2, "Top": 1, "Bottom": 2, "None": 0, "490Hz": 3}
NEAR = 0.01  # [mm] of chain


def dump_of(ini):
    """{number: value} of all that a client keeps in this file."""
    parser = configparser.RawConfigParser()
    parser.read(ini)
    sent = {}
    for setting in every_setting():
        section, _, key = setting.key.partition(": ")
        if key and parser.has_option(f"{section} Settings", key):
            value = parser.get(f"{section} Settings", key)
            sent[setting.number] = float(WORDS.get(value, value))
    return sent


def lines_of(path):
    """{number: value} of the lines for the machine."""
    pairs = re.findall(r"^\$(\d+)=(\S+)$", Path(path).read_text(), re.MULTILINE)
    return {int(number): float(value) for number, value in pairs}


def states(old, new, lines):
    """The firmware's numbers in the end, whichever file came first: named, by number."""
    yield "first the client, then the lines", {**old, **new, **lines}
    yield "and the client once more", {**old, **new, **lines, **new}
    yield "first the lines, while the old client is there", {**old, **lines, **old, **lines, **new}


def apart(settings, numbers):
    """[mm] by which the firmware's chains differ from the fitted machine's, over the sheet."""
    ours, _ = lengths(settings, grid(13, 9))
    theirs, outcome = lengths(machine_of(numbers, sheet=settings.sheet), grid(13, 9))
    assert not outcome.any()
    return np.abs(ours - theirs).max()


def expect_safe(machine, lines, new, *, old=OLD):
    settings = read_settings(machine)
    for when, numbers in states(dump_of(old), new, lines_of(lines)):
        assert _core.carried_twice(numbers) == [], when
        assert apart(settings, numbers) < NEAR, when


def test_files_for_two_firmwares_would_double_and_the_check_sees_it(run, tmp_path):
    ours, published = tmp_path / "ours.toml", tmp_path / "published.toml"
    assert run(*ADD, "-o", ours, "--client", "groundcontrol")[0] == 0
    options = ("--client", "groundcontrol", "--firmware", "published")
    assert run(*ADD, "-o", published, *options)[0] == 0
    mixed = {**lines_of(tmp_path / "ours.nc"), **dump_of(tmp_path / "published-groundcontrol.ini")}
    assert _core.carried_twice(mixed) == [(37, 160), (40, 180), (41, 181)]
    assert apart(read_settings(ours), mixed) > 3


def test_settings_and_add_write_the_fitted_machine_alike(run, tmp_path):
    machine = tmp_path / "machine.toml"
    assert run(*ADD, "-o", machine, "--client", "groundcontrol")[0] == 0
    new = dump_of(tmp_path / "machine-groundcontrol.ini")
    expect_safe(machine, tmp_path / "machine.nc", new)
    options = ("--client", "groundcontrol", "--original", OLD)
    code, said, _ = run("settings", machine, *options, "-o", tmp_path / "again.nc")
    assert code == 0 and "in place of its groundcontrol.ini" in said
    for name in (".nc", "-groundcontrol.ini"):
        written = (tmp_path / f"machine{name}").read_bytes()
        assert (tmp_path / f"again{name}").read_bytes() == written


def test_webcontrol_gets_numbers_to_type(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    _, answer = ask(*ADD, "-o", machine, "--client", "webcontrol")
    assert answer["written"] == [str(machine), str(tmp_path / "machine.nc")]
    numbers = {setting.key: setting.number for setting in every_setting()}
    typed = {
        numbers[name.replace(" Settings", "")]: float(value)
        for name, value in answer["typed"].items()
    }
    assert set(typed) == {2, 3, 8, 37, 40, 41} and typed[37] == typed[40] == typed[41] == 0
    expect_safe(machine, tmp_path / "machine.nc", {**dump_of(OLD), **typed})


def test_a_sender_without_numbers_needs_the_lines_alone(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    _, answer = ask(*ADD, "-o", machine, "--client", "none")
    assert answer["written"] == [str(machine), str(tmp_path / "machine.nc")]
    expect_safe(machine, tmp_path / "machine.nc", {})


def test_lines_alone_are_refused_until_the_client_is_named(run, tmp_path):
    machine, lines = tmp_path / "machine.toml", tmp_path / "machine.nc"
    assert run(*ADD, "-o", machine)[0] == 0
    code, _, complaint = run("settings", machine, "-o", lines)
    assert code == 2 and "twice" in complaint and "--client" in complaint
    for options in (
        ("--client", "groundcontrol", "--original", OLD),
        ("--client", "groundcontrol", "-o", lines),
        ("--client", "none", "--original", OLD, "-o", lines),
    ):
        assert run("settings", machine, *options)[0] == 2
    assert not lines.exists()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("chainpitch = 6.35", "chainpitch = 6.36", "$13 = 63.6 instead of 63.5"),
        ("chainoversprocket = Top", "chainoversprocket = Bottom", "$38 = 2 instead of 1"),
        ("kinematicstype = Triangular", "kinematicstype = Quadrilateral", "$7 = 1 instead of 2"),
        ("bedheight = 1219.2", "bedheight = 1200", "$1 = 1200 instead of 1219.2"),
        ("gearteeth = 10", "gearteeth = ten", "[Advanced Settings] gearteeth: 'ten' is not a"),
        ("gearteeth = 10\n", "", "gearTeeth is missing"),
    ],
)
def test_a_file_of_another_machine_is_refused(old, new, said, run, file, tmp_path):
    machine = tmp_path / "machine.toml"
    assert run(*ADD, "-o", machine)[0] == 0
    other = file("other.ini", OLD.read_text().replace(old, new))
    options = ("--client", "groundcontrol", "--original", other)
    code, _, complaint = run("settings", machine, *options, "-o", tmp_path / "machine.nc")
    assert code == 2 and said in complaint and complaint.count("\n") == 1
    assert not (tmp_path / "machine.nc").exists()


def test_the_published_firmware_gets_all_numbers_through_its_client(run, tmp_path):
    machine, lines = tmp_path / "machine.toml", tmp_path / "machine.nc"
    options = ("--client", "groundcontrol", "--firmware", "published")
    code, said, _ = run(*ADD, "-o", machine, *options)
    assert code == 0 and not lines.exists() and "cannot do" in said
    written = read_settings(machine)
    client = read_settings(tmp_path / "machine-groundcontrol.ini")
    paid_out = chain_lengths(written, grid(13, 9))
    assert np.abs(paid_out - chain_lengths(client, grid(13, 9))).max() < 0.001
    # The next board is cut with these numbers, so this file is what it was cut with.
    assert written.controller == "stock" and client.published.left_tolerance > 0.1
    options = ("--client", "none", "-o", lines)
    code, _, complaint = run("settings", machine, *options)
    assert code == 2 and "published numbers" in complaint and not lines.exists()
    ours = tmp_path / "ours.toml"
    assert run(*ADD, "-o", ours)[0] == 0
    model = read_settings(ours)
    same, _ = lengths(written.as_plumb_model(), grid(13, 9))
    assert np.abs(same - lengths(model, grid(13, 9))[0]).max() < 1e-9
