"""Verdicts kept in a file, so that a run goes on where it was stopped, and reasons of survivors."""

import hashlib
import json
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from mutants import EQUIVALENT, KILLED, STILLBORN, Mutant, Verdict


class Ledger:
    """Verdicts of one room in a JSON file, for one state of the tree."""

    def __init__(self, path: Path, state: str):
        self.path, self.state = path, state
        kept = json.loads(path.read_text()) if path.is_file() else {}
        self.is_same = kept.get("state") == state
        self.verdicts = {key: Verdict(**each) for key, each in kept.get("verdicts", {}).items()}

    def start_anew(self) -> None:
        """Forgets all verdicts."""
        self.verdicts = {}

    def note(self, mutant: Mutant, verdict: Verdict) -> None:
        """Keeps a verdict, at once: the run may be stopped at any moment."""
        self.verdicts[mutant.key] = verdict
        self.save()

    def save(self) -> None:
        """Writes the file in one go."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        text = json.dumps(
            {
                "state": self.state,
                "verdicts": {key: vars(each) for key, each in self.verdicts.items()},
            },
            indent=1,
        )
        fresh = self.path.with_suffix(".new")
        fresh.write_text(text)
        fresh.replace(self.path)


def state_of(root: Path, folders: tuple[str, ...]) -> str:
    """A digest of all files in some folders."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                digest.update(f"{path.relative_to(root)}\n".encode() + path.read_bytes())
    return digest.hexdigest()


def reasons(folder: Path) -> dict[tuple[str, str, str], str]:
    """Why some mutants may survive: by file, original and mutant; from one TOML file a room."""
    return {
        (file, row["original"], row["mutant"]): row["reason"]
        for path in sorted(folder.glob("*.toml"))
        for file, rows in tomllib.loads(path.read_text()).items()
        for row in rows
    }


@dataclass
class Score:
    """What became of a room's mutants."""

    room: str
    killed: int = 0
    survivors: list[str] = field(default_factory=list)
    excused: int = 0
    equivalent: int = 0
    stillborn: int = 0

    def __str__(self) -> str:
        counted = self.killed + len(self.survivors)
        share = self.killed / counted if counted else 1
        return (
            f"{self.room}: {share:.1%} of {counted} mutants fall; {len(self.survivors)} survive, "
            f"{self.excused} more with a reason; {self.equivalent} equivalent, "
            f"{self.stillborn} do not compile"
        )


def score(room: str, judged: dict[Mutant, Verdict], why: dict[tuple[str, str, str], str]) -> Score:
    """Counts verdicts; survivors with a reason do not count."""
    result = Score(room)
    for mutant, verdict in judged.items():
        if verdict.outcome == KILLED:
            result.killed += 1
        elif verdict.outcome == EQUIVALENT:
            result.equivalent += 1
        elif verdict.outcome == STILLBORN:
            result.stillborn += 1
        elif (mutant.file, mutant.original, mutant.changed) in why:
            result.excused += 1
        else:
            result.survivors.append(f"{mutant}  ({verdict.by})" if verdict.by else str(mutant))
    return result
