"""JSON answers of all commands: `python -m plumb.cli.answers` prints their schema."""

import json
from dataclasses import dataclass
from typing import Any

from plumb.cli.add import AddAnswer
from plumb.cli.calibrate import CalibrateAnswer
from plumb.cli.diagnose import DiagnosisAnswer
from plumb.cli.effects import Library
from plumb.cli.forward import PlacesAnswer
from plumb.cli.grid import PlannedGrid
from plumb.cli.inverse import ChainLengths
from plumb.cli.read import MachineNumbers
from plumb.cli.report import ReportAnswer
from plumb.cli.resume import ResumeAnswer
from plumb.cli.send import SendAnswer
from plumb.cli.settings import SettingLines
from plumb.fit.compare import Comparison
from plumb.plan.preview import SheetReach
from plumb.text.answers import schema_of
from plumb.vm.practice import Score
from plumb.words.job import JobAnswer
from plumb.words.proposals import ProposalsAnswer
from plumb.words.recheck import RecheckAnswer
from plumb.words.recover import HomeAnswer


@dataclass(frozen=True)
class RefusalAnswer:
    """Exit code 2; the same line is on standard error."""

    error: str


# The answer of each command.
ANSWERS: dict[str, Any] = {
    "refusal": RefusalAnswer,
    "add": AddAnswer,
    "calibrate": CalibrateAnswer | RecheckAnswer,
    "check": JobAnswer,
    "compare": Comparison,
    "diagnose": DiagnosisAnswer,
    "effects": Library,
    "forward": PlacesAnswer,
    "grid": PlannedGrid,
    "inverse": ChainLengths,
    "next": ProposalsAnswer,
    "practice": Score,
    "reach": SheetReach,
    "read": MachineNumbers,
    "recover": HomeAnswer,
    "report": ReportAnswer,
    "resume": ResumeAnswer,
    "send": SendAnswer,
    "settings": SettingLines,
}


HEAD = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "$id": "plumb-answers",
    "title": "What the commands of plumb print with --json",
    "description": "$defs/COMMAND is the object of that command; $defs/refusal stands for it with "
    "exit code 2. Lengths are mm, forces N, angles rad. What is not a finite number is null.",
}


def schema() -> dict[str, Any]:
    """Return the JSON schema: $defs has the answer of each command by its name."""
    return {
        **HEAD,
        "anyOf": [{"$ref": f"#/$defs/{name}"} for name in ANSWERS],
        "$defs": schema_of(ANSWERS),
    }


if __name__ == "__main__":
    print(json.dumps(schema(), indent=2, ensure_ascii=False))
