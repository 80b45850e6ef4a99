"""The laws of lab effects: zero means absent, zero has a slope, slopes are exact."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.observations import observe
from plumb.fit.sighting import LAB_NAMES, SHEET_ROTATION, sighted
from plumb.marks.read import Distance, Measurements
from plumb.model.catalogue import parameter_names, parameter_words
from plumb.model.lab_effects import EDGES, LAB_EFFECTS, SLED, TAPE
from plumb.model.predict import NAMES, frame_words, known_effects, library, values_of
from synthetic import BELIEVED, TRUE, grid, marks_on

APPROACHES = ((3.0, 4.0), (-1.0, 0.0), (0.0, 2.0), None)
EVERY = (*NAMES, SHEET_ROTATION, *LAB_NAMES)
SIZES = {parameter["name"]: abs(parameter["usual"]) or 10.0 for parameter in frame_words()}
SIZES |= {name: slopes["typical"] for name, slopes in parameter_words().items()}
SIZES[SHEET_ROTATION] = 1.0
TYPICAL = {name: SIZES[name] for name in LAB_NAMES}


def board():
    """Marks of two sleds, approached from three sides or not known whence, and a distance."""
    marks = marks_on(TRUE, BELIEVED, grid(4, 3))
    heavy = marks_on(TRUE, BELIEVED, grid(2, 2), sled_weight=150.0, prefix="heavy ")
    several = tuple(
        replace(mark, approach=APPROACHES[i % len(APPROACHES)])
        for i, mark in enumerate(marks + heavy)
    )
    return Measurements(several, (Distance(("0", "11"), 2400.0),))


ROWS = observe(BELIEVED, board())


def seen(outside, values=None, names=EVERY):
    return sighted(
        values_of(TRUE) if values is None else values,
        outside,
        ROWS,
        over_top=True,
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


@pytest.mark.parametrize("name", EVERY)
def test_the_slopes_of_all_that_is_measured_are_those_of_finite_differences(name):
    outside = TYPICAL | {SHEET_ROTATION: 0.1}
    values = values_of(TRUE)
    sighting = seen(outside)
    # Places come back within 1e-5 mm or so; a longer step hides that, a shorter step bends less.
    step = (1e-2 if "." in name else 1e-3) * SIZES[name]
    ends = []
    for signed in (step, -step):
        if name in NAMES:
            moved = values.copy()
            moved[NAMES.index(name)] += signed
            ends.append(seen(outside, moved, names=()))
        else:
            changed = outside | {name: outside.get(name, 0.0) + signed}
            ends.append(seen(changed, names=()))
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
