"""The budgets of the firmware: a build says that one is near, and refuses to exceed it."""

import runpy
import stat
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
import firmware  # noqa: E402
import main as bench  # noqa: E402
from record import Costs, over_budget  # noqa: E402

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
            str(ROOT / "tools/steps/budget.py"), init_globals={"Import": lambda _: None, "env": env}
        )
        return hook["hold_budgets"]([], ["firmware.elf"], env)

    return hold


@pytest.mark.parametrize(
    ("sizes", "said"),
    [
        ({"text": 800, "data": 20, "bss": 70}, ""),
        ({"text": 880, "data": 30, "bss": 70}, "takes 910 bytes, 91% of its budget of 1,000."),
        ({"text": 970, "data": 30, "bss": 70}, "The flash takes 1,000 bytes, 100% of its budget"),
    ],
)
def test_a_build_within_its_budget_goes_on_and_says_when_it_is_near(build, capsys, sizes, said):
    assert build(**sizes) == 0
    heard = capsys.readouterr().out
    assert said in heard and bool(said) == bool(heard)


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
    most = bench.budgets().most
    assert (most[firmware.FLASH], most[firmware.RAM]) == (184_320, 5_632)


def test_static_ram_and_the_deepest_stack_with_a_quarter_fit_into_the_mega():
    row, budgets = "static RAM, deepest stack and a quarter of it", bench.budgets()
    figures = {**dict.fromkeys(budgets.most, (0,)), **dict.fromkeys(budgets.least, (1000,))}
    fits, exceeds = (Costs("", {}, {**figures, row: (size,)}) for size in (8192, 8193))
    assert over_budget(fits, budgets) == []
    assert over_budget(exceeds, budgets) == [f"{row}: 8,193, the budget is 8,192"]


def test_what_a_question_costs_is_the_time_that_lines_lose():
    figures = {"lines_per_second": 200, "lines_per_second_asked": 190, "questions_per_second": 10}
    assert firmware.cycles_of_a_question(figures) == pytest.approx(80_000)
