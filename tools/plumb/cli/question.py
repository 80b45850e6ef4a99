"""A question in the terminal; whoever asks goes on working, and looks for the answer meanwhile."""

from __future__ import annotations

import os
from threading import Thread

STDIN = 0  # not sys.stdin: its lock would be held at the end of the program


class Question:
    """A question whose answer is a line."""

    def __init__(self, text: str) -> None:
        self.answer: str | None = None  # None: not yet; empty: just Enter
        self.is_unheard = False  # nobody can answer: the input has ended
        print(text, end="", flush=True)
        Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        typed = b""
        while not typed.endswith(b"\n"):
            came = os.read(STDIN, 1)
            if not came:
                self.is_unheard = True
                print()
                break
            typed += came
        self.answer = typed.decode(errors="replace").strip()
