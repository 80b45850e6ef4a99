"""Answers to the same question are worked out once in a run: tests ask how they are said.

The processes of a run share them by files. What a test changes on the way to an answer belongs into
its key.
"""

import hashlib
import os
import pickle
import sys
from pathlib import Path

import pytest
from hurried_plumb import FEW
from plumb.diagnosis import diagnose
from plumb.diagnosis.readings import clear_outliers
from plumb.model.catalogue import effect_names
from plumb.plan import propose
from plumb.plan.case import DRAWS, Outlooks

FOLDER = "PLUMB_ANSWERS"  # in the environment: where they are


def remember():
    """From now on these answers are remembered, whoever asks for them."""
    for work in (clear_outliers, diagnose, propose):
        known = remembered(work)
        for name, room in list(sys.modules.items()):
            if name.startswith("plumb.") and getattr(room, work.__name__, None) is work:
                setattr(room, work.__name__, known)


def remembered(work):
    """The same work, done once for the same arguments."""

    def answer(*asked, **how):
        key = work.__name__, Outlooks.__init__.__defaults__, effect_names(), asked
        file = Path(os.environ[FOLDER], hashlib.sha256(pickle.dumps(key)).hexdigest())
        if not file.exists():
            part = file.with_suffix(f".{os.getpid()}")
            part.write_bytes(pickle.dumps(work(*asked, **how)))
            part.replace(file)
        return pickle.loads(file.read_bytes())

    return answer


@pytest.fixture(scope="module", autouse=True)
def tried_less():
    """For the tests of a room whose conftest imports it: plans are tried less often."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Outlooks.__init__, "__defaults__", (FEW,))
        yield


@pytest.fixture
def tried_in_full(monkeypatch):
    """Plans are tried as often as in earnest: which comes first goes by their chances."""
    monkeypatch.setattr(Outlooks.__init__, "__defaults__", (DRAWS,))
