"""On the page: the machine holds other numbers than the file that is open, and which hold is
asked."""

import re

from lab_machine import PATIENCE, start_virtual
from playwright.sync_api import expect

GAP = re.compile(r"motor_gap\s*\$2 = 3008\.4 mm\s*\$2 = 2978\.4 mm")


def question(page):
    return page.get_by_role("alert", name="Which numbers hold?")


def with_another_file(lab, page):
    """A virtual machine is connected, and a file with another gap between the motors opened."""
    start_virtual(page, lab)
    other = lab.folder / "machine.toml"
    content = other.read_text().replace("2978.4", "3008.4").encode()
    picked = {"name": "other.toml", "mimeType": "text/plain", "buffer": content}
    page.locator("input[type=file]").first.set_input_files(picked)
    expect(question(page)).to_contain_text(GAP, timeout=PATIENCE)


def test_nothing_is_cut_before_it_is_said_which_numbers_hold(lab, page):
    with_another_file(lab, page)
    page.goto(f"{lab.site}#/cut")
    expect(question(page)).to_contain_text(GAP, timeout=PATIENCE)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    said = page.get_by_text(re.compile(r"is 3008\.4 in .* and 2978\.4 in the machine"))
    expect(said).to_be_visible(timeout=PATIENCE)
    assert not (lab.folder / "marks.toml").exists()
    question(page).get_by_role("button", name="The machine's: take them").click()
    expect(question(page)).to_have_count(0, timeout=PATIENCE)
    expect(page.get_by_text(re.compile("Which holds"))).to_have_count(0)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    page.get_by_text("All marks are cut.").wait_for(timeout=PATIENCE)


def test_the_files_numbers_go_into_the_machine_as_the_other_answer(lab, page):
    with_another_file(lab, page)
    question(page).get_by_role("button", name="send them to the machine").click()
    expect(question(page)).to_have_count(0, timeout=PATIENCE)
    (before,) = lab.folder.glob("*-before-*.nc")
    assert "$2=2978.4\n" in before.read_text()
