"""Numbers that are measured by hand: what is read, and how the number follows.

An effect brings its readings along; those of the frame are here. The steps and the accuracies are
those of plumb next.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from plumb.model.catalogue import LAB_EFFECTS
from plumb.model.predict import RuleReading, library
from plumb.settings import GRAVITY, MachineSettings
from plumb.text.values import INCH, INCHES, Unit, length_in, number_in

WEIGHT = "sled_weight"
WEIGHED = 0.2  # [kg] to which a sled is weighed


def readings(settings: MachineSettings, sled_weight: float) -> Mapping[str, RuleReading]:
    """Return the readings by the names of numbers, for this sheet and this weight [N]."""
    edge = settings.sheet_height / 2
    height = "how far the motors are above the sheet's top edge, the mean of both"
    read = {
        "motor_gap": RuleReading("the gap between the motors", 1.0),
        "motor_height": RuleReading(height, 1.0, zero=-edge),
        "rotation_radius": RuleReading("from the bit to the first link pin of a chain", 0.5),
        WEIGHT: RuleReading("the weight of the sled", WEIGHED, GRAVITY, "kg"),
    }
    for words in library():
        for parameter in words["parameters"]:
            if parameter["reading"]:
                reading = RuleReading(**parameter["reading"])
                factor = reading.factor * sled_weight ** words["weight_power"]
                read[f"{words['name']}.{parameter['name']}"] = replace(reading, factor=factor)
    for effect in LAB_EFFECTS:
        if effect.reading:
            read[effect.parameter] = effect.reading(*settings.sheet)
    return read


# A typed reading with the unit of its rule or scale.

VALUE = "VALUE"  # stands where the owner types his number
INCH_WORDS = ("inches", "inch", "in", '"')
UNITS = ("mm", *INCH_WORDS, "kg", "g", "degrees")


def to_fill_in(name: str, sigma: float, settings: MachineSettings, unit: Unit) -> str:
    """Return the words of --checked for a number that is measured next: `motor_gap=VALUE+-1mm`.

    sigma: of a number that is not read off a rule or scale [its unit].
    """
    reading = _reading_of(name, settings)
    if reading is None:
        return f"{name}={VALUE}+-{sigma:g}"
    if reading.unit == "mm" and unit == INCHES:
        return f"{name}={VALUE}+-{reading.usual / INCH:.1g}in"
    return f"{name}={VALUE}+-{reading.usual:g}{reading.unit}"


def what_to_type(names: Iterable[str], settings: MachineSettings, unit: Unit) -> str:
    """Return the word for VALUE, for people; "" for numbers that cannot be read."""
    read = [reading for name in names if (reading := _reading_of(name, settings))]
    if not read:
        return ""
    shown = "inches" if read[0].unit == "mm" and unit == INCHES else read[0].unit
    titles = "; then ".join(unit.reading(reading.title) for reading in read)
    return f"{VALUE}: {titles}, in {shown}."


def number_read(
    name: str, value: str, sigma: str, typed: str, settings: MachineSettings
) -> tuple[float, float]:
    """Return a number and its error [its unit] by what was read, in a unit of UNITS.

    Raises ValueError for text that is not a number, and for a unit that does not fit.
    """
    reading = _reading_of(name, settings)
    if reading is None:
        raise ValueError(f"this is not measured in {typed}: write the number without a unit")
    is_length = typed == "mm" or typed in INCH_WORDS
    if reading.unit != ("mm" if is_length else typed):
        raise ValueError(f"it is read in {reading.unit}, not in {typed}")
    if is_length:
        size = INCH if typed in INCH_WORDS else 1.0
        read, off = length_in(value, unit=size), length_in(sigma, unit=size)
    else:
        read, off = number_in(value), number_in(sigma)
    number, more, less = map(reading.value, (read, read + off, read - off))
    return number, max(abs(more - number), abs(number - less))


def _reading_of(name: str, settings: MachineSettings) -> RuleReading | None:
    return readings(settings, settings.sled_weight).get(name)
