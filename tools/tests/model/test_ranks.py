"""The order of computed numbers: what differs by rounding alone ties, and keeps its place."""

import re
from pathlib import Path

import numpy as np
import plumb
import pytest
from plumb.model.plain import TIE, ascending, greatest, least


def rounded_otherwise(numbers, seed):
    """The numbers as another processor may round them."""
    return numbers * (1 + 1e-12 * np.random.default_rng(seed).standard_normal(len(numbers)))


@pytest.mark.parametrize("seed", range(5))
def test_rounding_changes_no_order(seed):
    numbers = np.array([5.0, 3.0, 5.0, -2000.0, 3.0, 1e-15, 0.0, -1e-14, np.inf, 3.0])
    assert ascending(rounded_otherwise(numbers, seed)).tolist() == [3, 5, 6, 7, 1, 4, 9, 0, 2, 8]
    assert least(rounded_otherwise(numbers[:3], seed)) == 1
    assert greatest(rounded_otherwise(numbers[:3], seed)) == 0


def test_values_that_differ_are_in_order():
    assert ascending([2.0 + 2 * TIE, 2.0 - 2 * TIE, 2.0]).tolist() == [1, 2, 0]
    assert ascending([1e6, 1e6 - 1, 1e6 - 0.05]).tolist() == [1, 0, 2]  # a share of large numbers
    assert ascending([0.0, -0.5 * TIE, -5 * TIE]).tolist() == [2, 0, 1]
    assert ascending([np.inf, 1e300, -np.inf, np.inf]).tolist() == [2, 1, 0, 3]
    assert ascending([]).tolist() == []


def test_nothing_that_users_get_is_ranked_by_the_last_bit():
    """These alone may: they rank yes and no, whole numbers, or places that nobody is shown."""
    allowed = {
        "model/plain.py",
        "diagnosis/every_machine.py",
        "diagnosis/evidence.py",  # the order in which signs are conditioned on, which is not shown
        "job/check.py",
        "job/fixes.py",  # the first of yes and no
        "job/wood.py",  # the first of yes and no
    }
    root, ranks = Path(plumb.__file__).parent, re.compile(r"arg(?:min|max|sort)\(")
    users = [path for path in root.rglob("*.py") if path.parent.name not in ("bench", "vm")]
    ranking = [
        path.relative_to(root).as_posix() for path in users if ranks.search(path.read_text())
    ]
    assert {*ranking} <= allowed and "model/plain.py" in ranking
