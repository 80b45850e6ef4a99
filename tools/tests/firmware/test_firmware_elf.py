"""The firmware as it is flashed, on a simulated Mega: its answers, its pins, its cost."""

import subprocess
import sys
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from example_machine import ROOT
from plumb import _core

sys.path.insert(0, str(ROOT / "tools/bench"))
import played as plays
from played import check_board, play, played, ran

VM = ROOT / "test/vm"
DIALOGUES = VM / "dialogues"
TOLERANCE = 0.011  # [mm] two decimals, and a chain count or two
TICK_CYCLES = 160_000  # 10 ms at 16 MHz
CORNERS = [(x, y) for x in (-1219.2, 1219.2) for y in (-609.6, 609.6)]
PLACES = [(0.0, 0.0), (100.0, -50.25), *CORNERS]
RING = {7: 2, 8: 139.1, 63: 0.00137293, 160: 8.2e-12, 170: 5.2e-6}
BOOT = ["<* ok", "<* Settings are the defaults. Chain lengths are not known yet*"]


@pytest.fixture(scope="module")
def player() -> Path:
    """The program that plays dialogues on the simulated board; the firmware is built too."""
    return plays.player()


def figures(done: subprocess.CompletedProcess) -> dict[str, float]:
    assert done.returncode == 0, done.stdout + done.stderr
    pairs = [line.split() for line in done.stdout.splitlines() if len(line.split()) == 2]
    return {name: float(value) for name, value in pairs}


def test_it_boots_keeps_a_setting_over_a_reset_and_moves_its_motors(player):
    counted = figures(played(player, DIALOGUES, "smoke.nc"))
    # A client gives up after two seconds, of which the bootloader takes half.
    assert 0 < counted["first_line_ms"] < 500


@pytest.fixture(scope="module")
def hard(player) -> dict[str, float]:
    """Three axes in motion with sag, stretch and pitch."""
    return figures(played(player, DIALOGUES, "hard.nc"))


def built(tmp_path, compiler, *words):
    """A program for the Mega of these sources, with these options."""
    elf = tmp_path / "program.elf"
    avr = [compiler, "-mmcu=atmega2560", "-DF_CPU=16000000UL", "-Os"]
    subprocess.run([*avr, *words, "-o", elf], check=True)
    return elf


def test_the_simulated_mega_runs_as_a_mega_where_simavr_does_not(tmp_path):
    elf = built(tmp_path, "avr-gcc", VM / "board_program.cpp")
    counted = figures(ran(check_board(), elf))
    assert counted["masked"] == 10  # an interrupt waits behind its mask
    assert counted["taken_back"] == 0  # unless its flag is cleared
    assert counted["edges_low"] == 0  # writing to a port moves no pin that is held from outside
    assert counted["added"] == 5 * (15 + 1) + 5 * 1
    assert (counted["skip_cycles"], counted["add_cycles"]) == (2, 3)


def test_sum_product_and_quotient_are_those_of_avr_libc_and_faster(tmp_path):
    sources = [VM / "float_program.cpp", VM / "float_of_libc.S", ROOT / "src/board/float.S"]
    elf = built(tmp_path, "avr-g++", *sources, "-std=gnu++11")
    counted = figures(ran(check_board(), elf, "5500"))
    assert [counted[name] for name in ("products", "sums", "differences", "quotients")] == [0] * 4
    assert counted["product_cycles"] < 0.85 * counted["product_cycles_of_libc"]
    assert counted["sum_cycles"] < 0.85 * counted["sum_cycles_of_libc"]
    assert counted["quotient_cycles"] < 0.5 * counted["quotient_cycles_of_libc"]


def test_no_control_tick_is_missed_in_motion(hard):
    # From tick to tick: a single tick that did not come leaves two periods between its neighbours.
    assert hard["longest_gap_moving"] <= 1.5 * TICK_CYCLES
    assert hard["longest_gap_streaming"] <= 1.5 * TICK_CYCLES
    # And none comes twice. What is watched begins and ends between two ticks: one more or less.
    assert hard["ticks_per_second_moving"] == pytest.approx(100, abs=0.1)
    assert hard["ticks_per_second_streaming"] == pytest.approx(100, abs=1 / 3.4)


def test_the_control_tick_leaves_88_percent_with_three_axes_in_motion(hard):
    assert hard["tick_share_moving"] <= 0.12
    assert hard["tick_share_streaming"] <= 0.12


def test_the_processor_sleeps_where_the_main_program_waits(hard):
    # Nearly half of the time, with three motors' encoders turning.
    assert hard["sleep_share_moving"] >= 0.44


