"""Tests of tools/mutation, on a toy room of which the score is known."""

import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/mutation"))

import cxx_sites  # noqa: E402
from cxx import CxxRoom  # noqa: E402
from cxx_build import COPIED, Build, Layout, flags_of, layout_of  # noqa: E402
from cxx_schema import mutated, shown, with_switches  # noqa: E402
from ledger import Ledger, reasons, score  # noqa: E402
from mutants import EQUIVALENT, KILLED, STILLBORN, SURVIVED, Mutant, Verdict  # noqa: E402
from python import PythonRoom  # noqa: E402

TOY = """// A comment with 1 < 2 in it.
#pragma once
enum : int { kMost = 9 };
inline int bounded(int value) {
  if (value > kMost) return kMost;
  return value;
}
inline bool isSmall(unsigned value) { return value < 3; }
inline int sumTo(int last) {
  int sum = 0;
  for (int i = 0; i <= last; ++i) sum += i;
  return sum;
}
inline int sign(int value) { return -value; }
inline int third() {
  static const int kTable[] = {3};
  return kTable[0];
}
"""
SUITE = """#include <gtest/gtest.h>
#include "toy.h"
TEST(Toy, Bounds) {
  EXPECT_EQ(9, bounded(12));
  EXPECT_EQ(3, bounded(3));
}
TEST(Toy, IsSmall) { EXPECT_TRUE(isSmall(1)); }
TEST(Toy, Sums) { EXPECT_EQ(6, sumTo(3)); }
TEST(Toy, ReadsItsTable) { EXPECT_LT(0, third()); }
TEST(Toy, ReadsItsTableAgain) { EXPECT_EQ(3, third()); }
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
"""
HEADER = Path("lib/Toy/src/toy.h")
# By line and mutant; `->` is left out where the rest of the line is that of the original.
EXPECTED = {
    "enum : int { kMost = 10 };": KILLED,
    "enum : int { kMost = 8 };": KILLED,
    "if (value >= kMost) return kMost;": EQUIVALENT,
    "if (value <= kMost) return kMost;": KILLED,
    "(removed)": KILLED,
    "inline bool isSmall(unsigned value) { return value <= 3; }": SURVIVED,
    "inline bool isSmall(unsigned value) { return value >= 3; }": KILLED,
    "inline bool isSmall(unsigned value) { return value < 4; }": SURVIVED,
    "inline bool isSmall(unsigned value) { return value < 2; }": SURVIVED,
    "int sum = 1;": KILLED,
    "for (int i = 1; i <= last; ++i) sum += i;": SURVIVED,
    "for (int i = 0; i < last; ++i) sum += i;": KILLED,
    "for (int i = 0; i > last; ++i) sum += i;": KILLED,
    "for (int i = 0; i <= last; --i) sum += i;": KILLED,
    "for (int i = 0; i <= last; ++i) sum -= i;": KILLED,
    "inline int sign(int value) { return value; }": SURVIVED,
    "static const int kTable[] = {4};": KILLED,
    "static const int kTable[] = {2};": KILLED,
    "return kTable[1];": KILLED,
}


@pytest.fixture
def toy(tmp_path) -> CxxRoom:
    """The toy room in a separate tree."""
    for path, text in {HEADER: TOY, Path("test/test_toy/main.cpp"): SUITE}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    layout = Layout({"test_toy": Path("test/test_toy")}, (), (Path("lib/Toy/src"), Path("test")))
    borrowed = ROOT / ".pio/libdeps/native"

    def build() -> Build:
        return Build(tmp_path, tmp_path / "build", layout, borrowed, flags_of(ROOT))

    return CxxRoom(tmp_path, [HEADER], build, is_quick=False)


