"""palette: words and signs of the report stand out, WCAG AA, on light and on dark paper."""

import numpy as np
import pytest
from plumb.report.maps import COLOURS


def luminance(colour):
    parts = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(first, second):
    high, low = sorted((luminance(first), luminance(second)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("scheme", [0, 1])
def test_words_and_signs_stand_out_on_light_and_on_dark(scheme):
    colours = {name: both[scheme] for name, both in COLOURS.items()}
    for ground in ("paper", "panel"):
        for name in ("ink", "soft", "alarm", "good", "first", "third"):
            assert contrast(colours[name], colours[ground]) >= 4.5, (name, ground)
    for name in ("ink", "bad", "good", "edge"):
        assert contrast(colours[name], colours["wood"]) >= 3, name
    for name in ("first", "second", "third", "ink"):
        assert contrast(colours[name], colours["band"]) >= 3, name
