"""What all languages share: a mutant, its verdict, and the score."""

from dataclasses import dataclass

KILLED, SURVIVED, EQUIVALENT, STILLBORN = "killed", "survived", "equivalent", "stillborn"


@dataclass(frozen=True)
class Mutant:
    """One change of one place, as people read it."""

    file: str
    line: int
    original: str
    changed: str
    twin: int = 0  # which of those that read the same

    @property
    def key(self) -> str:
        """Its name, which stays when other lines of the file change."""
        return f"{self.file} | {self.original} | {self.changed} | {self.twin}"

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.original}  ->  {self.changed}"


@dataclass(frozen=True)
class Verdict:
    """What became of a mutant, and by which test."""

    outcome: str
    by: str = ""
