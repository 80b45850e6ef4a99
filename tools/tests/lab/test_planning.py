"""Tests of the known numbers, the reach and the planned marks, by the routes and on the page."""

import json
import re
import tomllib

import pytest
from folder import EXAMPLE, asked, choose, got
from playwright.sync_api import expect
from plumb.cli.main import main
from plumb.line.sender import cleaned
from screens import at_rest, await_question

PATIENCE = 300_000  # [ms] of a busy computer


@pytest.fixture
def opened(lab, page):
    """A page on a folder whose settings are open."""
    (lab.folder / "groundcontrol.ini").write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    (lab.folder / "lab.json").write_text('{"settings": "groundcontrol.ini"}')
    page.goto(lab.url)
    page.get_by_role("heading", name="This machine is open").wait_for(timeout=PATIENCE)
    return page


def choices(lab):
    return json.loads((lab.folder / "lab.json").read_text())


def is_change(sent):
    return sent.request.method == "POST"


def shows(page):
    """The number of causes that would show in their usual size."""
    text = page.locator(".sum").inner_text()
    return int(re.search(r"(\d+) would show", text)[1])


def test_marks_are_chosen_added_and_removed(lab, opened):
    page = opened
    page.goto(f"{lab.site}#/measure")
    page.locator(".sum", has_text="would show").wait_for(timeout=PATIENCE)
    nine = shows(page)
    page.get_by_label(re.compile("Twenty-five marks")).check()
    at_rest(page)
    assert shows(page) > nine
    assert choices(lab)["layout"] == "twenty-five"
    page.get_by_label(re.compile("^Nine marks")).check()
    at_rest(page)
    assert shows(page) == nine
    page.get_by_text("Other marks").click()
    page.get_by_label("x from the middle").fill("-100,5")
    page.get_by_label("y from the middle").fill("20")
    page.get_by_role("button", name="Add a mark").click()
    at_rest(page)
    assert choices(lab)["layout"] == "own"
    planned = choices(lab)["planned"]
    assert len(planned) == 10 and planned[1] == [0, 509.6] and planned[-1] == [-100.5, 20]
    page.locator(".sheet .frame").focus()
    page.keyboard.press("Home")
    page.get_by_role("button", name="Take mark 1 away").click()
    at_rest(page)
    assert choices(lab)["planned"] == planned[1:]
    page.get_by_label("x from the middle").fill("9000")
    page.get_by_role("button", name="Add a mark").click()
    expect(page.get_by_role("alert")).to_contain_text("sheet")


def test_the_recommended_plan_is_a_click_away(lab, opened):
    page = opened
    held = []
    page.route("**/layouts/advice*", lambda route: held.append(route))
    page.goto(f"{lab.site}#/measure")
    page.locator(".advised[aria-busy]", has_text="Working out").wait_for(timeout=PATIENCE)
    await_question(page, held)
    held.pop().continue_()
    page.unroute("**/layouts/advice*")
    advice = page.locator(".advised:not([aria-busy])")
    advice.wait_for(timeout=PATIENCE)
    said = advice.inner_text()
    assert "would show" in said and "instead of 2 and 1 with nine marks" in said
    take = page.get_by_role("button", name=re.compile(r"^Take .* \d+ minutes$"))
    take.click()
    at_rest(page)
    assert choices(lab).get("layout", "nine") != "nine"
    take.wait_for(state="detached")
    taken = page.locator(".layouts label:has(:checked)").inner_text().split("about")[0].strip()
    assert said.startswith(f"Recommended. {taken}")


