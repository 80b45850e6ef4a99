"""Tests of tools/checks: each lets a good tree pass and catches each violation planted in it."""

import io
import runpy
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

CHECKS = Path(__file__).resolve().parents[2] / "checks"
sys.path.append(str(CHECKS))
import generated  # noqa: E402

# Put together here, so that the check does not find it in this file.
BAD = "TO" + "DO\n"
GOOD = {
    "lib/Kinematics/src/strand.h": "#include <math.h>\n",
    "lib/Kinematics/src/Kinematics.h": '#include "strand.h"\n',
    "lib/Kinematics/src/effects/chain_sag.h": '#include "../strand.h"\n#include "strand.h"\n',
    "lib/Motion/src/Motion.h": "#include <stdint.h>\n",
    "include/board_pins.h": "#include <stdint.h>\n",
    "src/main.cpp": "#include <Arduino.h>\n\n#include <Kinematics.h>\n#include <board_pins.h>\n",
    "tools/judge/reference/hang.h": '#include <Eigen/Dense>\n\n#include "frame.h"\n',
    "tools/judge/reference/frame.h": "#include <vector>\n",
    "test/test_vm/main.cpp": '#include <Kinematics.h>\n#include "reference/hang.h"\n',
    "tools/plumb/grid/pattern.py": "import math\nfrom plumb.grid import other\n",
    "tools/plumb/__init__.py": '"""The lab."""\n',
    "tools/plumb/model/__init__.py": '"""The model."""\n',
    "tools/plumb/model/predict.py": "from plumb import _core\nimport plumb.text.errors\n",
    "tools/research/curves.py": "from plumb.model import predict\n",
    "tools/plumb/fit/problem.py": "from plumb.model import predict\nimport plumb.board.visits\n",
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


@pytest.mark.parametrize("check", ["arrows", "size", "names", "words", "prose"])
def test_good_tree_passes(tmp_path, check):
    code, text = said(check, plant(tmp_path, GOOD))
    assert (code, text.count("\n")) == (0, 1), text


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("lib/Kinematics/src/strand.h", "#include <Arduino.h>"),
        ("lib/Kinematics/src/strand.h", "#include <cmath>"),
        ("lib/Kinematics/src/strand.h", "#include <Motion.h>"),
        ("lib/Kinematics/src/strand.h", '#include "../../Motion/src/Motion.h"'),
        ("lib/Kinematics/src/strand.h", '#include "reference/hang.h"'),
        ("include/board_pins.h", "#include <Kinematics.h>"),
        ("src/main.cpp", '#include "../tools/judge/reference/hang.h"'),
        ("src/main.cpp", "#include <Eigen/Dense>"),
        ("tools/judge/reference/hang.h", "#include <Kinematics.h>"),
        ("tools/judge/reference/hang.h", '#  include "strand.h"'),
        ("tools/judge/reference/hang.h", '#include "../../lib/Kinematics/src/effects/chain_sag.h"'),
        ("tools/judge/reference/hang.h", '#include "effects/chain_sag.h"'),
        ("test/vm/machine.cpp", "#include <Kinematics.h>"),
        ("tools/core/binding.cpp", "#include <Motion.h>"),
        ("tools/plumb/grid/pattern.py", "import numpy"),
        ("tools/plumb/grid/pattern.py", "from plumb.text.errors import refusal"),
        ("tools/plumb/grid/pattern.py", "from . import other"),
        ("tools/plumb/fit/problem.py", "from plumb import _judge"),
        ("tools/plumb/model/predict.py", "from plumb.fit.fit import fit"),
        ("tools/plumb/model/predict.py", "from plumb import cli"),
        ("tools/plumb/model/predict.py", "import plumb.marks.read"),
        ("tools/plumb/model/predict.py", "import plumb"),
        ("tools/plumb/model/predict.py", "from . import reach"),
        ("tools/plumb/model/predict.py", "import curves"),
        ("tools/plumb/model/predict.py", "from research.curves import sag"),
        ("tools/plumb/attic/old.py", "import numpy"),
        ("tools/plumb/loose.py", "import numpy"),
    ],
)
def test_arrows_refuse(tmp_path, name, line):
    code, text = said("arrows", plant(tmp_path, {**GOOD, name: f"{line}\n"}))
    assert code == 1
    assert text.startswith(f"{name}:1:")
    assert text.count("\n") == 1


