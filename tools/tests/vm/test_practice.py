"""Practice: a secret in a folder, a machine that a tape reads, and what an answer is worth."""

import json
import signal
from dataclasses import replace

import pytest
from plumb.bench.boards import MAKER, Hidden
from plumb.cli.main import main
from plumb.cli.practice import _Reader
from plumb.marks.read import read_marks
from plumb.vm.garage import BLANK, Garage, sled_error
from plumb.vm.practice import Secret, score, secret_in
from served_machine import INTERRUPTIBLE, PLUMB, plumb
from systems import ON_POSIX

GRID = ("grid", "--places=-1119,510 1119,510 1119,-510 -1119,-510")


@pytest.fixture
def machine(tmp_path):
    """The machine of the folder game, with seed 7."""
    words = ("practice", "start", "game", "--seed", "7", "--speed", "30")
    program = INTERRUPTIBLE([*PLUMB, *words], cwd=tmp_path)
    while not (tmp_path / "game/port").is_symlink():
        assert program.poll() is None, "no machine"
    yield tmp_path / "game"
    program.send_signal(signal.SIGINT)
    assert program.wait() == 0


@ON_POSIX
def test_a_practice_is_cut_read_and_revealed_with_the_commands_of_a_machine(machine, tmp_path):
    plumb(*GRID, "--output", "game/grid.nc", "--marks", "game/marks.toml", folder=tmp_path)
    plumb("send", "game/grid.nc", "--port", "game/port", folder=tmp_path)
    marks = read_marks(machine / "marks.toml", sheet=MAKER.sheet)
    assert len(marks.measured_marks) == 4
    assert abs(marks.measured - marks.targets).max() > 2
    # What is hidden shows, and nothing says it.
    assert not any("sled_swing" in path.read_text() for path in machine.glob("*.*"))
    inputs = ("game/machine.toml", "game/marks.toml")
    words = ("--effect", "sled_swing", "--client", "none", "-o", "game/new.toml")
    plumb("add", *inputs, *words, folder=tmp_path)
    said = plumb("practice", "reveal", "game", "game/new.toml", folder=tmp_path)
    assert "Hidden was sled_swing" in said and "You found" in said
    again = ("practice", "reveal", "game", "game/new.toml", "--json")
    score = json.loads(plumb(*again, folder=tmp_path))
    assert score["named"] == ["sled_swing"] and not score["missed"] and not score["false"]
    assert score["after_mm"] < 0.5 * score["before_mm"]
    # Settings that were left as they are find nothing.
    assert "You missed" in plumb("practice", "reveal", "game", folder=tmp_path, code=1)


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["reveal", "nowhere"], "holds no secret; begin: plumb practice start nowhere"),
        (["reveal", "broken"], "is not a secret"),
        (["start", "game", "--seed", "2"], "holds a secret already"),
        (["start", "theirs"], "holds a machine.toml"),
        (["start", "game", "--json"], "--json goes with reveal"),
        (["hint", "game"], "give start, reveal"),
    ],
)
def test_refusals(words, complaint, here, capsys):
    for name, text in (("broken", "{}"), ("game", Secret(1).text)):
        (here / name).mkdir()
        (here / name / "practice.json").write_text(text)
    (here / "theirs").mkdir()
    (here / "theirs/machine.toml").write_text("")
    assert main(["practice", *words]) == 2
    assert complaint in capsys.readouterr().err


def test_a_secret_is_drawn_by_its_seed_and_kept(tmp_path):
    secrets = [Secret(seed) for seed in range(20)]
    assert len({secret.garage.hidden.effects for secret in secrets}) >= 4
    for secret in (Secret(3), Secret(4, 5.0, ()), Secret(4, 5.0, ("chain_sag",))):
        (tmp_path / "practice.json").write_text(secret.text)
        assert secret_in(tmp_path) == secret
        assert secret_in(tmp_path).garage.hidden == secret.garage.hidden
    assert secret.garage.hidden.effects == ("chain_sag",)


def test_the_error_over_the_sheet_is_nothing_where_the_settings_are_true():
    assert sled_error(Garage(Hidden()), MAKER) < 0.02
    assert sled_error(Secret(1).garage, MAKER) > 1
    assert score(Secret(1), replace(MAKER, motor_height=100.0)).after_mm is None


def test_the_same_form_again_waits_for_its_marks_to_be_cut_again(tmp_path):
    tape = CountingTape()
    reader = _Reader(tmp_path, tape)
    for _ in range(2):
        (tmp_path / "marks.toml").write_text(f'[[mark]]\nname = "1"\n{BLANK}\n')
        reader.look(machine=None)
        reader.look(machine=None)
    assert tape.passed_over == 2


class CountingTape:
    """A tape that reads at once, and counts the forms for which it left older marks."""

    passed_over = 0

    def pass_over(self, machine):
        self.passed_over += 1

    def fill_when_cut(self, form, machine):
        return form.replace(BLANK, "measured = [1, 2]")
