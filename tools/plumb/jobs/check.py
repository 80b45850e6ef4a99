"""Everything about a program before it is cut, in one value."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from plumb.fit.inputs import Inputs
from plumb.jobs.dry_run import Done, Run
from plumb.jobs.expected import Believed, PartErrors, errors_of
from plumb.jobs.findings import Finding, findings_of
from plumb.jobs.hanging import Hanging, hanging_along
from plumb.jobs.moves import Samples
from plumb.jobs.parts import Part, parts_of
from plumb.jobs.resting import ends_too_high
from plumb.jobs.speeds import Slower, Times, slower_moves, times_of
from plumb.settings.machine import MachineSettings

STEP = 5.0  # [mm] between places that are looked at


@dataclass(frozen=True)
class Checked:
    """A program, run dry."""

    done: Done
    samples: Samples
    findings: tuple[Finding, ...]
    hanging: Hanging | None  # None where nothing is cut
    slower: tuple[Slower, ...]
    times: Times
    parts: tuple[Part, ...]
    errors: tuple[PartErrors, ...] | None  # of each part; None without marks

    @property
    def is_good(self) -> bool:
        """Whether nothing spoils a part or stops the machine."""
        spoiled = any(finding.is_wrong for finding in self.findings)
        return not spoiled and not (self.hanging and self.hanging.bad)


def check_job(
    settings: MachineSettings,
    lines: Sequence[str],
    *,
    inputs: Inputs | None = None,
    limits: Mapping[str, float] | None = None,
    numbers: Mapping[int, float] | None = None,
    start: tuple[float, float, float] = (0.0, 0.0, 0.0),
    progress: Callable[[float], None] | None = None,
) -> Checked:
    """Run a program dry; `inputs` are marks that tell which errors to expect."""
    run = Run(settings, start=start, numbers=numbers)
    run.send(lines, progress=progress)
    done = run.finish()
    over_sheet = done.moves.only(done.moves.over_sheet)
    samples = over_sheet.sampled(STEP)
    parts = parts_of(over_sheet, samples)
    findings = findings_of(done)
    findings += ends_too_high(settings, done)
    errors = errors_of(Believed.of(inputs), settings, parts) if inputs else None
    return Checked(
        done=done,
        samples=samples,
        findings=tuple(sorted(findings, key=lambda finding: finding.line)),
        hanging=hanging_along(settings, over_sheet, samples, limits or {}),
        slower=slower_moves(over_sheet),
        times=times_of(done),
        parts=parts,
        errors=errors,
    )