def cxx_function(lines: int) -> str:
    return "int f(int x) {\n" + "  x += 1;\n" * (lines - 3) + "  return x;\n}\n"


def python_function(lines: int) -> str:
    return "def f(x):\n" + "    x += 1\n" * (lines - 2) + "    return x\n"


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("src/a.cpp", cxx_function(61), "f() has 61 lines of code, the most is 60"),
        ("tools/a.py", python_function(61), "f() has 61 lines of code, the most is 60"),
        ("tools/a", "#!/usr/bin/env python3\n" + python_function(61), "the most is 60"),
        ("src/a.cpp", cxx_function(41), "1 of 1 functions are over 40"),
        ("src/a.cpp", "// a line\n" * 401, "401 lines, the most is 400"),
        ("tools/a.sh", "# a line\n" * 401, "401 lines, the most is 400"),
        ("tools/a", "#!/usr/bin/env bash\n" * 401, "401 lines, the most is 400"),
        ("platformio.ini", "; a line\n" * 401, "401 lines, the most is 400"),
        ("docs/page.md", "word " * 25, ":1: 125 columns, the most is 120"),
        ("src/a.cpp", "\n// " + "word " * 25, ":2: 128 columns, the most is 120"),
        ("tools/a.sh", "# " + "word " * 25, ":1: 127 columns, the most is 120"),
        ("test/fuzz/Makefile", "FLAGS =" + " -Wall" * 20, ":1: 127 columns, the most is 120"),
        ("docs/a.md", "```\n" + "word " * 25, ":2: 125 columns, the most is 120"),
        ("docs/a.md", "```console\n```\n" + "word " * 25, ":3: 125 columns, the most is 120"),
    ],
)
def test_size_refuses(tmp_path, name, text, expected):
    code, out = said("size", plant(tmp_path, {name: text}))
    assert code == 1
    assert out.startswith(name)
    assert expected in out


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("docs/page.md", "word " * 23 + "words"),
        ("docs/page.md", "| " + "word | " * 30),
        ("docs/page.md", "https://example.org/" + "a" * 120),
        ("docs/effects.md", "word " * 25),
        ("docs/page.md", "![" + "word " * 25 + "](a.svg)"),
        ("docs/page.md", "```console\n$ plumb reach\n" + "word " * 25 + "\n```"),
    ],
)
def test_size_allows(tmp_path, name, text):
    assert said("size", plant(tmp_path, {name: text}))[0] == 0


def test_size_allows_one_long_function_in_fifty(tmp_path):
    short = "".join(cxx_function(5).replace("f(", f"f{i}(") for i in range(49))
    plant(tmp_path, {"src/a.cpp": cxx_function(41), "src/b.cpp": short})
    assert said("size", tmp_path)[0] == 0


@pytest.mark.parametrize(
    "line",
    [
        "x = min(a, b);",
        "x = max (a, b);",
        "x = abs(a);",
        "x = round(a);",
        "x = sq(a);",
        "x = radians(a);",
        "x = 2 * PI;",
        "int B0;",
    ],
)
def test_names_refuse(tmp_path, line):
    text = f"// min(1, 2) in a comment\n{line}\n"
    code, out = said("names", plant(tmp_path, {"lib/Motion/src/Motion.h": text}))
    assert code == 1
    assert out.startswith("lib/Motion/src/Motion.h:2:")


@pytest.mark.parametrize(
    "line", ["x = fabs(a);", "x = lround(a);", "x = frame.min;", "kPi;", '"PI"', "/* PI */"]
)
def test_names_allow(tmp_path, line):
    assert said("names", plant(tmp_path, {"lib/Motion/src/Motion.h": line}))[0] == 0


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("const float kTick = 1;\n", "kTick"),
        ("struct Motor {\n};\n", "Motor"),
        ("Plain cruising() {\n}\n", "cruising"),
    ],
)
def test_names_refuse_a_name_that_two_files_of_a_suite_define(tmp_path, text, word):
    files = {f"test/test_motion/test_{name}.cpp": text for name in ("mover", "stops")}
    code, out = said("names", plant(tmp_path, files))
    assert code == 1
    assert f"test/test_motion/test_stops.cpp: test_mover.cpp defines {word} too" in out
    apart = {"test/test_motion/test_mover.cpp": text, "test/test_control/test_sled.cpp": text}
    assert said("names", plant(tmp_path / "apart", apart))[0] == 0


