"""Practice in the lab: a virtual machine leaves its secret, and the page reveals it."""

from folder import asked, with_settings
from lab_machine import PATIENCE, start_virtual
from playwright.sync_api import expect
from plumb.vm.practice import Secret, secret_in


def reveal(client, status=200):
    answer = client.post("/api/practice/reveal")
    assert answer.status_code == status, answer.text
    return answer.json()


def test_a_virtual_machine_leaves_its_secret_and_the_settings_are_scored(tmp_path):
    client = asked(tmp_path)
    assert "start a virtual machine" in reveal(client, 422)["error"]
    client.post("/api/machine/virtual", json={"seed": 7, "millimetres": 5})
    assert secret_in(tmp_path) == Secret(7, 5.0)
    assert "no settings are open" in reveal(client, 422)["error"]
    with_settings(tmp_path)
    said = reveal(client)
    assert said["hidden"].startswith("sled_swing") and said["sentence"].startswith("You missed")
    assert said["before_mm"] > 1
    client.post("/api/machine/virtual", json={"hides": "nothing"})
    assert reveal(client)["hidden"] == "nothing"


def test_the_page_reveals_what_its_virtual_machine_hides(lab, page):
    page.goto(f"{lab.url}#/practice")
    page.get_by_text("No virtual machine was started in this folder").wait_for(timeout=PATIENCE)
    terminal = page.locator("details.command code")
    expect(terminal).to_have_text("plumb practice start .")
    start_virtual(page, lab, number=7)
    page.get_by_role("link", name="Practice").click()
    expect(terminal).to_have_text("plumb practice reveal . machine.toml")
    page.get_by_role("button", name="Reveal what was hidden").click()
    score = page.get_by_role("region", name="Score")
    expect(score).to_contain_text("Hidden was sled_swing (right and up). You missed")
    expect(score).not_to_contain_text("You added")  # its numbers are as it listed them
    expect(score).to_contain_text("2.13 mm as the settings were, 2.13 mm with yours")
