"""Proof marks, the diary, and marks on another sheet, by the routes and on the page."""

import json
import math
import re
import shutil
import tomllib
from datetime import UTC, datetime, timedelta

import pytest
from folder import EXAMPLE, asked, got, note_fit, type_in
from playwright.sync_api import expect
from plumb.diary.file import read_diary
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.words import round as round_words

PATIENCE = 300_000  # [ms] of a busy computer
JUDGED = ".judged"


def fitted_machine(folder):
    """A folder with the example's machine after a correction."""
    for name in ("machine.toml", "marks.toml", "groundcontrol.ini"):
        shutil.copy(EXAMPLE / name, folder)
    return chosen(folder)


def type_off(lab, page, mark, x, y):
    """Type a proof mark that lies so far [mm] right of its target, and so far below it."""
    meant = got(lab.client().get("/api/proof"))["meant"][mark - 1]
    for edge, place, off in zip(("left", "top"), meant, (x, y), strict=True):
        field = page.get_by_label(f"Mark {mark} from the {edge}, mm", exact=True)
        field.fill(f"{place + off:.6f}")


def where(page):
    """Where the proof marks are, as numbers."""
    expect(page.get_by_text("from your edges")).to_be_visible(timeout=PATIENCE)
    return re.findall(r"\d+", page.get_by_text("from your edges").inner_text())


def test_two_proof_marks_hold_then_miss_and_others_are_planned(lab, page):
    fitted_machine(lab.folder)
    page.goto(f"{lab.url}#/prove")
    page.get_by_role("button", name="Save proof.nc; nothing moves").click(timeout=PATIENCE)
    page.get_by_label("Mark 2 from the left, mm").wait_for(timeout=PATIENCE)
    first = where(page)
    assert "G1" in (lab.folder / "proof.nc").read_text()
    expect(page.locator(".sheet .spot.faint")).to_have_count(23)  # that were fitted
    type_off(lab, page, 1, 0.3, 0.1)
    type_off(lab, page, 2, -0.2, 0.4)
    expect(page.locator(JUDGED)).to_contain_text(
        "The machine is as it was fitted", timeout=PATIENCE
    )
    within = page.locator(".sheet .arrow.within")
    expect(within).to_have_count(2)
    wood = page.locator(".sheet .wood").bounding_box()  # what is promised is drawn, and fits
    circle = page.locator(".sheet g:has(> .place) circle.noise").first.bounding_box()
    expect(page.locator(".legend-of-sheet")).to_contain_text("promised")
    assert 0.05 < circle["width"] / wood["width"] < 0.35
    heads = page.locator("table.checked thead th").all_inner_texts()
    assert heads[2:] == ["error", "expected up to", "off its target"]
    of_target = page.locator("table.checked tbody td:last-child").all_inner_texts()
    assert of_target == ["0.32", "0.45"]  # as they were typed
    offs = page.locator("table.checked tbody td:nth-of-type(2)").all_inner_texts()
    assert all(re.fullmatch(r"[+-][01]\.\d\d, [+-][01]\.\d\d", off) for off in offs)
    fallen = page.locator(".off-target td").all_inner_texts()
    assert [text.strip() for text in fallen] == ["8.95 mm", "0.39 mm"]
    type_off(lab, page, 2, -4, 0.4)
    expect(page.locator(JUDGED)).to_contain_text("First read mark 2 again", timeout=PATIENCE)
    expect(within).to_have_count(1)
    beyond = page.locator(".sheet g:has(> .place) > .arrow.beyond")
    expect(beyond).to_have_count(1)
    # It was read 4 mm too far left and 0.4 mm too far down: from the target, the arrow says so.
    x, y, tip_x, tip_y = map(float, re.findall(r"-?[\d.]+", beyond.get_attribute("d"))[:4])
    assert tip_x < x - 20 and y < tip_y < y + (x - tip_x) / 4
    page.get_by_role("button", name="Let the verdict go by these marks too").click()
    expect(page.get_by_role("button", name="Let the verdict")).to_have_count(0, timeout=PATIENCE)
    assert json.loads((lab.folder / "lab.json").read_text())["marks"] == [
        "marks.toml",
        "proof.toml",
    ]
    results = [each.content for each in read_diary(lab.folder).of_kind("recheck")]
    assert [result["holds"] for result in results] == [True, False]  # each once
    assert results[-1]["machine"] == "machine.toml"
    page.goto(f"{lab.site}#/diary")
    expect(page.locator(".noted li").first).to_contain_text(
        re.compile("proof.toml, by machine.toml: .* First read mark 2 again"), timeout=PATIENCE
    )
    page.goto(f"{lab.site}#/prove")
    expect(page.locator(JUDGED)).to_contain_text("First read mark 2 again", timeout=PATIENCE)
    kept = (lab.folder / "proof.toml").read_bytes()
    page.get_by_role("button", name="Write two other marks").click()
    expect(page.locator(JUDGED)).to_have_count(0, timeout=PATIENCE)
    assert where(page) != first
    assert (lab.folder / "proof-2.nc").exists()
    assert (lab.folder / "proof.toml").read_bytes() == kept


