"""The correction: number by number, written, opened, taken back, by the routes and on the page."""

import re

import pytest
from folder import awaited, choose, compared, finished, type_in, with_marks, write_correction
from playwright.sync_api import expect
from plumb.diary.file import read_diary
from plumb.settings import read_settings
from screens import at_rest, measured_machine


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def shown(client):
    return awaited(client, "correction", lambda answer: answer["correction"])


def known(client):
    project = client.get("/api/project").json()
    settings = project["files"][project["choices"]["settings"]]
    return {"settings": settings, "choices": project["choices_digest"]}


def test_a_correction_is_written_opened_and_undone(client, tmp_path):
    answer = shown(client)
    before = answer["correction"]
    assert before["accepted"] is None and not answer["is_written"]
    names = [number["name"] for number in before["numbers"]]
    gap = before["numbers"][names.index("motor_gap")]
    assert gap["unit"] == "mm" and float(gap["margin"]) > 0 and gap["possible"]
    choose(client, accepted=names)
    after = shown(client)["correction"]
    assert after["accepted"]["fit_rms"] == pytest.approx(before["whole"]["fit_rms"])
    written = write_correction(client)
    assert set(written["files"]) >= {"machine.toml", "machine.nc", "machine-groundcontrol.ini"}
    project = client.get("/api/project").json()
    assert project["choices"]["settings"] == "machine.toml"
    made = read_settings(tmp_path / "machine.toml")
    assert made.motor_gap == pytest.approx(float(gap["after"]), abs=1)
    assert compared(tmp_path).rms == pytest.approx(before["whole"]["fit_rms"], abs=0.02)
    (entry,) = read_diary(tmp_path).of_kind("fit")
    assert entry.content["machine"] == "machine.toml"
    assert shown(client)["heading"]["title"] == "The numbers are written"
    undone = client.post("/api/correction/undo", json=known(client)).json()
    assert undone["choices"]["settings"] == "groundcontrol.ini"
    assert compared(tmp_path).rms == pytest.approx(before["as_set"]["fit_rms"])
    assert (tmp_path / "machine.toml").exists()


def test_nothing_accepted_is_not_written_and_an_older_page_neither(client, tmp_path):
    write_correction(client, 422)
    old = known(client)
    choose(client, accepted=["motor_gap"])
    assert client.post("/api/correction", json=old).status_code == 409
    assert not (tmp_path / "machine.toml").exists()
    assert client.post("/api/correction/undo", json=known(client)).status_code == 422


def test_a_machine_that_is_as_good_as_its_marks_can_show_is_left_as_it_is(client):
    type_in(client, "marks.toml", (0.3, -0.4), (-0.5, 0.1), (0.2, 0.5), (-0.1, -0.3))
    made = shown(client)["correction"]
    assert (made["heading"]["title"], made["instead"]["screen"]) == ("Nothing to change", "verdict")
    assert made["heading"]["say"] == "Your machine is as good as these marks can show."
    write_correction(client, 422)
    verdict = awaited(client, "verdict", lambda answer: answer["verdict"])["verdict"]
    assert verdict["title"] == "Nothing to change"


def test_a_slip_is_not_fitted(client, tmp_path):
    form = tmp_path / "marks.toml"
    form.write_text(
        form.read_text().replace("measured = [659.5, 110.5]", "measured = [659.5, 210.5]")
    )
    made = shown(client)["correction"]
    assert made["instead"] == {"text": "Go to mark 2", "screen": "readings"}
    assert made["numbers"] == []
    assert "look at the reading of 2" in made["reasons"][0]
    choose(client, accepted=["motor_gap"])
    write_correction(client, 422)


TITLE = "main h1"
WANTED = "main .primary"
ALL = ("motor_gap", "motor_height", "motor_center_x", "chain_stretch.compliance")


def write(page, lab, *names):
    """Numbers of the example's correction, into a file."""
    measured_machine(lab.folder)
    with lab.client() as client:
        choose(client, accepted=list(names))
        finished(client, "correction")
    page.goto(f"{lab.url}#/correct")
    expect(page.locator(TITLE)).to_have_text("What would change?")
    page.get_by_role("button", name=re.compile(r"Write \d numbers? into machine")).click()
    expect(page.locator(TITLE)).to_have_text("The numbers are written")
    expect(page.locator(".errors[aria-busy=false]")).to_be_visible()
    expect(page.locator(TITLE)).to_have_text("The numbers are written")


def test_after_writing_the_next_action_is_to_send_to_the_machine(lab, page):
    write(page, lab, *ALL)
    assert page.get_by_role("checkbox").count() == 0
    assert page.get_by_role("button", name="Accept all").count() == 0
    expect(page.locator(WANTED)).to_have_text("Connect the machine, then send machine.toml")
    page.reload()
    expect(page.locator(WANTED)).to_have_text("Connect the machine, then send machine.toml")
    page.get_by_role("button", name="Go back to groundcontrol.ini").click()
    expect(page.locator(TITLE)).to_have_text("What would change?")


def test_a_slider_shows_the_errors_before_on_its_left_and_after_on_its_right(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/correct")
    slider = page.get_by_role("slider", name="as groundcontrol.ini says on the left")
    expect(slider).to_be_visible()
    beyond = page.locator(".sheet .arrow.beyond")
    counts = []
    for place in ("1220", "0", "-1220"):  # [mm] from the middle
        slider.fill(place)
        at_rest(page)
        counts.append(beyond.count())
    assert counts[0] > counts[1] > counts[2]


def test_rejected_numbers_are_folded_away_and_can_be_accepted_later(lab, page):
    write(page, lab, "motor_height")
    before, now = (
        read_settings(lab.folder / each) for each in ("groundcontrol.ini", "machine.toml")
    )
    assert now.motor_gap == before.motor_gap and now.motor_height != before.motor_height
    assert page.get_by_role("checkbox").count() == 0
    page.get_by_text("What would still change").click()
    gap = page.get_by_role("checkbox", name="gap between the motors")
    gap.check()
    wanted = page.locator(WANTED)
    expect(wanted).to_have_text("Write 1 number into machine-2.toml")


def test_a_reading_changed_after_writing_marks_the_correction_as_stale(lab, page):
    write(page, lab, *ALL)
    form = lab.folder / "marks.toml"
    form.write_text(form.read_text().replace("[659.5, 110.5]", "[659.5, 111.5]"))
    for step in ("verdict", "prove", "correct"):
        page.goto(f"{lab.site}#/{step}")
        expect(page.locator(TITLE)).to_have_text("Your readings have changed")
    expect(page.locator(".say")).to_contain_text("The numbers in machine.toml are stale")
    page.get_by_role("button", name="Go back to groundcontrol.ini and fit again").click()
    expect(page.locator(TITLE)).to_have_text("What would change?")
    expect(page.locator(WANTED)).to_have_count(1)


def test_each_error_of_a_fit_is_shown_beside_that_of_noise_alone(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/correct")
    page.get_by_role("button", name="Accept all").click()
    fall = re.compile(r"8\.91\s*→\s*to 0\.\d\d mm\s*noise alone leaves 0\.\d\d$")
    expect(page.locator(".errors")).to_have_text(fall)
    by_hand = page.get_by_role("region", name="By hand").inner_text()
    assert "too long: no firmware" in by_hand and "_" not in by_hand
