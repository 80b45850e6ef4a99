"""Lengths as people type them: fractions, inches, and hints for decimal commas."""

import pytest
from plumb.text.values import INCH, length, length_in, point, typed_length


@pytest.mark.parametrize(
    ("text", "inches"),
    [
        ("47 7/8", 47.875),
        ("47-7/8", 47.875),
        ("7/8", 0.875),
        ("-1 1/2", -1.5),
        ("- 1/2", None),
        ("+3", 3.0),
        ("12.5", 12.5),
        ('47 7/8"', 47.875),
        ("47 7/8 in", 47.875),
        (" 3 / 4 ", 0.75),
        ("1/0", None),
        ("47 7", None),
        ("7/8/2", None),
        ("", None),
        ("12,5", None),
    ],
)
def test_inches_may_be_fractions(text, inches):
    if inches is None:
        with pytest.raises(ValueError, match=r"zero|not a number|missing|decimal comma"):
            length_in(text, unit=INCH)
    else:
        assert length_in(text, unit=INCH) == pytest.approx(25.4 * inches)


def test_a_toml_value_is_a_number_or_a_fraction_in_quotes():
    assert length(2) == 2.0 and length("1 1/4", unit=INCH) == pytest.approx(31.75)
    with pytest.raises(ValueError, match="without quotes"):
        length("12", unit=INCH)
    with pytest.raises(ValueError, match="without quotes"):
        length(True)


def test_a_point_with_decimal_commas_is_explained():
    assert point(["1/2", 3], unit=INCH) == pytest.approx((12.7, 76.2))
    for commas in ([12, 5, 300], [12, 5, 300, 5]):
        with pytest.raises(ValueError, match=r"a comma a decimal point\? Write \[12.5, 3\]"):
            point(commas)
    for wrong in ([1], "1, 2", [1, 2, 3, 4, 5]):
        with pytest.raises(ValueError, match=r"two numbers are needed, as \[x, y\]"):
            point(wrong)


@pytest.mark.parametrize(
    ("typed", "mm"),
    [
        ("120", 120.0),
        ("-7.5 mm", -7.5),
        ("5in", 127.0),
        ('3/4"', 19.05),
        ("4-3/4in", 120.65),
        ("-1 1/2 inch", -38.1),
        ("2 inches", 50.8),
    ],
)
def test_an_option_takes_a_length_with_its_unit(typed, mm):
    assert typed_length(typed) == pytest.approx(mm)


@pytest.mark.parametrize("typed", ["", "in", "3/4", "3/4mm", "1/0in", "4ft", "nan", "inf in"])
def test_an_option_takes_no_other_length(typed):
    with pytest.raises(ValueError):
        typed_length(typed)
