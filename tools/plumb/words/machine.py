"""What the machine does, whether it holds what is open, and who may move it, in words."""

from plumb.line.worker import LineState
from plumb.settings import MachineSettings
from plumb.text.values import Unit
from plumb.words import Heading


def doing(state: LineState, subject: str) -> str:
    """Return what a machine, called so at the beginning of a sentence, does: a few words."""
    program = state.program
    if state.phase in ("lost", "connecting"):
        what = "the line is lost" if state.phase == "lost" else "connecting"
        return f"{subject}: {what}"
    if state.phase == "stopping":
        does = "stops"
    elif state.waits_for:
        does = "waits for you"
    elif state.holds:
        does = "holds"
    elif state.phase == "busy" and program and program.outcome == "running":
        does = f"runs {program.title}"
    elif state.moves:
        does = "moves"
    elif not state.knows_place:
        does = "does not know its place"
    else:
        does = "stands" if state.phase == "ready" else "works"
    return f"{subject} {does}"


def at_work(state: LineState) -> Heading:
    """Return how a screen begins while the machine cuts what it was sent."""
    if asks := state.waits_for:
        return Heading(
            "The machine waits for you", f"{asks[0].upper()}{asks[1:]}. Then press Go on."
        )
    return Heading("The machine is cutting", "Stay beside it. Hold pauses; Stop gives up.")


def which(*, is_open: bool) -> Heading:
    """Return how a screen begins on which a machine is opened."""
    if is_open:
        return Heading(
            "This machine is open",
            "Is it yours? Else open another file; this file stays. Nothing moves before you press "
            "a button that says what moves.",
        )
    return Heading(
        "Which machine is it?",
        "Open the settings that your machine has now, connect the machine, or try a virtual "
        "machine. Nothing moves here.",
    )


def what_is_missing(*, is_open: bool, is_read: bool) -> tuple[str, str]:
    """Return what is to be done before a screen opens that needs a machine, or readings of it."""
    machine = "" if is_open else "open a machine first"
    return machine, machine or ("" if is_read else "type readings first")


def size(settings: MachineSettings, unit: Unit) -> str:
    """Return how large a machine and its sheet are, and how many effects its settings know."""
    gap, width, height = (unit.worded(mm, 1) for mm in (settings.motor_gap, *settings.sheet))
    known = len(settings.effects)
    effects = f", {known} {'effect' if known == 1 else 'effects'} known" if known else ""
    return f"motors {gap} apart, a sheet of {width} by {height}{effects}."


def held_otherwise(subject: str, file: str, *, is_fit: bool) -> str:
    """Return that a machine holds other numbers than a file, which may be fitted to its marks."""
    if is_fit:
        return f"{subject} does not hold the numbers of {file} yet."
    return f"{subject} holds other numbers than {file}. Which hold?"


def held_alike(file: str) -> Heading:
    """Return how a screen begins once a machine holds the numbers of a file."""
    return Heading(
        "The machine holds the numbers",
        f"They are those of {file}. Two marks on the same sheet show whether it came true.",
    )


def what_was_sent(count: int, kept: str, *, back: bool) -> str:
    """Return that a machine holds so many other numbers; `kept`: the file of those before."""
    if count == 0:
        return "The machine held these numbers already; each was read back."
    said = f"The machine holds {count} {'old' if back else 'new'} numbers; each was read back."
    return f"{said} Those before are in {kept}."


NOTHING_HIDDEN = "No virtual machine was started in this folder."


def how_to_pair(address: str, pin: str) -> str:
    """Return how a phone gets to the lab at this address; empty: there is no network."""
    if not address:
        return f"No network is here yet, so no phone reaches the lab. The PIN is {pin}."
    return f"Scan it with a phone, or open {address}, PIN {pin}."
