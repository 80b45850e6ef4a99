"""What the page says is so: small things, a line that is lost, and a lab that says nothing."""

import re
import signal
from pathlib import Path

import pytest
from folder import got
from lab_machine import bar, start_virtual, with_machine
from playwright.sync_api import expect
from screens import at_rest, await_question, measured_machine, with_virtual_machine
from served_lab import serve

SPOKEN = """() => {
  window.spoken = [];
  new MutationObserver((all) => all.forEach((each) => {
    const place = each.target.parentElement?.closest("[role=status]");
    if (place) window.spoken.push(place.textContent);
  })).observe(document.querySelector(".machine-bar"), { subtree: true, characterData: true });
}"""


def test_an_address_that_names_no_screen_shows_none(lab, page):
    page.goto(f"{lab.url}#/verdikt")
    expect(page.locator("main h1")).to_have_text("No such screen")
    page.get_by_role("link", name="To the machine").click()
    expect(page.locator("main h1")).to_have_text("Which machine is it?")


def test_the_question_for_the_next_measurement_outlasts_a_reload(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/verdict")
    page.get_by_role("button", name="Find the best next measurement").click()
    page.get_by_label("The next measurement").first.wait_for()
    page.reload()
    page.get_by_label("The next measurement").first.wait_for()
    assert page.get_by_role("button", name="Find the best next measurement").count() == 0


def test_the_report_is_saved_with_the_screens_sentence(lab, fresh_page):
    page = fresh_page
    measured_machine(lab.folder)
    # In the background a tab looks once: it does not see that a file goes, and keeps its button.
    page.add_init_script("Object.defineProperty(document, 'hidden', { value: true })")
    page.goto(f"{lab.url}#/verdict")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save the report").click()
    assert download.value.suggested_filename == "report.html"
    report = Path(download.value.path()).read_text()
    assert page.locator(".say").inner_text() in report
    assert "plumb report groundcontrol.ini marks.toml" in report
    (lab.folder / "marks.toml").unlink()
    page.get_by_role("button", name="Save the report").click()
    expect(page.get_by_role("alert")).to_contain_text("marks.toml")


def test_a_screen_reader_is_told_states_and_no_places_or_counts(lab, page):
    start_virtual(page, lab, number=9)
    page.goto(f"{lab.site}#/cut")
    page.evaluate(SPOKEN)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    page.get_by_text("All marks are cut.").wait_for()
    expect(bar(page).locator("[role=status]").first).to_have_text("The virtual machine stands")
    spoken = page.evaluate("() => window.spoken")
    assert any("runs grid.nc" in line for line in spoken)
    assert not [line for line in spoken if re.search(r"\d+ of \d+|\d mm", line)]
    assert len(spoken) < 12


def test_the_drawing_of_the_machine_has_the_sled_where_the_bar_says(lab, page):
    with_virtual_machine(lab, lambda program: program["outcome"] == "done", speed=1000)
    for screen in ("known", "open"):
        page.goto(f"{lab.url}#/{screen}")
        at_rest(page)
        place = bar(page).locator(".place").inner_text().replace("\u2212", "-")
        said = re.findall(r"-?\d+\.\d", place)
        sled = page.locator(".machine-picture .bit")
        drawn = [float(sled.get_attribute("cx")), -float(sled.get_attribute("cy"))]
        assert drawn == pytest.approx([float(mm) for mm in said[:2]], abs=0.06)


def test_the_page_is_at_rest_once_everything_is_answered_saved_and_drawn(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/readings")
    rest = page.locator("html[data-rest]")
    at_rest(page)
    held = []
    field = page.get_by_label("Mark 2 from the left, mm", exact=True)
    for path, press in (
        ("readings", lambda: field.fill("650")),
        ("verdict", lambda: page.evaluate("() => { location.hash = '#/verdict' }")),
    ):
        page.route(f"**/api/{path}", lambda route: held.append(route))
        press()
        await_question(page, held)
        expect(rest).to_have_count(0)
        held.pop().continue_()
        page.unroute(f"**/api/{path}")
        at_rest(page)
    assert page.locator(".sheet circle.place").count() == 23


def test_the_page_reveals_what_its_virtual_machine_hides(lab, page):
    page.goto(f"{lab.url}#/practice")
    page.get_by_text("No virtual machine was started in this folder").wait_for()
    terminal = page.locator("details.command code")
    expect(terminal).to_have_text("plumb practice start .")
    start_virtual(page, lab, number=7)
    page.get_by_role("link", name="Practice").click()
    expect(terminal).to_have_text("plumb practice reveal . machine.toml")
    page.get_by_role("button", name="Reveal what was hidden").click()
    score = page.get_by_role("region", name="Score")
    expect(score).to_contain_text("Hidden was sled_swing (right and up). You missed")
    expect(score).not_to_contain_text("You added")  # its numbers are as it listed them
    expect(score).to_contain_text("2.13 → 2.13 mm error all over the sheet")


def test_a_board_with_another_firmware_is_offered_ours_and_the_owner_asked_first(lab, fresh_page):
    with_machine(fresh_page, firmware="Firmware Version 1.29", brought="Plumb v1.0.0")
    fresh_page.goto(lab.url)
    expect(fresh_page.get_by_text("On the board: Firmware Version 1.29")).to_be_visible()
    write = fresh_page.get_by_role("button", name="Write Plumb v1.0.0 to this board")
    write.click()
    fresh_page.get_by_role("button", name="Leave it as it is").click()
    write.click()
    now = fresh_page.get_by_role("button", name="Write it now")
    now.click()
    expect(fresh_page.get_by_role("alert")).to_contain_text("no machine is connected")


UNREACHABLE = "Cannot reach the machine: use its power switch"
NEAR = 160  # CSS pixels between a button and what is said of it


@pytest.fixture
def lost(lab, page, cable):
    """The page of a machine whose cable was pulled; at which port it was."""
    path = cable.path
    page.goto(lab.url)
    got(lab.client().post("/api/machine/board", json={"port": path}))
    connected = page.get_by_role("heading", name=f"The machine at {path}")
    expect(connected).to_be_visible()
    expect(bar(page)).to_contain_text("stands")
    cable.pull_out()
    expect(bar(page)).to_contain_text("the line is lost")
    expect(bar(page)).to_contain_text(f"{UNREACHABLE}.")
    return path


def test_the_bar_reconnects_and_offers_new_ports(page, lost):
    port = {"path": "/dev/ttyACM9", "title": "Mega", "is_board": True}
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[port, modem]))
    new = bar(page).get_by_role("button", name="Connect /dev/ttyACM9")
    expect(new).to_be_visible()
    assert bar(page).get_by_role("button", name="ttyS0").count() == 0
    with page.expect_request("**/api/machine/board") as asked:
        bar(page).get_by_role("button", name=f"Connect {lost} again").click()
    assert asked.value.post_data_json == {"port": lost}
    expect(new).to_be_visible()  # it is not there, so the line is lost again
    with page.expect_request("**/api/machine/board") as asked:
        new.click()
    assert asked.value.post_data_json == {"port": "/dev/ttyACM9"}


