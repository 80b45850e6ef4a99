"""Tests of the pauses of a program, and of what the line knows of them."""

import pytest
from plumb.line.progress import Progress, Wait, waits_in
from plumb.line.worker import LineState


@pytest.mark.parametrize(
    ("program", "waits"),
    [
        ("G21\n(hang 5 kg)\nM0\nG0 X1", [Wait(1, "hang 5 kg")]),
        ("(a title)\nG21\nM0", [Wait(1, "")]),  # a comment belongs to the line that it is before
        ("G21 (first)\nM00 (now)\nM1\n; M0\n(M0)\nG0 X0", [Wait(1, "now"), Wait(2, "")]),
        ("(once)\n\n(twice)\nm0", [Wait(0, "twice")]),
        ("M10\nM0 P1\nM30\nG0 M0", []),
    ],
)
def test_pauses_are_found_with_their_instructions(program, waits):
    assert list(waits_in(program.splitlines())) == waits


def state_of(done, paused_at, *, holds=True, outcome="running"):
    waits = (Wait(3, "hang it"), Wait(7, "take it off"))
    program = Progress("more.nc", done, 9, outcome, waits=waits, paused_at=paused_at)
    return LineState("busy", holds=holds, program=program).waits_for


def test_a_program_waits_for_the_operator_only_in_a_pause():
    assert state_of(3, 3) == "hang it"
    assert state_of(7, 7) == "take it off"
    assert state_of(3, -1) == ""  # held by hand, before the pause began
    assert state_of(3, 3, holds=False) == ""
    assert state_of(5, 3) == ""  # held by hand, after the pause
    assert state_of(3, 3, outcome="stopped") == ""
