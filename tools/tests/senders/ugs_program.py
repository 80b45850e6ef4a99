"""Universal G-code Sender by its protocol: sends what it sends, and expects what it expects.

The program is Java and in no registry. What is here was read from its classes (GrblController,
GrblControllerInitializer, BufferedCommunicator, GrblUtils, StatusPollTimer) and says in our words
when it sends which bytes, and what makes it give up.
"""

import re
import threading
import time
from collections import deque
from pathlib import Path

import serial
from grbl_board import Shown, until

BAUD = 57_600
BUFFER = 128  # characters on their way at most, ends of lines counted: as Grbl holds
WAKING = 2.0  # [s] it waits before its first question, and again before the next
TRIES, TRY = 10, 1.0  # questions for a status, and [s] between them
PATIENCE = 5.0  # [s] for the answer to a command
POLL_EVERY = 0.2  # [s]
MISSED_POLLS = 20  # then it asks again
# Lines that touch the memory go alone: nothing follows before they are answered.
ALONE = re.compile(r"G10|G28|G30|\$x=|\$I|\$N|\$RST=|G5[456789]|\$\$|\$#", re.IGNORECASE)
STATUS = re.compile(r"<[a-zA-Z:0-9]+[|].*>")
SETTING = re.compile(r"\$(\d+)=(.+)")
COMMENT = re.compile(r"\([^)]*\)|;.*")
FEED = {100: 0x90, 110: 0x91, 90: 0x92, 101: 0x93, 99: 0x94}
RAPIDS = {100: 0x95, 50: 0x96, 25: 0x97}
SPINDLE = {100: 0x99, 110: 0x9A, 90: 0x9B, 101: 0x9C, 99: 0x9D}
BYTES = {"feed": FEED, "rapids": RAPIDS, "spindle": SPINDLE}
HOLD, GO_ON, RESET, CANCEL = b"!", b"~", b"\x18", b"\x85"


class Command:
    """A line on its way, and what came before its answer."""

    def __init__(self, text: str):
        self.text, self.answers, self.is_done, self.is_wrong = text, [], False, False

    def take(self, line: str) -> None:
        """A line that came while this is the oldest that is not answered."""
        if self.is_done:
            return  # the `ok` of the empty line behind a `?`
        self.answers.append(line)
        if self.text == "?":
            # A question for the status is over with whatever comes first.
            self.is_done, self.is_wrong = True, not STATUS.match(line)
        elif line.startswith(("ok", "error", "ALARM")):
            self.is_done, self.is_wrong = True, not line.startswith("ok")


