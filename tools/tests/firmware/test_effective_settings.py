"""The published numbers mean the chains that the published firmware pays out."""

from dataclasses import replace

import numpy as np
import pytest
from plumb import _core
from plumb.firmware.settings import machine_of
from plumb.model.predict import FOUND, chain_lengths, lengths
from plumb.settings import MachineSettings, PublishedSettings
from synthetic import BELIEVED, SHEET

POINTS = np.array([(x, y) for x in np.linspace(-1219, 1219, 13) for y in np.linspace(-609, 609, 9)])


def both(numbers):
    """Chains of the published formula and of this firmware for the same $-numbers, (n, 2) [mm]."""
    stock = MachineSettings(
        motor_gap=numbers.get(2, 2978.4),
        motor_height=SHEET[1] / 2 + numbers.get(3, 463),
        rotation_radius=numbers.get(8, 250),
        sheet_width=SHEET[0],
        sheet_height=SHEET[1],
        feed="top" if numbers.get(38, 1) == 1 else "bottom",
        sprocket_radius=numbers.get(13, 63.5) / (2 * np.pi),
        controller="stock",
        published=PublishedSettings(numbers.get(37, 0), numbers.get(40, 0), numbers.get(41, 0)),
    )
    ours, outcome = lengths(machine_of({7: 2, **numbers}, sheet=SHEET), POINTS)
    assert (outcome == FOUND).all()
    return chain_lengths(stock, POINTS), ours


@pytest.mark.parametrize("feed", [1, 2])
@pytest.mark.parametrize(
    "numbers", [{}, {2: 3602.6, 3: 468.4, 8: 139.1}, {8: 100, 13: 63.6}, {8: 0, 3: 700}]
)
def test_geometry_is_that_of_the_published_firmware(numbers, feed):
    published, ours = both({**numbers, 38: feed})
    assert ours == pytest.approx(published, abs=0.0015)


@pytest.mark.parametrize("feed", [1, 2])
@pytest.mark.parametrize(("left", "right"), [(0.3, -0.1), (-0.25, 0.0), (0.0, 0.5)])
def test_tolerances_are_those_of_the_published_firmware(left, right, feed):
    published, ours = both({8: 139.1, 38: feed, 40: left, 41: right})
    assert ours == pytest.approx(published, abs=0.002)


@pytest.mark.parametrize("feed", [1, 2])
@pytest.mark.parametrize("correction", [8.2, 33])
@pytest.mark.parametrize(
    "numbers", [{8: 139.1}, {8: 100}, {8: 250}, {2: 3602.6, 3: 468.4, 8: 139.1}, {46: 60, 8: 139.1}]
)
def test_sag_is_that_of_the_published_firmware(numbers, correction, feed):
    flat, _ = both({**numbers, 38: feed})
    published, ours = both({**numbers, 37: correction, 38: feed})
    most = (published - flat).max()
    # A 250th of the most sag, which with the published 33 is 24 mm in the lower corners.
    assert abs(ours - published).max() < max(0.004 * most, 0.003)


def test_positive_tolerance_means_a_longer_chain():
    """As in the lab: fewer links reach the same distance."""
    published = replace(BELIEVED, controller="stock", published=PublishedSettings(10, 0.2, 0.1))
    lab = published.as_plumb_model()
    board = machine_of({8: 139.1, 37: 10, 40: 0.2, 41: 0.1}, sheet=SHEET)
    for side in ("left", "right"):
        assert board.effect("chain_pitch", side) == pytest.approx(lab.effect("chain_pitch", side))
    sag = "chain_sag", "weight_ratio_squared"
    assert board.effect(*sag) == pytest.approx(lab.effect(*sag), rel=0.02)


@pytest.mark.parametrize(
    ("numbers", "twice"),
    [
        ({37: 8.2, 40: 0.1, 41: -0.1}, []),
        ({160: 8e-12, 180: 0.001, 181: 0.001}, []),
        ({37: 8.2, 160: 8e-12, 40: 0.1, 181: 0.001}, [(37, 160)]),
        ({40: 0.1, 180: 0.001, 41: -0.1, 181: -0.001}, [(40, 180), (41, 181)]),
        ({45: 5e-6, 170: 5e-6}, []),
    ],
)
def test_a_correction_that_two_settings_carry_is_named(numbers, twice):
    assert _core.carried_twice({7: 2, **numbers}) == twice
    assert _core.carried_twice({7: 1, **numbers}) == []


@pytest.mark.parametrize("number", [14, 300, -1])
def test_a_number_that_is_no_setting_is_refused(number):
    with pytest.raises(ValueError, match=rf"\${number} is no setting"):
        machine_of({number: 1}, sheet=SHEET)
