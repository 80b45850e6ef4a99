"""Tests of the checks that read C++: functions for tests alone, effects without their line."""

import pytest
from test_project_checks import plant, said


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("lib/Motion/src/path.h", "inline int lonely(int steps) { return steps; }\n"),
        ("lib/Motion/src/path.cpp", "int motion::lonely(int steps) { return steps; }\n"),
        ("src/machine/axes.h", "struct Axes { bool lonely() const; };\n"),
        ("src/machine/axes.h", "template <class Real> Real& lonely(Real& at) { return at; }\n"),
    ],
    ids=["function", "of a class", "method", "template"],
)
def test_unused_refuses_what_only_a_test_calls(tmp_path, name, text):
    files = {name: text, "test/test_motion/test_path.cpp": "int seen = lonely(3);\n"}
    code, output = said("unused", plant(tmp_path, files))
    assert code == 1 and f"{name}:1: only tests use lonely()" in output


@pytest.mark.parametrize(
    "use",
    [
        "int there = lonely(3);",
        "int there = axes.lonely(3);",
        "#define LONELY lonely(3)",
        "auto there = &Axes::lonely;",
    ],
)
def test_unused_allows_what_is_used(tmp_path, use):
    text = "inline int lonely(int steps) { return steps; }\n"
    files = {"lib/Motion/src/path.h": text, "src/main.cpp": f"{use}\n"}
    assert said("unused", plant(tmp_path, files))[0] == 0


@pytest.mark.parametrize(
    ("registry", "expected"),
    [
        ("", 'write #include "effects/chain_wear.h"'),
        ('#include "effects/chain_wear.h"', "give it a line At<NUMBER, ChainWear>"),
        ("At<185, ChainWear>", "is not included"),
    ],
)
def test_effects_refuse_a_header_without_its_line(tmp_path, registry, expected):
    files = {
        "lib/Kinematics/src/effects.h": registry,
        "lib/Kinematics/src/effects/chain_wear.h": "struct ChainWear : Effect<Real> {\n",
    }
    code, output = said("effects", plant(tmp_path, files))
    assert code == 1 and expected in output