class Ugs:
    """UGS with its buttons."""

    name = "UGS"
    lacks = frozenset()

    def __init__(self, folder: Path):
        self._line: serial.Serial | None = None
        self._lock = threading.RLock()
        self._empty()
        self._console: list[str] = []
        self._settings: dict[str, str] = {}
        self._is_ready = self._streams = False
        self._status = ""
        self._wco, self._overrides = (0.0, 0.0, 0.0), (0, 0, 0)
        self._missed = 0

    def _empty(self) -> None:
        """Forget what is on its way, and what waits."""
        self._on_the_way: deque[Command] = deque()
        self._waiting: deque[Command] = deque()
        self._is_paused = self._is_alone = False

    def connect(self, port: str) -> None:
        self._is_ready = False
        self._empty()
        self._line = serial.Serial(port, BAUD, timeout=0.05)
        threading.Thread(target=self._listen, args=[self._line], daemon=True).start()
        self._initialize()
        threading.Thread(target=self._poll, args=[self._line], daemon=True).start()
        until(lambda: self._status, "UGS has polled a status")

    def _initialize(self) -> None:
        """Its questions to a machine that it does not know yet."""
        time.sleep(WAKING)
        for _ in range(TRIES):
            began = time.monotonic()
            question = self._asked("?", TRY)
            if question.is_done and not question.is_wrong:
                break
            time.sleep(max(0.0, began + TRY - time.monotonic()))
        else:
            raise AssertionError("UGS: Could not query the device status")
        state = re.split("[|:]", question.answers[0][1:])[0]
        assert state != "Check", "UGS resets a machine in Check"
        if state in ("Sleep", "Door", "Hold", "Alarm"):
            empty = self._asked("", PATIENCE)
            assert empty.is_done and not empty.is_wrong, f"UGS: no answer in {state}: resets"
        time.sleep(WAKING)
        version = self._answered("$I")
        assert any(line.startswith("[VER") for line in version), f"UGS: no version in {version}"
        self._settings = dict(
            match.groups() for line in self._answered("$$") if (match := SETTING.match(line))
        )
        assert any(line.startswith("[GC:") for line in self._answered("$G")), "UGS: no modes"
        self._is_ready = True

    def _answered(self, text: str) -> list[str]:
        command = self._asked(text, PATIENCE)
        assert command.is_done and not command.is_wrong, f"UGS: {text}: {command.answers}"
        return command.answers

    def _asked(self, text: str, patience: float) -> Command:
        """A command that it waits for [s]."""
        command = Command(text)
        self._waiting.append(command)
        self._stream()
        end = time.monotonic() + patience
        while not command.is_done and time.monotonic() < end:
            time.sleep(0.01)
        return command

    def _stream(self) -> None:
        """Send what waits, as far as the machine's buffer holds it."""
        with self._lock:
            while self._waiting and not self._is_paused:
                on_the_way = sum(len(each.text) + 1 for each in self._on_the_way)
                text = self._waiting[0].text
                if on_the_way + len(text) + 1 > BUFFER or (self._is_alone and self._on_the_way):
                    return
                command = self._waiting.popleft()
                self._on_the_way.append(command)
                self._is_alone = bool(ALONE.search(text))
                self._line.write(f"{text}\n".encode())

    def _listen(self, line: serial.Serial) -> None:
        came = b""
        while line.is_open:
            try:
                came += line.read(line.in_waiting or 1)
            except (OSError, TypeError):
                return
            *whole, came = came.split(b"\n")
            for each in whole:
                with self._lock:
                    self._take(each.decode("ascii", "replace").strip())
            self._stream()

    def _take(self, text: str) -> None:
        """A line of the machine."""
        if not text:
            return
        if self._on_the_way:
            self._on_the_way[0].take(text)
        if text.startswith("<"):
            self._missed = 0
            self._take_status(text)
            return
        self._console.append(text)
        if text.startswith(("ok", "error", "ALARM")):
            if not self._on_the_way and self._is_ready:
                self._console.append(f"UGS: an unexpected answer: {text}")
            elif self._on_the_way:
                self._on_the_way.popleft()
            if text.startswith("error") and (self._waiting or self._on_the_way):
                self._is_paused = True
        elif text.startswith("Grbl ") and (self._on_the_way or self._waiting):
            self._empty()

    def _take_status(self, text: str) -> None:
        if not self._is_ready or not STATUS.match(text):
            return
        if self._status.startswith("<Jog") and text.startswith("<Idle"):
            self._empty()
        for part in text[1:-1].split("|")[1:]:
            name, _, numbers = part.partition(":")
            if name == "WCO":
                self._wco = tuple(map(float, numbers.split(",")))
            elif name == "Ov":
                self._overrides = tuple(map(int, numbers.split(",")))
        self._status = text

    def _poll(self, line: serial.Serial) -> None:
        while line.is_open:
            if self._missed % MISSED_POLLS == 0:
                try:
                    line.write(b"?")
                except (OSError, TypeError):
                    return
            self._missed += 1
            time.sleep(POLL_EVERY)

    def disconnect(self) -> None:
        line, self._line = self._line, None
        line.close()
        self._status = ""

    def shown(self) -> Shown:
        status = self._status
        fields = dict(part.split(":", 1) for part in status[1:-1].split("|")[1:])
        place = tuple(map(float, fields["MPos"].split(",")))
        work = tuple(a - b for a, b in zip(place, self._wco, strict=True))
        feed = float(fields.get("FS", "-1").split(",")[0])
        return Shown(re.split("[|:]", status[1:])[0], place, work, feed, self._overrides)

    def heard(self) -> list[str]:
        return list(self._console)

    def _queue(self, text: str) -> None:
        with self._lock:
            self._waiting.append(Command(text))
        self._stream()

    def jog(self, way: str, feed: float) -> None:
        self._queue(f"$J=G21G91{way}F{feed:g}")

    def cancel_jog(self) -> None:
        self._line.write(CANCEL)

    def run(self, lines: list[str]) -> None:
        assert self.shown().state != "Alarm", "UGS streams nothing in an alarm"
        plain = [COMMENT.sub("", line).replace(" ", "") for line in lines]
        with self._lock:
            self._waiting.extend(Command(line) for line in plain if line)
        self._stream()

    def ended(self) -> bool:
        return self._status.startswith("<Idle") and not self._waiting and not self._on_the_way

    def hold(self) -> None:
        self._line.write(HOLD)
        self._is_paused = True

    def go_on(self) -> None:
        self._line.write(GO_ON)
        self._is_paused = False
        self._stream()

    def stop(self) -> None:
        was_paused = self._is_paused
        with self._lock:
            self._empty()
        if not was_paused:
            self._line.write(HOLD)
        places: list[str] = []

        def stands() -> bool:
            time.sleep(POLL_EVERY)
            places.append(self._status.partition("|")[2].partition("|")[0])
            # In an alarm it gives up after ten seconds, and its user presses Unlock.
            return self._status.startswith(("<Idle", "<Alarm")) or (
                self._status.startswith("<Hold") and len(places) > 1 and places[-2] == places[-1]
            )

        until(stands, "UGS sees Hold at one place before it resets")
        if self._status.startswith("<Hold"):
            self._line.write(RESET)
        with self._lock:
            self._empty()

    def change(self, what: str, percent: int) -> None:
        self._line.write(bytes([BYTES[what][percent]]))

    def say(self, line: str) -> None:
        self._queue(line)

    def unlock(self) -> None:
        self._queue("$X")

    def end(self) -> None:
        if self._line:
            self.disconnect()
