"""plan_pictures: places are numbered, and a sentence says what to do at each."""

import re

import numpy as np
import pytest
from plumb.pictures.plan import (
    draw_plan,
    place_sentences,
    rows_for,
)
from plumb.plan.planned_visits import Visits

SHEET = (2400.0, 1200.0)
GRAVITY = 9.80665


def visits_to(*targets, kilograms=0.0, side=(0.0, 1.0), swapped=False):
    count = len(targets)
    return Visits(
        names=tuple(map(str, range(count))),
        targets=np.array(targets, dtype=float),
        chains=np.zeros((count, 2)),
        sled_weights=np.full(count, 100.0 + kilograms * GRAVITY),
        approaches=np.tile(side, (count, 1)),
        swapped=np.full(count, swapped),
    )


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "1: 200 mm from the left, 100 mm from the top, arrive upwards"),
        ({"side": (0, 0)}, "1: 200 mm from the left, 100 mm from the top"),
        ({"side": (-1, 0.1), "kilograms": 5}, "5.0 kg more, arrive leftwards"),
        ({"side": (0, -1), "swapped": True}, "chains swapped, arrive downwards"),
    ],
)
def test_a_sentence_says_where_and_how(given, said):
    visits = visits_to((-1000, 500), **given)
    (sentence,) = place_sentences(visits, usual_weight=100.0, sheet=SHEET)
    assert sentence.endswith(said)


def test_repeats_share_a_number_and_a_sentence():
    visits = visits_to((-1000, 500), (0, 0), (-1000, 500))
    said = place_sentences(visits, usual_weight=100.0, sheet=SHEET)
    assert [each.split(":")[0] for each in said] == ["1", "2"]
    assert said[0].endswith("2 times") and "times" not in said[1]
    drawn = draw_plan(
        visits, np.zeros((0, 2)), title="Next", usual_weight=100.0, sheet=SHEET, form="svg"
    ).decode()
    words = re.findall("<!-- (.*) -->", drawn)
    assert words.count("1") == words.count("2") == 1 and set(said) < set(words)


def test_many_places_have_no_sentences_and_a_few_have_a_column():
    many = visits_to(*((10 * i, 0) for i in range(41)))
    assert place_sentences(many, usual_weight=100.0, sheet=SHEET) == []
    assert [rows_for(count) for count in (0, 8, 9, 10)] == [0, 8, 5, 5]
