"""An owner's first day without a mouse: from an empty folder to a better machine at its port.

The machine is at a serial port, as a board is. Each number is typed as the tape says it.
"""

import re
import threading

import pytest
from folder import got
from lab_machine import PATIENCE
from playwright.sync_api import expect
from plumb.marks.read import read_marks
from plumb.model.plain import noun_of
from plumb.settings.files import read_settings
from plumb.vm.garage import RANDOM, hide, random_garage
from plumb.vm.owner import VirtualOwner
from plumb.vm.pseudo_terminal import Pace, PseudoTerminal
from plumb.vm.tape import marks_on

NUMBER = 9  # of the machine: one effect of 3 mm, and a sheet that lies turned
SPEED = 200  # times as fast as a real machine
GAP = 2  # the machine's number for the gap between the motors
SHEET = (2438.4, 1219.2)
MOST_STOPS = 300  # of the Tab key on a screen
FOCUSED = """() => {
  const at = document.activeElement;
  const words = at.getAttribute("aria-label") ?? at.labels?.[0]?.innerText ?? at.innerText ?? "";
  return words.replace(/\\s+/g, " ").trim();
}"""


class Garage:
    """The machine at its port, its sheet and the owner's tape."""

    def __init__(self):
        self.hidden = hide([RANDOM], millimetres=3, seed=NUMBER)
        self.owner = VirtualOwner(random_garage(self.hidden, NUMBER))
        self.owner.switch_on()
        self.owner.machine.advance(10_000)
        self._terminal, self._pace = PseudoTerminal(self.owner.machine), Pace(SPEED)
        self._is_over, self._mine = threading.Event(), threading.Lock()
        self._clock = threading.Thread(target=self._run)
        self._clock.start()

    @property
    def path(self):
        return self._terminal.path

    def _run(self):
        while not self._is_over.is_set():
            with self._mine:
                self._terminal.pass_time(self._pace.due())
        self._terminal.close()

    def read(self, form):
        """What the tape says of each mark of a form, from the sheet's left and top edges [mm]."""
        with self._mine:
            filled = self.owner.tape.fill(form.read_text(), self.owner.machine)
        copy = form.with_name("as-read.toml")
        copy.write_text(filled)
        marks = read_marks(copy, sheet=SHEET).readings
        copy.unlink()
        return [(x + SHEET[0] / 2, SHEET[1] / 2 - y) for _, (x, y) in marks]

    def await_marks(self, page, count):
        """Wait until that many are on the sheet."""
        for _ in range(PATIENCE // 100):
            with self._mine:
                if len(marks_on(self.owner.machine.cuts())) >= count:
                    return
            page.wait_for_timeout(100)

    def lay_next_sheet(self, raised):
        with self._mine:
            self.owner.lay_next_sheet(raised=raised)

    def end(self):
        self._is_over.set()
        self._clock.join()


@pytest.fixture
def garage():
    garage = Garage()
    yield garage
    garage.end()


class Keys:
    """Somebody at the page who has no mouse."""

    def __init__(self, page, lab):
        self.page, self.lab = page, lab

    def to(self, name):
        """Go to a control by its name, with the Tab key."""
        passed = []
        for _ in range(MOST_STOPS):
            words = self.page.evaluate(FOCUSED)
            if re.search(name, words):
                return
            passed.append(words[:60])
            self.page.keyboard.press("Tab")
        raise AssertionError(f"no way to {name}: {dict.fromkeys(passed)}")

    def press(self, name):
        button = self.page.get_by_role("button", name=re.compile(name))
        expect(button).to_be_enabled(timeout=PATIENCE)
        self.to(name)
        self.page.keyboard.press("Enter")

    def go_to(self, step):
        self.to(rf"^\d+ {step}$")
        self.page.keyboard.press("Enter")

    def see(self, text):
        expect(self.page.get_by_text(text).first).to_be_visible(timeout=PATIENCE)

    def type(self, words):
        self.page.keyboard.press("Control+a")
        self.page.keyboard.type(words)
        self.page.keyboard.press("Enter")

    def connect(self, path):
        self.to("^Another port$")
        self.page.keyboard.press("Enter")
        self.to("^Its name")
        self.type(path)
        self.press("^Read its settings")
        expect(self.page.get_by_role("heading", name="This machine is open")).to_be_visible(
            timeout=PATIENCE
        )

    def cut_and_type(self, garage, name):
        """Cut nine marks and type what the tape says; the error as the page counts it [mm]."""
        self.press("^Move the sled and cut 9 marks$")
        garage.await_marks(self.page, 9)
        self.see("All marks are cut.")
        form = self.lab.folder / name
        readings = garage.read(form)
        self.go_to("Readings")
        self.to("^Mark 1 from the left")
        for x, y in readings:  # Enter goes on
            self.type(f"{x:.1f}")
            self.type(f"{y:.1f}")
        self.see(re.compile("9 of 9 marks are read"))
        assert len(read_marks(form, sheet=SHEET).measured_marks) == 9
        said = self.page.locator(".count").inner_text()
        return float(re.search(r"(\d+\.\d+) mm", said)[1])

    def number(self, number):
        said = got(self.lab.client().post("/api/machine/line", json={"text": "$$"}))
        return float(re.search(rf"^\${number}=(\S+)", "\n".join(said), re.MULTILINE)[1])


def test_the_error_falls_on_the_machine_at_its_port(lab, page, garage):
    keys = Keys(page, lab)
    page.goto(lab.url)
    keys.connect(garage.path)
    keys.go_to("Cut")
    first = keys.cut_and_type(garage, "marks.toml")
    assert first > 5
    keys.go_to("Verdict")
    keys.see(re.compile("The error falls from"))
    (hidden,) = garage.hidden.effects
    assert noun_of(hidden) in page.locator(".say").first.inner_text()
    keys.go_to("Correct")
    keys.press("^Accept all")
    keys.press("^Write .* into machine-2.toml$")
    keys.press("^Send machine-2.toml to")
    keys.see(re.compile("each was read back"))
    written = read_settings(lab.folder / "machine-2.toml").motor_gap
    assert keys.number(GAP) == pytest.approx(written, abs=0.001)
    keys.go_to("Cut")
    keys.to("^On another sheet than marks.toml")
    page.keyboard.press("Space")
    lower = page.get_by_text(re.compile(r"its right end [\d.]+ mm (lower|higher)")).first
    expect(lower).to_be_visible(timeout=PATIENCE)
    size, way = re.search(r"right end ([\d.]+) mm (lower|higher)", lower.inner_text()).groups()
    garage.lay_next_sheet(raised=float(size) * (-1 if way == "lower" else 1))
    second = keys.cut_and_type(garage, "marks-2.toml")
    assert second < 0.3 * first
    keys.go_to("Diary")
    keys.see(re.compile(r"\d+ numbers changed by machine-2\.toml"))
