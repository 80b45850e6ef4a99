"""Values that people type: numbers, fractions, inches, and hints for decimal commas."""

import pytest
from plumb.text.values import (
    INCH,
    MM,
    length,
    length_in,
    number,
    number_in,
    pair,
    point,
    typed_length,
)


@pytest.mark.parametrize(
    ("text", "value"),
    [("12", 12.0), (" -3.5 ", -3.5), (".28", 0.28), ("7560.", 7560.0), ("+8.2e-12", 8.2e-12)],
)
def test_number_in_reads_what_programs_write(text, value):
    assert number_in(text) == value


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("", "missing"),
        ("  ", "missing"),
        ("abc", "not a number"),
        ("nan", "usable"),
        ("-inf", "usable"),
        ("1e999", "usable"),
        ("12,5", "decimal comma"),
        ("1_000", "not a number"),
        ("12 mm", "not a number"),
        ("0x10", "not a number"),
        ("\u0661", "not a number"),
    ],
)
def test_number_in_refuses_everything_else(text, hint):
    with pytest.raises(ValueError, match=hint):
        number_in(text)


@pytest.mark.parametrize("value", ["1", True, None, [1], float("nan"), float("inf"), 10**400])
def test_number_refuses_everything_else(value):
    with pytest.raises(ValueError):
        number(value)


@pytest.mark.parametrize("value", [[1], [1, 2, 3], "12", 5, [1, "2"]])
def test_pair_needs_two_numbers(value):
    with pytest.raises(ValueError):
        pair(value)


def test_a_number_shown_as_zero_has_no_sign():
    assert MM.signed(-1e-12) == MM.signed(1e-12) == "+0.00" and MM.bare(-0.004) == "0.00"
    assert MM.signed(-0.02) == "-0.02" and MM.bare(-0.02) == "-0.02"


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
