"""Connections of the lab's server: those that only hold a place give way to those that ask.

A browser sends a request whole, in milliseconds. A client that sends a byte a second would keep a
place for hours, and enough of them would keep the owner out. So headers have a deadline; and while
many connections have not asked anything yet, a new connection ends the oldest of them.
"""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

from uvicorn.protocols.http.h11_impl import H11Protocol

HEADERS_S = (
    10.0  # from the connection, or from the first byte of a further request, to the whole header
)
MOST_SILENT = 24  # connections that have not asked anything yet


class Connection(H11Protocol):
    """A connection with a deadline for what it asks."""

    silent: ClassVar[dict[Connection, None]] = {}  # oldest first

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        super().connection_made(transport)
        self._wait()
        if len(self.silent) > MOST_SILENT:
            next(iter(self.silent))._end()

    def data_received(self, data: bytes) -> None:
        asked = self.cycle
        if self not in self.silent and (asked is None or asked.response_complete):
            self._wait()
        super().data_received(data)
        if self.cycle is not asked or self.transport.get_protocol() is not self:
            self._answered()

    def connection_lost(self, exc: Exception | None) -> None:
        self._answered()
        super().connection_lost(exc)

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
        self.transport.abort()
