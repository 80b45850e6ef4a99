"""Faults strike a virtual machine: it stops in time, says so, and never believes a wrong place."""

from dataclasses import replace

import numpy as np
import pytest
from fault_stories import FAULTS, UNSEEN, Fault, nothing
from faults import faults_named, page, tried_all
from trial import are_kept, farthest_from, length_of, tried

# [mm] of the bit's way after which it stands, where the machine stops a job.
STOPS_WITHIN = {
    "power cut in mid-move": 8.0,
    "12 V gone, processor on USB": 8.0,
    "encoder unplugged": 8.0,
    "channel of an encoder lost": 15.0,
    "driver too hot: it complains and lets go": 12.0,
    "motor unplugged": 12.0,
    "motor blocked": 12.0,
    "motor wired in reverse": 15.0,
    "encoder wired in reverse": 15.0,
    "client opens the line again": 8.0,
    "ctrl-X": 3.0,
    "Stop": 3.0,
}
# The machine cannot help but notice these.
CERTAIN = {*STOPS_WITHIN, "5 V sags below 4.3 V", "motor of z blocked"} - {"Stop"}


def fault_named(name: str) -> Fault:
    return faults_named([name])[0]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_no_fault_makes_a_machine_believe_a_wrong_place(fault):
    outcome = tried(fault, 3)
    assert outcome.struck, outcome
    assert not outcome.is_false, outcome
    assert outcome.settings_kept
    if fault.name in CERTAIN:
        assert outcome.noticed, outcome
    if fault.name in STOPS_WITHIN:
        assert outcome.stopped
        assert 0 < outcome.went_on < STOPS_WITHIN[fault.name]


@pytest.mark.parametrize("fault", UNSEEN, ids=lambda fault: fault.name)
def test_what_no_encoder_sees_is_a_false_belief(fault):
    outcome = tried(fault, 3)
    assert outcome.is_false
    assert not outcome.noticed


def test_a_machine_without_a_fault_keeps_its_way():
    outcome = tried(Fault("nothing", nothing), 4)
    assert not outcome.noticed and not outcome.stopped
    assert outcome.off < 0.05 and outcome.astray < 0.05


@pytest.mark.parametrize("seed", range(4))
def test_power_may_go_at_a_byte(seed):
    """The mark of motion, a setting, its copy, a position."""
    fault = fault_named("power cut at a byte")
    outcome = tried(fault, 15 + 17 * seed)
    assert outcome.stopped and not outcome.is_false and outcome.settings_kept


def test_a_setting_that_changed_by_itself_is_seen():
    before = {"8": "139.1", "9": "2000"}
    assert are_kept(before, before, [])
    assert are_kept(before, {**before, "9": "1500"}, ["$9=1500"])
    assert not are_kept(before, {**before, "9": "1501"}, ["$9=1500"])
    assert not are_kept(before, {"8": "139.1"}, [])


def test_ways_are_compared_by_their_places():
    way = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 5.0]])
    assert length_of(way) == pytest.approx(15.0)
    assert length_of(way[:1]) == 0
    assert farthest_from(way, np.array([[5.0, 0.0], [7.0, -2.0]])) == pytest.approx(2.0, abs=0.01)


def test_the_page_says_what_was_lost():
    fault = fault_named("Stop")
    report = tried_all([fault, fault_named("chain climbs")], tries=1, seed=3)
    assert report.is_well
    text = page(report)
    assert "| Stop | 1 | 0 |" in text and "plumb slip" in text
    row = report.rows[0]
    wrong = replace(row, outcomes=(replace(row.outcomes[0], astray=0.6),))
    assert not replace(report, rows=(wrong,)).is_well
    lost = replace(row, outcomes=(replace(row.outcomes[0], settings_kept=False),))
    assert not replace(report, rows=(lost,)).is_well


def test_an_unknown_fault_is_refused():
    with pytest.raises(ValueError, match="no fault is called 'rust'"):
        faults_named(["rust"])


@pytest.mark.parametrize(
    "name",
    [
        "power cut in",
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("encoder edges", "encoder unplugged", "main program", "client opens")
        ),
    ],
)
def test_the_flashed_program_believes_no_wrong_place(elf, name):
    outcome = tried(fault_named(name), 5, elf=elf)
    assert outcome.struck and not outcome.is_false and outcome.settings_kept, outcome
    # A main program may be late without harm.
    assert outcome.noticed or name == "main program", outcome
