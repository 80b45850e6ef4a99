"""The motor gap from a tight chain: what is taken off, and how well it is known."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from gap_tables import frames, row, tables, trial
from plumb.cli.main import main
from plumb.model.predict import BEYOND, PULL, motor_gap

ROOT = Path(__file__).resolve().parents[3]
WEIGHT = 0.00137293  # [N/mm]
MACHINE = str(ROOT / "docs/example/machine.toml")


def test_a_weightless_stiff_chain_is_as_long_as_the_gap_but_for_its_stretch():
    measured = motor_gap([3000 + BEYOND], chain_weight=0.0, flex=0.0)
    assert measured.gap == pytest.approx(3000 * (1 + 5.17e-6 * PULL))


def test_sag_makes_the_chain_longer_and_flex_the_gap_shorter():
    plain = motor_gap([3000 + BEYOND], chain_weight=WEIGHT, flex=0.0)
    assert plain.sag == pytest.approx(WEIGHT**2 * 3000**3 / (24 * PULL**2))
    assert plain.gap == pytest.approx(3000 - plain.sag + plain.stretch)
    bent = motor_gap([3000 + BEYOND], chain_weight=WEIGHT, flex=2.0)
    assert bent.gap - plain.gap == pytest.approx(0.02 * PULL)


def test_the_drop_says_the_pull_and_makes_the_interval_narrower():
    drop = WEIGHT * 3000**2 / (8 * 60.0)
    by_drop = motor_gap([3000 + BEYOND], chain_weight=WEIGHT, flex=1.0, drop=drop)
    assert by_drop.pull == pytest.approx(60)
    assert by_drop.interval < motor_gap([3000 + BEYOND], chain_weight=WEIGHT, flex=1.0).interval
    by_guess = motor_gap([3000 + BEYOND], chain_weight=WEIGHT, drop=drop)
    assert by_guess.interval > by_drop.interval


def test_three_lengths_count_by_their_mean_and_say_their_spread():
    lengths = [3012.6, 3012.7, 3012.9]
    three = motor_gap(lengths, chain_weight=WEIGHT)
    single = motor_gap([sum(lengths) / 3], chain_weight=WEIGHT)
    assert three.gap == pytest.approx(single.gap)
    assert three.interval < single.interval
    assert three.spread == pytest.approx(0.3)


def test_on_virtual_machines_the_gap_is_within_half_a_millimetre():
    chosen = [frames()[i] for i in (0, 3, 7, 12, 13, 22)]
    measured = [
        trial(frame, drop_error) for frame, drop_error in zip(chosen, (1, -1) * 3, strict=True)
    ]
    for each in measured:
        assert each.by_drop.gap == pytest.approx(each.frame.gap, abs=0.5)
        assert abs(each.by_drop.gap - each.frame.gap) < each.by_drop.interval
        assert abs(each.by_force.gap - each.frame.gap) < each.by_force.interval
        assert f"| {each.frame.gap:.2f} |" in row(each)
    for each in measured[:3]:  # nominal motors pull as stated, whatever the supply
        assert each.by_force.gap == pytest.approx(each.frame.gap, abs=0.55)


def test_the_command_says_the_gap(capsys):
    assert main(["gap", MACHINE, "--length", "2989.29", "2990.10", "--drop", "18.3"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Motor gap 2978" in said
    assert "83 N that the drop says" in said
    assert "The lengths differ by 0.81 mm" in said
    assert "--flex makes it better" in said
    assert "--drop" not in said


def test_the_object_holds_what_the_sentences_say(capsys):
    words = ["gap", MACHINE, "--length", "2989.29", "2990.10", "--json"]
    assert main([*words, "--flex", "1", "--drop", "18.3"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["pull_by"] == "drop" and answer["pull_N"] == pytest.approx(83, abs=0.5)
    assert answer["spread_mm"] == pytest.approx(0.81) and answer["pull_again"] is True
    taken_off = answer["beyond_mm"] + answer["sag_mm"] - answer["stretch_mm"] - answer["flex_mm"]
    assert answer["gap_mm"] == pytest.approx((2989.29 + 2990.10) / 2 - taken_off)
    assert main(["gap", MACHINE, "--length", "2989.29", "2989.79", "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert (answer["pull_by"], answer["pull_N"], answer["pull_again"]) == ("B11", PULL, False)
    assert answer["interval_mm"] > 1


@pytest.mark.slow
def test_the_tables_of_the_page_are_what_the_trials_give():
    page = (ROOT / "docs/commands/gap.md").read_text()
    for table in tables():
        assert table in page, table


@pytest.mark.parametrize(
    "words",
    [["--length", "12"], ["--length", "2989", "--drop", "0"], ["--length", "2989", "--flex=-1"]],
)
def test_what_no_chain_can_be_is_refused(words):
    words = ["gap", MACHINE, *words]
    code = f"import sys; from plumb.cli.main import main; sys.exit(main({words!r}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 2


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["2989.29", "--drop", "183"], "--drop 183: that means a pull of 8 N"),
        (["2989.29", "--drop", "183"], "is it 18.3?"),
        (["2989.29", "--drop", "1.83"], "is it 18.3?"),
        (["2989.29", "--drop", "61.5"], "measure it again"),
        (["2989.29", "--drop", "6"], "measure it again"),
        (["2989.29", "2994.30"], "the lengths differ by 5.01 mm"),
    ],
)
def test_a_number_that_was_misread_is_no_gap(words, complaint, capsys):
    assert main(["gap", MACHINE, "--length", *words]) == 2
    assert complaint in capsys.readouterr().err


@pytest.mark.parametrize("words", [["2989.29", "2994.28"], ["2989", "--drop", "60"]])
def test_what_is_odd_but_possible_is_taken(words):
    assert main(["gap", MACHINE, "--length", *words]) == 0