def test_known_numbers_are_kept_and_lower_the_expected_error(lab, opened):
    page = opened
    page.goto(f"{lab.site}#/reach")
    normal = page.locator(".say", has_text="That is normal.")
    normal.wait_for(timeout=PATIENCE)
    before = float(re.search(r"off by ([\d.]+) mm", normal.inner_text())[1])
    page.goto(f"{lab.site}#/known")
    gap = page.get_by_role("textbox", name="the gap between the motors, mm")
    held = []

    def hold(asked):
        held.append(asked) if is_change(asked) else asked.fallback()

    page.route("**/api/known", hold)
    gap.fill("2982,5")
    page.get_by_role("textbox", name=re.compile("the gap.*how far it may be off")).fill("0,8")
    page.keyboard.press("Tab")
    await_question(page, held)
    while held:  # what was sent last is let through first: a busy server may take any order
        with page.expect_response(is_change):
            held.pop().continue_()
        page.wait_for_timeout(100)
    page.unroute("**/api/known")
    at_rest(page)
    assert choices(lab).get("known") == {"motor_gap": {"value": 2982.5, "sigma": 0.8}}
    gap.fill("about two")
    page.keyboard.press("Tab")
    page.get_by_text(re.compile("Type a number, like")).wait_for()
    # What cannot be read does not count, and the number before it no more.
    at_rest(page)
    assert "motor_gap" not in (choices(lab).get("known") or {})
    gap.fill("298")
    page.keyboard.press("Tab")
    refused = page.get_by_role("alert").filter(has_text="298.0 mm is far from the 2978.4 mm")
    refused.wait_for()
    assert gap.get_attribute("aria-invalid") == "true"
    gap.fill("2982.5")
    page.keyboard.press("Tab")
    refused.wait_for(state="detached")
    page.goto(f"{lab.site}#/reach")
    normal.wait_for(timeout=PATIENCE)
    assert float(re.search(r"off by ([\d.]+) mm", normal.inner_text())[1]) < before
    assert "of the sheet is usable" in page.get_by_role("heading", level=1).inner_text()


def test_a_link_to_a_number_opens_its_field(lab, opened):
    page = opened
    page.goto(f"{lab.site}#/known/frame_lean.tangent_squared")
    lean = page.get_by_role("textbox", name="how far the frame leans, degrees")
    lean.wait_for(timeout=PATIENCE)  # though it is folded away for others
    page.get_by_text("with a plumb line or an angle gauge").wait_for()
    assert lean.bounding_box()["y"] < 900
    lean.fill("15")
    page.keyboard.press("Tab")
    at_rest(page)
    assert choices(lab).get("known")
    known = choices(lab)["known"]["frame_lean.tangent_squared"]
    assert known["value"] == pytest.approx(0.0718, abs=1e-4)
    assert known["sigma"] == pytest.approx(0.005, rel=0.1)
    page.reload()
    lean.wait_for(timeout=PATIENCE)
    assert lean.input_value() == "15.0"


def test_without_settings_a_line_says_what_is_missing(tmp_path):
    with asked(tmp_path) as client:
        for path in ("known", "reach", "layouts", "rounds/marks"):
            assert "open the settings" in got(client.get(f"/api/{path}"), 422)["error"]