@pytest.mark.slow
def test_each_mutant_of_a_toy_room_has_the_verdict_that_its_tests_deserve(toy):
    verdicts = {}
    toy.judge(toy.mutants(), lambda mutant, verdict: verdicts.update({mutant: verdict}))
    outcomes: dict[str, set[str]] = {}
    for mutant, verdict in verdicts.items():
        outcomes.setdefault(mutant.changed, set()).add(verdict.outcome)
    assert outcomes == {changed: {outcome} for changed, outcome in EXPECTED.items()}
    by = {mutant.changed: verdict.by for mutant, verdict in verdicts.items()}
    assert by["if (value <= kMost) return kMost;"] == "test_toy Toy.Bounds"
    assert by["enum : int { kMost = 8 };"] == "test_toy Toy.Bounds"
    assert by["for (int i = 0; i <= last; --i) sum += i;"] in (
        "test_toy hangs",
        "test_toy Toy.Sums",
    )
    assert by["inline int sign(int value) { return value; }"] == "no test reaches it"
    assert by["inline bool isSmall(unsigned value) { return value < 4; }"] == ""


def changes(code: str) -> list[str]:
    text = code.encode()
    return [shown(text, site)[1] for site in cxx_sites.read(text)[0]]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("// a < b\nint a = f<3>(); char c[4]; static_assert(1 < 2, \"3 < 4\");", []),
        ("#if N < 3\n#endif\n#include <a/b.h>", []),
        ("Row r = {\"left\", \"mm\", -30, 30};", []),
        ("float f = 0.5f;", ["float f = 0.25f;"]),
        ("bool b = !a;", ["bool b = a;"]),
        ("float f = -a;", ["float f = a;"]),
        ("bool b = a && c;", ["bool b = c;", "bool b = a;"]),
        ("float f = left(1.0f);", ["float f = right(1.0f);", "float f = left(0.5f);"]),
        ("int f(int left) { if (a) return b; return c; }",
         ["int f(int left) { if (!(a)) return b; return c; }", "(removed)"]),
        ("float f = clipped(a, b);", ["float f = a;"]),
        ("int f() { switch (a) { case 3: break; } }", ["(removed)"]),
    ],
)  # fmt: skip
def test_code_is_mutated_and_what_is_no_code_is_not(code, expected):
    assert changes(code) == expected


def test_text_with_switches_keeps_its_lines_and_each_mutant_is_one_change():
    text = TOY.encode()
    sites, words = cxx_sites.read(text)
    switched = with_switches(text, dict(enumerate(sites, 1)), words)
    assert switched.count(b"\n") == text.count(b"\n")
    assert with_switches(text, {}, words) == text
    for site in sites:
        start, end, new = site.edit
        assert len(mutated(text, site)) - len(text) in (
            len(new) - (end - start),
            len(new) - (end - start) + 1,
        )


def test_constexpr_gives_way_to_a_switch():
    text = b"struct S { static constexpr float k = 2.0f; };\nconstexpr int f() { return 1; }"
    sites, words = cxx_sites.read(text)
    switched = with_switches(text, dict(enumerate(sites, 1)), words).decode()
    assert "static inline const float k = (MUTANT(1) ? (1.0f) : (2.0f));" in switched
    assert "inline int f()" in switched


def test_what_is_worked_out_once_is_reached_by_all_tests_that_follow():
    text = b"int f() {\n  static const int kept[] = {3};\n  const int fresh = 4;\n  return 5;\n}"
    sites, words = cxx_sites.read(text)
    switched = with_switches(text, dict(enumerate(sites, 1)), words).decode().splitlines()
    assert "MUTANT_KEPT(1)" in switched[1] and "MUTANT(" not in switched[1]
    assert "MUTANT(3)" in switched[2] and "MUTANT(5)" in switched[3]


def test_what_the_suites_include_is_copied():
    for folder in layout_of(ROOT, []).includes:
        assert any(folder.is_relative_to(copied) for copied in COPIED), folder
        assert (ROOT / folder).is_dir(), folder


