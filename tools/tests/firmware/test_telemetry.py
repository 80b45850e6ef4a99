"""The telemetry line: what is read from a log, and what an owner should look at."""

import json

import pytest
from plumb.cli import main as cli

WELL = (
    "error:0.094,0.074,0.002|dry:0|tick:1208|illegal:0,0,0|supply:5.01,4.96|eeprom:ok|start:usual"
    "|events:2,0,5,1|last:supply,8|slips:0,0|slipped:none,0,0,0"
)


@pytest.fixture
def ask(tmp_path, capsys):
    """Exit code, standard output and standard error for a log with one line."""

    def asked(fields: str, *options: str) -> tuple[int, str, str]:
        log = tmp_path / "log.txt"
        log.write_text(f"-> B30\nB30\n[Telemetry|{fields}]\nok\n")
        code = cli.main(["telemetry", str(log), *options])
        said = capsys.readouterr()
        return code, said.out, said.err

    return asked


def test_a_machine_that_is_well_is_called_well(ask):
    code, said, _ = ask(WELL)
    assert code == 0
    assert "left 0.09  right 0.07  z 0.00 mm" in said
    assert "5.01 V, lowest 4.96 V" in said
    assert said.endswith("All is well.\n")
    assert max(map(len, said.splitlines())) <= 80


@pytest.mark.parametrize(
    ("was", "now", "hint"),
    [
        ("error:0.094", "error:1.010", "left chain fell 1.01 mm behind"),
        ("0.074", "1.010", "right chain fell 1.01 mm behind"),
        ("0.002", "1.010", "z axis fell 1.01 mm behind"),
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
def test_each_figure_that_is_off_is_one_warning(ask, was, now, hint):
    code, said, _ = ask(WELL.replace(was, now), "--json")
    (warning,) = json.loads(said)["warnings"]
    assert code == 1
    assert hint in warning
    # What an owner reads is wrapped, and says the same.
    assert hint in " ".join(ask(WELL.replace(was, now))[1].split())


@pytest.mark.parametrize(
    ("was", "now"),
    [("0.094", "1.000"), ("tick:1208", "tick:5000"), ("4.96", "4.50")],
)
def test_a_figure_at_its_bound_is_no_warning(ask, was, now):
    assert ask(WELL.replace(was, now))[0] == 0


def test_the_bounds_follow_the_settings(ask):
    assert ask(WELL.replace("0.094", "1.010"), "--limit", "3")[0] == 0
    assert ask(WELL.replace("1208", "2501"), "--rate", "200")[0] == 1


def test_what_ever_went_wrong_is_told_and_is_no_warning(ask):
    code, said, _ = ask(WELL)
    assert code == 0
    assert "2 brown-outs, 0 hangs, 5 low supplies, 1 driver error" in said
    assert "low supply, number 8" in said
    hint = json.loads(ask(WELL, "--json")[1])
    assert hint["events"] == [2, 0, 5, 1]
    assert (hint["last_event"], hint["total_events"]) == ("supply", 8)
    nothing = WELL.replace("2,0,5,1", "0,0,0,0").replace("supply,8", "none,0")
    assert "never any" in ask(nothing)[1]


@pytest.mark.parametrize(
    ("slips", "last", "hint"),
    [
        (
            "1,0",
            "left,-312,120,341",
            "Look at the left chain: a motor's load fell away for a moment, once since power-on, "
            "the last time on the left near x -312, y 120 mm, 5 minutes ago.",
        ),
        (
            "0,2",
            "right,5,-6,59",
            "Look at the right chain: a motor's load fell away for a moment, 2",
        ),
        ("1,2", "left,5,-6,59", "Look at both chains"),
        ("0,2", "right,5,-6,59", "near x 5, y -6 mm, 59 s ago"),
        ("0,2", "right,5,-6,60", "1 minute ago"),
        ("0,2", "right,5,-6,7300", "2 hours ago"),
    ],
)
def test_a_chain_that_may_have_slipped_is_to_be_looked_at(ask, slips, last, hint):
    line = WELL.replace("slips:0,0", f"slips:{slips}").replace("none,0,0,0", last)
    (warning,) = json.loads(ask(line, "--json")[1])["warnings"]
    assert hint in warning
    code, said, _ = ask(line)
    assert code == 1
    assert hint in " ".join(said.split())


def test_a_firmware_that_does_not_watch_for_slips_is_well(ask):
    code, said, _ = ask(WELL.partition("|slips")[0], "--json")
    assert (code, json.loads(said)["last_slip"]) == (0, None)


def test_the_last_line_of_a_log_counts(ask):
    code, said, _ = ask(f"{WELL.replace('dry:0', 'dry:9')}]\n[Telemetry|{WELL}")
    assert (code, "All is well." in said) == (0, True)


@pytest.mark.parametrize(
    "fields",
    [
        "",
        WELL.replace("dry:0|", ""),
        WELL.replace("5.01,4.96", "5.01"),
        WELL.replace("1208", "12o8"),
        WELL.replace("eeprom:ok", "eeprom:?"),
        WELL.replace("start:usual", "start:later"),
        WELL.replace("events:2,0,5,1", "events:2,0,5"),
        WELL.replace("last:supply", "last:flood"),
        WELL.replace("slips:0,0", "slips:0"),
        WELL.replace("slipped:none", "slipped:z"),
        WELL.replace("|slipped:none,0,0,0", ""),
    ],
)
def test_a_damaged_line_is_refused(ask, fields):
    code, said, error = ask(fields)
    assert (code, said) == (2, "")
    assert "the last telemetry line is damaged" in error
    assert error.count("\n") == 1


def test_a_log_without_telemetry_is_refused(tmp_path, capsys):
    log = tmp_path / "log.txt"
    log.write_text("ok\n")
    assert cli.main(["telemetry", str(log)]) == 2
    assert "no [Telemetry|...] line; send B30" in capsys.readouterr().err
