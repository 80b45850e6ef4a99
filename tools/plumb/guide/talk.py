"""How the guide speaks with the owner: on a terminal, or in a test with prepared answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from plumb.text.lengths import UNITS, length_in

YES = ("y", "yes")
LEAVE = ("q", "quit", "leave")


class LeftError(Exception):
    """The owner leaves; what is done stays done."""


@dataclass
class Talk:
    """Says lines and asks questions; `unit` is that of the owner's tape."""

    say: Callable[[str], None]
    answer: Callable[[str], str]  # to a question; EOFError where nobody answers
    unit: str = "mm"
    asked: list[str] = field(default_factory=list)

    def ask(self, question: str) -> str:
        """What the owner types. Raises LeftError for q, and where nobody answers."""
        self.asked.append(question)
        try:
            text = self.answer(question).strip()
        except EOFError:
            raise LeftError from None
        if text.lower() in LEAVE:
            raise LeftError
        return text

    def agrees(self, what: str, act: str) -> bool:
        """Whether the owner says yes to what will move; anything else is no.

        `act` says it in a few words, for a button.
        """
        return self.ask(f"{what}\nGo? [y/n, q leaves] ").lower() in YES

    def says_yes(self, question: str) -> bool:
        """Whether the owner says yes to what moves nothing."""
        return self.ask(f"{question} [y/n] ").lower() in YES

    def choice(self, question: str, answers: dict[str, str]) -> str:
        """The letter of one of the answers."""
        listed = "".join(f"\n  {letter}  {words}" for letter, words in answers.items())
        while True:
            letter = self.ask(f"{question}{listed}\nType a letter: ").lower()
            if letter in answers:
                return letter
            self.say(f"{letter!r} is none of {', '.join(answers)}.")

    def length(self, question: str, usual: float | None, low: float, high: float) -> float:
        """A length [mm] from low to high, typed in the owner's unit; Enter: the usual."""
        scale = UNITS[self.unit]
        hint = "" if usual is None else f" [{usual / scale:.{1 if scale == 1 else 3}f}]"
        while True:
            text = self.ask(f"{question}, {self.unit}{hint}: ")
            if not text and usual is not None:
                return usual
            try:
                size = length_in(text.replace(",", "."), unit=scale)
            except ValueError as error:
                self.say(f"{error}")
                continue
            if low <= size <= high:
                return size
            self.say(f"That is not from {low / scale:g} to {high / scale:g} {self.unit}.")

    def turn(self, side: str, most: float) -> float:
        """How far the owner lets a sprocket turn [mm of chain]; 0: a tooth points straight up."""
        question = (
            f"The {side.upper()} sprocket turns as far as you type ({self.unit} of chain; minus "
            "turns back). Type 0 when a tooth points straight up"
        )
        return self.length(question, None, -most, most)

    def mass(self, question: str, usual: float, low: float, high: float) -> float:
        """A mass [kg] from low to high; Enter: the usual."""
        while True:
            text = self.ask(f"{question}, kg [{usual:.1f}]: ")
            try:
                mass = float(text.replace(",", ".")) if text else usual
            except ValueError:
                mass = 0.0
            if low <= mass <= high:
                return mass
            self.say(f"A sled weighs from {low:g} to {high:g} kg.")
