"""Other calibrations, as docs/compare.md has them: each cures a machine of its formula."""

import numpy as np
import other_calibrations as others
import pytest
from plumb.bench.report import shape_of, sheet
from real_data_page import HOLES, real_set

FRAME_OFF = {"motor_gap": 2982.0, "motor_height": 1069.0}
WRONG = {"motor_height": 1069.0, "rotation_radius": 140.4, "chain_sag_correction": 12.0}
TOO_LONG = {**FRAME_OFF, "left_tolerance": 0.1, "right_tolerance": 0.2}


class Machine:
    """A machine whose sled hangs where a published formula says."""

    def __init__(self, settings):
        self.settings = settings

    def sleds(self, chains, **_):
        return others.places_by(self.settings, chains)

    read = on_sheet = sleds


@pytest.mark.parametrize(
    ("calibrate", "truth", "left"),
    [
        (others.triangular, others.changed(others.STOCK, WRONG), 0.02),
        (others.holey, others.changed(others.HOLEY, TOO_LONG), 0.02),
        (others.by_script, others.changed(others.STOCK, {**WRONG, **FRAME_OFF}), 0.02),
        (others.camera_curve, others.changed(others.STOCK, FRAME_OFF), 0.3),
        (others.camera_table, others.changed(others.STOCK, FRAME_OFF), 0.1),
    ],
)
def test_each_cures_the_machine_that_it_was_made_for(calibrate, truth, left, monkeypatch):
    monkeypatch.setattr(others, "TAPE", 0.0)
    monkeypatch.setattr(others, "CAMERA", 0.0)
    machine, source = Machine(truth), np.random.default_rng(1)
    before = others.as_bought(machine, source)(sheet())
    assert shape_of(machine.sleds(before)) > 0.7
    assert shape_of(machine.sleds(calibrate(machine, source)(sheet()))) < left


def test_a_reading_that_is_left_out_is_predicted_worse_than_one_that_was_fitted():
    name, as_set, other, theirs, ours = others.on_real_set(real_set(HOLES[2]))
    assert (name, as_set, other) == (HOLES[2], "2.75", "holey")
    for cell in (theirs, ours):
        fitted, left_out = map(float, cell.split(" / "))
        assert fitted < left_out < float(as_set)
