"""What the connected machine does, and whether it holds what is open, in words."""

from plumb.line.worker import LineState


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


def held_otherwise(subject: str, file: str, *, is_fit: bool) -> str:
    """Return that a machine holds other numbers than a file, which may be fitted to its marks."""
    if is_fit:
        return f"{subject} does not hold the numbers of {file} yet."
    return f"{subject} holds other numbers than {file}. Which hold?"
