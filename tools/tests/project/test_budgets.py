"""The budgets of the firmware: a build says that one is near, and refuses to exceed it."""

import random
import runpy
import stat
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
import board  # noqa: E402
import deepest  # noqa: E402
import firmware  # noqa: E402

LIMITS = {"upload.maximum_size": 1000, "upload.maximum_ram_size": 100}


@pytest.fixture
def build(tmp_path):
    """Runs the hook of the build on a program with sections of these sizes."""

    def hold(**sizes):
        listed = tmp_path / "avr-size"
        rows = "".join(f"echo '.{name}  {size}  0'\n" for name, size in sizes.items())
        listed.write_text(f"#!/bin/sh\n{rows}")
        listed.chmod(listed.stat().st_mode | stat.S_IXUSR)
        env = SimpleNamespace(
            subst=lambda _: str(listed),
            BoardConfig=lambda: LIMITS,
            AddPostAction=lambda *_: None,
            VerboseAction=lambda *_: None,
        )
        hook = runpy.run_path(
            str(ROOT / "tools/budget.py"), init_globals={"Import": lambda _: None, "env": env}
        )
        return hook["hold_budgets"]([], ["firmware.elf"], env)

    return hold


def test_a_small_program_is_built_without_a_word(build, capsys):
    assert build(text=800, data=20, bss=70) == 0
    assert capsys.readouterr().out == ""


def test_a_build_over_90_percent_says_so_and_goes_on(build, capsys):
    assert build(text=880, data=30, bss=70) == 0
    assert "The flash takes 910 bytes, 91% of its budget of 1,000." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("sizes", "what"),
    [
        ({"text": 990, "data": 11, "bss": 0}, "flash"),
        ({"text": 100, "data": 41, "bss": 60}, "static RAM"),
    ],
)
def test_a_build_over_its_budget_fails(build, capsys, sizes, what):
    assert build(**sizes) == 1
    assert f"The {what} takes" in capsys.readouterr().out


def test_the_bench_reads_the_budgets_of_the_build():
    assert firmware.BUDGETS["flash"] == board.budget("maximum_size") == 184_320
    assert firmware.BUDGETS["static RAM"] == board.budget("maximum_ram_size") == 5_632


def test_the_search_changes_a_candidate_by_one_step():
    lines = deepest.known_lines()
    assert "-> $$" in lines
    best = [(2000, ["-> G0 X1", "-> $$", ">> !"])]
    for seed in range(40):
        changed = deepest.one_more(random.Random(seed), lines, best)
        assert abs(len(changed) - 3) <= 1
        assert len({*changed} & {*best[0][1]}) >= 2
