"""The colours of the report, on light and on dark paper; apart for every eye.

Pictures are drawn in the light colours; the page knows each by its name, so that the same picture
goes with both kinds of paper.
"""

from __future__ import annotations

from plumb.pictures.sheet import BAD, EDGE, GOOD, INK, WOOD

# By name: on light paper, on dark paper.
COLOURS: dict[str, tuple[str, str]] = {
    "paper": ("#ffffff", "#15171a"),
    "panel": ("#f7f5f1", "#1f2226"),
    "ink": (INK, "#ebe9e4"),
    "soft": ("#57534c", "#b9b5ac"),
    "rule": ("#d6d2c8", "#43474d"),
    "band": ("#e6e3db", "#33373d"),
    "wood": (WOOD, "#2d2721"),
    "edge": (EDGE, "#b08f5b"),
    "bad": (BAD, "#ff9f61"),
    "good": (GOOD, "#79bcf3"),
    "alarm": ("#a83f00", "#ffa66b"),  # words
    # Explanations: green, purple and brown, each with its stroke.
    "first": ("#00795a", "#4fd0a8"),
    "second": ("#96387a", "#f0a0d4"),
    "third": ("#7a5c00", "#e0c25c"),
    # The zones of the reach.
    "tight": ("#8e2c22", "#f08a7e"),
    "slack": ("#1f5f8b", "#74bdea"),
    "upright": ("#6b3fa0", "#bd9cf0"),
    "nothing": ("#444444", "#9a9a9a"),
}
SUSPECTS = ("first", "second", "third")
DASHES = ("solid", (0, (3.5, 3)), (0, (1, 2)))  # of their curves, for who sees no colours


def light(name: str) -> str:
    """The colour in which a picture is drawn."""
    return COLOURS[name][0]


def named(svg: str) -> str:
    """The text of a picture with the names of its colours, which the page gives their values."""
    for name, (colour, _) in COLOURS.items():
        svg = svg.replace(f": {colour}", f": var(--{name})")
    return svg


def style() -> str:
    """The names and values for the page's style: light, then dark on screens that ask for it."""
    bright, dark = (
        "".join(f"--{name}:{both[i]};" for name, both in COLOURS.items()) for i in (0, 1)
    )
    return (
        f":root{{color-scheme:light dark;{bright}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}"
    )
