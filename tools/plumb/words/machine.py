"""What the connected machine does, and whether it holds what is open, in words."""

from plumb.line.worker import LineState
from plumb.settings.machine import MachineSettings
from plumb.text.values import Unit


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
