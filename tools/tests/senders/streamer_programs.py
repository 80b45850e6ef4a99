"""grbl-streamer and pygrbl-streamer from PyPI: libraries with which programs send to Grbl."""

import re
import sys
import threading
from pathlib import Path

from grbl_board import Shown, until

ROOT = Path(__file__).resolve().parents[3]
PACKAGES = ROOT / ".build/senders/python"
BAUD = 57_600
UNKNOWN = (0.0, 0.0, 0.0)
BUTTONLESS = frozenset({"jog", "cancel a jog", "overrides"})


class GrblStreamer:
    """The library grbl-streamer by its functions; it drops all words of `[MSG:...]`."""

    name = "grbl-streamer"
    lacks = BUTTONLESS | {"status", "a wrong line"}

    def __init__(self, folder: Path):
        sys.path.append(str(PACKAGES))
        import grbl_streamer

        self._console: list[str] = []
        self._library = grbl_streamer.GrblStreamer(self._take)

    def _take(self, event: str, *what) -> None:
        if event in ("on_read", "on_error"):
            self._console.append(what[0])

    def connect(self, port: str) -> None:
        self._console.clear()
        self._library.cnect(port, BAUD)
        until(self._library.is_connected, "grbl-streamer has seen a start")
        self._library.poll_start()
        # It asks `$$`, `$#` and `$G` by itself, and would count their answers as the program's.
        until(lambda: any(line.startswith("[GC:") for line in self._console), "its questions end")
        until(lambda: self._library.cmode, "grbl-streamer has read a status")

    def disconnect(self) -> None:
        self._library.disconnect()
        self._library.cmode = None

    def shown(self) -> Shown:
        state = (self._library.cmode or "").partition(":")[0]
        return Shown(state, self._library.cmpos, UNKNOWN, -1.0, (0, 0, 0))

    def heard(self) -> list[str]:
        return list(self._console)

    def run(self, lines: list[str]) -> None:
        self._library.job_new()
        self._library.write(lines)
        self._library.job_run()

    def ended(self) -> bool:
        return self._library.job_finished

    def hold(self) -> None:
        self._library.hold()

    def go_on(self) -> None:
        self._library.resume()

    def stop(self) -> None:
        self._library.abort()

    def say(self, line: str) -> None:
        self._library.send_immediately(line)

    def unlock(self) -> None:
        self._library.killalarm()

    def end(self) -> None:
        self._library.disconnect()


class PygrblStreamer:
    """The library pygrbl-streamer by its functions."""

    name = "pygrbl-streamer"
    lacks = BUTTONLESS

    def __init__(self, folder: Path):
        sys.path.append(str(PACKAGES))
        import pygrbl_streamer

        self._console: list[str] = []
        self._states = pygrbl_streamer.State
        self._new = pygrbl_streamer.GrblStreamer
        self._library = None
        self._job: threading.Thread | None = None

    def connect(self, port: str) -> None:
        self._library = self._new(port, BAUD)
        self._library.receive_callback = self._console.append
        self._library.connect()
        self.shown()

    def disconnect(self) -> None:
        self._library.disconnect()

    def shown(self) -> Shown:
        before = self._library.last_status.get("time", 0)
        self._library.realtime(b"?")
        until(lambda: self._library.last_status.get("time", 0) > before, "a status comes")
        raw = self._library.last_status["raw"]
        fields = dict(re.findall(r"\|(\w+):([-\d.,]+)", raw))
        place, begin = (
            tuple(map(float, fields.get(name, "nan,nan,nan").split(",")))
            for name in ("MPos", "WCO")
        )
        work = tuple(a - b for a, b in zip(place, begin, strict=True))
        feed = float(fields.get("FS", "-1").partition(",")[0])
        return Shown(self._library.last_status["state"], place, work, feed, (0, 0, 0))

    def heard(self) -> list[str]:
        return list(self._console)

    def run(self, lines: list[str]) -> None:
        how = {"commands": lines, "stop_on_error": True}
        self._job = threading.Thread(target=self._library.stream, kwargs=how, daemon=True)
        self._job.start()
        until(lambda: self._library.state is self._states.STREAMING, "the program begins")

    def ended(self) -> bool:
        return not self._job.is_alive()

    def hold(self) -> None:
        self._library.pause()

    def go_on(self) -> None:
        self._library.resume()

    def stop(self) -> None:
        self._library.stop()
        until(self.ended, "the program has ended")
        self._library.sync()

    def say(self, line: str) -> None:
        self._library.write_line(line)

    def unlock(self) -> None:
        self._library.unlock()

    def end(self) -> None:
        if self._library:
            self._library.disconnect()
