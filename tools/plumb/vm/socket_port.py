"""A virtual machine behind a socket, for systems without pseudo terminals.

plumb, and what else opens ports with pyserial, takes its name: socket://localhost:7000.
"""

import contextlib
import re
import socket

from plumb._vm import VirtualMachine
from plumb.text.errors import InputError
from plumb.vm.served_port import BOOTLOADER, CHUNK, ServedPort

NAME = re.compile(r"socket://(localhost|127\.0\.0\.1):(\d{1,5})")
ANY = "socket://localhost:0"  # a number that is free


class SocketPort(ServedPort):
    """A socket of this computer alone as the port. A new connection ends the one before."""

    def __init__(
        self, machine: VirtualMachine, name: str = ANY, *, boot_time: int = BOOTLOADER
    ) -> None:
        """boot_time [ms]: 0 for a machine with a bootloader of its own.

        Raises InputError for a name of another kind, or one that is taken.
        """
        super().__init__(machine, boot_time=boot_time)
        parts = NAME.fullmatch(name)
        if not parts or int(parts[2]) > 65535:
            raise InputError(name, "is not like socket://localhost:7000", remedy="write it so")
        try:
            self._listener = socket.create_server(("127.0.0.1", int(parts[2])))
        except OSError:
            why = "a virtual machine is at it already"
            raise InputError(name, why, remedy="end it or give another number") from None
        self._listener.setblocking(False)
        self._client: socket.socket | None = None
        self.path = f"socket://localhost:{self._listener.getsockname()[1]}"

    def close(self) -> None:
        """Take the port away."""
        self._leave()
        self._listener.close()

    def _leave(self) -> None:
        if self._client:
            self._client.close()
            self._client = None

    def _is_open(self) -> bool:
        return self._client is not None

    def _was_opened(self) -> bool:
        try:
            client, _ = self._listener.accept()
        except OSError:  # nobody came
            return False
        self._leave()
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._client = client
        return True

    def _take(self) -> bytes:
        if self._client:
            try:
                came = self._client.recv(CHUNK)
            except BlockingIOError:
                return b""
            except OSError:
                came = b""
            if came:
                return came
            self._leave()
        return b""

    def _give(self, said: bytes) -> bytes:
        if self._client:
            with contextlib.suppress(BlockingIOError):
                try:
                    return said[self._client.send(said) :]
                except ConnectionError:
                    self._leave()
        return said
