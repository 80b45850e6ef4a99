"""Tests of the packages that tools/setup installs, and of its messages without the right to."""

import subprocess
from pathlib import Path

import pytest
from example_machine import ROOT

# The step alone, on a machine where nothing is installed and that this test describes.
STEP = """
set -euo pipefail
root=$1 log=$2
say() { echo "says: $1"; }
stop() { echo "stops: $1"; exit 1; }
dpkg-query() { return 1; }
apt-get() { echo "runs: apt-get $*"; }
env() { shift; "$@"; }
source "$root/tools/steps/debian.sh"
"""
LAB = "g++ cmake python3-dev python3 python3-venv libeigen3-dev ccache"


def step(tmp_path: Path, machine: str, packages: str) -> list[str]:
    """The lines that the step prints, as a user sees them."""
    script = f"{STEP}\n{machine}\nsetup_debian {packages}"
    log = tmp_path / "log"
    done = subprocess.run(["bash", "-c", script, "step", ROOT, log], capture_output=True, text=True)
    assert not done.stderr
    return done.stdout.splitlines() + (log.read_text().splitlines() if log.exists() else [])


def test_root_gets_the_packages_of_the_lab_and_no_others(tmp_path):
    said = step(tmp_path, "id() { echo 0; }", "lab")
    assert said == [
        f"says: installs with apt-get: {LAB}",
        "runs: apt-get update",
        f"runs: apt-get install -y --no-install-recommends {LAB}",
    ]


def test_the_whole_project_needs_the_lab_and_the_firmware_and_the_tests(tmp_path):
    names = step(tmp_path, "id() { echo 0; }", "all")[0].split(": ")[-1].split()
    assert set(LAB.split()) < set(names)
    assert {"gcc-avr", "googletest", "make"} < set(names)
    assert not {"bash", "coreutils"} & set(names)


@pytest.mark.parametrize(
    "machine",
    [
        'id() { echo 1000; }; command() { [ "$2" != sudo ]; }',
        "id() { echo 1000; }; sudo() { echo not in the sudoers file >&2; return 1; }",
    ],
)
def test_without_root_and_sudo_one_line_names_the_packages(tmp_path, machine):
    assert step(tmp_path, machine, "lab") == [
        "stops: an administrator has to install packages first: "
        f"apt-get install --no-install-recommends {LAB}"
    ]


def test_installed_packages_are_left_alone(tmp_path):
    assert step(tmp_path, "dpkg-query() { echo 'ii '; }; id() { echo 0; }", "lab") == []
    missing = "dpkg-query() { if [ $4 = cmake ]; then echo 'rc '; else echo 'ii '; fi; }"
    said = step(tmp_path, f"{missing}; id() {{ echo 0; }}", "lab")
    assert said[0] == "says: installs with apt-get: cmake"


# The step that builds the lab; the compiler finds the libraries that lie in the folder.
BUILD = """
set -euo pipefail
root=$PWD log=log
say() { echo "says: $1"; }
stop() { echo "stops: $1"; exit 1; }
source <(sed -n '/^fingerprint()/,/^}/p; /^same_as()/p' "$1/tools/setup")
source "$1/tools/steps/plumb.sh"
c++() { if [ "$1" = --version ]; then cat compiler; else echo "$PWD/${1#*=}"; fi; }
cmake() { echo cmake; }
setup_plumb
"""


@pytest.fixture
def build(tmp_path):
    """Runs the step in an empty folder and says whether it built the lab."""
    programs = {"python": "cat sources 2>/dev/null || cat ../sources", "pip": 'echo "$*" >>pip.log'}
    for name, script in programs.items():
        program = tmp_path / ".venv/bin" / name
        program.parent.mkdir(parents=True, exist_ok=True)
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
    (tmp_path / "tools").mkdir()
    for name in ("pyproject.toml", "compiler", "sources"):
        (tmp_path / name).write_text(name)

    def step() -> bool:
        command = ["bash", "-c", BUILD, "step", ROOT]
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0 and not done.stderr, done.stderr
        return done.stdout == "says: builds and installs the package plumb\n"

    return step


@pytest.mark.parametrize("change", ["libsimavr.so", "libelf.so", "compiler", "sources"])
def test_the_lab_is_built_again_when_the_machine_or_the_sources_change(build, tmp_path, change):
    assert build() and not build()
    (tmp_path / change).write_text("another")
    assert build() and not build()
    (tmp_path / change).write_text("and another")
    assert build()


def test_an_unknown_set_is_refused_before_anything_happens():
    done = subprocess.run([ROOT / "tools/setup", "lba"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (1, "")
    remedy = "use tools/setup, alone or with lab, senders or windows"
    assert done.stderr == f'setup: knows no set "lba"; {remedy}\n'
