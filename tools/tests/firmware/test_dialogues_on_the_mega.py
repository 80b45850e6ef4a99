"""Every dialogue of test/dialogues, played by the flashed program on the simulated Mega.

The host's build of the firmware plays the same files in test/test_dialogues.
"""

import subprocess
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
ELF = ROOT / ".pio/build/megaatmega2560/firmware.elf"
BUILD = ROOT / ".build/vm"
DIALOGUES = ROOT / "test/dialogues"
# The simulated shield is v1.2, whose drivers have no error pins.
ON_OTHER_SHIELDS = {"driver_error.nc"}
NAMES = sorted({path.name for path in DIALOGUES.glob("*.nc")} - ON_OTHER_SHIELDS)
PARTS = [
    "test/vm/play_dialogues.cpp",
    "test/vm/mega_stage.cpp",
    "tools/vm/mega/virtual_board.cpp",
    "test/test_dialogues/stage.cpp",
    "test/test_dialogues/stage_questions.cpp",
    *sorted(ROOT.glob("tools/judge/reference/*.cpp")),
]
INCLUDES = [
    *(f"-I{folder}" for folder in ("src", "test", "tools/vm", "tools/vm/host_avr", "tools/judge")),
    *(f"-I{path.relative_to(ROOT)}" for path in sorted(ROOT.glob("lib/*/src"))),
]


@pytest.fixture(scope="module")
def player() -> Path:
    """The program that plays a dialogue on the simulated board; the firmware is built too."""
    # Other tests and the bench, which may run at the same time, build it too.
    pio = ["flock", ROOT / ".pio", ROOT / ".venv/bin/pio"]
    subprocess.run([*pio, "run", "-s", "-d", ROOT, "-e", "megaatmega2560"], check=True)
    BUILD.mkdir(parents=True, exist_ok=True)
    program = BUILD / "play_dialogues"
    strict = ["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror"]
    eigen = ["-isystem", "/usr/include/eigen3"]
    libraries = ["-lsimavr", "-lelf"]
    command = ["g++", *strict, *INCLUDES, *eigen, *PARTS, *libraries, "-o", program]
    subprocess.run(command, check=True, cwd=ROOT)
    return program


def play(program: Path, folder: Path, name: str) -> subprocess.CompletedProcess:
    command = [program, ELF, folder, name]
    return subprocess.run(command, capture_output=True, text=True, timeout=1500)


@pytest.fixture(scope="module")
def played(player, request) -> dict[str, Future]:
    """The end of each dialogue that was asked for; two at a time, as each takes up to minutes."""
    calls = [item.callspec for item in request.session.items if hasattr(item, "callspec")]
    asked = {call.params["name"] for call in calls if call.params.get("name") in NAMES}
    pool = ThreadPoolExecutor(2)
    yield {name: pool.submit(play, player, DIALOGUES, name) for name in sorted(asked)}
    pool.shutdown(cancel_futures=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_flashed_program_answers_as_written(played, name):
    done = played[name].result()
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_the_player_notices_what_is_wrong(player, tmp_path):
    wrong = [
        "<- PCB v1.3 Detected",
        "<* ok\n~~ wait 1\n~~ on left",
        "<* ok\n~~ wait 1\n~~ laser high",
    ]
    for i, text in enumerate(wrong):
        (tmp_path / f"{i}.nc").write_text(text)
        assert play(player, tmp_path, f"{i}.nc").returncode == 1
    assert play(player, tmp_path, "absent.nc").returncode == 2
