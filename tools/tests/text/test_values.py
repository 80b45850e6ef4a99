"""Single checks on values that people type."""

import pytest
from plumb.text.values import MM, number, number_in, pair


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