def test_reach_agrees_with_the_command_and_states_the_expected_error(
    client, tmp_path, capsys, monkeypatch
):
    answer = got(client.get("/api/reach"))
    assert main(["reach", str(tmp_path / "groundcontrol.ini")]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert answer["conclusion"] in printed and answer["normal"] in printed
    whole = "".join(answer["map"])
    assert whole.count(".") / len(whole) == pytest.approx(answer["shares"]["usable"], abs=0.05)
    expected = answer["expected"]
    assert 1 < expected["among_marks_mm"] < expected["whole_mm"] < 50
    choose(client, known={"motor_gap": {"value": 2990.0, "sigma": 0.5}}, units="inch")
    better = got(client.get("/api/reach"))
    assert better["expected"]["among_marks_mm"] < expected["among_marks_mm"]
    assert "--prior motor_gap=0.5" in better["command"]
    monkeypatch.chdir(tmp_path)
    assert main(better["command"].split()[1:]) == 0
    assert better["normal"] in " ".join(capsys.readouterr().out.split())
    assert main([*better["command"].split()[1:], "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["expected"] == pytest.approx(better["expected"])


def test_a_plan_says_which_causes_its_marks_would_show(client):
    plan = got(client.post("/api/preview", json={"layout": "fifteen"}))
    answer, effects = plan["preview"], plan["preview"]["outlines"]
    seen = [effect["effect"] for effect in effects if effect["is_seen"]]
    named = [effect for effect in effects if effect["is_seen"] and effect["is_distinct"]]
    assert answer["marks"] == 15 and plan["trouble"] == ""
    assert 0 < len(named) == answer["named"] <= len(seen) == answer["seen"]
    assert answer["seen"] < len(effects)
    assert "motor_level" not in seen, "the frame takes it up"


def test_the_plan_that_names_most_causes_is_recommended(client):
    choose(client, fineness=0.25)
    advice = got(client.get("/api/layouts/advice"))
    plans = {
        each["id"]: got(client.post("/api/preview", json={"layout": each["id"]}))
        for each in got(client.get("/api/layouts"))
    }
    minutes = {name: plan["minutes"] for name, plan in plans.items()}
    plans = {name: plan["preview"] for name, plan in plans.items()}
    worth = {name: (plan["named"], plan["seen"], -minutes[name]) for name, plan in plans.items()}
    assert worth[advice["layout"]] == max(worth.values())
    best, few = plans[advice["layout"]], plans["nine"]
    said = f"{best['seen']} would show and {best['named']} could be named"
    assert (said in advice["sentence"]) == (best["seen"] > 0)
    instead = f"instead of {few['seen']} and {few['named']} with nine marks"
    assert (instead in advice["sentence"]) == (advice["layout"] != "nine")


def test_program_and_form_are_written_and_no_reading_is_overwritten(client, tmp_path):
    before = got(client.get("/api/rounds/marks"))
    assert not before["is_saved"] and before["trouble"] == ""
    assert (before["form"], before["program"]) == ("marks.toml", "grid.nc")
    lines = list(cleaned(before["text"].splitlines()))
    for mark, taken in zip(before["marks"], before["lines"], strict=True):
        x, y = mark["target"]
        assert lines[taken - 3] == f"G1 X{x:g} Y{y:g} F700"
        assert lines[taken - 2].startswith("G1 Z-0.5")
    assert [mark["name"] for mark in before["marks"]] == list("123654789")
    got(client.post("/api/rounds/marks"))
    after = got(client.get("/api/rounds/marks"))
    assert after["is_saved"] and after["waits"] == 9
    form_line = "(form: marks.toml)\n"
    assert (tmp_path / "grid.nc").read_text().replace(form_line, "") == after["text"]
    form = tomllib.loads((tmp_path / "marks.toml").read_text())
    assert form["cut_with"] == "groundcontrol.ini" and len(form["mark"]) == 9
    choose(client, layout="fifteen")
    assert got(client.get("/api/rounds/marks"))["form"] == "marks.toml"  # nothing was read yet
    text = (tmp_path / "marks.toml").read_text()
    read = text.replace("# measured = [ , ]", "measured = [101.0, 102.0]", 1)
    (tmp_path / "marks.toml").write_text(read)
    got(client.post("/api/rounds/marks"))
    assert (tmp_path / "marks.toml").read_text() == read
    form = tomllib.loads((tmp_path / "marks-2.toml").read_text())
    assert len(form["mark"]) == 15 and (tmp_path / "grid-2.nc").exists()


def test_marks_off_the_sheet_are_refused_in_words_and_nothing_is_written(client, tmp_path):
    choose(client, layout="own", planned=[[0.0, 0.0], [1300.0, 600.0]])
    shown = got(client.get("/api/rounds/marks"))
    assert "sheet" in shown["trouble"] and not shown["is_saved"]
    assert got(client.post("/api/rounds/marks"), 422)["error"] == shown["trouble"]
    assert not list(tmp_path.glob("marks*"))


def test_a_grid_is_not_cut_without_a_machine(client, tmp_path):
    assert "connect it first" in got(client.post("/api/rounds/marks/cut"), 422)["error"]
    assert (
        "of a virtual machine"
        in got(client.post("/api/machine/readings", json={"form": "marks.toml"}), 422)["error"]
    )
