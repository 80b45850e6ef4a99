"""Practice in a real browser, from the start to the score."""

import pytest
from playwright.sync_api import expect
from plumb.cli.main import build_parser
from plumb.model.plain import noun_of


@pytest.fixture
def game(lab, page):
    page.set_default_timeout(300_000)  # a sheet is cut by a simulated machine
    page.goto(f"{lab.url}#/practice")
    return page


def test_practice_is_solved_from_start_to_score(game, lab):
    game.get_by_role("radio", name="1 one effect, large").check()
    game.get_by_text("Play a certain machine").click()
    game.get_by_label("Its number").fill("3")
    terminal = game.locator("details.command code")
    expect(terminal).to_have_text("plumb practice start . --level 1 --seed 3")
    game.get_by_role("button", name="Begin a game").click()
    game.get_by_label("Which").select_option("5x3")
    expect(terminal).to_contain_text("plumb practice measure . 5x3")
    game.get_by_label("Directly").select_option("motor_gap")
    expect(terminal).to_contain_text("plumb practice check . motor_gap")
    game.get_by_role("button", name="Move the virtual machine and cut 15 marks").click()
    game.get_by_role("progressbar").wait_for()
    game.get_by_text("15 readings").wait_for()
    assert (lab.folder / "marks.toml").read_text().count("measured") == 15
    game.get_by_role("button", name="Take a hint").click()
    game.get_by_text("It is one effect, large.").wait_for()
    game.reload()
    game.get_by_text("It is one effect, large.").wait_for()  # nothing is lost
    game.get_by_text("15 readings").wait_for()  # from now on nothing moves under the mouse
    game.get_by_role("button", name="Take a hint").click()
    hint = game.get_by_text("Among these").inner_text()
    among = hint.removeprefix("Among these: ").rstrip(".").split(", ")
    expect(game.locator(".budget")).to_contain_text("30 of 45")

    game.get_by_role("link", name="Effects bench").last.click()
    rows, left_out = game.locator(".stairs tbody tr"), {}
    for effect in among:
        box = game.get_by_role("checkbox", name=noun_of(effect))
        box.check()
        rows.nth(2).wait_for()
        left_out[effect] = float(rows.nth(2).locator("td").last.inner_text())
        box.uncheck()
        rows.nth(2).wait_for(state="detached")
    game.get_by_role("checkbox", name=noun_of(min(left_out, key=left_out.get))).check()
    rows.nth(2).wait_for()
    game.get_by_role("button", name="Write these numbers to new.toml").click()
    game.get_by_text("new.toml is written.").wait_for()

    game.get_by_role("link", name="Practice").click()
    game.get_by_label("Mark", exact=True).select_option("7")
    expect(terminal).to_contain_text("plumb practice read . 7")
    lines = terminal.text_content().splitlines()
    assert "plumb practice read . 7" in lines and "plumb practice solve . new.toml" in lines
    for line in lines:
        build_parser().parse_args(line.split()[1:])
    game.get_by_role("button", name="Send new.toml and cut a second sheet").click()
    game.get_by_role("heading", name="Practice: solved").wait_for()
    assert "You found" in game.locator(".say").inner_text()
    assert "False claims: 0" in game.locator(".score").inner_text()
    yours = game.locator(".score tr.yours td").last.inner_text()
    before = game.locator(".score tr.wrong td").last.inner_text()
    assert float(yours.split()[0]) < 0.5 * float(before.split()[0])


def test_places_are_chosen_by_touch(game):
    game.get_by_role("button", name="Begin a game").click()
    game.get_by_label("Which").select_option("places")
    sheet = game.locator(".practice-sheet svg")
    box = sheet.bounding_box()
    for share in (0.3, 0.6):
        sheet.click(position={"x": box["width"] * share, "y": box["height"] / 2})
    game.get_by_role("button", name="cut 2 marks").click()
    game.get_by_text("2 readings").wait_for()
    game.locator(".budget").get_by_text("43 of 45").wait_for()
