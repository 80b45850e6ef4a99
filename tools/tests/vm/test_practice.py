"""Practice: a game in a folder, what it costs, what it tells, and games that the lab plays."""

import json
import re
from dataclasses import replace
from types import SimpleNamespace

import games
import numpy as np
import pytest
from game import Played, chosen_in, claimed_in, is_solved, play
from game_rates import row_of, rows_of
from matrix_page import page
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.cli.main import main
from plumb.grid.options import Grid
from plumb.marks.read import read_marks
from plumb.plan.planned_visits import sent
from plumb.settings.files import read_settings
from plumb.text.errors import InputError
from plumb.vm.budget import Budget, Spent, cutting, reading
from plumb.vm.floor import sled_error
from plumb.vm.garage import Garage, random_garage
from plumb.vm.hiding import astray
from plumb.vm.owner import VirtualOwner
from plumb.vm.practice import Practice, claims_of, hint
from plumb.vm.secret import KINDS, LARGEST, LEVELS, Secret, of_kind, of_level

# One hidden effect, and two.
CAUSES_OF = (causes_of("chain_sag"), (*causes_of("chain_sag"), causes_of("chain_pitch")[0]))


@pytest.fixture
def step(capsys, tmp_path):
    """Takes a step of the game in a folder; gives exit code, output and complaint."""

    def take(name, *words):
        code = main(["practice", name, str(tmp_path / "game"), *map(str, words)])
        said = capsys.readouterr()
        return code, said.out, said.err

    return take


def game_of(tmp_path):
    return json.loads((tmp_path / "game/game.json").read_text())


def test_a_game_is_played_in_a_folder(step, tmp_path, capsys):
    folder = tmp_path / "game"
    assert step("start", "--level", "1", "--seed", "1")[0] == 0
    code, said, _ = step("measure", "3x3")
    assert code == 0 and "9 marks were cut and read" in said and "Left: 36 marks" in said
    marks = read_marks(folder / "marks.toml", sheet=MAKER.sheet)
    assert len(marks.measured_marks) == 9 and marks.tape_sigma == 0.4
    # What is hidden shows, and nothing says it.
    errors = np.linalg.norm(marks.measured - marks.targets, axis=1)
    assert errors.max() > 4
    hidden = of_level(1, 1).hidden.effects[0]
    assert not any(hidden in path.read_text() for path in folder.iterdir())
    assert game_of(tmp_path)["spent"] == {"marks": 9, "minutes": 3 + 9 * 1.5}
    new = folder / "new.toml"
    added = ["add", folder / "machine.toml", folder / "marks.toml", "--effect", hidden, "-o", new]
    assert main([str(word) for word in added]) == 0
    capsys.readouterr()
    code, said, _ = step("solve", folder / "new.toml")
    assert code == 0 and f"Hidden was {hidden}" in said and "You found" in said
    before, after = (
        float(re.search(rf"{words} +([\d.]+)", said)[1])
        for words in ("as the settings were", "yours")
    )
    assert after < 0.2 * before
    # Settings that were left as they are find nothing.
    code, said, _ = step("solve", folder / "machine.toml")
    assert code == 1 and "You missed" in said


def test_marks_of_a_form_are_added_and_may_be_read_again(step, tmp_path):
    folder = tmp_path / "game"
    step("start", "--level", "2", "--seed", "4")
    assert step("measure", "2x2")[0] == 0
    form = tmp_path / "more.toml"
    form.write_text(
        'frame = "sheet-top-left"\n[[mark]]\nname = "a"\ntarget = [1200, 600]\n'
        "sled_weight_n = 147.0\napproach = [1.0, 0.0]\n# measured = [ , ]\n"
    )
    assert step("measure", form)[0] == 0
    spent = game_of(tmp_path)["spent"]
    # A round of four marks, and a round of a mark with a weight on the sled.
    assert spent == {"marks": 5, "minutes": (3 + 4 * 1.5) + (3 + 1.5 + 4)}
    assert step("read", "a", "1")[0] == 0
    marks = read_marks(folder / "marks.toml", sheet=MAKER.sheet).marks
    # The machine goes to and fro.
    assert [mark.name for mark in marks] == ["1", "2", "4", "3", "a", "a", "1"]
    old, new = marks[4], marks[5]
    assert old.target == new.target and old.approach == new.approach
    assert old.sled_weight == new.sled_weight == 147.0
    assert 0 < np.hypot(*np.subtract(old.measured, new.measured)) < 3
    assert game_of(tmp_path)["spent"]["minutes"] == spent["minutes"] + 2 * 0.75
    assert "no mark on the sheet has that name" in step("read", "b")[2]


