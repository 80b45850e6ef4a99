"""`plumb report`: a file with the page of the lab and its answers, opened without a server."""

from __future__ import annotations

import io
import json
import re
import shutil
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from example_machine import INI, MARKS, checked
from plumb.cli.main import main
from plumb.marks.form import marks_toml
from plumb.marks.read import Measurements
from plumb.model.plain import plain_change
from plumb.settings import write_machine_toml
from plumb.text.values import MM
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on
from systems import ON_POSIX


@pytest.fixture
def opened(browser):
    """Opens a saved page from its file, offline. It asks nobody and complains of nothing."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, offline=True)
    page, files, asked, complaints = context.new_page(), [], [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("dialog", lambda dialog: complaints.append(dialog.message))

    def open_file(path):
        files.append(path.as_uri())
        page.goto(path.as_uri())
        page.locator("html[data-rest]").wait_for(state="attached")
        return page

    yield open_file
    context.close()
    assert complaints == [] and asked == files


def asked(*words) -> dict:
    """The object that a command prints with --json."""
    said = io.StringIO()
    with redirect_stdout(said), redirect_stderr(io.StringIO()):
        main([*map(str, words), "--json"])
    return json.loads(said.getvalue())


def reported(*words, folder: Path) -> tuple[dict, Path]:
    """The object of a report, and its page."""
    path = folder / "report.html"
    answer = asked("report", *words, "-o", path, "--force")
    assert answer.get("written") == [str(path)], answer
    return answer, path


def board(folder: Path, marks, distances=(), *, name="marks.toml", settings=BELIEVED):
    """Settings and marks as files."""
    machine, path = folder / "machine.toml", folder / name
    write_machine_toml(machine, settings)
    path.write_text(marks_toml(Measurements(tuple(marks), tuple(distances))))
    return machine, path


def nine(**how):
    """Nine marks of a machine that sags and stretches more than its settings know."""
    return marks_on(TRUE, BELIEVED, grid(3, 3), **{"noise": 0.3, **how})


def spans(folder: Path) -> tuple[Path, Path]:
    """A board of distances alone."""
    measured = distances_between(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3))
    return board(folder, measured.marks, measured.distances, name="spans.toml")


AXE = Path(__file__).resolve().parents[2] / "page/node_modules/axe-core/axe.min.js"
HOSTILE = ("</script><script>alert(1)</script>", '"><img src=x onerror=alert(1)>')
HOSTILE += ("<!-- <script>", "-->&amp;<b>")


def slipped(folder):
    """The example of a day, with a reading that is wrong by 40 mm."""
    path = folder / "slipped.toml"
    text = MARKS.read_text().replace("measured = [98, 106]", "measured = [138, 106]")
    path.write_text(f'date = "2026-05-03"\n{text}')
    return INI, path


def hostile(folder):
    """Nine marks, with names that would be tags."""
    marks = [
        mark.__class__(HOSTILE[i] if i < len(HOSTILE) else mark.name, mark.target, mark.measured)
        for i, mark in enumerate(nine())
    ]
    return board(folder, marks, name="<img src=x onerror=alert(2)>.toml")


BOARDS = {"cannot_tell": lambda folder: (INI, MARKS), "slip": slipped}
BOARDS |= {"spans": spans, "hostile": hostile}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The words, the answer and the file of a kind of board, made once."""
    known = {}

    def make(kind):
        if kind not in known:
            folder = tmp_path_factory.mktemp(kind)
            words = BOARDS[kind](folder)
            known[kind] = (words, *reported(*words, folder=folder))
        return known[kind]

    return make


def table(page, heading):
    """The cells of the first table below a heading."""
    section = page.locator("section", has=page.get_by_role("heading", name=heading)).last
    rows = section.locator("table").first.locator("tbody tr")
    return [row.locator("th, td").all_inner_texts() for row in rows.all()]


