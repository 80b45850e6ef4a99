"""The laws of lab effects, and their numbers worked out by hand."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.observations import LAB_NAMES, SHEET_ROTATION, observe, sighted
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.catalogue import EDGES, LAB_EFFECTS, SLED, TAPE, parameter_names, parameter_words
from plumb.model.predict import NAMES, frame_words, known_effects, library, values_of
from synthetic import BELIEVED, TRUE, grid, marks_on

APPROACHES = ((3.0, 4.0), (-1.0, 0.0), (0.0, 2.0), None)
EVERY = (*NAMES, SHEET_ROTATION, *LAB_NAMES)
SIZES = {parameter["name"]: abs(parameter["usual"]) or 10.0 for parameter in frame_words()}
SIZES |= {name: slopes["typical"] for name, slopes in parameter_words().items()}
SIZES[SHEET_ROTATION] = 1.0
TYPICAL = {name: SIZES[name] for name in LAB_NAMES}


def board(feed):
    """Marks of two sleds, approached from three sides or not known whence, and a distance."""
    true, believed = (replace(machine, feed=feed) for machine in (TRUE, BELIEVED))
    marks = marks_on(true, believed, grid(4, 3))
    heavy = marks_on(true, believed, grid(2, 2), sled_weight=150.0, prefix="heavy ")
    several = tuple(
        replace(mark, approach=APPROACHES[i % len(APPROACHES)])
        for i, mark in enumerate(marks + heavy)
    )
    return observe(believed, Measurements(several, (Distance(("0", "11"), 2400.0),)))


ROWS = {feed: board(feed) for feed in ("top", "bottom")}


def seen(outside, values=None, names=EVERY, *, feed="top"):
    return sighted(
        values_of(TRUE) if values is None else values,
        outside,
        ROWS[feed],
        over_top=feed == "top",
        usual_weight=TRUE.sled_weight,
        names=names,
    )


@pytest.mark.parametrize("effect", LAB_EFFECTS, ids=lambda parameter: parameter.name)
class TestEach:
    def test_describes_itself_as_the_firmwares_effects_do(self, effect):
        words = effect.words
        example = library()[0]
        assert set(example) <= set(words) and words["where"] == "lab"
        assert set(example["parameters"][0]) == set(words["parameters"][0])
        said = [words[key] for key in ("summary", "pattern", "look_alikes", "remedy")]
        texts = [*said, effect.needs]
        assert all(re.match(r"\w", text) and not text.endswith(".") for text in texts)
        assert effect.acts_on in (SLED, EDGES, TAPE)

    def test_is_not_an_effect_of_the_firmware(self, effect):
        assert effect.name not in known_effects()
        assert parameter_names(effect.name) == (effect.parameter,)

    def test_zero_and_the_typical_size_are_plausible(self, effect):
        (words,) = effect.words["parameters"]
        assert words["low"] <= 0 < words["typical"] < words["high"]

    def test_zero_means_absent(self, effect):
        without = seen({}, names=())
        zero = seen({effect.parameter: 0.0})
        assert zero.read.where.tobytes() == without.read.where.tobytes()
        assert zero.taped.where.tobytes() == without.taped.where.tobytes()

    def test_zero_has_a_slope(self, effect):
        at_zero = seen({}, names=(effect.parameter,)).read.slopes
        assert (np.abs(at_zero).max(axis=(0, 1)) > 0).all()


@pytest.mark.parametrize("feed", ROWS)
@pytest.mark.parametrize("name", EVERY)
def test_the_slopes_of_all_that_is_measured_are_those_of_finite_differences(name, feed):
    outside = TYPICAL | {SHEET_ROTATION: 0.1}
    values = values_of(TRUE)
    sighting = seen(outside, feed=feed)
    # Places come back within 1e-5 mm or so; a longer step hides that, a shorter step bends less.
    step = (1e-2 if "." in name else 1e-3) * SIZES[name]
    ends = []
    for signed in (step, -step):
        if name in NAMES:
            moved = values.copy()
            moved[NAMES.index(name)] += signed
            ends.append(seen(outside, moved, names=(), feed=feed))
        else:
            changed = outside | {name: outside.get(name, 0.0) + signed}
            ends.append(seen(changed, names=(), feed=feed))
    for which in ("read", "taped"):
        above, below = (getattr(end, which).where for end in ends)
        difference = (above - below) / (2 * step)
        slopes = getattr(sighting, which).slopes[:, :, EVERY.index(name)]
        assert slopes == pytest.approx(difference, abs=1e-3 * np.abs(difference).max() + 1e-9)


def test_derivatives_that_are_not_asked_for_are_not_computed():
    whole, part = seen(TYPICAL), seen(TYPICAL, names=("motor_gap", "tape_scale.strain"))
    assert part.read.where.tobytes() == whole.read.where.tobytes()
    for i, name in enumerate(("motor_gap", "tape_scale.strain")):
        assert part.read.slopes[:, :, i] == pytest.approx(
            whole.read.slopes[:, :, EVERY.index(name)], abs=1e-12
        )


CHAINS = {"chain_sag": {"weight_ratio_squared": (0.00137293 / 97.9) ** 2 / 24}}
CHAINS["chain_stretch"] = {"compliance": 5.17e-6}
MACHINE = replace(BELIEVED, effects=CHAINS)
CORNER = (1000.0, 500.0)
TWO = (Mark("corner", CORNER), Mark("middle", (0.0, 0.0)))


def shown(marks, distances=(), **outside):
    rows = observe(MACHINE, Measurements(marks, distances))
    return sighted(
        values_of(MACHINE),
        {name.replace("__", "."): value for name, value in outside.items()},
        rows,
        over_top=True,
        usual_weight=MACHINE.sled_weight,
        names=(),
    )


def lag(place, approach, drag=6.6):
    """The distance by which friction moves a mark [mm]."""
    marks = (Mark("one", place, approach=approach),)
    return (shown(marks, sled_friction__drag=drag).read.where - shown(marks).read.where)[0]


# Friction of 6.6 N, published, rounded to one or two digits: top centre 0.24 mm in y, right middle
# 0.8 and right bottom 2.5 mm in x, lower calibration mark (965, -356) 0.48 mm in x.
@pytest.mark.parametrize(
    ("place", "axis", "published", "slack"),
    [
        ((0, 550), 1, 0.24, 0.03),
        ((1150, 0), 0, 0.8, 0.05),
        ((1150, -550), 0, 2.5, 0.06),
        ((965, -356), 0, 0.48, 0.01),
        ((0, 0), 0, 0.05, 0.01),
    ],
)
def test_friction_holds_the_sled_back_as_far_as_published(place, axis, published, slack):
    ahead = [0.0, 0.0]
    ahead[axis] = 30.0
    back = [-part for part in ahead]
    assert lag(place, tuple(ahead))[axis] == pytest.approx(-published, abs=slack)
    assert lag(place, tuple(back))[axis] == pytest.approx(published, abs=slack)


def test_a_sideways_lag_in_a_lower_corner_drags_the_mark_up_or_down_too():
    # Coming from the middle it stays behind, and the slacker chain lets it stay higher.
    x, y = lag((1150, -550), (1.0, 0.0))
    assert x < 0 < y and abs(y) == pytest.approx(0.0733 * 6.6, rel=0.02)


def test_a_tape_that_reads_too_long_gives_larger_numbers():
    sighting = shown(TWO, (Distance(("corner", "middle"), 1.0),), tape_scale__strain=0.001)
    for places in (sighting.read, sighting.taped):
        assert places.where == pytest.approx(np.array([(1001.0, 500.5), (0, 0)]), abs=1e-4)


def test_a_skew_sheet_moves_the_top_right_in_readings_and_leaves_distances_alone():
    sighting = shown(TWO, (Distance(("corner", "middle"), 1.0),), sheet_skew__angle=0.002)
    assert sighting.read.where == pytest.approx(np.array([(1001.0, 500.0), (0, 0)]), abs=1e-4)
    assert sighting.taped.where == pytest.approx(np.array([CORNER, (0, 0)]), abs=1e-4)


def test_readings_from_the_edges_are_those_of_the_turned_sheet():
    # A quarter turn: what was to the right is up, and is read too far right.
    sighting = shown(TWO, sheet_skew__angle=0.01, **{SHEET_ROTATION: np.pi / 2})
    assert sighting.read.where[0] == pytest.approx([-500.0 + 10.0, 1000.0], abs=1e-3)
