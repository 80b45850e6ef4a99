"""What the lab says names no option and no command: its readers have no command line."""

import ast
import re
import subprocess
import sys
import time
from pathlib import Path

import plumb
import pytest
from folder import EXAMPLE, got, with_settings
from plumb.cli.main import COMMANDS, main
from plumb.lab.machine_line import MachineLine
from plumb.text.errors import read_on_page, to_do

PACKAGE = Path(plumb.__file__).parent
OTHERS = "|".join(name for name in COMMANDS if name != "lab")
NAMED = re.compile(rf"(?<![\w-])--[a-z]|\bplumb (?:{OTHERS})\b")
WORD = re.compile(r"--[a-z-]+=?")  # of a command that is put together, and shown as that
LOADED = """
import sys, plumb.lab.app
files = [getattr(m, "__file__", None) for n, m in sys.modules.items() if n.startswith("plumb.")]
print("\\n".join(file for file in files if file and file.endswith(".py")))
"""
PATIENCE = 120  # [s]


def run_by_the_lab():
    """The files of the package that the lab runs, but for those that read options themselves."""
    said = subprocess.run(
        [sys.executable, "-c", LOADED], capture_output=True, text=True, check=True
    )
    for name in said.stdout.splitlines():
        tree = ast.parse(Path(name).read_text())
        imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import)]
        if not any(alias.name == "argparse" for node in imports for alias in node.names):
            yield Path(name).relative_to(PACKAGE), tree


def shown(tree):
    """Each string that the page may show: no docstring, and nothing for a terminal."""
    left_out = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            left_out.add(node.value)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "to_do":
            left_out.update(ast.walk(node.args[0]))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in left_out:
            yield node


def test_no_message_names_an_option_or_a_command():
    trees = list(run_by_the_lab())
    assert len(trees) > 100
    named = [
        f"{path}:{node.lineno}: {node.value}"
        for path, tree in trees
        for node in shown(tree)
        if NAMED.search(node.value) and not WORD.fullmatch(node.value)
    ]
    assert not named, "\n".join(named)


@pytest.mark.parametrize(
    ("text", "is_named"),
    [
        ('raise E("no: raise --margin")', True),
        ('raise E(f"--prior {name}: no")', True),
        ('say("see plumb reach")', True),
        ('say(to_do("raise --margin", page="use --margin"))', True),
        ('say(to_do(f"--prior {name}", page="how far off"))', False),
        ('"""Docstring of --margin."""', False),
        ('words += ["--columns", f"--places={places}"]', False),
    ],
)
def test_the_search_bites(text, is_named):
    named = [node.value for node in shown(ast.parse(text)) if NAMED.search(node.value)]
    assert any(not WORD.fullmatch(value) for value in named) is is_named


def test_what_to_do_is_said_to_who_reads_it(tmp_path, capsys):
    places = [[-900, 400], [900, 650], [0, -400]]
    with with_settings(tmp_path) as client:
        plan = got(client.post("/api/preview", json={"layout": "own", "places": places}))
        assert "outside the sheet: place your choice of marks farther" in plan["trouble"]
    words = ["grid", "--settings", str(tmp_path / "groundcontrol.ini")]
    assert main([*words, "--margin", "1"]) == 2
    assert "raise --margin" in capsys.readouterr().err
    assert main([*words, "--places=900,650"]) == 2
    assert "outside the sheet: move that place" in capsys.readouterr().err


def test_what_is_worked_out_in_the_background_is_said_to_the_page(tmp_path):
    form = (EXAMPLE / "marks.toml").read_text()
    # A tape that is said to be far worse than these marks show.
    (tmp_path / "marks.toml").write_text(f"tape_sigma_mm = 4.0\n{form}")
    with with_settings(tmp_path) as client:
        project = got(client.get("/api/project"))
        body = {
            "choices": {**project["choices"], "marks": ["marks.toml"]},
            "read": project["choices_digest"],
        }
        got(client.put("/api/choices", json=body))
        end = time.monotonic() + PATIENCE
        while (answer := got(client.get("/api/verdict")))["share"] < 1:
            assert time.monotonic() < end
            time.sleep(0.05)
    notes = " ".join(answer["verdict"]["notes"])
    assert "or correct what your tape is good to" in notes and "--sigma" not in notes


def test_work_on_the_line_speaks_to_whom_asked():
    class Worker:
        def do(self, work):
            self.work = work
            return self

        def result(self, patience):
            return self.work(None)

    line = MachineLine()
    line._worker = Worker()
    with read_on_page():
        line.begin(lambda sender: said.append(to_do("line", page="page")))
    said = []
    line._worker.work(None)  # later, in another thread, where nobody reads the page
    assert said == ["page"]
    assert line.do(lambda sender: to_do("line", page="page")) == "line"
