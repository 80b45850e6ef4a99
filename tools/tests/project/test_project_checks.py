"""Tests of tools/checks: each lets a good tree pass and catches each breach planted in it."""

import io
import runpy
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

CHECKS = Path(__file__).resolve().parents[2] / "checks"
sys.path.append(str(CHECKS))

LONELY = "inline int lonely(int steps) { return steps; }\n"
GOOD = {
    "lib/Kinematics/src/strand.h": "#include <math.h>\n",
    "lib/Kinematics/src/Kinematics.h": '#include "strand.h"\n',
    "lib/Kinematics/src/effects/chain_sag.h": "struct ChainSag : Effect<Real> {\n",
    "lib/Kinematics/src/effects.h": '#include "effects/chain_sag.h"\nAt<37, ChainSag>\n',
    "lib/Motion/src/Motion.h": "#include <stdint.h>\nx = fabs(frame.min, kPi); // PI, one\n",
    "lib/Motion/src/path.h": LONELY.replace("lonely", "friendly"),
    "include/board_pins.h": "#include <stdint.h>\n",
    "src/main.cpp": "#include <Arduino.h>\n\n#include <Kinematics.h>\nint there = friendly(3);\n",
    "src/board.cpp": 'Found found = min(ones, kOne, "the one", owner);\nint tempt = 1;\n',
    "tools/judge/reference/hang.h": '#include <Eigen/Dense>\n\n#include "frame.h"\n',
    "tools/judge/reference/frame.h": "#include <vector>\n",
    "test/test_vm/main.cpp": '#include <Kinematics.h>\n#include "reference/hang.h"\n',
    "test/test_control/a.cpp": "const float kTick = 1;\n",
    "tools/plumb/grid.py": "import math\nfrom plumb.grid import other\n",
    "tools/plumb/__init__.py": '"""The lab."""\n',
    "tools/plumb/model/__init__.py": '"""The model."""\n',
    "tools/plumb/model/predict.py": "from plumb import _core\nimport plumb.text.errors\n",
    "tools/plumb/fit/fit.py": "from plumb.model import predict\nimport plumb.marks.model\n",
}


def plant(root: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root


def said(check: str, root: Path) -> tuple[int, str]:
    """The exit code of a check and what it prints. It runs here: to start Python takes longer."""
    out, complaint, program = io.StringIO(), io.StringIO(), CHECKS / f"{check}.py"
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(complaint):
        patch.setattr(sys, "argv", [str(program), str(root)])
        with pytest.raises(SystemExit) as ended:
            runpy.run_path(str(program), run_name="__main__")
    assert not complaint.getvalue()
    return int(ended.value.code), out.getvalue()


def refused(check: str, root: Path, name: str, text: str, expected: str) -> None:
    """Holds that a check says a single line of a good tree with one file in it that is wrong."""
    code, out = said(check, plant(root, {**GOOD, name: text}))
    assert code == 1 and out.startswith(f"{name}:") and out.count("\n") == 1, out
    assert expected in out


@pytest.mark.parametrize("check", ["arrows", "unused", "effects"])
def test_good_tree_passes(tmp_path, check):
    code, text = said(check, plant(tmp_path, GOOD))
    assert (code, text.count("\n")) == (0, 1), text


STRAND, MODEL = "lib/Kinematics/src/strand.h", "tools/plumb/model/predict.py"
HANG = "tools/judge/reference/hang.h"


@pytest.mark.parametrize(
    ("name", "line"),
    [
        (STRAND, "#include <Arduino.h>"),
        (STRAND, "#include <cmath>"),
        (STRAND, '#include "../../Motion/src/Motion.h"'),
        ("src/machine/axes.h", "#include <EEPROM.h>"),
        (HANG, "#include <Kinematics.h>"),
        (HANG, '#  include "strand.h"'),
        (HANG, '#include "effects/chain_sag.h"'),
        ("tools/vm/world/sled.h", "#include <Kinematics.h>"),
        ("tools/plumb/fit/fit.py", "from plumb import _judge"),
        (MODEL, "from plumb.fit.fit import fit"),
        (MODEL, "from plumb import cli"),
        (MODEL, "import plumb.marks.read"),
        (MODEL, "import plumb"),
        (MODEL, "from . import reach"),
        ("tools/plumb/attic/old.py", "import numpy"),
        ("tools/plumb/loose.py", "import numpy"),
    ],
)
def test_arrows_refuse(tmp_path, name, line):
    without_room = line in ("import plumb", "from . import reach")
    refused("arrows", tmp_path, name, f"{line}\n", "name the room" if without_room else ":1:")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("lib/Motion/src/a.h", LONELY),
        ("lib/Motion/src/a.cpp", "int motion::lonely(int steps) { return steps; }\n"),
        ("src/machine/axes.h", "struct Axes { bool lonely() const; };\n"),
        ("src/machine/axes.h", "template <class Real> Real& lonely(Real& at) { return at; }\n"),
        ("tools/plumb/fit/a.py", "def lonely(steps):\n    return steps\n"),
    ],
    ids=["function", "of a class", "method", "template", "python"],
)
def test_unused_refuses_what_only_a_test_calls(tmp_path, name, text):
    plant(tmp_path, {"test/a.cpp": "int a = lonely(3);\n", "tools/tests/a.py": "lonely(3)\n"})
    refused("unused", tmp_path, name, text, ":1: only tests use lonely()")


