"""Serves the lab on this computer: 127.0.0.1 alone, behind a token."""

from __future__ import annotations

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

import uvicorn
from starlette.types import ASGIApp

from plumb.lab.app import lab_app
from plumb.lab.connections import MOST_CONNECTIONS, Connection
from plumb.lab.guard import Address
from plumb.text.errors import InputError, refusal

HOST = "127.0.0.1"
TOKEN_FILE = ".lab.token"  # keeps the token, so that an open page survives a restart
IDLE_S = 15  # a connection on which nothing happens is closed
LARGEST_MESSAGE = 65_536  # bytes of the page's live line
MOST_MESSAGES = 16  # that wait to be taken
TOKEN = re.compile(r"[A-Za-z0-9_-]{43}")


def serve(folder: Path, *, port: int, browser: bool, say: Callable[[str], None]) -> None:
    """Serve the lab of a folder until Ctrl-C; port 0 takes any. Raises InputError."""
    if not folder.is_dir():
        raise InputError(f"{folder}: there is no such folder; make it, or name another")
    token = _token(folder)
    with _listening(port) as listener:
        address = Address(HOST, listener.getsockname()[1])
        url = f"http://{HOST}:{address.port}/?token={token}"
        say(url)
        if browser:
            Thread(target=_open, args=(url, say), daemon=True).start()
        server = uvicorn.Server(_settings(lab_app(folder, address=address, token=token)))
        with suppress(KeyboardInterrupt):  # Ctrl-C is how the lab ends
            server.run([listener])


def _settings(app: ASGIApp) -> uvicorn.Config:
    """How patient the server is; connections.py says with how many."""
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


def _listening(port: int) -> socket.socket:
    """A socket on the port, of this computer alone."""
    listener = socket.socket()
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((HOST, port))
    except OSError as error:
        listener.close()
        reason = error.strerror or str(error)
        raise InputError(
            f"port {port} is not free ({reason}); is the lab open already? Try another --port"
        ) from None
    listener.listen(MOST_CONNECTIONS)
    return listener


def _token(folder: Path) -> str:
    """The token of this folder; only its owner can read the file. Raises InputError for a folder in
    which nothing can be written."""
    path = folder / TOKEN_FILE
    if kept := _kept_token(path):
        return kept
    token = secrets.token_urlsafe(32)
    try:
        path.unlink(missing_ok=True)
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(f"{token}\n")
    except OSError as error:
        raise refusal(
            folder, f"cannot be written ({error.strerror})", remedy="name a folder of yours"
        ) from None
    return token


def _kept_token(path: Path) -> str:
    """The token that an earlier server wrote; empty if others can read or wrote it."""
    with suppress(OSError):
        kept = path.lstat()
        private = stat.S_ISREG(kept.st_mode) and not kept.st_mode & 0o077
        text = path.read_text().strip() if private and kept.st_uid == os.getuid() else ""
        return text if TOKEN.fullmatch(text) else ""
    return ""