def test_names_refuse_two_files_of_tests_with_the_same_name(tmp_path):
    files = {f"tools/tests/{folder}/test_new.py": "" for folder in ("lab", "line")}
    code, out = said("names", plant(tmp_path, files))
    assert code == 1 and "test_new.py: tools/tests/" in out
    assert said("names", plant(tmp_path / "one", {"tools/tests/lab/test_new.py": ""}))[0] == 0


@pytest.mark.parametrize(
    "text",
    [
        "\nfor one in range(3):\n    print(one)\n",
        "\ndef f(own: int) -> int:\n    return 1\n",
        "\nplaces = [found for found in ()]\n",
        "\nfound: int = 1\n",
        "\ndef _told() -> None: ...\n",
    ],
)
def test_names_refuse_a_crutch(tmp_path, text):
    code, out = said("names", plant(tmp_path, {"tools/plumb/text/new.py": text}))
    assert code == 1
    assert out.startswith("tools/plumb/text/new.py:2:") and out.count("\n") == 1


def test_names_allow_a_crutch_that_belongs_to_others(tmp_path):
    text = "import re\n\nprint(re.found, {'one': 1})\nprint(re.sub(own=1))\n"
    assert said("names", plant(tmp_path, {"tools/plumb/text/new.py": text}))[0] == 0


@pytest.mark.parametrize(
    "line", ["int own = 1;", "f(one.x);", "int told_ = 0;", "for (auto& one : all)"]
)
def test_names_refuse_a_crutch_in_cxx(tmp_path, line):
    code, out = said("names", plant(tmp_path, {"src/board.cpp": f"// own\n{line}\n"}))
    assert code == 1
    assert out.startswith("src/board.cpp:2:") and out.count("\n") == 1


@pytest.mark.parametrize(
    "line", ["int ones = 1;", "Found found;", '"the one"', "int owner;", "kOne", "x = 1;  // one"]
)
def test_names_allow_in_cxx(tmp_path, line):
    assert said("names", plant(tmp_path, {"src/board.cpp": f"{line}\n"}))[0] == 0


def test_names_leave_the_rest_alone(tmp_path):
    assert said("names", plant(tmp_path, {"src/board.cpp": "x = min(a, b);"}))[0] == 0


# Put together here, so that the check does not find them in this file.
@pytest.mark.parametrize(
    "line",
    [
        "see /" + "work/main",
        "open('/" + "root/x')",
        "cd /home" + "/ann/plumb",
        "// TO" + "DO later",
        "# FIX" + "ME",
        "GTEST_" + "SKIP();",
        "TEST(A, DIS" + "ABLED_B)",
        "@pytest.mark." + "skip(reason='x')",
        "@pytest.mark." + "skipif(True, reason='x')",
        "@pytest.mark." + "xfail",
        "pytest." + "skip('x')",
        "pytest." + "importorskip('x')",
        "EXPECT_TRUE(" + "true);",
        "assert " + "True",
    ],
)
def test_words_refuse(tmp_path, line):
    code, out = said("words", plant(tmp_path, {"docs/page.md": f"first\n{line}\n"}))
    assert code == 1
    assert out.startswith("docs/page.md:2:")


def test_words_allow_an_address_with_such_a_folder(tmp_path):
    text = "https://example.org/wor" + "k/page, ../ro" + "ot/x\n"
    assert said("words", plant(tmp_path, {"docs/page.md": text}))[0] == 0


def test_annotations_refuse_what_has_no_type_or_no_reason(tmp_path):
    """All in a single tree: each run of mypy takes a second and more."""
    texts = {
        "a": "def f(x):\n    return x\n",
        "b": "def f(x: int) -> str:\n    return x\n",
        "c": "x: int = ''  # type: ignore\n",
        "d": "x: int = ''  # type: ignore[assignment]\n",
        "e": "x: int = ''  # type: ignore[assignment]  # the library takes text as well\n",
    }
    files = {f"tools/plumb/text/{name}.py": text for name, text in texts.items()}
    code, out = said("annotations", plant(tmp_path, files))
    assert code == 1
    places = sorted(line.split(" ")[0] for line in out.splitlines())
    assert places == [f"tools/plumb/text/{at}:" for at in ("a.py:1", "b.py:2", "c.py:1", "d.py:1")]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("src/main.cpp", "int  a;\n"),
        ("tools/a.py", "x = 1;y = 2\n"),
        ("tools/a.py", "import os\n"),
        ("tools/a", "#!/usr/bin/env python3\nx = {  }\n"),
    ],
)
def test_formatting_refuses(tmp_path, name, text):
    code, out = said("formatting", plant(tmp_path, {name: text}))
    assert code == 1
    assert out.startswith(f"{name}:")


