"""compliance: how far the sled gives way, against the judge's exact statics."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.model.predict import compliance, values_of
from synthetic import BELIEVED

CHAIN_WEIGHT = 0.00137293
COMPLIANCE = 5.17e-6

# What the judge in tools/judge finds for a push of 0.05 N either way with the chains held, on
# chains of 0.14 kg/m and 5.17e-6 strain per newton: [mm/N] xx, xy = yx, yy.
DEFAULT = {
    (0, 550): (0.004285, 0.0, 0.033228),
    (0, 0): (0.007473, 0.0, 0.014069),
    (0, -550): (0.014381, 0.0, 0.011898),
    (1150, 550): (0.023864, -0.014313, 0.012059),
    (1150, 0): (0.122179, -0.035402, 0.015820),
    (1150, -550): (0.383536, -0.073312, 0.022168),
    (1200, -600): (0.685886, -0.109849, 0.025864),
    (-700, -300): (0.023625, 0.008651, 0.012389),
}
# With mounts that give 0.007 mm/N inward and 0.02 mm/N down.
FLEXIBLE = {
    (0, 550): (0.009054, 0.0, 0.070131),
    (1150, 550): (0.030581, -0.014482, 0.032360),
    (1150, -550): (0.399591, -0.065752, 0.038704),
    (-700, -300): (0.036479, 0.005626, 0.027049),
}
SOFT = {"inward": 0.007, "downward": 0.02}


def machine(weight=97.9, **changes):
    matrix = {
        "chain_sag": {"weight_ratio_squared": (CHAIN_WEIGHT / weight) ** 2 / 24},
        "chain_stretch": {"compliance": COMPLIANCE},
    } | changes.pop("effects", {})
    return replace(BELIEVED, sled_weight=weight, effects=matrix, **changes)


def giving(settings, points):
    over_top, places = settings.feed == "top", np.array(points, dtype=float)
    return compliance(values_of(settings), over_top=over_top, points=places)


@pytest.mark.parametrize(
    ("settings", "judged"),
    [(machine(), DEFAULT), (machine(effects={"frame_flex": SOFT}), FLEXIBLE)],
    ids=["default", "flexible"],
)
def test_give_agrees_with_the_judge_within_a_percent(settings, judged):
    compliances = giving(settings, list(judged))
    for matrix, (xx, xy, yy) in zip(compliances, judged.values(), strict=True):
        expected = np.array([[xx, xy], [xy, yy]])
        assert matrix == pytest.approx(expected, abs=0.01 * np.abs(expected).max())


def test_there_is_no_give_where_no_sled_can_hang():
    compliances = giving(machine(), [(0, 3000), (0, 0)])
    assert not compliances[0].any() and compliances[1].any()
