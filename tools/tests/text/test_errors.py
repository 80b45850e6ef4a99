"""The error for files."""

from plumb.text.errors import InputError


def test_one_line_with_file_place_problem_and_remedy():
    error = InputError("a.csv", "is\nbroken", place="line 3", remedy="mend it")
    assert str(error) == "a.csv, line 3: is broken; mend it"
    assert str(InputError("a.csv", "is empty")) == "a.csv: is empty"
    assert str(InputError("no sled hangs there")) == "no sled hangs there"
