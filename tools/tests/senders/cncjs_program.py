"""CNCjs: its server from npm, driven over the socket to which its page talks."""

import json
import os
import signal
import socket
import subprocess
import threading
import time
import urllib.request
from collections.abc import Sequence
from pathlib import Path

from grbl_board import Shown, until
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

ROOT = Path(__file__).resolve().parents[3]
SERVER = ROOT / ".build/senders/node_modules/cncjs/bin/cncjs"
NODE = ROOT / ".venv/bin/node"
BAUD = 57_600
START = 60  # [s] in which its server must answer
HELD = 2.0  # [s] after which a machine that still holds was not reset
PING = 20.0  # [s] after which its server wants to hear from a page
STEPS = {"feed": "feedOverride", "rapids": "rapidOverride", "spindle": "spindleOverride"}


def free_port() -> int:
    """A free TCP port."""
    with socket.socket() as line:
        line.bind(("127.0.0.1", 0))
        return line.getsockname()[1]


class CncjsServer:
    """The program `cncjs`, with a folder for its settings."""

    def __init__(self, folder: Path, ports: Sequence[str] = ()):
        """`ports`: ports that its page offers in addition to those on USB."""
        named = [{"path": port, "manufacturer": "virtual machine"} for port in ports]
        kept = {"ports": named, "state": {"checkForUpdates": False}}
        (folder / "cncrc").write_text(json.dumps(kept))
        # It asks udev for the ports on USB, which a container lacks, and would then offer none.
        udev = folder / "udevadm"
        udev.write_text("#!/bin/sh\n")
        udev.chmod(0o755)
        self.tcp_port = free_port()
        self.site = f"http://127.0.0.1:{self.tcp_port}"
        words = ["--host", "127.0.0.1", "--port", str(self.tcp_port)]
        with (folder / "cncjs.log").open("w") as log:
            self.process = subprocess.Popen(
                [NODE, SERVER, *words, "--config", folder / "cncrc"],
                cwd=folder,
                env={**os.environ, "HOME": str(folder), "PATH": f"{folder}:{os.environ['PATH']}"},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,  # the program that npm's wheel starts is a child of this
            )
        until(self._answers, "CNCjs's server answers")

    def _answers(self) -> bool:
        try:
            with urllib.request.urlopen(self.site, timeout=5):
                return True
        except OSError:
            return False

    def token(self) -> str:
        """The token with which its page opens the socket."""
        head = {"Content-Type": "application/json"}
        asked = urllib.request.Request(f"{self.site}/api/signin", b"{}", head)
        with urllib.request.urlopen(asked, timeout=START) as answer:
            return json.load(answer)["token"]

    def end(self) -> None:
        """End it."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


class Cncjs:
    """CNCjs with its buttons; its socket speaks socket.io 2 over a websocket."""

    name = "CNCjs"
    lacks = frozenset()

    def __init__(self, folder: Path, ports: Sequence[str] = ()):
        self.server = CncjsServer(folder, ports)
        query = f"EIO=3&transport=websocket&token={self.server.token()}"
        address = f"ws://127.0.0.1:{self.server.tcp_port}/socket.io/?{query}"
        self.socket = connect(address, legacy=True)
        self.port = ""
        self._state: dict = {}
        self._settings: dict = {}
        self._sender: dict = {}
        self._workflow = ""
        self._console: list[str] = []
        self._open = False
        self._thread = threading.Thread(target=self._listen)
        self._thread.start()
        self._beat = threading.Event()
        threading.Thread(target=self._ping, daemon=True).start()

    def _ping(self) -> None:
        while not self._beat.wait(PING):
            self.socket.send("2")

    def _listen(self) -> None:
        try:
            for message in self.socket:
                if message.startswith("42"):
                    self._take(*json.loads(message[2:]))
        except ConnectionClosed:
            return

    def _take(self, event: str, *what) -> None:
        if event == "controller:state":
            self._state = what[1]
        elif event == "controller:settings":
            self._settings = what[1]
        elif event == "sender:status":
            self._sender = what[0]
        elif event == "workflow:state":
            self._workflow = what[0]
        elif event == "serialport:read":
            self._console.append(what[0])
        elif event in ("serialport:open", "serialport:close"):
            self._open = event.endswith("open")

    def _emit(self, *what) -> None:
        self.socket.send(f"42{json.dumps(what)}")

    def _command(self, *what) -> None:
        self._emit("command", self.port, *what)

    def connect(self, port: str) -> None:
        self.port = port
        self._state, self._settings = {}, {}
        self._emit("open", port, {"controllerType": "Grbl", "baudrate": BAUD})
        until(lambda: self._open, "CNCjs opens the port")
        until(lambda: self._state.get("status", {}).get("activeState"), "CNCjs shows a state")
        until(lambda: self._settings.get("settings"), "CNCjs has read `$$`")
        modes = self._state.get
        until(lambda: modes("parserstate", {}).get("modal", {}).get("units"), "CNCjs has `$G`")

    def disconnect(self) -> None:
        self._emit("close", self.port)
        until(lambda: not self._open, "CNCjs closes the port")

    def shown(self) -> Shown:
        status = self._state["status"]
        # Its page takes places for inches when $13 is not 0.
        unit = 25.4 if float(self._settings["settings"].get("$13", 0)) > 0 else 1.0
        place, work = (
            tuple(unit * float(status[which][axis]) for axis in "xyz") for which in ("mpos", "wpos")
        )
        overrides = tuple(int(each) for each in status.get("ov", (0, 0, 0)))
        feed = float(status.get("feedrate", -1))
        return Shown(status["activeState"], place, work, feed, overrides)

    def heard(self) -> list[str]:
        return list(self._console)

    def jog(self, way: str, feed: float) -> None:
        self._command("gcode", f"$J=G91 G21 {way} F{feed:g}")

    def cancel_jog(self) -> None:
        self._command("jogCancel")

    def run(self, lines: list[str]) -> None:
        self._sender = {}
        self._command("gcode:load", "program.nc", "\n".join(lines))
        until(lambda: self._sender.get("total", 0) >= len(lines), "CNCjs has loaded the program")
        self._command("gcode:start")
        until(lambda: self._sender.get("sent"), "CNCjs has sent a line of the program")

    def ended(self) -> bool:
        total = self._sender.get("total", -1)
        return self._workflow == "idle" and self._sender.get("finishTime", 0) > 0 and total > 0

    def hold(self) -> None:
        self._command("gcode:pause")

    def go_on(self) -> None:
        self._command("gcode:resume")

    def stop(self) -> None:
        # It holds, and resets if it shows Hold half a second later. On a busy computer it may not
        # show it by then, and stays so until Stop is pressed again.
        self._command("gcode:stop", {"force": True})
        until(lambda: self.shown().state != "Run", "CNCjs shows that the machine holds")
        time.sleep(HELD)
        if self.shown().state == "Hold":
            self._command("gcode:stop", {"force": True})

    def change(self, what: str, percent: int) -> None:
        step = percent if what == "rapids" else percent - 100
        self._command(STEPS[what], step)

    def say(self, line: str) -> None:
        self._command("gcode", line)

    def unlock(self) -> None:
        self._command("unlock")

    def end(self) -> None:
        self._beat.set()
        self.socket.close()
        self._thread.join()
        self.server.end()
