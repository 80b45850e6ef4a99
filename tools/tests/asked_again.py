"""Diagnoses and proposals of the same inputs are worked out once: tests ask how they are said."""

import pickle

import pytest
from hurried_plumb import FEW
from plumb.diagnosis import diagnose
from plumb.model.catalogue import effect_names
from plumb.plan import propose
from plumb.plan.outlook import DRAWS, Outlooks

DIAGNOSING = ("plumb.cli.diagnose", "plumb.cli.next", "plumb.cure.decision", "plumb.lab.report")
PROPOSING = ("plumb.cli.diagnose", "plumb.cli.next", "plumb.cli.calibrate", "plumb.lab.report")
_known = {}


def _once(work, inputs, *others, **how):
    key = work.__name__, *Outlooks.__init__.__defaults__, *effect_names(), pickle.dumps(inputs)
    if key not in _known:
        _known[key] = work(*others, inputs, **how)
    return _known[key]


@pytest.fixture(scope="module", autouse=True)
def asked_again():
    """For the tests of a room whose conftest imports it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Outlooks.__init__, "__defaults__", (FEW,))
        for room in DIAGNOSING:
            patch.setattr(f"{room}.diagnose", lambda inputs: _once(diagnose, inputs))
        for room in PROPOSING:
            patch.setattr(
                f"{room}.propose",
                lambda diagnosis, inputs, **how: _once(propose, inputs, diagnosis, **how),
            )
        yield


@pytest.fixture
def tried_in_full(monkeypatch):
    """Plans are tried as often as in earnest: which comes first goes by their chances."""
    monkeypatch.setattr(Outlooks.__init__, "__defaults__", (DRAWS,))