def test_the_diary_shows_a_fit_that_comes_in_and_a_number_that_moved(lab, page):
    day = datetime(2026, 5, 1, 12, tzinfo=UTC)
    note_fit(lab.folder, day, 0.9, 2978.0)
    page.goto(f"{lab.url}#/diary")
    rows = page.locator(".rounds tbody tr")
    expect(rows).to_have_count(1, timeout=PATIENCE)
    expect(rows).to_contain_text(re.compile(r"chain sag.*8\.90 mm.*0\.90 mm", re.DOTALL))
    assert page.locator(".course.moved, .course svg").count() == 0  # a fit is no course
    note_fit(lab.folder, day + timedelta(days=30), 0.5, 2984.0)
    expect(rows).to_have_count(2, timeout=PATIENCE)
    expect(page.locator(".course.moved")).to_contain_text("gap between the motors: 2984.0 mm")
    page.get_by_role("radio", name="inch").check()
    expect(page.locator(".course")).to_contain_text("117.48 inch", timeout=PATIENCE)
    expect(rows.last).to_contain_text("0.020 inch")


FORM = "proof.toml"


@pytest.fixture
def client(tmp_path):
    return fitted_machine(tmp_path)


def test_proof_marks_take_no_part_unless_asked_for(client, tmp_path):
    client.post("/api/rounds/proof")
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    assert client.get("/api/project").json()["choices"]["marks"] == ["marks.toml"]
    names = [file["name"] for file in client.get("/api/readings").json()["files"]]
    assert names == ["marks.toml"]
    before = len(got(client.get("/api/bench"))["marks"])
    got(client.post("/api/proof/use"))
    assert len(got(client.get("/api/bench"))["marks"]) == before + 2
    assert got(client.get("/api/proof"))["is_used"]


def places_in(form):
    """Where the marks of a form were sent [mm]."""
    return [mark["target"] for mark in tomllib.loads(form.read_text())["mark"]]


def test_a_second_round_gets_other_places_and_keeps_the_first(client, tmp_path):
    client.post("/api/rounds/proof")
    kept = (tmp_path / "proof.toml").read_bytes()
    got(client.post("/api/rounds/proof"))
    assert (tmp_path / "proof.toml").read_bytes() == kept
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    got(client.post("/api/rounds/proof"))
    assert got(client.get("/api/proof"))["round"]["form"] == "proof-2.toml"
    assert (tmp_path / "proof.toml").read_bytes() != kept
    first, second = (places_in(tmp_path / name) for name in ("proof.toml", "proof-2.toml"))
    assert min(math.dist(here, there) for here in first for there in second) > 100


