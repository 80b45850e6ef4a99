"""Games that the lab's advice plays: what is hidden, what counts as solved, and their rates."""

from types import SimpleNamespace

import games
import numpy as np
import pytest
from game import Played, chosen_in, claimed_in, is_solved, play
from game_rates import row_of, rows_of
from kinds import KINDS, LARGEST, of_kind
from matrix_page import page
from plumb.bench.boards import size_for
from plumb.bench.causes import Hidden, causes_of
from plumb.text.errors import InputError
from plumb.vm.garage import BOARD
from plumb.vm.loop import Budget

# One hidden effect, and two.
CAUSES_OF = (causes_of("chain_sag"), (*causes_of("chain_sag"), causes_of("chain_pitch")[0]))
ASIDE = causes_of("sled_swing")[0]
SWING = Hidden(((ASIDE, size_for(ASIDE, BOARD, 6.0)),))


def test_each_kind_of_the_matrix_hides_what_it_is_called():
    for kind in KINDS:
        hidden = of_kind(kind, 2)
        assert all(size <= LARGEST for _, size in hidden.causes) or kind == "two"
        if kind not in ("two", "none", "unknown"):
            assert hidden.effects == (kind,)
    assert of_kind("none", 2) == Hidden()
    assert len({*of_kind("two", 2).effects}) == 2
    assert of_kind("unknown", 2).outside


def test_the_lab_plays_a_game_and_its_cost_is_counted():
    game = play("x", SWING, seed=1, grid=games.GRIDS["9"], budget=Budget())
    assert game.chosen == game.claimed == ("sled_swing",) and game.solved and game.false == 0
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
    sag, two = (Hidden(tuple((cause, 1.0) for cause in each)) for each in CAUSES_OF)
    assert is_solved(sag, auto_of("one_suspect", "chain_sag"))
    assert is_solved(sag, auto_of("one_suspect", "sled_friction", "chain_sag"))
    assert not is_solved(sag, auto_of("one_suspect", "chain_sag", "frame_lean"))
    assert not is_solved(two, auto_of("one_suspect", "chain_sag"))
    assert not is_solved(sag, auto_of("slip", "chain_sag", added=False))
    assert is_solved(Hidden(), auto_of("nothing_provable"))
    unknown = Hidden(outside="bump", outside_mm=3.0)
    assert is_solved(unknown, auto_of("not_in_library", "chain_sag"))
    assert not is_solved(unknown, auto_of("nothing_provable"))


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
    tasks = [games.Task(row, seed) for seed in (5, 6) for row in ("two 9", "none 9")]
    first = games.played(tasks, **run)
    assert [next(first), next(first)] == [played("two 9", 5), played("none 9", 5)]
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