def test_the_firmware_reports_its_health(hard):
    # The last of two questions: since the first.
    longest_us = hard["longest_tick_streaming"] / 16
    assert longest_us - 20 <= hard["said_tick_0"] <= longest_us + 200  # it counts its delay, too
    assert 0.01 < hard["said_error_0"] < 0.6
    assert hard["said_dry_0"] == 0
    assert [hard[f"said_illegal_{axis}"] for axis in range(3)] == [0, 0, 0]
    assert hard["said_supply_0"] == pytest.approx(5, abs=0.03)


def test_short_moves_are_taken_as_fast_as_a_streaming_sender_gives_them(player):
    counted = figures(played(player, DIALOGUES, "stream.nc"))
    assert counted["lines_per_second"] >= 180
    assert counted["tick_share_streaming"] <= 0.12


def test_a_sender_that_asks_ten_times_a_second_hardly_slows_short_moves(player):
    counted = figures(played(player, DIALOGUES, "asked.nc"))
    assert 9.9 < counted["questions_per_second"] < 10.2
    assert 0 < counted["longest_answer_ms"] <= 100
    assert counted["lines_per_second_asked"] >= 0.9 * counted["lines_per_second"]


def test_every_effect_at_200_hz_leaves_time_for_short_moves(player):
    counted = figures(played(player, DIALOGUES, "every_effect.nc"))
    assert counted["mm_per_minute"] >= 0.9 * 1000


def test_the_loop_runs_at_200_hz_if_a_setting_asks_for_it(player):
    counted = figures(played(player, DIALOGUES, "fast_loop.nc"))
    assert 0.12 < counted["tick_share_streaming"] < 0.3


@pytest.mark.parametrize("dialogue", ["hangs.nc", "held.nc", "stack.nc", "watchdog.nc", "board.nc"])
def test_motors_are_let_go_when_the_firmware_hangs_or_the_board_fails(player, dialogue):
    done = played(player, DIALOGUES, dialogue)
    assert done.returncode == 0, done.stdout + done.stderr


def test_power_lost_in_motion_is_known_and_a_rest_is_kept(player):
    done = played(player, DIALOGUES, "power_cut.nc")
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_shield_is_known_by_its_straps(player):
    done = played(player, DIALOGUES, "shields.nc")
    assert done.returncode == 0, done.stdout + done.stderr


def test_places_are_those_of_the_lab(player, tmp_path):
    numbers = [field["usual"] for field in _core.frame()]
    for effect in _core.effects():
        numbers += [RING.get(parameter["setting"], 0.0) for parameter in effect["parameters"]]
    chains, outcome = _core.lengths(np.array(numbers), True, np.array(PLACES))
    assert not outcome.any()
    lines = list(BOOT)
    for number, value in RING.items():
        lines += [f"-> ${number}={value}", "<- ok"]
    for (x, y), (left, right) in zip(PLACES, chains, strict=True):
        lines += [f"-> B06 L{left:.4f} R{right:.4f}", "<* position loaded at:"]
        lines += [f"<- {x:.2f} within {TOLERANCE}", f"<- {y:.2f} within {TOLERANCE}", "<- ok"]
    (tmp_path / "places.nc").write_text("\n".join(lines))
    done = play(player, tmp_path, "places.nc")
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_player_notices_what_is_wrong(player, tmp_path):
    wrong = [
        "<- PCB v1.3 Detected",
        "<* never said",
        *(
            f"<* ok\n~~ wait 1\n~~ {each}"
            for each in ("paid left", "on left", "laser high", "resets 1")
        ),
    ]
    for i, text in enumerate(wrong):
        (tmp_path / f"{i}.nc").write_text(text)
        assert play(player, tmp_path, f"{i}.nc").returncode == 1
    assert play(player, tmp_path, "absent.nc").returncode == 2


sys.path.insert(0, str(ROOT / "tools/bench"))

SPOKEN = ROOT / "test/dialogues"
NAMES = sorted(path.name for path in SPOKEN.glob("*.nc"))
# Played whenever anything changed: motion, a halt, the memory, the probe.
ALWAYS = {"arcs.nc", "halts.nc", "power_cut.nc", "probe.nc"}


@pytest.fixture(scope="module")
def ends(request) -> dict[str, Future]:
    """The end of each dialogue that was asked for; two at a time, as each takes seconds."""
    calls = [item.callspec for item in request.session.items if hasattr(item, "callspec")]
    asked = {call.params["name"] for call in calls if call.params.get("name") in NAMES}
    player = plays.player()
    pool = ThreadPoolExecutor(2)
    yield {name: pool.submit(played, player, SPOKEN, name) for name in sorted(asked)}
    pool.shutdown(cancel_futures=True)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in ALWAYS else pytest.mark.slow) for name in NAMES]
)
def test_the_flashed_program_answers_as_written(ends, name):
    done = ends[name].result()
    assert done.returncode == 0, done.stderr
