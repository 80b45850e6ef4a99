"""What a file of marks says, as a short text: equal readings have equal texts."""

from __future__ import annotations

import json
from hashlib import sha256

from plumb.marks.model import Measurements


def digest_of(measurements: Measurements) -> str:
    """The SHA-256 of all marks and distances with their readings."""
    marks = [
        (mark.name, mark.target, mark.measured, mark.approach, mark.sled_weight, mark.chains)
        for mark in measurements.marks
    ]
    distances = [(distance.between, distance.length) for distance in measurements.distances]
    return sha256(json.dumps([marks, distances]).encode()).hexdigest()
