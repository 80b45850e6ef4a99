"""A `plumb lab` that runs for a test."""

import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import httpx2
import hurried_plumb
from folder import PATIENCE, got
from plumb.lab.server import TOKEN_FILE
from websockets.sync.client import connect


@dataclass
class ServedLab:
    """`plumb lab` on a folder."""

    folder: Path
    process: subprocess.Popen
    url: str  # with the token

    @property
    def site(self) -> str:
        """The address without the token."""
        return self.url.partition("?")[0]

    @property
    def port(self) -> int:
        return int(self.site.rpartition(":")[2].strip("/"))

    @property
    def token(self) -> str:
        return self.url.partition("token=")[2]

    def client(self):
        """A client that asks it as its page does."""
        headers = {"X-Plumb-Token": self.token}
        return httpx2.Client(base_url=self.site, headers=headers, timeout=PATIENCE)

    def live(self, *, path="api/live", protocols=..., **more):
        """The page's live line to the machine, or one that is opened in some other way."""
        own = ["plumb", self.token] if protocols is ... else protocols
        address = self.site.replace("http", "ws") + path
        return connect(address, subprotocols=own, open_timeout=PATIENCE, **more)

    def end(self):
        self.process.terminate()
        self.process.wait(120)


PLUMB = (sys.executable, hurried_plumb.__file__)


def serve(folder, *, port=0, command=PLUMB, options=()):
    """Start `plumb lab` on a folder; comes back when it answers."""
    process = subprocess.Popen(
        [*command, "lab", str(folder), "--no-browser", "--port", str(port), *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    for line in process.stdout:
        if match := re.search(r"http://\S+", line):
            return ServedLab(folder, process, match[0])
    raise AssertionError(process.stderr.read())


class SharedLab:
    """A lab for many tests, as its start costs more than most of them: each gets it empty."""

    def __init__(self, folder):
        self.folder, self._lab = folder, None

    def emptied(self) -> ServedLab:
        """The lab without a machine, on an empty folder; started again if a test ended it."""
        if self._lab and self._lab.process.poll() is None:
            got(self._lab.client().post("/api/machine/disconnect"))
        else:
            self._lab = None
        for path in self.folder.iterdir():
            if path.name == TOKEN_FILE:
                continue  # by which the lab knows its pages when it starts again
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        self._lab = self._lab or serve(self.folder)
        return self._lab

    def end(self):
        if self._lab:
            self._lab.end()
