"""Results of simulations are kept until something that they depend on changes.

A simulated Mega has no clock but the program's cycles. So what it says depends on the simulator's
program, on the program that is flashed and on the dialogue alone, and holds until one of these is
another.
"""

import fcntl
import hashlib
import json
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from commands import ROOT, output

KEPT = ROOT / ".build/kept"
LONGEST = 1500  # [s] on a busy computer

Done = subprocess.CompletedProcess[str]


def kept(command: Sequence[str | Path], files: Sequence[Path], name: str) -> Done:
    """Return what a simulation says. One that went well says it again without being run, while its
    program, its arguments and these files are the same.
    """
    program, *arguments = command
    KEPT.mkdir(parents=True, exist_ok=True)
    note = KEPT / f"{Path(program).name}.{name}.json"
    with note.with_suffix(".turn").open("w") as turn:
        # Tests and the bench, which may run at the same time, ask for the same.
        fcntl.flock(turn, fcntl.LOCK_EX)
        key = _key([Path(program), *files], [str(argument) for argument in arguments])
        old = json.loads(note.read_text()) if note.is_file() else {}
        if old.get("key") == key:
            return subprocess.CompletedProcess(command, 0, old["stdout"], old["stderr"])
        done = run(command)
        if done.returncode == 0:
            note.write_text(json.dumps({"key": key, "stdout": done.stdout, "stderr": done.stderr}))
        return done


def run(command: Sequence[str | Path]) -> Done:
    """Return what a simulation says."""
    return subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)


def _key(files: Sequence[Path], arguments: Sequence[str]) -> str:
    """Return one number for the contents of all that a simulation depends on."""
    whole = hashlib.sha256(json.dumps(arguments).encode())
    for file in files:
        whole.update(f"{file.name}\n".encode())
        whole.update(hashlib.sha256(_content(file)).digest())
    return whole.hexdigest()


def _content(file: Path) -> bytes:
    """Return what counts of a file: of what is flashed, no symbols, which the linker names by
    chance.
    """
    if file.suffix != ".elf":
        return file.read_bytes()
    with tempfile.NamedTemporaryFile(suffix=".elf") as bare:
        output("avr-strip", "-o", bare.name, file)
        return Path(bare.name).read_bytes()
