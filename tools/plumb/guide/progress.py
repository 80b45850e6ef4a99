"""How far the owner came, in `guide.json`: each step can be left and taken up again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from plumb.text.errors import refusal
from plumb.text.files import read_text, write_whole

FILE = "guide.json"


@dataclass
class Progress:
    """What is done, and what the owner said of the machine."""

    folder: Path
    done: list[str] = field(default_factory=list)
    sigmas: dict[str, float] = field(default_factory=dict)  # how far a number may be wrong

    def finish(self, step: str) -> None:
        """Keep that a step is done."""
        if step not in self.done:
            self.done.append(step)
        self.save()

    def save(self) -> None:
        """Write the file."""
        kept = {"done": self.done, "sigmas": self.sigmas}
        write_whole(self.folder / FILE, f"{json.dumps(kept, indent=2)}\n".encode())


def progress_in(folder: Path) -> Progress:
    """The progress in a folder; an empty progress where nothing was begun. Raises InputError."""
    path = folder / FILE
    if not path.exists():
        return Progress(folder)
    try:
        kept = json.loads(read_text(path))
        done = [str(step) for step in kept["done"]]
        sigmas: Mapping[str, float] = kept["sigmas"]
        return Progress(folder, done, {name: float(size) for name, size in sigmas.items()})
    except (ValueError, KeyError, TypeError, AttributeError):
        raise refusal(path, "is damaged", remedy="delete it, and begin again") from None