@pytest.mark.parametrize("kind", BOARDS)
def test_the_page_has_the_answer_of_diagnose(made, opened, kind):
    words, answer, path = made(kind)
    said = asked("diagnose", *words)
    assert answer["diagnosis"] == {key: said[key] for key in said if key != "next"}
    assert answer["next"] == said["next"]
    if kind in ("cannot_tell", "slip"):
        assert said["verdict"] == kind
    page = opened(path)
    assert said["sentence"] in page.locator(".say").inner_text()
    assert page.title().endswith(f"{Path(words[0]).name} with {Path(words[1]).name}")
    assert page.locator(".plot").count() >= (0 if kind == "spans" else 8)
    assert page.locator(".card[aria-label]").count() == (
        len(said["explanations"]) if kind != "slip" else 0
    )


@pytest.mark.parametrize("kind", ["cannot_tell", "slip", "spans", "hostile"])
def test_every_button_works_and_no_link_leaves_the_page(made, opened, kind):
    page = opened(made(kind)[2])
    page.evaluate(AXE.read_text())
    assert page.evaluate("async () => (await axe.run(document)).violations.map(({id}) => id)") == []
    assert page.locator("a, input[type=text], form, iframe").count() == 0
    names = {name.strip() for name in page.locator("button:visible").all_inner_texts()}
    assert names <= {"−", "+", "All"}
    # The likeliest cause lies over the marks; another takes its place.
    suspects = page.get_by_role("checkbox", name="Over the marks")
    if suspects.count():
        page.locator(".key.laid").wait_for()
        assert page.locator(".strokes.left").count() > 0
    for suspect in suspects.all()[1:2]:
        suspect.check()
        page.locator(".key.laid").wait_for()


def test_the_numbers_are_those_of_add(made, opened):
    words, answer, path = made("cannot_tell")
    said = asked("add", *words, "--effect", "auto")
    assert answer["addition"]["parameters"] == said["parameters"]
    sizes = {}
    for each in said["parameters"]:
        four = (each[key] for key in ("before", "value", "low", "high"))
        change = plain_change(each["name"], *four, MM)
        after = f"{change.after}\n± {change.margin} {change.unit}"
        sizes[change.noun] = [change.before, after]
    rows = table(opened(path), "The numbers")
    assert len(rows) == 4 and all(row[1:] == sizes[row[0].split("\n")[0]] for row in rows)


def test_a_slip_changes_no_number_and_has_its_mark(made, opened):
    _, answer, path = made("slip")
    page = opened(path)
    assert answer["addition"] is None and answer["diagnosis"]["slips"][0]["sentence"]
    page.get_by_role("heading", name="A reading disagrees: look at it first").wait_for()
    assert "on a sheet of 2438 mm by 1219 mm, measured 2026-05-03" in page.inner_text("main")
    assert "(read it again)" in page.locator("tr.doubted").inner_text()
    assert page.locator(".slips li").all_inner_texts() == [
        slip["sentence"] for slip in answer["diagnosis"]["slips"]
    ]


def test_names_from_files_are_shown_as_plain_text(made, opened):
    path = made("hostile")[2]
    page = opened(path)
    assert page.locator("img, b b").count() == 0
    shown = page.locator("main").inner_text()
    assert all(name in shown for name in (*HOSTILE, "<img src=x onerror=alert(2)>.toml"))
    # Not by the page's good will alone: no script runs but that of the page.
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', path.read_text())[1]
    assert policy.startswith("default-src 'none'; script-src 'sha256-")


def test_lengths_are_in_the_unit_that_was_asked_for(made, opened, tmp_path):
    words, path = made("cannot_tell")[0], tmp_path / "inch.html"
    assert main(["report", *map(str, words), "--units", "inch", "-o", str(path)]) == 0
    page = opened(path)
    states = page.locator(".states").inner_text()
    assert "inch" in states and not re.search(r"\bmm\b", states)
    page.get_by_role("heading", name="The readings [inch]").wait_for()
    assert "--units inch" in page.locator("main").inner_text()


