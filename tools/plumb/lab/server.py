"""Serves the lab on this computer, behind a token; if it is shared, to paired phones too."""

from __future__ import annotations

import asyncio
import os
import re
import secrets
import socket
import stat
import webbrowser
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import Any, ClassVar

import uvicorn
from starlette.types import ASGIApp
from uvicorn.protocols.http.h11_impl import H11Protocol

from plumb.lab.app import lab_app
from plumb.lab.guard import Address
from plumb.lab.routes.phones import Phones, Sharing
from plumb.text.errors import InputError
from plumb.text.files import is_private

HOST, NETWORK = "127.0.0.1", "0.0.0.0"  # the second takes what comes by the network too
TOKEN_FILE = ".lab.token"  # keeps the token, so that an open page survives a restart
IDLE_S = 15  # a connection on which nothing happens is closed
LARGEST_MESSAGE = 65_536  # bytes of the page's live line
MOST_MESSAGES = 16  # that wait to be taken
TOKEN = re.compile(r"[A-Za-z0-9_-]{43}")


def serve(
    folder: Path, *, port: int, browser: bool, sharing: Sharing = "no", say: Callable[[str], None]
) -> None:
    """Serve the lab of a folder until Ctrl-C; port 0 takes any. Raises InputError."""
    if not folder.exists():
        folder.mkdir(parents=True)
        say(f"{folder}: a new folder, made for this machine")
    if not folder.is_dir():
        raise InputError(folder, "is a file", remedy="name a folder")
    token = _token(folder)
    with _listening(HOST if sharing == "no" else NETWORK, port) as listener:
        address = Address(HOST, listener.getsockname()[1])
        url = f"http://{HOST}:{address.port}/?token={token}"
        say("The lab is at this address; Ctrl-C ends it.")
        say(url)
        phones = Phones(sharing, port=address.port, say=say)
        if browser:
            Thread(target=_open, args=(url, say), daemon=True).start()
        app = lab_app(folder, address=address, token=token, paired=phones)
        server = uvicorn.Server(_settings(app))
        with suppress(KeyboardInterrupt):  # Ctrl-C is how the lab ends
            server.run([listener])


def _settings(app: ASGIApp) -> uvicorn.Config:
    """Return how patient the server is; Connection says with how many."""
    return uvicorn.Config(
        app,
        http=Connection,
        log_level="error",
        timeout_keep_alive=IDLE_S,
        ws_max_size=LARGEST_MESSAGE,
        ws_max_queue=MOST_MESSAGES,
        ws_per_message_deflate=False,
        server_header=False,
        timeout_graceful_shutdown=2,
    )


def _open(url: str, say: Callable[[str], None]) -> None:
    """Show the page in a browser, some of which come back only when they are closed."""
    try:
        shown = webbrowser.open(url)
    except webbrowser.Error:
        shown = False
    if not shown:
        say("No browser opened; copy the address into yours.")


def _listening(host: str, port: int) -> socket.socket:
    """Return a socket on the port.

    It says that it is TCP: asyncio sends the body of an answer at once only where it knows that.
    Else each answer waits for the browser's receipt of its header, 40 ms.
    """
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
    except OSError as error:
        listener.close()
        reason = error.strerror or str(error)
        raise InputError(
            f"port {port} is not free ({reason}); is the lab open already? Try another --port"
        ) from None
    listener.listen(MOST_CONNECTIONS)
    return listener


def _token(folder: Path) -> str:
    """Return the token of this folder; only its owner can read the file. Raises InputError for a
    folder in which nothing can be written.
    """
    path = folder / TOKEN_FILE
    if kept := _kept_token(path):
        return kept
    token = secrets.token_urlsafe(32)
    try:
        path.unlink(missing_ok=True)
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(f"{token}\n")
    except OSError as error:
        raise InputError(
            folder, f"cannot be written ({error.strerror})", remedy="name a folder of yours"
        ) from None
    return token


def _kept_token(path: Path) -> str:
    """Return the token that an earlier server wrote; empty if others can read or wrote it."""
    with suppress(OSError):
        kept = path.lstat()
        private = stat.S_ISREG(kept.st_mode) and is_private(kept)
        text = path.read_text().strip() if private else ""
        return text if TOKEN.fullmatch(text) else ""
    return ""


# Connections of the lab's server: those that only hold a place give way to those that ask.
#
# A browser sends a request whole, in milliseconds. A client that sends a byte a second would keep
# a place for hours, and enough of them would keep the owner out. So headers have a deadline; and
# while many connections have not asked anything yet, a new connection ends the oldest of them. No
# request is refused because of other connections: Stop has to come through. While there are many,
# a new connection ends the oldest that was answered and rests, or else the oldest that takes a
# file of the page and does not read it.

# [s] from the connection, or from the first byte of a further request, to the whole header.
HEADERS_S = 10.0
MOST_SILENT = 24  # connections that have not asked anything yet
MOST_CONNECTIONS = 64


class Connection(H11Protocol):
    """A connection with a deadline for what it asks."""

    silent: ClassVar[dict[Connection, None]] = {}  # oldest first
    others: ClassVar[dict[Connection, None]] = {}  # that asked; the longest unchanged first

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        super().connection_made(transport)
        self._wait()
        if len(self.silent) > MOST_SILENT:
            next(iter(self.silent))._end()
        if len(self.silent) + len(self.others) > MOST_CONNECTIONS:
            self._give_way()

    def data_received(self, data: bytes) -> None:
        if self.transport.is_closing():
            return  # on Windows what was on its way still comes
        asked = self.cycle
        if self not in self.silent and (asked is None or asked.response_complete):
            self._wait()
        super().data_received(data)
        if self.transport.get_protocol() is not self:  # it is a live line from now on
            self._answered()
            self.others.pop(self, None)
        elif self.cycle is not asked:
            self._answered()
            self._renew()

    def on_response_complete(self) -> None:
        self._renew()
        super().on_response_complete()

    def connection_lost(self, exc: Exception | None) -> None:
        self._answered()
        self.others.pop(self, None)
        super().connection_lost(exc)

    @property
    def _rests(self) -> bool:
        return self.cycle is None or self.cycle.response_complete

    @property
    def _reads_page(self) -> bool:
        return not self.scope["path"].startswith("/api/")

    def _renew(self) -> None:
        """From now on it is the last to be ended."""
        self.others.pop(self, None)
        self.others[self] = None

    def _give_way(self) -> None:
        """End a connection that is idle, or that only reads the page."""
        resting = (each for each in self.others if each._rests)
        reading = (each for each in self.others if each._reads_page)
        for each in (*resting, *reading)[:1]:
            each._end()

    def _wait(self) -> None:
        """From now on this connection has to ask something."""
        self.silent[self] = None
        self._deadline: Any = self.loop.call_later(HEADERS_S, self._end)

    def _answered(self) -> None:
        """Note that it asked, or is gone."""
        if self in self.silent:
            del self.silent[self]
            self._deadline.cancel()

    def _end(self) -> None:
        self._answered()
        self.others.pop(self, None)
        self.transport.abort()
