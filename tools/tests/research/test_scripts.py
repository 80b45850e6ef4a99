"""The scripts of tools/research: what they refuse, before they work for minutes."""

import bench_page
import faults
import games
import pytest
import soak
from plumb.vm import garage

# What each calls for its long work, and how its line begins.
LONG = [
    pytest.param(faults, (), "tried_all", id="faults"),
    pytest.param(bench_page, (), "run_bench", id="bench_page"),
    pytest.param(games, (), "played", id="games"),
]
ON_A_MEGA = [(soak, ()), (faults, ("--only", "ctrl-X", "--tries", "1")), (games, ())]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("script", "words", "work"), LONG)
def test_long_work_does_not_begin_if_its_page_cannot_be_written(
    script, words, work, here, monkeypatch, capsys
):
    class BegunError(Exception):
        pass

    def begin(*_, **__):
        raise BegunError

    monkeypatch.setattr(script, work, begin)
    (here / "theirs.md").write_text("# Notes\n")
    for page in ("theirs.md", "nowhere/page.md"):
        assert script.main([*words, "--write", page]) == 2
        said = capsys.readouterr().err
        assert said.startswith(f"{script.__name__}.py: {page}: ") and said.count("\n") == 1
    for more in (("ours.md",), ("theirs.md", "--force")):
        with pytest.raises(BegunError):
            script.main([*words, "--write", *more])


@pytest.mark.parametrize(("script", "words"), ON_A_MEGA)
def test_what_the_simulated_mega_cannot_run_is_refused(script, words, here, monkeypatch, capsys):
    def without_simavr(*_, **__):
        raise RuntimeError("the lab was built without the simulated Mega")

    monkeypatch.setattr(garage, "VirtualMachine", without_simavr)
    assert script.main([*words, "--mega", "firmware.elf"]) == 2
    last = capsys.readouterr().err.splitlines()[-1]
    assert last == f"{script.__name__}.py: the lab was built without the simulated Mega"


def test_the_rates_of_games_are_a_table(here, monkeypatch, capsys):
    monkeypatch.setattr(games, "matrix_tasks", lambda number, seed: [games.Task("none 9", seed)])
    assert games.main(["--games", "1", "--keep", "games.jsonl"]) == 0
    said = capsys.readouterr().out
    assert "none 9" in said and "Solved: just what is hidden" in said
    assert (here / "games.jsonl").read_text().count("\n") == 1
    # A game that is kept is not played again.
    monkeypatch.setattr(games.Task, "play", lambda *_: pytest.fail("played again"))
    assert games.main(["--games", "1", "--keep", "games.jsonl"]) == 0
    assert capsys.readouterr().out == said
