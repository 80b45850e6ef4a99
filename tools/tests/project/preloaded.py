"""Commands of the lab from a program that has loaded it already: each runs in a copy of it.

A page has up to a dozen commands, and most of the time of each goes to loading numpy, scipy and
matplotlib. Here a server loads them once and forks for each command, which then reads and writes
the files, the folder and the environment of whoever asked.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

# Starts a program that outlives the line it is on, and shares the work with others.
BY_ITSELF = ("vm", "lab", "practice")
CLIENT = """#!{python} -IS
import json, os, socket, sys
if sys.argv[1:2] and sys.argv[1] in {by_itself}:
    os.execv({python!r}, [{python!r}, "-m", "plumb.cli.main", *sys.argv[1:]])
line = socket.socket(socket.AF_UNIX)
line.connect({address!r})
asked = json.dumps([sys.argv[1:], os.getcwd(), dict(os.environ)]).encode()
socket.send_fds(line, [b"."], [0, 1, 2])
line.sendall(asked)
line.shutdown(socket.SHUT_WR)
code = line.recv(16)
sys.exit(int(code) if code else 1)
"""


@contextlib.contextmanager
def preloaded() -> Iterator[Path]:
    """A folder with a program `plumb` that is answered at once, while this lasts."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        address = str(folder / "line")
        client = folder / "plumb"
        how = {"python": sys.executable, "by_itself": BY_ITSELF, "address": address}
        client.write_text(CLIENT.format(**how))
        client.chmod(0o755)
        command = [sys.executable, __file__, address]
        # It ends when its input does.
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as server:
            assert server.stdout is not None and server.stdout.readline() == b"ready\n"
            yield folder


def serve(address: str) -> None:
    """Load the lab, then answer one command after the other, each in a copy of this program."""
    from importlib import import_module

    # What the commands load when they run.
    for module in ("plumb.api", "plumb.cli.main", "scipy.special", "scipy.stats"):
        import_module(module)
    import_module("matplotlib.backends.backend_svg")
    import_module("matplotlib.backends.backend_agg")
    with socket.socket(socket.AF_UNIX) as door:
        door.bind(address)
        door.listen()
        print("ready", flush=True)
        while door in select.select([door, sys.stdin], [], [])[0]:
            line, _ = door.accept()
            if os.fork() == 0:
                end_with_parent()
                door.close()
                answer(line)
            line.close()
            with contextlib.suppress(ChildProcessError):
                while os.waitpid(-1, os.WNOHANG)[0]:
                    pass


def end_with_parent() -> None:
    """Have the kernel end this program when its parent ends: nobody waits for its answer then."""
    parent_death_signal = 1  # PR_SET_PDEATHSIG of Linux
    ctypes.CDLL(None).prctl(parent_death_signal, signal.SIGKILL)


def answer(line: socket.socket) -> None:
    """Run the command that a client asks for as if it had been started there; never returns."""
    from plumb.cli.main import main

    _, files, _, _ = socket.recv_fds(line, 1, 3)
    asked = b"".join(iter(lambda: line.recv(65536), b""))
    words, folder, environment = json.loads(asked)
    for number, file in enumerate(files):
        os.dup2(file, number)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = ["plumb", *words]
    code = 1
    try:
        code = main()
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    except BaseException:
        sys.excepthook(*sys.exc_info())
    sys.stdout.flush()
    sys.stderr.flush()
    line.sendall(str(code).encode())
    os._exit(code)


if __name__ == "__main__":
    serve(sys.argv[1])