@pytest.mark.parametrize(
    "use", ["int a = axes.lonely(3);", "#define LONELY lonely(3)", "auto there = &Axes::lonely;"]
)
def test_unused_allows_what_is_used(tmp_path, use):
    files = {"lib/Motion/src/path.h": LONELY, "src/main.cpp": f"{use}\n"}
    assert said("unused", plant(tmp_path, files))[0] == 0


@pytest.mark.parametrize(
    ("registry", "expected"),
    [
        ("At<185, ChainWear>", 'write #include "effects/chain_wear.h"'),
        ('#include "effects/chain_wear.h"', "give it a line At<NUMBER, ChainWear>"),
    ],
)
def test_effects_refuse_a_header_without_its_line(tmp_path, registry, expected):
    header = "lib/Kinematics/src/effects/chain_wear.h"
    text = "struct ChainWear : Effect<Real> {\n"
    plant(tmp_path, {"lib/Kinematics/src/effects.h": registry, header: text})
    code, out = said("effects", tmp_path)
    assert code == 1 and out.startswith(f"{header}:") and expected in out


@pytest.mark.slow
def test_annotations_refuse_what_has_no_type_or_a_bare_ignore(tmp_path):
    """All in a single tree: each run of mypy takes a second and more."""
    texts = {
        "a": "def f(x):\n    return x\n",
        "b": "def f(x: int) -> str:\n    return x\n",
        "c": "x: int = ''  # type: ignore\n",
        "d": "x: int = ''  # type: ignore[assignment]\n",
    }
    files = {f"tools/plumb/text/{name}.py": text for name, text in texts.items()}
    code, out = said("annotations", plant(tmp_path, files))
    assert code == 1
    places = sorted(line.split(" ")[0] for line in out.splitlines())
    assert places == [f"tools/plumb/text/{at}:" for at in ("a.py:1", "b.py:2", "c.py:1")]


BRANCHES = "def f(x):\n" + "".join(f"    if x == {i}:\n        x += 1\n" for i in range(12))


def test_formatting_refuses(tmp_path):
    """All in a single tree: each run starts five programs."""
    good = {"src/good.cpp": "int a;\n", "tools/good.py": '"""A."""\n\nx = 1\n'}
    assert said("formatting", plant(tmp_path, good))[0] == 0
    bad = {
        "src/main.cpp": "int  a;\n",
        "tools/a.py": "import os\n",
        "tools/b.py": f"{BRANCHES}    return x\n",
        "tools/c": "#!/usr/bin/env python3\nx = {  }\n",
        "tools/d": "#!/usr/bin/env bash\nrm $1\n",
        "docs/a.md": "Wich mark?\n",
    }
    code, out = said("formatting", plant(tmp_path, bad))
    assert code == 1 and {line.partition(":")[0] for line in out.splitlines()} == {*bad}


def test_no_sentence_is_composed_outside_the_room_of_words(tmp_path):
    right = 'title = f"{mm} mm RMS"\nraise InputError(f"{name}: it is not there at all")\n'
    good = {"tools/plumb/cli/add.py": right, "tools/plumb/words/a.py": 'f"{a} is {b} off by now"\n'}
    assert said("sentences", plant(tmp_path, good))[0] == 0
    refused(
        "sentences", tmp_path, "tools/plumb/lab/routes/a.py", 'f"It is {a} mm off."\n', "belongs"
    )


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("const float kTick = 1;\n", "kTick"),
        ("struct Motor {};\n", "Motor"),
        ("Plain go() {\n}\n", "go"),
    ],
)
def test_names_refuse_a_name_that_two_files_of_a_suite_define(tmp_path, text, word):
    plant(tmp_path, {"test/test_motion/test_mover.cpp": text})
    expected = f"test_mover.cpp defines {word} too"
    refused("names", tmp_path, "test/test_motion/test_stops.cpp", text, expected)


def test_checks_pass_over_what_gitignore_names_and_need_no_git(tmp_path):
    ignored = {".gitignore": "/lib/built/\n*.gen.h\n"}
    ignored |= {"lib/built/a.h": LONELY, "lib/b.gen.h": LONELY, ".git/lib/a.h": LONELY}
    plant(tmp_path, {**GOOD, **ignored})
    assert said("unused", tmp_path)[0] == 0
