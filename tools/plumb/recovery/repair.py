"""The G-code that declares chains as they are, while the bit is in a known hole."""

from __future__ import annotations

from plumb.model.predict import Array


def chains_line(chains: Array) -> str:
    """The line that tells the machine how long its chains are, left and right [mm]."""
    return f"B06 L{chains[0]:.3f} R{chains[1]:.3f}"


def repair_program(chains: Array, *, where: str) -> list[str]:
    """The lines of a program that declares chains with the bit at a place, said in words."""
    return [f"(Plumb: only with the bit in {where}, and nothing moved since)", chains_line(chains)]
