"""What the journeys of people share: a machine at its port, its sheet, a tape, and who uses them.

The machine is at a serial port, as a board is. Each number is typed as the tape says it.
"""

import re
import threading

import pytest
from folder import got
from lab_machine import PATIENCE
from playwright.sync_api import expect
from plumb.marks.read import read_marks
from plumb.settings.files import read_settings
from plumb.vm.garage import RANDOM, hide, random_garage
from plumb.vm.owner import VirtualOwner
from plumb.vm.pseudo_terminal import Pace, PseudoTerminal
from plumb.vm.tape import marks_on
from screens import at_rest

NUMBER = 9  # of the machine: one effect of 3 mm, and a sheet that lies turned
SPEED = 200  # times as fast as a real machine
RESTS_MS = 30_000  # in which a machine goes on, if it has its lines
GAP = 2  # the machine's number for the gap between the motors
SHEET = (2438.4, 1219.2)


class Garage:
    """The machine at its port, its sheet and the owner's tape."""

    def __init__(self):
        self.hidden = hide([RANDOM], millimetres=3, seed=NUMBER)
        self.owner = VirtualOwner(random_garage(self.hidden, NUMBER))
        self.owner.switch_on()
        self.owner.machine.advance(10_000)
        self._mine = threading.Lock()
        self.plug_in()

    def plug_in(self, speed=SPEED):
        """A cable to the machine; its port may have another name than before."""
        self._terminal = PseudoTerminal(self.owner.machine)
        self.run_at(speed)
        self._is_pulled = threading.Event()
        self._clock = threading.Thread(target=self._run)
        self._clock.start()

    def run_at(self, speed):
        """Let it run this many times as fast as a real machine while it moves."""
        self._speed, self._pace = speed, Pace(speed)

    @property
    def path(self):
        return self._terminal.path

    def _run(self):
        while not self._is_pulled.is_set():
            with self._mine:
                before = self._place
                self._terminal.pass_time(self._pace.due())
            # To hurry at rest would cost a whole processor for nothing.
            self._pace.speed = self._speed if self._place != before else 1
        self._terminal.close()

    @property
    def _place(self):
        machine = self.owner.machine
        return *(round(length, 3) for length in machine.chains), round(machine.height, 3)

    def read(self, form):
        """What the tape says of each mark of a form, from the sheet's left and top edges [mm]."""
        with self._mine:
            filled = self.owner.tape.fill(form.read_text(), self.owner.machine)
        copy = form.with_name("as-read.toml")
        copy.write_text(filled)
        marks = read_marks(copy, sheet=SHEET).readings
        copy.unlink()
        return [(x + SHEET[0] / 2, SHEET[1] / 2 - y) for _, (x, y) in marks]

    @property
    def lengths(self):
        """What a tape says of both chains, and of the bit's height [mm]."""
        with self._mine:
            return *self.owner.machine.chains, self.owner.machine.height

    @property
    def marks(self):
        """How many are on the sheet."""
        with self._mine:
            return len(marks_on(self.owner.machine.cuts()))

    def marks_at_rest(self):
        """How many there are when the machine has done all that it was sent."""
        before = None
        while self._place != before:
            before = self._place
            with self._mine:
                self._terminal.pass_time(RESTS_MS)
        return self.marks

    def lay_next_sheet(self, raised):
        with self._mine:
            self.owner.lay_next_sheet(raised=raised)

    def pull_out(self):
        self._is_pulled.set()
        self._clock.join()


class Person:
    """Somebody at the page, with a mouse or a finger."""

    def __init__(self, page, lab):
        self.page, self.lab = page, lab

    def press(self, name):
        button = self.page.get_by_role("button", name=re.compile(name))
        expect(button).to_be_enabled(timeout=PATIENCE)
        at_rest(self.page)
        button.click()

    def go_to(self, step):
        fold = self.page.locator("nav .fold")
        if fold.is_visible() and fold.get_attribute("aria-expanded") == "false":
            fold.click()
        self.page.get_by_role("navigation").get_by_role("link", name=step).click()

    def unfold(self, name):
        self.page.locator("summary", has_text=name).click()

    def tick(self, name):
        self.page.get_by_role("checkbox", name=re.compile(name)).check()

    def into(self, label):
        """The keyboard writes into the field of this label."""
        self.page.get_by_label(re.compile(label)).first.click()

    def type(self, words):
        self.page.keyboard.press("Control+a")
        self.page.keyboard.type(words)
        self.page.keyboard.press("Enter")

    def see(self, text):
        expect(self.page.get_by_text(text).first).to_be_visible(timeout=PATIENCE)

    def number(self, number):
        """A number as the machine itself says it."""
        said = got(self.lab.client().post("/api/machine/line", json={"text": "$$"}))
        return float(re.search(rf"^\${number}=(\S+)", "\n".join(said), re.MULTILINE)[1])

    def plug(self, path):
        """Connect the machine at a port."""
        self.unfold("Another port")
        self.into("^Its name")
        self.type(path)
        self.see(re.compile("is connected"))

    def connect(self, path):
        """Connect a machine that the folder does not know yet."""
        self.page.goto(self.lab.url)
        self.plug(path)
        self.press("^Read its settings")
        expect(self.page.get_by_role("heading", name="This machine is open")).to_be_visible(
            timeout=PATIENCE
        )

    def cut(self, garage):
        self.go_to("Cut")
        self.press("^Move the sled and cut 9 marks$")
        self.see("All marks are cut.")

    def type_readings(self, garage, name):
        """What the tape says; the error as the page counts it [mm]."""
        readings = garage.read(self.lab.folder / name)
        self.go_to("Readings")
        self.into("^Mark 1 from the left")
        for x, y in readings:  # Enter goes on
            self.type(f"{x:.1f}")
            self.type(f"{y:.1f}")
        self.see(re.compile("9 of 9 marks are read"))
        typed = [[round(x, 1), round(y, 1)] for x, y in readings]
        at_rest(self.page)
        assert self._saved(name) == typed
        at_rest(self.page)
        said = self.page.locator(".count").inner_text()
        return float(re.search(r"(\d+\.\d+) mm", said)[1])

    def _saved(self, name):
        form = got(self.lab.client().get("/api/readings", params={"file": name}))
        return [mark["read"] for mark in form["marks"]]

    def write_and_send(self):
        """The numbers that are accepted, into the machine."""
        self.press("^Write .* into machine-2.toml$")
        self.press("^Send machine-2.toml to")
        self.see(re.compile("each was read back"))
        written = read_settings(self.lab.folder / "machine-2.toml").motor_gap
        assert self.number(GAP) == pytest.approx(written, abs=0.001)

    def lay_next_sheet(self, garage):
        """As the page says: its right end higher or lower, if the first lay turned."""
        self.go_to("Cut")
        self.tick("^On another sheet than marks.toml")
        lower = self.page.get_by_text(re.compile(r"its right end [\d.]+ mm (lower|higher)")).first
        expect(lower).to_be_visible(timeout=PATIENCE)
        size, way = re.search(r"right end ([\d.]+) mm (lower|higher)", lower.inner_text()).groups()
        garage.lay_next_sheet(raised=float(size) * (-1 if way == "lower" else 1))
