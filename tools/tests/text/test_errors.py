"""The error for files."""

import pytest
from plumb.text.errors import InputError, naming


def test_one_line_with_file_place_problem_and_remedy():
    error = InputError("a.csv", "is\nbroken", place="line 3", remedy="mend it")
    assert str(error) == "a.csv, line 3: is broken; mend it"
    assert str(InputError("a.csv", "is empty")) == "a.csv: is empty"
    assert str(InputError("no sled hangs there")) == "no sled hangs there"


def test_bytes_that_cannot_be_printed_are_written_out():
    str(InputError("a\udcfc.ini", "is empty")).encode("utf-8")


def test_naming_turns_value_errors_only():
    with pytest.raises(InputError, match=r"a\.csv, line 3: wrong"), naming("a.csv", "line 3"):
        raise ValueError("wrong")
    with pytest.raises(KeyError), naming("a.csv", "line 3"):
        raise KeyError("a bug stays a bug")
