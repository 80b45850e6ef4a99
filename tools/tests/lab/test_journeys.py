"""First days at a machine at its port: without a mouse, and with a phone while much goes wrong."""

import re

import pytest
from folder import until
from journeys import Person
from lab_machine import PATIENCE, bar
from playwright.sync_api import expect
from plumb.model.plain import noun_of
from screens import at_rest
from served_lab import serve

MOST_STOPS = 300  # of the Tab key on a screen
FOCUSED = """() => {
  const at = document.activeElement;
  const words = at.getAttribute("aria-label") ?? at.labels?.[0]?.innerText ?? at.innerText ?? "";
  return words.replace(/\\s+/g, " ").trim();
}"""


class Keys(Person):
    """Somebody at the page who has no mouse."""

    def into(self, label):
        """Go to a control by its name, with the Tab key."""
        passed = []
        for _ in range(MOST_STOPS):
            words = self.page.evaluate(FOCUSED)
            if re.search(label, words):
                return
            passed.append(words[:60])
            self.page.keyboard.press("Tab")
        raise AssertionError(f"no way to {label}: {dict.fromkeys(passed)}")

    def press(self, name):
        button = self.page.get_by_role("button", name=re.compile(name))
        expect(button).to_be_enabled(timeout=PATIENCE)
        at_rest(self.page)
        self._enter(name)

    def go_to(self, step):
        self._enter(rf"^\d+ {step}$")

    def unfold(self, name):
        self._enter(f"^{name}$")

    def tick(self, name):
        self.into(name)
        self.page.keyboard.press("Space")

    def _enter(self, name):
        self.into(name)
        self.page.keyboard.press("Enter")


def test_the_error_falls_on_the_machine_at_its_port(lab, page, garage):
    keys = Keys(page, lab)
    keys.connect(garage.path)
    keys.cut(garage)
    first = keys.type_readings(garage, "marks.toml")
    assert first > 5
    keys.go_to("Verdict")
    keys.see(re.compile("The error falls from"))
    (hidden,) = garage.hidden.effects
    assert noun_of(hidden) in page.locator(".say").first.inner_text()
    keys.go_to("Correct")
    keys.press("^Accept all")
    keys.write_and_send()
    keys.lay_next_sheet(garage)
    keys.cut(garage)
    assert keys.type_readings(garage, "marks-2.toml") < 0.3 * first
    keys.go_to("Diary")
    keys.see(re.compile(r"\d+ numbers changed by machine-2\.toml"))


PHONE = {"width": 390, "height": 844}
ABSURD_MM = 298  # for a gap of about 3 m


@pytest.fixture
def phone(browser):
    """A page as large as a phone, which is touched."""
    context = browser.new_context(viewport=PHONE, has_touch=True)
    context.set_default_timeout(PATIENCE)
    yield context.new_page()
    context.close()


class Wary(Person):
    """Somebody who touches the page, believes little, and is let down by cable and computer."""

    def state_what_cannot_be(self):
        """A gap with a digit too few is refused where it was typed, and taken away again."""
        self.go_to("What you know")
        self.into("^the gap between the motors, mm")
        self.type(str(ABSURD_MM))
        self.page.keyboard.press("Tab")
        self.see(re.compile(f"{ABSURD_MM}.0 mm is far from the 2978.4 mm of the settings"))
        self.into("^the gap between the motors, mm")
        self.page.keyboard.press("Control+a")
        self.page.keyboard.press("Delete")
        self.page.keyboard.press("Tab")
        expect(self.page.get_by_text("is far from")).to_have_count(0, timeout=PATIENCE)

    def cut_while_the_computer_fails(self, garage):
        """The server ends in the cut; started again, it knows how far it came.

        Who is wary lays a fresh sheet and begins again.
        """
        self.go_to("Cut")
        self.press("^Move the sled and cut 9 marks$")
        with self.lab.client() as client:
            until(client, lambda machine: garage.marks >= 3)
        self.lab.process.kill()
        self.lab.process.wait()
        self.see("The lab does not answer")
        self.lab = serve(self.lab.folder, port=self.lab.port)
        self.page.goto(f"{self.lab.url}#/cut")
        self.see(re.compile(r"Cut [1-8] of 9 marks, then it broke off\. .*Connect"))
        self.go_to("Machine")
        self.plug(garage.path)
        self.go_to("Cut")
        garage.lay_next_sheet(raised=0)
        self.press("^Begin again on a fresh sheet: move the sled")
        self.see("All marks are cut.")

    def lose_the_line(self, garage):
        """The cable falls out, and is plugged in again: the bar and the page agree."""
        garage.pull_out()
        expect(bar(self.page)).to_contain_text("the line is lost", timeout=PATIENCE)
        expect(bar(self.page).get_by_role("button", name="Connect")).to_be_visible()
        garage.plug_in()
        self.go_to("Machine")
        assert self.page.get_by_text("is connected").count() == 0
        self.plug(garage.path)  # the bar has the way, whatever the screen

    def refuse_a_number(self):
        """All numbers are accepted but the last, which stays as it is."""
        self.go_to("Correct")
        nothing = self.page.get_by_role("button", name="Accept a number first")
        expect(nothing).to_be_disabled(timeout=PATIENCE)
        self.press("^Accept all")
        boxes = self.page.locator(".numbers input")
        count = boxes.count()
        boxes.nth(count - 1).uncheck()
        self.see(re.compile(f"^Write {count - 1} numbers? into machine-2.toml$"))


def test_a_wary_user_is_told_the_truth_and_the_error_falls(lab, phone, garage):
    wary = Wary(phone, lab)
    wary.connect(garage.path)
    wary.state_what_cannot_be()
    try:
        wary.cut_while_the_computer_fails(garage)
        first = wary.type_readings(garage, "marks.toml")
        wary.lose_the_line(garage)
        wary.refuse_a_number()
        wary.write_and_send()
        wary.lay_next_sheet(garage)
        wary.cut(garage)
        second = wary.type_readings(garage, "marks-2.toml")
        wary.go_to("Diary")
        wary.see(re.compile(r"\d+ numbers? changed by machine-2\.toml"))
    finally:
        wary.lab.end()
    assert second < 0.6 * first
