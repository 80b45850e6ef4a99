"""Tests of the files to save and print: each can be read back or printed."""

from folder import choose, finished, got, with_marks
from playwright.sync_api import expect
from plumb.pictures import grid_paper
from screens import measured_machine


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
    cut = [(hole.x - width / 2, height / 2 - hole.y) for hole in drawn[1].holes]
    assert sorted(cut) == sorted(map(tuple, places))
    assert any("marks.toml" in line for line in drawn[1].how)
    # Marks that the verdict proposed and somebody took come before.
    got(client.post("/api/rounds/marks"))
    for ending in ("toml", "nc"):
        written = tmp_path / ("marks.toml" if ending == "toml" else "grid.nc")
        written.rename(tmp_path / f"more.{ending}")
    choose(client, layout="nine", proposed="more.toml")
    paper(client, "marks.pdf")
    assert len(drawn[2].holes) == 4 and any("more.toml" in line for line in drawn[2].how)


def test_the_report_has_the_verdicts_sentence(tmp_path):
    with with_marks(tmp_path) as client:
        page = paper(client, "report.html").decode()
        assert finished(client, "verdict")["verdict"]["sentence"] in page
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
