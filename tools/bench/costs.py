"""The figures of one measurement on the board, and the names they are compared by."""

from dataclasses import dataclass
from typing import NamedTuple


class Cycles(NamedTuple):
    """One case over all places of the sheet."""

    least: int
    median: int
    most: int


class Bytes(NamedTuple):
    """What a part takes of the board's memories; None where that was not asked."""

    flash: int | None
    ram: int | None
    stack: int | None


@dataclass(frozen=True)
class Costs:
    """All exact figures: the same source and compiler give the same figures anywhere."""

    compiler: str
    cycles: dict[str, Cycles]
    bytes: dict[str, Bytes]

    def figures(self) -> dict[str, int]:
        """Return every figure under a name that says what it is."""
        rows = [
            (name, row, unit)
            for table, unit in ((self.cycles, "cycles"), (self.bytes, "bytes"))
            for name, row in table.items()
        ]
        return {
            f"{name}: {field} {unit}": value
            for name, row, unit in rows
            for field, value in row._asdict().items()
            if value is not None
        }