def test_a_slip_is_in_the_first_reading_only(step, tmp_path):
    step("start", "--level", "5", "--seed", "3")
    step("measure", "2x2")
    step("read", "1", "2", "4", "3")
    marks = read_marks(tmp_path / "game/marks.toml", sheet=MAKER.sheet).measured
    apart = np.linalg.norm(marks[:4] - marks[4:], axis=1)
    assert (apart > 6).sum() == 1 and (apart < 3).sum() == 3
    # The next marks are read right: cut at the same targets, they lie beside the first.
    step("measure", "2x2")
    marks = read_marks(tmp_path / "game/marks.toml", sheet=MAKER.sheet).measured
    assert (np.linalg.norm(marks[4:8] - marks[8:], axis=1) < 3).all()


def test_a_direct_measurement_costs_minutes_and_is_told_to_the_lab(step, tmp_path):
    step("start", "--seed", "2")
    code, said, _ = step("check", "motor_gap")
    value = float(re.search(r"motor_gap=([\d.]+)\+-1\b", said)[1])
    assert code == 0 and abs(value - random_garage(Hidden(), 2).motor_gap) < 4
    assert game_of(tmp_path)["spent"] == {"marks": 0, "minutes": 10.0}
    assert "chain_pitch.left=" in step("check", "chain_pitch")[1]
    assert "motor_gap" in step("check", "motor_gip")[2]


def test_hints_get_clearer_and_cost_minutes():
    game = Practice(3, 5)
    hidden = of_level(3, 5).hidden.effects
    hints = []
    for _ in range(3):
        game, said = hint(game)
        hints.append(said)
    assert game.spent.minutes == 30 and game.hints == 3
    assert not any(name in hints[0] for name in hidden)
    assert all(name in hints[1] for name in hidden) and hints[1].count(",") == 2
    assert all(name in hints[2] for name in hidden)
    with pytest.raises(InputError, match="all 3 hints"):
        hint(game)


def test_what_the_budget_does_not_allow_is_refused_and_not_done(step, tmp_path):
    step("start", "--seed", "2")
    before = game_of(tmp_path)
    code, _, complaint = step("measure", "7x7")
    assert code == 2 and "49 marks" in complaint and "45 marks" in complaint
    assert game_of(tmp_path) == before and not (tmp_path / "game/marks.toml").exists()
    assert Budget(4, 9.0).allows(Spent(4, 9.0))
    assert not Budget(4, 9.0).allows(Spent(5, 9.0))
    assert not Budget(4, 9.0).allows(Spent(4, 9.1))
    assert cutting([98.0, 98.0], 98.0) == Spent(2, 6.0) and reading(2) == Spent(0, 1.5)


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ([], "name a step"),
        (["measure", "nowhere", "3x3"], "holds no game"),
        (["measure", "game"], "name a form, or a grid like 5x5"),
        (["measure", "game", "0x3"], "0x3"),
        (["solve", "game"], "name the new machine.toml"),
        (["read", "game"], "name the marks"),
        (["start", "game"], "holds a game already"),
        (["start", "other", "--level", "7"], "give 1, 2, 3, 4, 5"),
    ],
)
def test_refusals(words, complaint, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["practice", "start", "game", "--seed", "1"]) == 0
    capsys.readouterr()
    assert main(["practice", *words]) == 2
    assert complaint in capsys.readouterr().err


def test_a_file_that_is_no_game_is_refused(tmp_path, capsys):
    tmp_path.joinpath("game.json").write_text('{"level": 9, "seed": 1}')
    assert main(["practice", "hint", str(tmp_path)]) == 2
    assert "is no game" in capsys.readouterr().err


def test_a_seed_hides_the_same_and_levels_hide_what_they_say():
    for level in LEVELS:
        assert of_level(level, 7).hidden.effects == of_level(level, 7).hidden.effects
    counts = [{len(of_level(level, seed).hidden.effects) for seed in range(9)} for level in LEVELS]
    assert counts == [{1}, {1}, {2}, {0}, {1}]
    assert {of_level(4, seed).hidden.outside for seed in range(9)} == {
        "bump",
        "cubic",
        "tipping sled",
    }
    assert [level for level in LEVELS if of_level(level, 1).slip] == [5]
    assert len({of_level(2, seed).hidden.effects for seed in range(20)}) >= 4