def test_formatting_lets_clean_files_pass(tmp_path):
    good = {"src/main.cpp": "int a;\n", "tools/a.py": '"""A."""\n\nx = 1\n'}
    assert said("formatting", plant(tmp_path, good))[0] == 0


def test_generated_reports_a_stale_page(tmp_path):
    plant(tmp_path, {"stale.py": "print('docs/effects.md is stale'); exit(1)", "fresh.py": ""})
    said_of = list(generated.violations(tmp_path, [["fresh.py"], ["stale.py"]]))
    assert said_of == ["stale.py --check: docs/effects.md is stale"]


PACKAGES = "tools/setup_steps/debian_packages.txt"
CALLS = {
    PACKAGES: "# a comment\nmake | all | make | builds\nbash | base | bash | runs scripts\n",
    "tools/build": '#!/usr/bin/env bash\ngo() { :; }\ngo\nmake "$1"\n"./$1"\n',
}


def test_programs_lets_a_tree_pass_whose_programs_have_packages(tmp_path):
    code, text = said("programs", plant(tmp_path, CALLS))
    assert (code, text.count("\n")) == (0, 1), text


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.sh", "foo --bar\n", 1),
        ("a.sh", "x=$(ls | foo)\n", 1),
        ("a.sh", "nice -n 5 timeout 6 foo bar\n", 1),
        ("a.sh", "env A=1 foo\n", 1),
        ("a.sh", '"${as_root[@]}" foo\n', 1),
        ("Makefile", "all:\n\t@foo -p x\n", 2),
        ("Makefile", "CXX := foo\n", 1),
        ("Makefile", "x = $(shell foo .)\n", 1),
        ("a.py", 'import subprocess\n\nsubprocess.run(["foo", "-x"])\n', 3),
        ("a.py", 'import subprocess\n\ncommand = ["foo"]\nsubprocess.Popen([*command, 1])\n', 3),
        ("a.py", 'import subprocess\n\ncommand = ["foo"]\nsubprocess.run(command)\n', 3),
        ("a.py", 'output("foo", "-x")\n', 1),
        ("a.py", 'shutil.which("foo")\n', 1),
        ("a.py", 'env.Replace(CC="foo")\n', 1),
        ("a.py", 'env.VerboseAction("foo -O ihex", "Builds")\n', 1),
        ("a.cpp", 'FILE* f = popen("foo -x", "r");\n', 1),
    ],
)
def test_programs_names_a_program_that_no_package_brings(tmp_path, name, text, line):
    packages = CALLS[PACKAGES] + "coreutils | base | env ls nice timeout | common commands\n"
    others = {PACKAGES: packages, "b.sh": "ls\ntimeout 1 nice env true\n"}
    code, out = said("programs", plant(tmp_path, {**CALLS, **others, name: text}))
    assert code == 1
    assert out == f"{name}:{line}: calls foo, which no package in {PACKAGES} brings\n"


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ("gcc | all | gcc | compiles", ":4: nothing calls gcc of gcc"),
        ("gcc | some | - | compiles", ":4: write package | lab, all or base | programs | why"),
        ("gcc | all | -", ":4: write package | lab, all or base | programs | why"),
        ("gcc | all | - |", ":4: write package | lab, all or base | programs | why"),
        ("dpkg | all | make | builds", ":4: dpkg does not bring make"),
    ],
)
def test_programs_names_a_row_that_is_wrong(tmp_path, row, expected):
    plant(tmp_path, {**CALLS, PACKAGES: CALLS[PACKAGES] + row + "\n"})
    code, out = said("programs", tmp_path)
    assert (code, out) == (1, f"{PACKAGES}{expected}\n")


def test_checks_pass_over_what_gitignore_names_and_need_no_git(tmp_path):
    ignored = {".gitignore": "/.venv/\n*.pyc\n", ".venv/lib/a.md": BAD, "docs/b.pyc": BAD}
    git = {".git/a.md": BAD}
    plant(tmp_path, {**GOOD, **ignored, **git})
    assert said("words", tmp_path)[0] == 0
    plant(tmp_path, {"docs/.venv/c.md": BAD})
    assert said("words", tmp_path)[1].startswith("docs/.venv/c.md:1:")
