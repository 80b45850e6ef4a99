"""An owner's first day without a mouse: from an empty folder to a better machine at its port."""

import re

from journeys import Person
from lab_machine import PATIENCE
from playwright.sync_api import expect
from plumb.model.plain import noun_of
from screens import at_rest

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
