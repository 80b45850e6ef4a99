"""A round of marks in words: what is cut, how that ended, the next sheet, and how it is read."""

from collections.abc import Sequence

from plumb.text.values import Unit
from plumb.words import Heading

LEAST_MM = 0.5  # a smaller turn of a sheet is not worth a shim
CHOSEN = (
    "Router off, hands and hoses away from the chains, the bit just above the wood. The sled moves "
    "over the whole sheet; the bit touches each mark 0.5 mm deep."
)
PROPOSED = (
    "The verdict proposed these marks, on the same sheet. Router off, hands and hoses away from "
    "the chains, the bit just above the wood; it touches each mark 0.5 mm deep."
)


def what_is_cut(marks: int, origin: str) -> Heading:
    """Return how a screen begins that cuts so many marks of this origin."""
    if origin == "proposed":
        return Heading(f"Cut {marks} more marks", PROPOSED)
    return Heading(f"Cut {marks} marks", CHOSEN)


def of_files(program: str, form: str, *, is_saved: bool) -> str:
    """Return where a round is kept, or what its files are."""
    if is_saved:
        return f"{program} and {form} are in your folder."
    return f"{program} is the G-code, {form} the form for your readings."


ALL_CUT = "All marks are cut."
ENDED = {
    "done": ALL_CUT,
    "stopped": "Stopped. The machine knows where it is.",
    "refused": "The machine refused a line; read what it says below.",
    "lost": (
        "The line was lost. Nothing that you typed is lost. Connect it again in the bar below, and "
        "set its chains."
    ),
}


def ended(outcome: str, broken: str) -> str:
    """Return how a cut ended that was sent last, and how far one came that broke off."""
    return ALL_CUT if outcome == "done" else f"{ENDED.get(outcome, '')} {broken}".strip()


def how_far(cut: int, begun: int, names: Sequence[str]) -> str:
    """Return how far a cut came that broke off: marks that are surely cut, and perhaps."""
    if cut == len(names):
        return ALL_CUT
    said = f"Cut {cut} of {len(names)} marks, then it broke off."
    *more, last = names[cut:begun] or [""]
    if not last:
        return said
    which = f"marks {', '.join(more)} and {last}" if more else f"mark {last}"
    return f"{said} The machine may have cut {which} too."


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


TO_READ = Heading(
    "What does the tape say?",
    "Type each mark from the blue edges, or touch another on the sheet. Enter goes on. Each number "
    "is saved at once.",
)


def how_much_is_read(read: int, marks: int) -> str:
    """Return how many of the marks are read."""
    return f"{read} of {marks} marks are read."


def look_again(said: str, others: Sequence[float], corner: str, unit: Unit) -> str:
    """Return what is said of a reading, then what the other marks say [mm]: of a mark its place
    from the edges of a corner, or a distance.
    """
    lengths = [unit.worded(length, 1) for length in others]
    edges = reversed(corner.split("-")) if len(lengths) > 1 else ()
    places = [f"{length} from the {edge}" for length, edge in zip(lengths, edges, strict=False)]
    end = "" if said.endswith("?") else "."
    return f"{said}{end} The other marks say {' and '.join(places or lengths)}."
