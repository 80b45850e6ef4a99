"""plan_pictures: places are numbered, and a sentence says what to do at each."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.pictures.plan import (
    draw_plan,
    numbered_places,
    place_sentences,
    rows_for,
    sentences_of,
    with_places,
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


def addition(title, visits, named):
    return SimpleNamespace(title=title, minutes=9.2, visits=visits, named=named)


def test_a_preview_numbers_the_places_of_additions_and_says_what_each_brings():
    additions = (
        addition("a level", (), 5),
        addition("marks from opposite sides", visits_to((0, 0), (100, 0), (0, 0)), 7),
        addition("a fine grid", visits_to(*((i, i) for i in range(28))), 9),
        addition("4 marks with 5 kg more", visits_to((100, 0)), 6),
    )
    outlines = tuple(
        SimpleNamespace(effect=name, is_seen=is_seen)
        for name, is_seen in (("chain_sag", True), ("chain_pitch", False), ("frame_lean", False))
    )
    preview = SimpleNamespace(additions=additions, outlines=outlines, named=1)
    assert [each.named for each in with_places(preview)] == [7, 6]
    places = {said: place.tolist() for said, place in numbered_places(preview)}
    assert places == {"1": [0.0, 0.0], "1, 2": [100.0, 0.0]}
    assert sentences_of(preview) == [
        "Found in their usual size: chain sag.",
        "Not found in their usual size: chains too long or too short, a leaning frame.",
        "1 of 3 causes could be named.",
        "More could be with what follows; numbers show where on the sheet:",
        "1: marks from opposite sides, about 9 minutes: 7 could be named.",
        "2: 4 marks with 5 kg more, about 9 minutes: 6 could be named.",
        "Without a mark: a level, about 9 minutes: 5 could be named.",
    ]