@pytest.mark.parametrize("kind", ["cannot_tell", "spans"])
def test_on_paper_there_are_no_buttons_folds_or_cuts(made, opened, kind):
    page = opened(made(kind)[2])
    page.set_viewport_size({"width": 718, "height": 1047})  # A4 within its margins
    page.emulate_media(media="print", color_scheme="dark")
    assert page.locator("button:visible, select:visible, summary:visible").count() == 0
    assert page.get_by_text("The frame of the machine is always fitted too").is_visible()
    cut = """() => [...document.querySelectorAll("main *")].filter((each) =>
      each.getBoundingClientRect().right > innerWidth + 1 ||
      each.scrollWidth > each.clientWidth + 1 && getComputedStyle(each).overflowX !== "visible")
      .map((each) => each.outerHTML.slice(0, 90))"""
    assert page.evaluate(cut) == []
    paper = page.evaluate("() => getComputedStyle(document.body).backgroundColor")
    assert min(map(int, re.findall(r"\d+", paper))) > 240
    assert page.pdf(format="A4").startswith(b"%PDF")


@ON_POSIX  # its files have names that Windows refuses
def test_the_same_files_give_the_same_bytes(made, tmp_path):
    words, _, path = made("hostile")
    before = path.read_bytes()
    reported(*words, folder=path.parent)
    assert path.read_bytes() == before and len(before) < 1_000_000


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ((INI, MARKS, "-o", "report.txt"), "-o report.txt: end the name with .html, .htm"),
        ((INI, "none.toml", "-o", "r.html"), "none.toml: there is no such file"),
        ((INI, INI, "-o", "r.html"), "groundcontrol.ini"),
        ((INI, MARKS, "--without", "99", "-o", "r.html"), "--without"),
        ((INI, MARKS, "-o", "no/such/r.html"), "cannot be written"),
        ((INI, "own.html", "-o", "own.html"), "own.html"),
        ((INI, MARKS, "-o", "own.html"), "own.html: exists, and plumb did not write it"),
        ((INI, MARKS), "-o/--output"),
    ],
)
def test_unusable_files_are_refused_and_nothing_is_written(here, capsys, words, complaint):
    (here / "own.html").write_text("mine")
    assert main(["report", *map(str, words)]) == 2
    said = capsys.readouterr()
    assert complaint in said.err and said.err.count("\n") == 1 and not said.out
    assert [path.name for path in here.iterdir()] == ["own.html"]
    assert (here / "own.html").read_text() == "mine"


def test_a_page_that_plumb_wrote_may_be_replaced(made, tmp_path, capsys):
    words, _, page = made("cannot_tell")
    path = shutil.copy(page, tmp_path / "r.html")
    assert main(["report", *map(str, words), "-o", str(path)]) == 0
    # A long name stands on the next line.
    assert f"Written: {path}" in " ".join(capsys.readouterr().out.split())


def test_correct_settings_need_no_change(opened, tmp_path):
    write_machine_toml(tmp_path / "machine.toml", TRUE)
    marks = board(tmp_path, marks_on(TRUE, TRUE, grid(3, 3), noise=0.3), settings=TRUE)
    answer, path = reported(*marks, folder=tmp_path)
    assert answer["diagnosis"]["verdict"] == "nothing_provable"
    page = opened(path)
    page.get_by_role("heading", name="Nothing to change").wait_for()
    assert page.locator(".card").count() == 0


def test_the_rounds_of_the_diary_are_shown_with_their_errors(opened, tmp_path):
    done = asked("calibrate", INI, MARKS, *checked(), "-o", tmp_path / "machine.toml")["addition"]
    words = (tmp_path / "machine.toml", MARKS, "--cut-with", INI)
    page = opened(reported(*words, folder=tmp_path)[1])
    ((_, errors, left_out),) = table(page, "Round by round")
    assert [float(size) for size in re.findall(r"[\d.]+(?= mm)", errors)] == pytest.approx(
        [done["raw"]["rms_mm"], done["after"]["fit_rms_mm"]], abs=0.0051
    )
    assert float(left_out.split()[0]) == pytest.approx(done["after"]["left_out_rms_mm"], abs=0.0051)
