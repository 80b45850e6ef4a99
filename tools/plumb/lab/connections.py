"""Connections of the lab's server: those that only hold a place give way to those that ask.

A browser sends a request whole, in milliseconds. A client that sends a byte a second would keep a
place for hours, and enough of them would keep the owner out. So headers have a deadline; and while
many connections have not asked anything yet, a new connection ends the oldest of them. No request
is refused because of other connections: Stop has to come through. While there are many, a new
connection ends the oldest that was answered and rests, or else the oldest that takes a file of the
page and does not read it.
"""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

from uvicorn.protocols.http.h11_impl import H11Protocol

HEADERS_S = (
    10.0  # from the connection, or from the first byte of a further request, to the whole header
)
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
        """End a connection whose end costs nobody work."""
        resting = (each for each in self.others if each._rests)
        reading = (each for each in self.others if each._reads_page)
        for each in (*resting, *reading)[:1]:
            each._end()

    def _wait(self) -> None:
        """From now on this connection has to ask something."""
        self.silent[self] = None
        self._deadline: Any = self.loop.call_later(HEADERS_S, self._end)

    def _answered(self) -> None:
        """It asked, or it is gone."""
        if self in self.silent:
            del self.silent[self]
            self._deadline.cancel()

    def _end(self) -> None:
        self._answered()
        self.others.pop(self, None)
        self.transport.abort()