def test_a_folder_that_calls_them_check_marks_is_still_read(client, tmp_path):
    client.post("/api/rounds/proof")
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    for name in ("toml", "nc"):
        (tmp_path / f"proof.{name}").rename(tmp_path / f"check.{name}")
    shown = got(client.get("/api/proof"))
    assert shown["round"]["form"] == "check.toml" and shown["checked"]["holds"]
    assert [file["name"] for file in got(client.get("/api/readings"))["files"]] == ["marks.toml"]
    got(client.post("/api/rounds/proof"))
    assert got(client.get("/api/proof"))["round"]["form"] == FORM
    first, second = (places_in(tmp_path / name) for name in ("check.toml", FORM))
    assert min(math.dist(here, there) for here in first for there in second) > 100


TURN = 9.996939502150416e-06  # [rad] of the example's sheet, as its machine.toml says
WIDTH = 2438.4  # [mm]


def chosen(folder, **more):
    choices = {"settings": "machine.toml", "marks": ["marks.toml"], **more}
    (folder / "lab.json").write_text(json.dumps(choices))
    return asked(folder)


def another_sheet(folder, *, shift=0.0, turn=0.0):
    """The example's marks once more, on another sheet that lies `shift` [mm] farther right, its
    right end `turn` [rad] lower: there the marks are farther from its top edge."""
    text = (EXAMPLE / "marks.toml").read_text()

    def read(match):
        x, y = float(match[1]), float(match[2])
        return f"measured = [{x + turn * y + shift + 0.01:.2f}, {y - turn * x:.2f}]"

    moved = re.sub(r"measured = \[([\d.]+), ([\d.]+)\]", read, text)
    head = 'frame = "sheet-top-left"\n'
    assert head in moved
    (folder / "marks-2.toml").write_text(moved.replace(head, f"{head}new_sheet = true\n"))


def test_the_form_of_a_new_sheet_says_so(client, tmp_path):
    got(client.post("/api/rounds/marks"))
    assert "new_sheet" not in (tmp_path / "marks-2.toml").read_text()
    chosen(tmp_path, new_sheet=True)
    assert not got(client.get("/api/rounds/marks"))["is_saved"]
    got(client.post("/api/rounds/marks"))
    form = read_form(tmp_path / "marks-2.toml", sheet=(WIDTH, 1219.2), known=known_effects())
    assert form.measurements.rounds[0].new_sheet
    assert (
        got(client.get("/api/rounds/marks"))["is_saved"]
        and got(client.get("/api/rounds/marks"))["last_form"] == "marks.toml"
    )


def test_the_next_sheet_is_turned_back_once(client, tmp_path, monkeypatch):
    rise = math.tan(TURN) * WIDTH
    monkeypatch.setattr(round_words, "LEAST_MM", 0.9 * rise)
    stops = "Lay it on the same stops"
    turned = f"{stops}, its right end {rise:.1f} mm higher."
    assert got(client.get("/api/rounds/marks"))["next_sheet"] == turned
    another_sheet(tmp_path)
    chosen(tmp_path, marks=["marks.toml", "marks-2.toml"])
    assert got(client.get("/api/rounds/marks"))["next_sheet"] == f"{stops}."
    chosen(tmp_path, settings="groundcontrol.ini")
    assert got(client.get("/api/rounds/marks"))["next_sheet"] == f"{stops}."


def test_proof_marks_go_by_the_sheet_that_they_are_on(client, tmp_path):
    client.post("/api/rounds/proof")
    type_in(client, "proof.toml", (0.3, 0))
    before = client.get("/api/proof").json()
    assert before["checked"]["state"] == "as_fitted"
    assert [each["form"] for each in before["rounds"]] == ["marks.toml", "proof.toml"]
    first, check = (each["off_target"] for each in before["rounds"])
    assert first > 8 and check == pytest.approx(0.3, abs=1e-6)
    assert [each["is_proof"] for each in before["rounds"]] == [False, True]
    another_sheet(tmp_path, shift=12)
    chosen(tmp_path, marks=["marks.toml", "marks-2.toml"])
    after = client.get("/api/proof").json()
    assert after["checked"]["marks"] == before["checked"]["marks"]
    assert len(after["rounds"]) == 3 and after["rounds"][1]["off_target"] > 12
