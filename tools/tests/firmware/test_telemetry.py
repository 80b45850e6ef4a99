"""The telemetry line: what is read from an answer, and what an owner should look at."""

import pytest
from plumb.firmware.telemetry import telemetry_in, warnings

WELL = (
    "error:0.094,0.074,0.002|dry:0|tick:1208|illegal:0,0,0|supply:5.01,4.96|eeprom:ok|start:usual"
    "|events:2,0,5,1|last:supply,8|slips:0,0|slipped:none,0,0,0"
)


def looks(fields, rate_hz=100):
    """The warnings for the last line of an answer."""
    return [*warnings(telemetry_in(f"B30\n[Telemetry|{fields}]\nok\n"), rate_hz=rate_hz)]


@pytest.mark.parametrize(
    ("was", "now", "hint"),
    [
        ("dry:0", "dry:3", "waited for the next set-point 3 times"),
        ("tick:1208", "tick:5001", "took 5001 us of 10000 us"),
        ("illegal:0,0,0", "illegal:4,0,0", "left chain made 4 illegal steps"),
        ("illegal:0,0,0", "illegal:0,5,0", "right chain made 5 illegal steps"),
        ("illegal:0,0,0", "illegal:0,0,6", "z axis made 6 illegal steps"),
        ("4.96", "4.49", "5 V fell to 4.49 V"),
        ("eeprom:ok", "eeprom:worn", "no longer keeps what is written"),
        ("start:usual", "start:brown-out", "its 5 V broke down"),
        ("start:usual", "start:watchdog", "the firmware hung"),
    ],
)
def test_each_figure_that_is_off_is_one_warning(was, now, hint):
    (warning,) = looks(WELL.replace(was, now))
    assert hint in warning


@pytest.mark.parametrize(("was", "now"), [("tick:1208", "tick:5000"), ("4.96", "4.50")])
def test_a_figure_at_its_bound_is_no_warning(was, now):
    assert looks(WELL.replace(was, now)) == []


def test_the_bound_of_a_tick_follows_the_rate():
    assert looks(WELL.replace("1208", "2501")) == []
    assert len(looks(WELL.replace("1208", "2501"), rate_hz=200)) == 1


@pytest.mark.parametrize(
    ("slips", "last", "hint"),
    [
        (
            "1,0",
            "left,-312,120,341",
            "Look at the left chain: a motor's load fell away for a moment, once since power-on, "
            "the last time on the left near x -312, y 120 mm, 5 minutes ago.",
        ),
        ("0,2", "right,5,-6,59", "Look at the right chain: a motor's load fell away for a moment"),
        ("1,2", "left,5,-6,59", "Look at both chains"),
        ("0,2", "right,5,-6,59", "near x 5, y -6 mm, 59 s ago"),
        ("0,2", "right,5,-6,60", "1 minute ago"),
        ("0,2", "right,5,-6,7300", "2 hours ago"),
    ],
)
def test_a_chain_that_may_have_slipped_is_a_warning(slips, last, hint):
    (warning,) = looks(WELL.replace("slips:0,0", f"slips:{slips}").replace("none,0,0,0", last))
    assert hint in warning


def test_the_last_line_of_an_answer_counts():
    assert looks(f"{WELL.replace('dry:0', 'dry:9')}]\n[Telemetry|{WELL}") == []


@pytest.mark.parametrize(
    "fields",
    [
        "",
        WELL.replace("dry:0|", ""),
        WELL.replace("5.01,4.96", "5.01"),
        WELL.replace("1208", "12o8"),
        WELL.replace("eeprom:ok", "eeprom:?"),
        WELL.replace("start:usual", "start:later"),
        WELL.replace("slips:0,0", "slips:0"),
        WELL.replace("slipped:none", "slipped:z"),
        WELL.replace("|slipped:none,0,0,0", ""),
    ],
)
def test_a_damaged_line_is_ignored(fields):
    assert telemetry_in(f"[Telemetry|{fields}]") is None
