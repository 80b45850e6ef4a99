"""What a virtual machine says, handed over in whole lines.

A serial client takes what it read within a quarter of a second for a line. A board's bytes follow
each other by fractions of a millisecond. A computer that is busy can stop a program for longer, in
the middle of a line, and a client would take the half for the whole.
"""

from __future__ import annotations

LONGEST_PAUSE = 20  # [ms] of the machine's time; then what it said was no line


class WholeLines:
    """Holds the begin of a line until its end has come."""

    def __init__(self) -> None:
        self._begun = b""
        self._since = 0  # [ms] since its last byte

    def take(self, said: bytes, milliseconds: int) -> bytes:
        """What can go to the client.

        `said`: what the machine said in the `milliseconds` of its time that just passed.
        """
        whole, end, begun = (self._begun + said).rpartition(b"\n")
        self._since = 0 if said else self._since + milliseconds
        if self._since >= LONGEST_PAUSE:
            self._begun, self._since = b"", 0
            return whole + end + begun
        self._begun = begun
        return whole + end