def test_the_bar_connects_at_any_port_whose_name_is_typed(page, lost):
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[modem]))
    bar(page).get_by_text("Another port").click()
    expect(bar(page).get_by_role("button", name="Connect /dev/ttyS0")).to_be_visible()
    bar(page).get_by_label("Its name").fill("/dev/ttyACM7")
    with page.expect_request("**/api/machine/board") as asked:
        bar(page).get_by_role("button", name="Connect", exact=True).click()
    assert asked.value.post_data_json == {"port": "/dev/ttyACM7"}
    expect(bar(page)).to_contain_text("Connect /dev/ttyACM7 again")


def test_a_refusal_stands_at_its_button(page, lab):
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label("Its name, like COM3").fill("maslow")
    button = page.get_by_role("button", name="Connect", exact=True)
    button.click()
    said = page.get_by_role("alert").filter(has_text="'maslow' is not a serial port")
    expect(said).to_be_visible()
    pressed, words = button.bounding_box(), said.bounding_box()
    assert abs(words["y"] - pressed["y"]) < NEAR


@pytest.fixture
def cutting(lab, page):
    """The page of a slow machine in mid-cut."""
    start_virtual(page, lab, speed=10)
    page.goto(f"{lab.site}#/cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    bar(page).get_by_text(re.compile(r"runs grid.nc: [3-9] of")).wait_for()
    return page


def test_a_killed_lab_is_not_mistaken_for_a_running_machine(lab, cutting):
    lab.process.kill()
    shown = bar(cutting)
    shown.get_by_role("button", name="Stop", exact=True).click()
    expect(cutting.get_by_text("Stop did not get through. Switch off")).to_be_visible()
    expect(cutting.get_by_role("row", name="It was doing grid.nc, line")).to_be_visible()
    expect(shown).to_contain_text(re.compile(r"last seen \d+ s ago"))
    expect(shown.get_by_role("button", name="Try Stop again")).to_be_visible()
    expect(shown.get_by_role("button", name="Stop", exact=True)).to_have_count(0)
    expect(shown.locator(".old .place")).to_be_visible()
    expect(cutting.get_by_role("heading", name="Nobody sees the machine")).to_be_visible()
    assert "runs grid.nc" not in shown.inner_text()
    lab.process = serve(lab.folder, port=lab.port).process
    expect(cutting.get_by_role("region", name="The machine", exact=True)).to_have_count(0)


def test_a_stop_pressed_while_the_lab_is_down_acts_once_it_is_back(lab, cutting):
    shown = bar(cutting)
    lab.process.send_signal(signal.SIGSTOP)
    try:
        shown.locator("button.stop").click()
        expect(cutting.get_by_text("Stop did not get through. Switch off")).to_be_visible()
        expect(shown.get_by_role("button", name="Try Stop again")).to_be_visible()
    finally:
        lab.process.send_signal(signal.SIGCONT)
    expect(shown).to_contain_text("Stop was passed on to the machine.")
    expect(cutting.get_by_text("Stopped. The machine knows")).to_be_visible()
    expect(shown.get_by_role("button", name="Stop", exact=True)).to_be_visible()


def test_stop_comes_through_while_the_browser_has_no_connection_left(lab, cutting):
    """A browser sends six requests at a time: questions that nobody answers take them all."""
    lines = "() => { for (let i = 0; i < 6; i++) void fetch('api/machine/slow' + i); }"
    cutting.route("**/api/machine/s*", lambda route: None)  # held back, Stop as a request too
    cutting.evaluate(lines)
    bar(cutting).get_by_role("button", name="Stop", exact=True).click()
    expect(bar(cutting)).to_contain_text("Stop was passed on to the machine.")
    expect(cutting.get_by_text("Stopped. The machine knows")).to_be_visible()