def test_verdicts_outlive_a_run_and_excused_survivors_do_not_count(tmp_path):
    dead, alive = Mutant("a.h", 1, "x < 1", "x <= 1"), Mutant("a.h", 2, "y < 1", "y <= 1")
    excused, born = Mutant("a.h", 3, "z < 1", "z <= 1"), Mutant("a.h", 4, "w < 1", "w <= 1")
    outcomes = {dead: KILLED, alive: SURVIVED, excused: SURVIVED, born: STILLBORN}
    ledger = Ledger(tmp_path / "room.json", "as it was")
    for mutant, outcome in outcomes.items():
        ledger.note(mutant, Verdict(outcome))
    again = Ledger(tmp_path / "room.json", "as it was")
    assert again.is_same
    assert {each.key: Verdict(what) for each, what in outcomes.items()} == again.verdicts
    assert not Ledger(tmp_path / "room.json", "changed").is_same
    (tmp_path / "toy.toml").write_text(
        '[["a.h"]]\noriginal = "z < 1"\nmutant = "z <= 1"\nreason = "z is never 1"\n'
    )
    judged = {each: again.verdicts[each.key] for each in outcomes}
    result = score("toy", judged, reasons(tmp_path))
    assert result.survivors == ["a.h:2: y < 1  ->  y <= 1"]
    assert str(result).startswith("toy: 50.0% of 2 mutants fall; 1 survive, 1 more with a reason")


THING = """\"\"\"A toy.\"\"\"


def bounded(value):
    if value > 9:
        return 9
    return value


def is_small(value):
    return value < 3
"""
THING_TESTS = """from toy.thing import bounded, is_small


def test_bounds():
    assert bounded(12) == 9 and bounded(9) == 9 and bounded(3) == 3


def test_small():
    assert is_small(1) and not is_small(5)
"""
PYTHON_EXPECTED = {
    "if value >= 9:": SURVIVED,
    "if value < 9:": KILLED,
    "return 10": KILLED,
    "return value <= 3": SURVIVED,
    "return value > 3": KILLED,
    "return value < 4": SURVIVED,
}


@pytest.mark.parametrize("is_quick", [pytest.param(False, marks=pytest.mark.slow), True])
def test_each_mutant_of_a_python_toy_has_the_verdict_that_its_tests_deserve(tmp_path, is_quick):
    folders = {"toy/thing.py": THING, "tests/test_thing.py": THING_TESTS, "conftest.py": ""}
    for name, text in folders.items():
        path = tmp_path / "tools" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    file = Path("tools/toy/thing.py")
    room = PythonRoom(tmp_path, [file], ["tools/tests/test_thing.py"], is_quick)
    asked = [mutant for mutant in room.mutants() if mutant.changed in PYTHON_EXPECTED]
    verdicts = {}
    room.judge(asked, lambda mutant, verdict: verdicts.update({mutant.changed: verdict}))
    assert {changed: verdict.outcome for changed, verdict in verdicts.items()} == PYTHON_EXPECTED
    assert "test_small" in verdicts["return value > 3"].by
    assert (tmp_path / file).read_text() == THING


def test_a_python_toy_that_fails_by_itself_is_not_judged(tmp_path):
    (tmp_path / "test_thing.py").write_text("def test_nothing():\n    assert 1 == 2\n")
    room = PythonRoom(tmp_path, [], ["test_thing.py"], False)
    with pytest.raises(SystemExit, match="fail without any mutant"):
        room.judge([], lambda mutant, verdict: None)


@cache
def mutants_of(file: str) -> set[tuple[str, str]]:
    """Each mutant of a file of C++ as it reads, original and changed."""
    text = (ROOT / file).read_bytes()
    return {shown(text, site) for site in cxx_sites.read(text)[0]}


def test_every_reason_names_a_line_that_the_tree_has():
    for file, original, mutant in reasons(ROOT / "tools/mutation/reasons"):
        if file.endswith(".py"):
            # While the line stays, the operators make the same of it: to ask them takes long.
            lines = {line.strip() for line in (ROOT / file).read_text().splitlines()}
            assert original in lines, f"{file}: {original}"
        else:
            assert (original, mutant) in mutants_of(file), f"{file}: {original}"
