"""The package as an owner installs it: a wheel built from the tree works in an empty folder."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import zipfile
from dataclasses import replace
from functools import partial
from pathlib import Path
from urllib.request import urlopen

import pytest
from plumb.settings.files import read_settings
from plumb.settings.toml import machine_toml
from published_marks import MARKS, SETTINGS

ROOT = Path(__file__).resolve().parents[3]
PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check"]


@pytest.fixture
def wheel(tmp_path_factory):
    """A wheel built from a copy of what the package is made of, without the folder test.

    The compiler's cache knows what the clone's build compiled.
    """
    source = tmp_path_factory.mktemp("source")
    for folder in ("lib", "src", "tools"):
        shutil.copytree(
            ROOT / folder, source / folder, ignore=shutil.ignore_patterns("__pycache__")
        )
    folder = tmp_path_factory.mktemp("wheel")
    options = ["--no-deps", "--no-build-isolation", "--wheel-dir", folder]
    done = subprocess.run(
        [*PIP, "wheel", *options, source / "tools"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return next(folder.glob("plumb-*.whl"))


run_to_its_end = partial(subprocess.run, capture_output=True)


@pytest.fixture
def plumb(wheel, tmp_path_factory):
    """Runs a command of the installed wheel in an empty folder, without the project's folder."""
    installed = tmp_path_factory.mktemp("installed")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(installed)
    empty = tmp_path_factory.mktemp("empty")
    shutil.copy(SETTINGS, empty / "groundcontrol.ini")
    shutil.copy(MARKS, empty / "marks.ini")
    machine = replace(read_settings(SETTINGS), controller="plumb")
    (empty / "machine.toml").write_text(machine_toml(machine))
    (empty / "job.nc").write_text("G0 Z2\nG0 X50\nG1 Z-1 F60\nG1 X90 F500\nG0 Z2\n")
    (empty / "points.csv").write_text("0,0\n")
    (empty / "chains.csv").write_text("1700,1700\n")
    # Without -S the project's installation would answer to the name plumb.
    packages = os.pathsep.join([str(installed), sysconfig.get_path("purelib")])

    def run(*arguments, program=("-m", "plumb.cli.main"), start=run_to_its_end):
        return start(
            [sys.executable, "-S", *program, *arguments],
            cwd=empty,
            env={"PATH": os.environ["PATH"], "HOME": str(empty), "PYTHONPATH": packages},
            text=True,
        )

    return run


MEASURED = ("groundcontrol.ini", "marks.ini")
COMMANDS = {
    "grid": ("--settings", "groundcontrol.ini", "--details"),
    "calibrate": MEASURED,
    "check": ("job.nc", "groundcontrol.ini"),
    "compare": MEASURED,
    "diagnose": MEASURED,
    "next": MEASURED,
    "add": (*MEASURED, "--effect", "chain_pitch", "-o", "fitted.toml"),
    "effects": (),
    "bench": ("--kinds", "none", "--marks", "9", "--boards", "1"),
    "report": (*MEASURED, "-o", "report.html"),
    "inverse": ("groundcontrol.ini", "--points", "points.csv"),
    "forward": ("groundcontrol.ini", "--lengths", "chains.csv"),
    "resume": ("job.nc", "groundcontrol.ini", "--line", "4"),
    "settings": ("machine.toml",),
    "reach": ("groundcontrol.ini",),
    "recover": ("machine.toml", "--touch=-900,250:-895,253"),
    "vm": ("--seconds", "1"),
    "practice": ("start", "game", "--seconds", "1"),
}
# What needs a file or a board that an empty folder lacks, and what its refusal names.
LACKING = {
    "send": ("marks.nc", "--port", "none"),
    "read": ("--port", "none"),
    "flash": ("none.hex", "--port", "none"),
}


def every_command_is_tried(plumb):
    shown = plumb("--help").stdout
    names = re.findall(r"^  ([a-z]+)\b", shown, re.MULTILINE)
    assert set(names) == {*COMMANDS, *LACKING, "lab"}, shown


# One after the other in a single program: to load the numerics takes longer than any of them.
EACH = """
import contextlib, io, json, sys
from plumb.cli.main import main

ended = {}
for name, words in json.loads(sys.argv[1]).items():
    said, complaint = (io.TextIOWrapper(io.BytesIO(), write_through=True) for _ in range(2))
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complaint):
        code = main([name, *words])
    ended[name] = code, *(each.buffer.getvalue().decode() for each in (said, complaint))
json.dump(ended, sys.stdout)
"""


def every_command_runs_or_says_what_it_lacks(plumb):
    done = plumb(json.dumps({**COMMANDS, **LACKING}), program=["-c", EACH])
    assert done.returncode == 0, done.stderr
    ended = json.loads(done.stdout)
    for name in COMMANDS:
        code, said, complaint = ended[name]
        assert code in (0, 1) and said, f"{name}: {code}: {complaint}"
    for name in LACKING:
        code, _, complaint = ended[name]
        assert code == 2 and re.match(r"plumb: (marks\.nc|none|none\.hex): ", complaint), name


def the_lab_is_served_with_its_page(plumb):
    served = plumb(
        "lab",
        "--no-browser",
        "--port",
        "0",
        start=partial(subprocess.Popen, stdout=subprocess.PIPE),
    )
    try:
        address = [served.stdout.readline() for _ in range(2)][1].partition("?")[0]
        page = urlopen(address, timeout=120).read().decode()
        assert '<div id="lab">' in page
        for name in re.findall(r'(?:src|href)="\./([^"]+)"', page):
            assert len(urlopen(address + name, timeout=120).read()) > 1000, name
    finally:
        served.send_signal(signal.SIGINT)
        assert served.wait(20) == 0


def test_a_wheel_works_in_an_empty_folder(wheel, plumb):
    """In a single test: another worker would build the wheel once more."""
    with zipfile.ZipFile(wheel) as archive:
        assert {"plumb/cli/answers.schema.json", "plumb/py.typed"} <= {*archive.namelist()}
        name = next(n for n in archive.namelist() if n.endswith("METADATA"))
        assert "Requires-Python: >=3.11" in archive.read(name).decode()
    every_command_is_tried(plumb)
    every_command_runs_or_says_what_it_lacks(plumb)
    the_lab_is_served_with_its_page(plumb)
