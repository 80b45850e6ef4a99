"""A cut that broke off: the folder knows how far it came, and it goes on or begins again."""

import re

import pytest
from folder import asked, got, until
from lab_machine import PATIENCE, bar, start_virtual
from playwright.sync_api import expect
from plumb.lab.broken_cut import BrokenCut, Noting, broken_cut, rest_of
from plumb.lab.project import Project, digest_of
from plumb.marks.read import read_marks
from served_lab import serve

SHEET = (2438.4, 1219.2)
LINES = [
    "G21",
    "G90",
    "G0 Z5",
    "G0 X1 Y1",
    "G1 Z-1",
    "G0 Z5",
    "G0 X2 Y1",
    "G1 Z-1",
    "G0 Z5",
    "G0 X0",
]
ENDS = [6, 9]


def test_the_rest_has_the_modes_and_the_marks_that_are_not_cut():
    assert rest_of(LINES, ENDS, 0) == (LINES, 0)
    rest, left_out = rest_of(LINES, ENDS, 1)
    assert rest == [*LINES[:3], *LINES[6:]] and len(rest) + left_out == len(LINES)


def test_marks_are_counted_once_they_are_cut_and_never_less_than_before(tmp_path):
    project, text = Project(tmp_path), "\n".join(LINES)
    cut = BrokenCut("grid.nc", digest_of(text.encode()), 0, False)
    noting = Noting(project, cut, ENDS)
    noting(5)
    assert broken_cut(project, "grid.nc", text) == cut
    noting(6)
    now = broken_cut(project, "grid.nc", text)
    assert now.marks == 1
    Noting(project, now, ENDS)(3)  # it goes on: its modes come again
    assert broken_cut(project, "grid.nc", text).marks == 1
    assert broken_cut(project, "grid-2.nc", text) is None
    assert broken_cut(project, "grid.nc", text + "G0") is None


@pytest.mark.parametrize("content", ["", "[1]", "{}", '{"program": 1}', "\xff"])
def test_a_note_of_somebody_else_is_none(tmp_path, content):
    (tmp_path / ".cut.json").write_text(content)
    assert broken_cut(Project(tmp_path), "grid.nc", "") is None


def test_without_a_broken_cut_nothing_goes_on(client):
    grid = got(client.get("/api/grid"))
    assert grid["broke_off"] is None and not grid["goes_on"]
    assert "begin with the first mark" in got(client.post("/api/grid/go-on"), 422)["error"]


def test_a_stopped_cut_goes_on_from_the_next_mark(lab, page):
    start_virtual(page, lab, speed=10)
    page.goto(f"{lab.site}#/cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    expect(page.get_by_label(re.compile("[2-4] of 9 marks are cut"))).to_be_visible(
        timeout=PATIENCE
    )
    bar(page).get_by_role("button", name="Stop").click()
    expect(page.get_by_text(re.compile("Cut [2-5] of 9 marks, then it broke off"))).to_be_visible()
    expect(page.get_by_role("button", name="Begin again: move the sled")).to_be_visible()
    with lab.client() as client:
        got(client.post("/api/machine/speed", json={"speed": 1000}))
    page.get_by_role("button", name=re.compile("Go on: move the sled and cut from mark")).click()
    expect(page.get_by_text("All marks are cut.")).to_be_visible(timeout=PATIENCE)
    assert not (lab.folder / ".cut.json").exists()
    page.get_by_role("button", name="Let a tape read the 9 marks").click()
    expect(page.get_by_text("9 of 9 marks are read")).to_be_visible(timeout=PATIENCE)
    assert len(read_marks(lab.folder / "marks.toml", sheet=SHEET).measured_marks) == 9


def test_a_lab_that_starts_again_knows_the_cut_that_broke_off(tmp_path, page, cable):
    path, _ = cable
    lab = serve(tmp_path)
    with lab.client() as client:
        got(client.post("/api/machine/board", json={"port": path}))
        until(client, lambda machine: machine["phase"] == "ready")
        got(client.post("/api/machine/settings"))
        got(client.post("/api/grid/cut"))
        until(client, lambda machine: machine["program"]["done"] > 8)
    lab.process.kill()
    lab.process.wait()
    lab = serve(tmp_path)
    try:
        page.goto(f"{lab.url}#/cut")
        said = page.get_by_text(re.compile(r"Cut \d of 9 marks, then it broke off\. Connect"))
        expect(said).to_contain_text("or go on from mark", timeout=PATIENCE)
        assert asked(tmp_path).get("/api/grid").json()["goes_on"]
    finally:
        lab.end()
