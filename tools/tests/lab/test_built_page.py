"""The page as it is shipped: made of its source, small, styled once, in words of its readers."""

import ast
import gzip
import re
import subprocess
import sys
from pathlib import Path

import plumb
from example_machine import ROOT
from folder import got, with_settings
from plumb.cli.main import COMMANDS, main
from published_marks import SETTINGS

PAGE = ROOT / "tools/plumb/lab/page"
MOST = 70_000  # bytes, gzipped


def files(folder):
    """Each file of a folder with its content."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.*")}


def test_the_page_is_made_of_the_source_as_it_is(tmp_path):
    made = [ROOT / "tools/page/make", tmp_path / "page"]
    done = subprocess.run(made, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    made, shipped = files(tmp_path / "page"), files(PAGE)
    stale = sorted(name for name in made | shipped if made.get(name) != shipped.get(name))
    assert stale == [], "run tools/page/make"


def test_the_page_is_small_and_asks_no_other_site():
    parts = files(PAGE)
    assert {"index.html", "index.css", "lab.js"} <= parts.keys()
    assert sum(len(gzip.compress(part)) for part in parts.values()) <= MOST
    assert b"http" not in (PAGE / "index.html").read_bytes()


SOURCE = ROOT / "tools/page/src"
MOST_LINES = 1440  # of all styles: what looks alike is a component of the shell
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)


def test_each_class_that_is_styled_is_on_the_page():
    source = "\n".join(path.read_text() for path in SOURCE.rglob("*.ts*"))
    styles = "".join(path.read_text() for path in SOURCE.rglob("*.css"))
    selectors = re.findall(r"([^{};]+)\{", COMMENT.sub("", styles))
    classes = {name for each in selectors for name in re.findall(r"\.([a-z][\w-]*)", each)}
    unused = [name for name in classes if not re.search(rf"(?<![\w-]){name}(?![\w-])", source)]
    assert len(classes) > 80 and unused == []
    assert styles.count("\n") <= MOST_LINES


NODE = Path(sys.executable).parent / "node"


def test_the_pages_functions_pass_their_tests():
    done = subprocess.run(
        [NODE, "--test", "--test-reporter", "tap", "src/**/*.test.js"],
        cwd=SOURCE.parent,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    assert "# pass 0" not in done.stdout


def test_a_settings_file_opens_the_next_steps(lab, page):
    page.goto(lab.url)
    assert page.get_by_role("link", name="Readings").count() == 0
    page.get_by_label("Settings' file").set_input_files(SETTINGS)
    page.get_by_role("link", name="Readings").wait_for()
    assert (lab.folder / "groundcontrol.ini").read_bytes() == SETTINGS.read_bytes()


def test_a_bad_file_is_refused_in_a_line_and_changes_nothing(lab, page, tmp_path):
    page.goto(lab.url)
    bad = tmp_path / "holiday.ini"
    bad.write_text("no settings\n")
    page.get_by_label("Settings' file").set_input_files(bad)
    assert "holiday.ini" in page.get_by_role("alert").inner_text()
    assert not (lab.folder / "groundcontrol.ini").exists()


PACKAGE = Path(plumb.__file__).parent
OTHERS = "|".join(name for name in COMMANDS if name != "lab")
NAMED = re.compile(rf"(?<![\w-])--[a-z]|\bplumb (?:{OTHERS})\b")
WORD = re.compile(r"--[a-z-]+=?")  # of a command that is put together, and shown as that
LOADED = """
import sys, plumb.lab.app
files = [getattr(m, "__file__", None) for n, m in sys.modules.items() if n.startswith("plumb.")]
print("\\n".join(file for file in files if file and file.endswith(".py")))
"""


def run_by_the_lab():
    """The files of the package that the lab runs, but for those that read options themselves."""
    command = [sys.executable, "-c", LOADED]
    said = subprocess.run(command, capture_output=True, text=True, check=True)
    for name in said.stdout.splitlines():
        tree = ast.parse(Path(name).read_text())
        imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import)]
        if not any(alias.name == "argparse" for node in imports for alias in node.names):
            yield Path(name).relative_to(PACKAGE), tree


def shown(tree):
    """Each string that the page may show: no docstring, and nothing for a terminal."""
    left_out = set()
    for node in ast.walk(tree):
        # There the words for a terminal would be all that is left.
        assert not (isinstance(node, ast.JoinedStr) and "id='to_do'" in ast.dump(node))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            left_out.add(node.value)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "to_do":
            left_out.update(ast.walk(node.args[0]))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in left_out:
            yield node


def test_no_message_names_an_option_or_a_command():
    trees = list(run_by_the_lab())
    assert len(trees) > 80
    named = [
        f"{path}:{node.lineno}: {node.value}"
        for path, tree in trees
        for node in shown(tree)
        if NAMED.search(node.value) and not WORD.fullmatch(node.value)
    ]
    assert not named, "\n".join(named)


def test_remedies_suit_the_page_or_the_command_line(tmp_path, capsys):
    places = [[-900, 400], [900, 650], [0, -400]]
    with with_settings(tmp_path) as client:
        plan = got(client.post("/api/preview", json={"layout": "own", "places": places}))
        assert "outside the sheet: place your choice of marks farther" in plan["trouble"]
    words = ["grid", "--settings", str(tmp_path / "groundcontrol.ini")]
    assert main([*words, "--margin", "1"]) == 2
    assert "raise --margin" in capsys.readouterr().err
    assert main([*words, "--places=900,650"]) == 2
    assert "outside the sheet: move that place" in capsys.readouterr().err