def test_each_kind_of_the_matrix_hides_what_it_is_called():
    for kind in KINDS:
        hidden = of_kind(kind, 2).hidden
        assert all(size <= LARGEST for _, size in hidden.causes) or kind == "two"
        if kind not in ("two", "none", "unknown"):
            assert hidden.effects == (kind,)
    assert of_kind("none", 2).hidden == Hidden()
    assert len({*of_kind("two", 2).hidden.effects}) == 2
    assert of_kind("unknown", 2).hidden.outside


def test_what_no_effect_explains_moves_marks_by_its_size_and_alike_everywhere():
    hidden = Hidden(outside="bump", outside_mm=3.0)
    across, up = np.meshgrid(np.linspace(-1100, 1100, 5), np.linspace(-500, 500, 5))
    places = np.stack([across.ravel(), up.ravel()], axis=1)
    moved = astray(hidden, places, 4)
    assert np.sqrt(np.mean(np.sum(moved**2, axis=1))) == pytest.approx(3.0)
    # A place is moved alike whatever else is asked about.
    assert astray(hidden, places[7:8], 4) == pytest.approx(moved[7:8])
    assert not astray(Hidden(), places, 4).any()
    garage = Garage(hidden, seed=4)
    assert garage.read(places) == pytest.approx(places + moved)


def test_the_error_over_the_sheet_is_nothing_where_the_settings_are_true():
    assert sled_error(Garage(Hidden()), MAKER) < 0.02
    assert sled_error(Garage(of_level(1, 1).hidden), MAKER) > 1


def test_claims_are_the_effects_that_changed(tmp_path):
    path = tmp_path / "machine.toml"
    assert main(["practice", "start", str(tmp_path), "--seed", "1"]) == 0
    believed = read_settings(path)
    assert claims_of(believed, believed) == ()
    text = path.read_text() + "\n[effects.frame_lean]\nsine = 0.02\n"
    path.write_text(text)
    assert claims_of(believed, read_settings(path)) == ("frame_lean",)


def test_the_lab_plays_a_game_and_its_cost_is_counted():
    game = play("x", of_level(1, 1), seed=1, grid=games.SMALL_GRID, budget=Budget())
    (hidden,) = of_level(1, 1).hidden.effects
    assert game.chosen == game.claimed == (hidden,) and game.solved and game.false == 0
    assert game.marks == 9 and game.minutes == 3 + 9 * 1.5
    assert game.sled_after < 0.2 * game.sled_before and game.cut_after < 0.2 * game.cut_before
    # The truth was added, so nobody could do better.
    assert (game.sled_after, game.cut_after) == (game.sled_known, game.cut_known)
    assert game.sled_known < game.sled_frame < game.sled_before


def auto_of(verdict, *chosen, rivals=(), added=True):
    """What add --effect auto answers, as far as a game looks at it."""
    diagnosis = SimpleNamespace(verdict=verdict)
    addition = object() if added else None
    return SimpleNamespace(diagnosis=diagnosis, chosen=chosen, rivals=rivals, addition=addition)


def test_a_claim_has_no_rival_and_friction_is_on_every_machine():
    alone = auto_of("one_suspect", "chain_sag", "sled_friction")
    assert claimed_in(alone) == chosen_in(alone) == ("chain_sag",)
    for unsure in (
        auto_of("cannot_tell", "chain_sag", rivals=(("frame_lean",),)),
        auto_of("not_in_library", "chain_sag"),
    ):
        assert chosen_in(unsure) == ("chain_sag",) and claimed_in(unsure) == ()


def test_a_game_is_solved_by_all_that_is_hidden_and_nothing_else():
    sag, two = (Secret(Hidden(tuple((cause, 1.0) for cause in each))) for each in CAUSES_OF)
    assert is_solved(sag, auto_of("one_suspect", "chain_sag"))
    assert is_solved(sag, auto_of("one_suspect", "sled_friction", "chain_sag"))
    assert not is_solved(sag, auto_of("one_suspect", "chain_sag", "frame_lean"))
    assert not is_solved(two, auto_of("one_suspect", "chain_sag"))
    assert not is_solved(sag, auto_of("slip", "chain_sag", added=False))
    assert is_solved(Secret(Hidden()), auto_of("nothing_provable"))
    unknown = Secret(Hidden(outside="bump", outside_mm=3.0))
    assert is_solved(unknown, auto_of("not_in_library", "chain_sag"))
    assert not is_solved(unknown, auto_of("nothing_provable"))


