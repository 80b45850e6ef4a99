"""The sheet of paper for the readings: what is on it, and that it can be printed."""

import itertools
import re
import tomllib

import plumb.grid as marks_grid
import pytest
from matplotlib.patches import Rectangle
from plumb.pictures.grid_paper import content_of
from plumb.pictures.measuring_sheet import PAPER, measuring_sheet, pages_of
from plumb.text.values import MM

MACHINE = marks_grid.PlainMachine()
# US Letter is wider and lower than A4: what both can print lies within these [mm].
SIDE, ABOVE, BELOW = 10.0, 18.0, 279.0
GRIDS = {
    "usual": {},
    "two pages": {"columns": 9, "rows": 7},
    "dense": {"columns": 15, "rows": 9, "margin": 60},
    "four": {"columns": 2, "rows": 2, "repeats": False},
}


def content(**options):
    grid = marks_grid.Grid(**options)
    return content_of(grid, MACHINE, MM, settings="home/groundcontrol.ini", form="home/marks.toml")


def extents(figure):
    """Each text with its box on the paper [mm], y down from the top."""
    renderer = figure.canvas.get_renderer()
    for text in figure.axes[0].texts:
        box = text.get_window_extent(renderer)
        scale = 25.4 / figure.dpi
        low = PAPER[1] - scale * box.y0
        yield text.get_text(), scale * box.x0, low - scale * box.height, scale * box.x1, low


def boxes(figure):
    """The boxes to fill in: left, top, right, low [mm]."""
    patches = [patch for patch in figure.axes[0].patches if isinstance(patch, Rectangle)]
    white = [patch for patch in patches if patch.get_facecolor()[:3] == (1, 1, 1)]
    return [
        (p.get_x(), p.get_y(), p.get_x() + p.get_width(), p.get_y() + p.get_height()) for p in white
    ]


@pytest.mark.parametrize("options", GRIDS.values(), ids=GRIDS)
def test_print_keeps_off_the_edges_of_a4_and_letter(options):
    for figure in pages_of(content(**options)):
        places = [each[1:] for each in extents(figure) if each[0]] + boxes(figure)
        assert min(x for x, *_ in places) > SIDE
        assert max(right for _, _, right, _ in places) < PAPER[0] - SIDE
        assert min(top for _, top, *_ in places) > ABOVE
        assert max(low for *_, low in places) < BELOW


@pytest.mark.parametrize("options", GRIDS.values(), ids=GRIDS)
def test_every_reading_has_its_row_and_each_number_a_box(options):
    sheet = content(**options)
    figures = pages_of(sheet)
    filled = sum(len(boxes(figure)) for figure in figures)
    assert filled == sum(len(reading.planned) for reading in sheet.readings)
    for figure in figures:
        for first, second in itertools.pairwise(sorted(boxes(figure))):
            same_column = abs(first[0] - second[0]) < 0.1
            assert not same_column or second[1] >= first[3] - 1e-6


@pytest.mark.parametrize("name", ["usual", "two pages", "dense", "four"])
def test_texts_do_not_overlap(name):
    for figure in pages_of(content(**GRIDS[name])):
        written = [each for each in extents(figure) if each[0] and each[0] not in ("x", "y")]
        for first, second in itertools.combinations(written, 2):
            across = min(first[3], second[3]) - max(first[1], second[1])
            down = min(first[4], second[4]) - max(first[2], second[2])
            assert across < 0.2 or down < 0.3, (first, second)


def test_the_rows_are_those_of_the_form_in_its_order(run, tmp_path):
    form, paper = tmp_path / "form.toml", tmp_path / "sheet.pdf"
    command = ("grid", "--marks", form, "--output", tmp_path / "g.nc", "--paper", paper)
    assert run(*command)[0] == 0
    marks = tomllib.loads(form.read_text())["mark"]
    rows = content().readings
    assert [mark["name"] for mark in marks] == [reading.name for reading in rows]
    assert [tuple(map(float, reading.planned)) for reading in rows] == [
        tuple(round(number, 1) for number in mark["target"]) for mark in marks
    ]
    assert [reading.note for reading in rows].count("again") == 8


def test_the_same_grid_gives_the_same_pages(run, tmp_path):
    paper = tmp_path / "sheet.pdf"
    places = tuple((100.0 * x - 400, 100.0 * y - 200) for y in range(5) for x in range(9))
    words = " ".join(f"{x},{y}" for x, y in places)
    command = ("grid", f"--places={words}", "--output", tmp_path / "g.nc")
    for _ in range(2):
        assert run(*command, "--paper", paper)[0] == 0
    grid = marks_grid.Grid(repeats=False, places=places)
    sheet = content_of(grid, MACHINE, MM, settings=None, form="marks.toml")
    assert paper.read_bytes() == measuring_sheet(sheet)
    assert len(re.findall(rb"/Type /Page\b(?!s)", paper.read_bytes())) == 2


def test_the_paper_is_a_pdf_and_a_file_of_its_own(run, ask, here):
    for name, hint in (("sheet.png", ".pdf"), ("g.pdf", "two results")):
        code, _, complaint = run("grid", "--output", "g.pdf", "--paper", name)
        assert code == 2 and hint in complaint and list(here.iterdir()) == []
    _, answer = ask("grid", "--output", "g.nc", "--paper", "sheet.pdf")
    assert answer["written"] == ["g.nc", "sheet.pdf"]
