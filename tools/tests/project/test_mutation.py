"""Tests of tools/mutation, on toy files of which the outcomes are known."""

import shutil
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/mutation"))

import cxx  # noqa: E402
import main  # noqa: E402
import mutants as shared  # noqa: E402
import python  # noqa: E402
from mutants import (  # noqa: E402
    KILLED,
    SAME,
    STILLBORN,
    SURVIVED,
    code_of,
    mutant_of,
    reasons,
    recalled,
    sampled,
    save,
    summary,
)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("// a < b\n/* a < b\n   b < c */\n", []),
        ("x = a;  // 1 < 2\n", []),
        ("int f = 0;  // 1 < 2\n", ["int f = (0 + 1);"]),
        ("#if N < 3\n#endif\n#include <a/b.h>\n", []),
        ("static_assert(1 < 2);\ntemplate <int N = 3>\n", []),
        ('Row r = {"left", "mm", -30, 30};\n', []),
        ('say("1 < 2");\n', []),
        ("x = f<a> < b ? a : b;\n", ["x = f<a> <= b ? a : b;", "x = f<a> >= b ? a : b;"]),
        ("float f = 0.5f;\n", ["float f = (0.5f / 2);"]),
        ("int f = 0;\n", ["int f = (0 + 1);"]),
        ("bool b = !a;\n", ["bool b = a;"]),
        ("float f = -a;\n", ["float f = a;"]),
        ("bool b = a && c(d);\n", ["bool b = a;", "bool b = c(d);"]),
        ("if (a(b)) return c;\n", ["if (!(a(b))) return c;", "if (false && (a(b))) return c;"]),
        ("float f = clipped(a, b);\n", ["float f = (a);"]),
        ("float f = b.left;\n", ["float f = b.right;"]),
        ("{\n  stop(a);\n  b.c = a;\n  const int d = a;\n  return a;\n}\n", [";", ";"]),
    ],
)
def test_code_is_mutated_and_what_is_no_code_is_not(tmp_path, code, expected):
    (tmp_path / "toy.h").write_text(code)
    sites = cxx.sites(tmp_path, Path("toy.h"))
    changed = [mutant_of(site, tmp_path).changed for site in sites]
    alike = [" ".join(line.split()).replace(" ;", ";") for line in changed]
    assert sorted(alike) == sorted(expected)


TOY = Path("lib/Toy/src/toy.h")
SUITE = """#include <gtest/gtest.h>
#include <toy.h>
TEST(Toy, IsSmall) { EXPECT_TRUE(isSmall(1)); }
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
"""


@pytest.mark.slow
def test_mutants_of_a_cxx_toy_have_the_outcomes_that_their_test_deserves(tmp_path):
    root = tmp_path / "toy"
    texts = {
        TOY: "#pragma once\ninline bool isSmall(unsigned value) { return value < 3; }\n"
        "inline int unused() { return 3; }\ninline bool flag(bool left) { return left; }\n"
        "inline bool hangs() {\n  for (;;)\n    if (true) break;\n  return true;\n}\n",
        Path("test/test_toy/main.cpp"): SUITE.replace("isSmall(1)", "hangs() && isSmall(1)"),
    }
    for part in (*cxx.COPIED, *texts):
        (root / part if part in cxx.COPIED else (root / part).parent).mkdir(
            parents=True, exist_ok=True
        )
    for part, text in texts.items():
        (root / part).write_text(text)
    for part in ("platformio.ini", "tools/own_flags.py", "test/test_custom_runner.py"):
        shutil.copy(ROOT / part, root / part)
    (root / ".pio").mkdir()
    for part in cxx.LINKED:
        (root / part).symlink_to(ROOT / part)
    judge = cxx.Judge(root, tmp_path / "build", ("test_toy",), TOY)
    mutants = [mutant_of(site, root) for site in cxx.sites(root, TOY)]
    outcomes = {mutant.changed: judge.outcome(mutant) for mutant in mutants}
    expected = {
        "inline bool isSmall(unsigned value) { return value <= 3; }": SURVIVED,
        "inline bool isSmall(unsigned value) { return value >= 3; }": KILLED,
        "inline int unused() { return (3 + 1); }": SAME,
        "inline bool flag(bool right) { return left; }": STILLBORN,
        "if (false) break;": KILLED,
    }
    assert {changed: outcomes[changed] for changed in expected} == expected
    assert (tmp_path / "build" / TOY).read_text() == texts[TOY]


THING = """LIMIT = 9


def bounded(value):
    if value > LIMIT:
        return LIMIT
    return value


class Size:
    def is_small(self, value):
        return value < 3
"""
THING_TESTS = """from toy.thing import Size, bounded


def test_bounds():
    assert bounded(12) == 9 and bounded(9) == 9 and bounded(3) == 3


def test_small():
    assert Size().is_small(1) and not Size().is_small(5)
"""
FILE = Path("tools/toy/thing.py")
EXPECTED = {
    ("", "LIMIT = 10"): KILLED,
    ("bounded", "if value >= LIMIT:"): SURVIVED,
    ("bounded", "if value < LIMIT:"): KILLED,
    ("Size.is_small", "return value <= 3"): SURVIVED,
    ("Size.is_small", "return value > 3"): KILLED,
}


