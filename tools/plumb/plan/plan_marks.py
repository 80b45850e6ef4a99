"""A marks.toml of planned visits that waits for the tape's readings."""

from __future__ import annotations

from plumb.plan.planned_visits import Visits


def marks_file(
    visits: Visits,
    *,
    sheet: tuple[float, float],
    controller: str,
    said: tuple[str, ...],
    cut_with: str = "",
) -> str:
    """The text of the file: places count from the sheet's top left corner, y down [mm]; `cut_with`
    are lines that name the settings in force."""
    lines = [
        "# Measured from the sheet's left and top edges, in mm: take away the # before `measured`",
        "# and write what the tape says. Give this file to plumb after the marks you have.",
        *(f"# {sentence}" for sentence in said),
        f'frame = "sheet-top-left"{cut_with}',
        f'controller = "{controller}"',
    ]
    for i, name in enumerate(visits.names):
        x, y = visits.targets[i, 0] + sheet[0] / 2, sheet[1] / 2 - visits.targets[i, 1]
        lines += ["", "[[mark]]", f'name = "{name}"', f"target = [{x:.3f}, {y:.3f}]"]
        lines.append(f"sled_weight_n = {visits.sled_weights[i]:.1f}")
        side = visits.approaches[i]
        if side.any():
            lines.append(
                f"approach = [{side[0] + 0.0:.3f}, {-side[1] + 0.0:.3f}]  # y down here too"
            )
        if visits.swapped[i]:
            lines.append("chains_swapped = true")
        lines.append("# measured = [ , ]")
    return "\n".join(lines) + "\n"