@pytest.mark.slow
def test_the_lab_reads_a_slip_again_and_then_names_the_effect():
    secret = replace(of_level(1, 1), slip=10.0)
    game = play("x", secret, seed=1, grid=games.LARGE_GRID, budget=Budget())
    assert game.verdict == "one_suspect" and game.solved
    # A reading costs no hole.
    assert game.marks == 25 and game.minutes == 3 + 25 * 1.5 + 0.75


def played(row, seed, *, solved=True, false=0, after=0.2, known=0.1):
    return Played(
        row, seed, "x", "one_suspect", (), (), solved, false, 25, 40.0, 3.0, 1.0, after, known,
        3.0, after, known,
    )  # fmt: skip


def test_rates_are_counted_by_row_with_intervals():
    games = [
        played("a", i, solved=i < 9, false=int(i == 9), after=0.1 * (1 + i)) for i in range(10)
    ]
    row = row_of("a", games)
    share, low, high = row.solved
    # Clopper and Pearson for 9 of 10.
    assert share == 0.9 and (low, high) == pytest.approx((0.555, 0.9975), abs=0.001)
    assert row.false == 1 and row.games == 10
    value, error = row.sled_ratio
    assert value == pytest.approx(5.5) and error == pytest.approx(3.0277 / np.sqrt(10), rel=1e-3)
    assert row.after == pytest.approx(0.1 * np.sqrt(38.5))
    assert row_of("b", games[:1]).solved == (1.0, pytest.approx(0.025), 1.0)
    assert [row.name for row in rows_of([played("b", 1), played("a", 1), played("b", 2)])] == [
        "b",
        "a",
    ]


def test_games_that_are_kept_are_not_played_again(tmp_path, monkeypatch):
    kept, asked = tmp_path / "games.jsonl", []

    def play(task, budget, elf):
        asked.append(task)
        return played(task.row, task.seed)

    monkeypatch.setattr(games.Task, "play", play)
    run = {"budget": Budget(), "elf": None, "kept": str(kept), "jobs": 1}
    tasks = games.level_tasks([1, 3], 2, 5)
    assert [(task.row, task.seed) for task in tasks] == [
        *(("level 1", 5), ("level 3", 5), ("level 1", 6), ("level 3", 6))
    ]
    first = games.played(tasks, **run)
    assert [next(first), next(first)] == [played("level 1", 5), played("level 3", 5)]
    first.close()
    assert len(list(games.played(tasks, **run))) == 4
    assert asked == [*tasks[:2], *tasks[2:]]
    kept.write_text("{}\n")
    with pytest.raises(InputError, match="line 1: is no game"):
        list(games.played(tasks, **run))


def test_the_matrix_asks_for_each_kind_with_25_and_9_marks():
    rows = {task.row for task in games.matrix_tasks(1, 1)}
    assert rows == {f"{kind} {marks}" for kind in KINDS for marks in (25, 9)}


def test_the_page_has_a_row_for_each_cell_and_judges_the_second_sheet():
    games = [
        played("chain_sag 25", 1, after=0.5, known=0.5),
        played("none 9", 1),
        played("chain_sag 25", 2, after=0.9, known=0.5),
        played("motor_level 25", 1, solved=False),
    ]
    said = page(games)
    rows = [line.strip("| ").split(" | ") for line in said.splitlines() if line.startswith("| ")]
    assert [row[:4] for row in rows[2:]] == [
        ["motor_level", "25", "1", "0 % (0 to 98)"],
        ["chain_sag", "25", "2", "100 % (16 to 100)"],
        ["none", "9", "1", "100 % (3 to 100)"],
        ["one that shows", "25", "2", "100 % (16 to 100)"],
        ["all", "25", "3", "67 % (9 to 99)"],
        ["all", "9", "1", "100 % (3 to 100)"],
    ]
    assert rows[3][-1] == "1.40 +- 0.40" and rows[4][-1] == "2.00"
    assert "1.40 +- 0.40 times what the truth" in said and "missed.\n1 of 2 sheets" in said
    assert "reached.\n1 of 1" in page(games[:1])


def test_a_machine_that_halts_is_begun_anew_and_its_sheet_stays():
    owner = VirtualOwner(random_garage(Hidden(), 3))
    owner.switch_on()
    owner.cut_grid(Grid(columns=2, rows=2, repeats=0))
    places = owner.tape.places
    owner.restart()
    assert owner.tape.places == places
    visits = sent(MAKER, np.array([(0.0, 0.0)]), controller="plumb", sled_weight=MAKER.sled_weight)
    form = owner.carry_out(visits)
    assert form.count("\nmeasured = ") == 1 and len(owner.tape.places) == 5
