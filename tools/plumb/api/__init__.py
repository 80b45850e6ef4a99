"""The lab in Python: read, compare, diagnose, propose what to measure next, add.

`import plumb` has all of it: plumb.read, plumb.compare and so on. docs/lab.ipynb goes through a
calibration. Lengths are mm, forces N, angles rad.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from plumb.cure.add import Addition as Addition
from plumb.cure.add import add as add_effects
from plumb.cure.decision import decide as decided
from plumb.diagnosis import Checked
from plumb.diagnosis import diagnose as diagnosed
from plumb.fit.compare import Comparison as Comparison
from plumb.fit.compare import compare as compare
from plumb.fit.compare import refuse_absurd
from plumb.fit.fit import priors_with
from plumb.fit.inputs import Inputs as Inputs
from plumb.fit.inputs import read_inputs
from plumb.plan import propose
from plumb.settings import write_machine_toml
from plumb.text.compiled import refuse_stale
from plumb.text.errors import InputError as InputError
from plumb.text.errors import Source
from plumb.words import decision, proposals, verdict
from plumb.words.decision import DecisionInWords as Decision
from plumb.words.proposals import NextInWords as Next
from plumb.words.verdict import DiagnosisInWords as Diagnosis

refuse_stale()


def read(
    settings: Source,
    *marks: Source,
    cut_with: Source | None = None,
    controller: str | None = None,
    sigma: float | None = None,
    priors: Mapping[str, float] | None = None,
    checked: Mapping[str, tuple[float, float]] | None = None,
) -> Inputs:
    """Return the machine and its marks, from files; several files of marks make one board.

    `sigma` is the reading error of a coordinate [mm]. `priors` says how far (one sigma) a number of
    the frame may be wrong. `checked` holds numbers that were measured directly, with their sigmas.
    Raises InputError for what cannot be used.
    """
    checks = [Checked(name, *numbers) for name, numbers in (checked or {}).items()]
    frame = priors_with(list((priors or {}).items()))
    inputs = read_inputs(settings, marks, cut_with=cut_with, controller=controller)
    refuse_absurd(checks, inputs.settings)
    return replace(inputs, sigma=sigma, priors=frame, checked=checks)


def diagnose(inputs: Inputs) -> Diagnosis:
    """Return what the model of these settings misses in the marks. Raises InputError."""
    return verdict.in_words(diagnosed(inputs))


def decide(inputs: Inputs, *, patch: bool = False) -> Decision:
    """Return what to write; `patch` takes a residual patch if it helps. Raises InputError."""
    return decision.in_words(decided(inputs, patch=patch))


def next(inputs: Inputs, diagnosis: Diagnosis | None = None) -> Next:
    """Return what to measure next, best first."""
    return proposals.in_words(propose(diagnosis or diagnose(inputs), inputs))


def add(inputs: Inputs, effects: Sequence[str] = (), *, patch: bool = False) -> Addition:
    """Return the machine with its frame and these effects fitted to the marks."""
    return add_effects(inputs, effects=effects, patch=patch)


def write(addition: Addition, path: Source) -> Path:
    """Write the new machine as a machine.toml; an old file of that name is replaced."""
    write_machine_toml(path, addition.settings)
    return Path(path)
