"""Tests of the files to save and print: each can be read back or printed."""

import json
import shutil

import pytest
from folder import EXAMPLE, choose, got
from playwright.sync_api import expect
from plumb.pictures import grid_paper
from screens import measured_machine


@pytest.fixture
def measured(client, tmp_path):
    """A lab whose marks are read."""
    shutil.copy(EXAMPLE / "marks.toml", tmp_path / "marks.toml")
    choices = json.loads((tmp_path / "lab.json").read_text())
    (tmp_path / "lab.json").write_text(json.dumps({**choices, "marks": ["marks.toml"]}))
    return client


def paper(client, name):
    answer = client.get(f"/api/papers/{name}")
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-disposition"] == f'attachment; filename="{name}"'
    return answer.content


def test_a_sheet_to_print_has_the_marks_that_are_to_be_cut(client, tmp_path, monkeypatch):
    drawn = []
    draw = grid_paper.measuring_sheet
    monkeypatch.setattr(
        grid_paper, "measuring_sheet", lambda content: drawn.append(content) or draw(content)
    )
    assert paper(client, "marks.pdf").startswith(b"%PDF")
    places = [[-900.0, 300.0], [0.0, 0.0], [700.0, -200.0], [100.0, 250.0]]
    choose(client, layout="own", planned=places)
    paper(client, "marks.pdf")
    assert [len(content.holes) for content in drawn] == [9, 4]
    width, height = drawn[1].sheet
    assert sorted((hole.x - width / 2, height / 2 - hole.y) for hole in drawn[1].holes) == sorted(
        map(tuple, places)
    )
    assert any("marks.toml" in line for line in drawn[1].how)
    # Marks that the verdict proposed and somebody took come before.
    got(client.post("/api/rounds/marks"))
    for ending in ("toml", "nc"):
        written = tmp_path / ("marks.toml" if ending == "toml" else "grid.nc")
        written.rename(tmp_path / f"more.{ending}")
    choose(client, layout="nine", proposed="more.toml")
    paper(client, "marks.pdf")
    assert len(drawn[2].holes) == 4 and any("more.toml" in line for line in drawn[2].how)


def test_the_report_has_the_verdicts_sentence(measured):
    page = paper(measured, "report.html").decode()
    share, verdict = 0.0, None
    while share < 1:
        answer = got(measured.get("/api/verdict"))
        share, verdict = answer["share"], answer["verdict"]
    assert verdict["sentence"] in page
    assert "plumb report groundcontrol.ini marks.toml" in page


def test_the_browser_saves_them(lab, page):
    measured_machine(lab.folder)
    for step, words, name in (
        ("cut", "Save a sheet to print", "marks.pdf"),
        ("verdict", "Save the report", "report.html"),
    ):
        page.goto(f"{lab.url}#/{step}")
        with page.expect_download() as download:
            page.get_by_role("button", name=words).click()
        assert download.value.suggested_filename == name
    # A tab in the background does not see that the file goes, and still has its button.
    page.evaluate("Object.defineProperty(document, 'hidden', { value: true })")
    (lab.folder / "marks.toml").unlink()
    page.get_by_role("button", name="Save the report").click()
    expect(page.get_by_role("alert")).to_contain_text("marks.toml")
