"""The machine from the front with its numbers, as docs/machine-toml.md shows it."""

from __future__ import annotations

from fields import text as said
from fingerprints import default_machine
from plumb.pictures.drawing import INK, WOOD

PICTURE = "docs/pictures/machine/numbers.svg"
SCALE = 0.22  # [px/mm]
MIDDLE, TOP = 400.0, 70.0  # [px] of the sheet's middle from the left; of the motors from above
SLED = (-430.0, -60.0)  # [mm] from the middle of the sheet
STEEL, RULE = "#555555", "#0b62a4"


def pages() -> dict[str, str]:
    """Return the picture by its name below the project's root."""
    machine = default_machine()
    up, width, height = machine.motor_height, machine.sheet_width, machine.sheet_height
    gap, ring = machine.motor_gap, machine.rotation_radius

    def at(x: float, y: float) -> str:
        return f"{MIDDLE + SCALE * x:.1f} {TOP + SCALE * (up - y):.1f}"

    def words(x: float, y: float, text: str) -> str:
        across, down = map(float, at(x, y).split())
        return said(across, down, text, size=13, anchor="middle")

    wood = f"M{at(-width / 2, height / 2)}H{MIDDLE + SCALE * width / 2:.1f}"
    wood += f"L{at(width / 2, -height / 2)}L{at(-width / 2, -height / 2)}z"
    chains = "".join(f"M{at(side * gap / 2, up)}L{at(*SLED)}" for side in (-1, 1))
    rules = [
        (f"M{at(-gap / 2, up + 110)}L{at(gap / 2, up + 110)}", (0, up + 150, "motor_gap")),
        (f"M{at(200, up)}L{at(200, 0)}", (470, up / 2 + 120, "motor_height")),
        (
            f"M{at(*SLED)}L{at(SLED[0] + ring, SLED[1])}",
            (SLED[0] + 430, SLED[1], "rotation_radius"),
        ),
        (
            f"M{at(-width / 2, -height / 2 - 60)}L{at(width / 2, -height / 2 - 60)}",
            (0, -height / 2 - 150, "sheet_width"),
        ),
        (
            f"M{at(width / 2 + 60, height / 2)}L{at(width / 2 + 60, -height / 2)}",
            (width / 2 + 260, -60, "sheet_height"),
        ),
    ]
    circle = '<circle cx="{}" cy="{}" r="{:.1f}" fill="{}" stroke="{}"/>'
    rounds = [
        circle.format(*at(side * gap / 2, up).split(), SCALE * 55, STEEL, INK) for side in (-1, 1)
    ]
    for radius, fill in ((230, "none"), (ring, WOOD), (12, "none")):
        rounds.append(circle.format(*at(*SLED).split(), SCALE * radius, fill, INK))
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="800" height="490" viewBox="0 0 800 490" '
        'role="img">',
        "<title>The machine from the front, with its numbers</title>",
        '<rect width="800" height="490" fill="white"/>',
        f'<path d="{wood}" fill="{WOOD}" stroke="{INK}"/>',
        f'<path d="{chains}" stroke="{STEEL}" stroke-width="2"/>',
        *rounds,
        *(f'<path d="{way}" stroke="{RULE}" stroke-width="1.5"/>' for way, _ in rules),
        *(words(*place) for _, place in rules),
        words(SLED[0], SLED[1] - 300, "sled_weight"),
        "</svg>",
        "",
    ]
    return {PICTURE: "\n".join(lines)}
