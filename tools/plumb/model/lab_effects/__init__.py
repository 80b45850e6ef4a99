"""Lab effects: they act on what is measured and never on what is sent to the machine.

To add an effect, write its module in this folder, import it here and give it a line.
"""

from plumb.model.lab_effects import sheet_skew, sled_friction, tape_scale
from plumb.model.lab_effects.lab_effect import LabEffect

# From the sled over the sheet to the tape: where the sled stops, what the edges say of it, and
# what the tape reads.
LAB_EFFECTS: tuple[LabEffect, ...] = (
    sled_friction.EFFECT,
    sheet_skew.EFFECT,
    tape_scale.EFFECT,
)
