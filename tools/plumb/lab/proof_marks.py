"""Proof marks: two that took no part in the fit, on the sheet of the marks before them."""

import re

import numpy as np

from plumb.fit.inputs import Inputs
from plumb.lab.project import Project
from plumb.lab.rounds import (
    PROOFS,
    Round,
    form_of,
    inputs_of,
    is_proof,
    new_round,
    next_names,
    planned,
    saved_round,
    settings_of,
)
from plumb.plan.planned_visits import proof_places
from plumb.text.errors import InputError

FORM = re.compile(r"(proof|check)(?:-(\d+))?\.toml")  # check: as they were called before


def proof_round(project: Project, *, anew: bool = False) -> Round:
    """Return the newest round of proof marks; another where there is none, or `anew`: it takes the
    place of one without readings.
    """
    forms = proof_forms(project)
    if forms and not anew:
        return saved_round(project, forms[-1], "proof")
    choices, inputs = project.choices, inputs_of_promise(project)
    names = next_names(project, PROOFS)
    before = [form_of(project, choices, form) for form in forms if form not in names]
    cut = [mark.target for form in before for mark in form.measurements.marks]
    # Far from the marks that were fitted, and from proof marks that were cut before.
    known = [*map(tuple, inputs.measurements.targets), *cut]
    places = proof_places(inputs.settings, np.array(known))
    if not len(places):
        raise InputError("no place is left that the sled reaches and that was not fitted")
    plan = planned(inputs.settings, "own", [(float(x), float(y)) for x, y in places])
    same_sheet = choices.model_copy(update={"new_sheet": False})
    return new_round(project, same_sheet, plan, names, origin="proof")


def proof_forms(project: Project) -> list[str]:
    """Return the forms of proof marks in the folder, in the order in which they were made."""
    found = [match for name in project.names() if (match := FORM.fullmatch(name))]
    return [match[0] for match in sorted(found, key=lambda match: (match[1], int(match[2] or 1)))]


def inputs_of_promise(project: Project) -> Inputs:
    """Return the readings that the promise goes by. Raises InputError."""
    return inputs_of(project, among=_promising(project))


def _promising(project: Project) -> list[str]:
    """Return the files of these readings: proof marks take no part, nor does a sheet that was laid
    after the correction, for proof marks are on the sheet before it.
    """
    choices = project.choices
    names = [name for name in choices.marks if not is_proof(name)]
    settings = settings_of(project, choices)
    fitted = settings and settings.fitted
    seen = [board.marks for board in fitted.boards] if fitted else names
    later = (
        place
        for place, name in enumerate(names)
        if name not in seen and form_of(project, choices, name).measurements.rounds[0].new_sheet
    )
    return names[: next(later, len(names))]
