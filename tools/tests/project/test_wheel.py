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
from example_machine import ROOT
from plumb.settings import machine_toml, read_settings
from plumb.text.compiled import version
from published_marks import MARKS, SETTINGS

sys.path.insert(0, str(ROOT / "tools/bench"))
from board import built_firmware

PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check"]


SDIST = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"


@pytest.fixture
def wheel(tmp_path_factory):
    """A wheel built from what would be published: sources, and the firmware as it is flashed.

    The compiler's cache knows what the clone's build compiled.
    """
    built_firmware()
    folder = tmp_path_factory.mktemp("wheel")
    packed = [sys.executable, "-c", SDIST, folder]
    subprocess.run(packed, cwd=ROOT, capture_output=True, check=True)
    options = ["--no-deps", "--no-build-isolation", "--wheel-dir", folder]
    source = next(folder.glob("plumb_maslow-*.tar.gz"))
    done = subprocess.run([*PIP, "wheel", *options, source], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return next(folder.glob("plumb_maslow-*.whl"))


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
# What needs files of the package or its compiled parts.
COMMANDS = {
    "calibrate": MEASURED,
    "check": ("job.nc", "groundcontrol.ini"),
    "add": (*MEASURED, "--effect", "chain_pitch", "-o", "fitted.toml"),
    "effects": (),
    "report": (*MEASURED, "-o", "report.html"),
    "settings": ("machine.toml",),
    "vm": ("--seconds", "1"),
    "practice": ("start", "game", "--seconds", "1"),
}


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


def every_command_runs(plumb):
    done = plumb(json.dumps(COMMANDS), program=["-c", EACH])
    assert done.returncode == 0, done.stderr
    for name, (code, said, complaint) in json.loads(done.stdout).items():
        assert code in (0, 1) and said, f"{name}: {code}: {complaint}"


def the_lab_is_served_with_its_page(plumb):
    running = partial(subprocess.Popen, stdout=subprocess.PIPE)
    served = plumb("lab", "--no-browser", "--port", "0", start=running)
    try:
        address = [served.stdout.readline() for _ in range(2)][1].partition("?")[0]
        page = urlopen(address, timeout=120).read().decode()
        assert '<div id="lab">' in page
        for name in re.findall(r'(?:src|href)="\./([^"]+)"', page):
            assert len(urlopen(address + name, timeout=120).read()) > 1000, name
    finally:
        served.send_signal(signal.SIGINT)
        assert served.wait(20) == 0


@pytest.mark.slow
def test_a_wheel_works_in_an_empty_folder(wheel, plumb):
    """In a single test: another worker would build the wheel once more."""
    with zipfile.ZipFile(wheel) as archive:
        licences = [name for name in archive.namelist() if "/licenses/" in name]
        assert {Path(name).name for name in licences} == {"LICENSE", "NOTICE"}
        assert {"plumb/firmware.hex", "plumb/py.typed"} <= {*archive.namelist()}
        name = next(n for n in archive.namelist() if n.endswith("METADATA"))
        metadata = archive.read(name).decode()
        assert metadata.startswith("Metadata-Version: ") and "\n# Plumb\n" in metadata
        assert f"Name: plumb-maslow\nVersion: {version()}\n" in metadata
    every_command_runs(plumb)
    the_lab_is_served_with_its_page(plumb)
