"""`plumb practice`: find what is hidden in a virtual machine."""

import argparse
import secrets
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np

from plumb.cli.arguments import add_shared, unit_of
from plumb.cli.screen import headline, print_json, sentences, table
from plumb.cli.vm import add_brain, serve
from plumb.grid import BLANK
from plumb.model.predict import known_effects
from plumb.settings import machine_toml, read_settings
from plumb.text.errors import InputError
from plumb.text.files import write_all, write_whole
from plumb.text.values import Unit
from plumb.vm.garage import Tape, VirtualMachine
from plumb.vm.practice import MACHINES, SECRET, Score, Secret, score, secret_in

SETTINGS, PORT = "machine.toml", "port"
NOISE = 0.4  # [mm] of the tape


def run(arguments: argparse.Namespace) -> int:
    """Start the machine of a folder, or reveal its secret, and return the exit code."""
    folder = Path(arguments.folder)
    if arguments.json and arguments.step == "start":
        raise InputError("--json goes with reveal: start serves a machine and answers nothing")
    return _start(folder, arguments) if arguments.step == "start" else _reveal(folder, arguments)


def _start(folder: Path, arguments: argparse.Namespace) -> int:
    """Serve the folder's machine until Ctrl-C; a tape fills in the forms of the folder."""
    if (folder / SECRET).exists():
        if arguments.seed is not None:
            raise InputError(
                folder, "holds a secret already", remedy="name a new folder, or no seed"
            )
        secret = secret_in(folder)
    else:
        drawn = secrets.randbelow(MACHINES) if arguments.seed is None else arguments.seed
        secret = _begun(folder, Secret(drawn))
    garage = secret.garage
    tape = Tape(garage, np.random.default_rng([secret.seed, 5]), noise=NOISE)
    print(
        sentences(
            [
                f"A machine with a secret. {folder / SETTINGS} has what its owner believes. A tape "
                f"reads to {NOISE} mm and fills in the newest form in {folder} once its marks are "
                "cut."
            ],
            mark="",
        ),
        flush=True,
    )
    link = str(folder / PORT) if sys.platform == "linux" else None
    vars(arguments).update(link=link, eeprom=None, fresh=False)
    return serve(garage, arguments, _Reader(folder, tape).look)


def _begun(folder: Path, secret: Secret) -> Secret:
    """Write the secret and what the owner believes into a folder that has neither."""
    if (folder / SETTINGS).exists():
        raise InputError(folder, f"holds a {SETTINGS}", remedy="name a new folder")
    folder.mkdir(parents=True, exist_ok=True)
    said = "What the owner of the virtual machine believes."
    believed = machine_toml(secret.garage.settings, comment=said)
    write_all(
        {str(folder / SETTINGS): believed.encode(), str(folder / SECRET): secret.text.encode()}
    )
    return secret


class _Reader:
    """Fills in the newest form of a folder that waits for readings, once its marks are cut."""

    def __init__(self, folder: Path, tape: Tape) -> None:
        self._folder, self._tape = folder, tape
        self._form = ""

    def look(self, machine: VirtualMachine) -> None:
        """Look whether a form waits, and whether its marks are cut."""
        # What is taken away meanwhile waits no more; Windows keeps others out while it is written.
        with suppress(FileNotFoundError, PermissionError):
            for path in sorted(self._folder.glob("*.toml"), key=lambda path: -path.stat().st_mtime):
                form = path.read_text(encoding="utf-8", errors="replace")
                if BLANK in form:
                    return self._fill(path, form, machine)

    def _fill(self, path: Path, form: str, machine: VirtualMachine) -> None:
        if form != self._form:  # what was cut before it was written is not its
            self._form = form
            self._tape.pass_over(machine)
        filled = self._tape.fill_when_cut(form, machine)
        if filled:
            self._form = ""
            write_whole(str(path), filled.encode())


def _reveal(folder: Path, arguments: argparse.Namespace) -> int:
    """Say what is hidden, and what the answer is worth."""
    secret = secret_in(folder)
    answer = read_settings(arguments.answer or folder / SETTINGS, known=known_effects())
    result = score(secret, answer)
    print_json(result) if arguments.json else print(_as_text(result, unit_of(arguments)))
    return int(bool(result.false or result.missed))


def _as_text(result: Score, unit: Unit) -> str:
    """Return the score for people."""
    before, after = unit.bare(result.before_mm), result.after(unit.bare)
    rows = [["as the settings were", before], ["yours", after]]
    return "\n\n".join(
        [
            headline(f"Hidden was {result.hidden}."),
            sentences([result.sentence], mark=""),
            table([f"error all over the sheet, {unit.name} RMS", "left"], rows),
        ]
    )


# The arguments of `plumb practice`.

STEPS = ("start", "reveal")
EXAMPLES = ("plumb practice start game", "plumb practice reveal game game/new.toml")
EXIT = (
    "Exit: 0 done; 1 revealed, and you missed something or added what is not there; 2 it cannot "
    "be done."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb practice`."""
    parser.add_argument("step", metavar="STEP", choices=STEPS, help=", ".join(STEPS))
    parser.add_argument("folder", metavar="FOLDER", help="where you practise")
    parser.add_argument(
        "answer",
        metavar="MACHINE",
        nargs="?",
        help="reveal: your new machine.toml [FOLDER/machine.toml, as it was at the start]",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=int,
        help="start: the same number gives the same machine [random]",
    )
    add_brain(parser, "start: ")
    add_shared(parser, "--units", "--json")
