"""A round of marks in words: what is cut, what to do about a broken cut, and the next sheet."""

from plumb.text.values import Unit

LEAST_MM = 0.5  # a smaller turn of a sheet is not worth a shim
CHOSEN = (
    "Router off, hands and hoses away from the chains, the bit just above the wood. The sled moves "
    "over the whole sheet; the bit touches each mark 0.5 mm deep."
)
PROPOSED = (
    "The verdict proposed these marks, on the same sheet. Router off, hands and hoses away from "
    "the chains, the bit just above the wood; it touches each mark 0.5 mm deep."
)


def what_is_cut(marks: int, origin: str) -> tuple[str, str]:
    """Return a title and a sentence or two for so many marks of this origin."""
    if origin == "proposed":
        return f"Cut {marks} more marks", PROPOSED
    return f"Cut {marks} marks", CHOSEN


def begin_or_go_on(
    origin: str, *, is_virtual: bool, is_connected: bool, goes_on: bool, next_mark: str
) -> str:
    """Return what can be done about a cut that broke off; no next mark: it is not known which."""
    connect = "" if is_connected else "Connect the machine. "
    fresh = "" if is_virtual or origin != "chosen" else " on a fresh sheet"
    on = f", or go on{f' from mark {next_mark}' if next_mark else ''}" if goes_on else ""
    return f"{connect}Begin again{fresh}{on}."


def beginning(origin: str, *, may_be_twice: bool) -> str:
    """Return how a cut that broke off begins with its first mark: on the same sheet it would cut
    marks a second time.
    """
    if not may_be_twice:
        return "Begin again: move"
    if origin == "chosen":
        return "Begin again on a fresh sheet: move"
    return "Cut what is there a second time: move"


def next_sheet(rise: float, unit: Unit, *, is_virtual: bool) -> str:
    """Return how the next sheet lies, with its right end raised [mm]."""
    stops = (
        "The virtual machine gets another sheet on the same stops"
        if is_virtual
        else "Lay it on the same stops"
    )
    if abs(rise) < LEAST_MM:
        return f"{stops}."
    way = "higher" if rise > 0 else "lower"
    return f"{stops}, its right end {unit.worded(abs(rise), 1)} {way}."