@pytest.fixture
def thing(tmp_path):
    """The root of a toy of Python with its tests."""
    texts = {FILE: THING, "tools/tests/test_thing.py": THING_TESTS, "tools/conftest.py": ""}
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def test_mutants_of_a_python_toy_have_the_outcomes_that_their_tests_deserve(thing):
    judge = python.Judge(thing, thing, ("tools/tests/test_thing.py",), FILE)
    mutants = [mutant_of(site, thing) for site in python.sites(thing, FILE)]
    named = {(mutant.site.scope, mutant.changed): mutant for mutant in mutants}
    assert {key: judge.outcome(named[key]) for key in EXPECTED} == EXPECTED
    assert (thing / FILE).read_text() == THING


@pytest.mark.parametrize(
    ("code", "passes"), [("while True: pass", False), ("import time; time.sleep(1.5)", True)]
)
def test_what_takes_a_processor_too_long_falls_and_what_waits_does_not(
    monkeypatch, tmp_path, code, passes
):
    monkeypatch.setattr(shared, "LEAST", 1)
    monkeypatch.setattr(shared, "PATIENCE", 60)
    assert shared.tested([sys.executable, "-S", "-c", code], tmp_path, {}, 0.01)[0] is passes


def test_a_decorator_belongs_to_what_it_decorates():
    text = "@cut(2)\nclass A:\n    @cut(3)\n    def b(self):\n        return 1\n"
    assert python.scopes_of(text) == {1: "A", 2: "A", 3: "A.b", 4: "A.b", 5: "A.b"}


def test_tests_that_fail_by_themselves_judge_nothing(thing):
    (thing / FILE).write_text("")
    with pytest.raises(SystemExit, match="fail without any mutant"):
        python.Judge(thing, thing, ("tools/tests/test_thing.py",), FILE)


def test_a_saved_sample_is_the_same_after_a_move_to_another_file(thing):
    sites = list(python.sites(thing, FILE))
    sample = [mutant_of(site, thing) for site in sampled(sites, 4, seed=2)]
    assert len(set(sample)) == 4 and [each.site for each in sample] == sampled(sites, 4, seed=2)
    assert sampled(sites, 4, seed=3) != sampled(sites, 4, seed=2)
    outcomes = dict(zip(sample, (SURVIVED, KILLED, KILLED, KILLED), strict=True))
    save(thing / "sample.json", outcomes)
    other = Path("tools/toy/merged.py")
    (thing / other).write_text(f"import math\n\n{THING}\n\n{THING}")  # each line twice
    moved = list(python.sites(thing, other))
    again = list(recalled(moved, thing / "sample.json", thing, ""))
    assert [each.key for each in again] == [each.key for each in sample]
    survivors = recalled(moved, thing / "sample.json", thing, SURVIVED)
    assert [each.key for each in survivors] == [sample[0].key]


def test_survivors_at_lines_with_a_reason_do_not_count(thing):
    mutants = [mutant_of(site, thing) for site in python.sites(thing, FILE)]
    above = next(each for each in mutants if each.changed == "if value >= LIMIT:")
    small = next(each for each in mutants if each.changed == "return value <= 3")
    dead, born, same = [each for each in mutants if each not in (above, small)][:3]
    judged = {dead: KILLED, above: SURVIVED, small: SURVIVED, born: STILLBORN, same: SAME}
    rows = f'[["{FILE}"]]\noriginal = "if value > LIMIT:"\nmutant = "-"\nreason = "the same"\n'
    (thing / "toy.toml").write_text(rows)
    *survivors, score = summary("toy", judged, reasons(thing))
    assert survivors == [f"{FILE}:12: return value < 3  ->  return value <= 3"]
    assert score.startswith("toy: 50.0% of 2 mutants fall; 1 survive, 1 more at lines with a")
    assert score.endswith("1 make the same program, 1 do not compile")


@pytest.mark.parametrize("room", [*main.TESTS, "tools/plumb/fit", "lib/Motion/src/corner.h"])
def test_rooms_have_files_and_tests(room):
    files = main.files_of(room)
    assert files and all((ROOT / file).is_file() for file in files)
    for test in main.tests_of(room):
        assert (ROOT / ("test" if files[0].suffix != ".py" else "") / test).exists(), test


def test_every_reason_names_a_line_that_the_tree_has():
    for file, original in reasons(ROOT / "tools/mutation/reasons"):
        lines = {code_of(line) for line in (ROOT / file).read_text().splitlines()}
        assert original in lines, f"{file}: {original}"
