"""bCNC from PyPI, its sender and its Grbl controller, in a program without its window."""

import json
import os
import subprocess
import sys
import threading
from pathlib import Path

from grbl_board import Shown, until

ROOT = Path(__file__).resolve().parents[3]
PACKAGES = ROOT / ".build/senders/python"
HEADLESS = Path(__file__).with_name("bcnc_headless.py")
BAUD = 57_600
SLIDERS = {"feed": "Feed", "rapids": "Rapid", "spindle": "Spindle"}


class Bcnc:
    """bCNC with its buttons."""

    name = "bCNC"
    lacks = frozenset({"cancel a jog"})

    def __init__(self, folder: Path):
        self._log = (folder / "bcnc.log").open("w")
        self._program = subprocess.Popen(
            [sys.executable, HEADLESS, PACKAGES / "bCNC"],
            cwd=folder,
            env={**os.environ, "HOME": str(folder), "PYTHONPATH": str(PACKAGES)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            text=True,
        )
        self._turn = threading.Lock()
        self._was_running = False

    def _ask(self, *what) -> dict:
        with self._turn:
            self._program.stdin.write(f"{json.dumps(what)}\n")
            self._program.stdin.flush()
            answer = self._program.stdout.readline()
        assert answer, f"bCNC ended in {what[0]}; see {self._log.name}"
        return json.loads(answer)

    def _vars(self) -> dict:
        return self._ask("state")["vars"]

    def connect(self, port: str) -> None:
        self._ask("open", port, BAUD)
        until(lambda: self._vars()["state"] in ("Idle", "Alarm", "Run", "Hold:0"), "bCNC: a state")
        until(lambda: self._vars()["G"], "bCNC has read `$G`")
        assert self._ask("state")["alive"], "bCNC's serial thread is dead"

    def disconnect(self) -> None:
        self._ask("close")

    def shown(self) -> Shown:
        now = self._vars()
        place, work = (tuple(float(now[f"{which}{axis}"]) for axis in "xyz") for which in "mw")
        overrides = tuple(int(now[f"Ov{slider}"]) for slider in SLIDERS.values())
        state = now["state"].partition(":")[0]
        return Shown(state.title(), place, work, float(now["curfeed"]), overrides)

    def heard(self) -> list[str]:
        return [line.partition(" ")[2] for line in self._ask("state")["heard"]]

    def jog(self, way: str, feed: float) -> None:
        self._ask("sendGCode", f"$J=G91 {way} F100000")

    def run(self, lines: list[str]) -> None:
        self._ask("run_lines", lines)
        assert self._ask("state")["running"], "bCNC runs the program"

    def ended(self) -> bool:
        return not self._ask("state")["running"]

    def hold(self) -> None:
        self._ask("feedHold")

    def go_on(self) -> None:
        self._ask("resume")

    def stop(self) -> None:
        before = self._ask("state")["purges"]
        self._ask("stopRun")
        # It resets the machine at once, and again when it sees Idle; a line typed before is lost.
        until(lambda: self._ask("state")["purges"] >= before + 2, "bCNC has seen Idle after Stop")

    def change(self, what: str, percent: int) -> None:
        self._ask("change", SLIDERS[what], percent)

    def say(self, line: str) -> None:
        self._ask("sendGCode", line)

    def unlock(self) -> None:
        self._ask("unlock")

    def end(self) -> None:
        self._program.kill()
        self._program.wait()
        self._log.close()
