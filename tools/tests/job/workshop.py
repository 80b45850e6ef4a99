"""A virtual machine that cuts programs, and the dry run with the same numbers."""

from example_machine import ROOT
from plumb.hidden import MAKER
from plumb.job.dry_run import Done, Run
from usual_machine import declaration, switched_on, usual_machine

PROGRAMS = ROOT / "test/programs"
NAMES = sorted(path.name for path in PROGRAMS.iterdir() if path.suffix not in (".places", ".md"))


def lines_of(name: str) -> list[str]:
    """The lines of a program of test/programs."""
    return (PROGRAMS / name).read_text().splitlines()


def run_dry(lines: list[str]) -> Done:
    """A program in a dry run."""
    run = Run(MAKER)
    run.send(lines)
    return run.finish()


class Workshop:
    """A machine without errors at the middle of its sheet, z at the face."""

    def __init__(self) -> None:
        self.machine = usual_machine()
        self.sender = switched_on(self.machine, MAKER, said=self._hear)
        self.sender.stream([declaration(self.machine)])

    def _hear(self, line: str) -> None:
        if line == "Maslow Paused":
            self.sender.go_on()

    def cut(self, lines: list[str]) -> float:
        """Cut a program; the machine's time for it [s]."""
        begin = self.machine.seconds
        self.sender.stream([*lines, "G4 P0"])
        return self.machine.seconds - begin

    def stop(self) -> None:
        """Stop where the sled is, and wait until it stands."""
        self.machine.send(b"!\n")
        self.machine.advance(3000)
        self.machine.take_said()
