"""Options take a length in inches as they take it in mm."""

import argparse

import pytest
from plumb.cli.arguments import length, place
from plumb.cli.grid import add_arguments
from plumb.cli.grid import grid_of as planned
from plumb.cli.recover import touch


def grid_of(*words):
    """The grid of these options."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return planned(parser.parse_args(words))


def test_a_grid_is_the_same_in_inches():
    said = grid_of("--margin=5in", '--depth=1/8"', "--safe-height=1/4in", "--feed", "500")
    assert said == grid_of("--margin=127", "--depth=3.175", "--safe-height=6.35", "--feed=500")
    places = grid_of("--places=-30-1/2in,4in 0,100").places
    assert places == ((pytest.approx(-774.7), pytest.approx(101.6)), (0.0, 100.0))


def test_places_and_lengths_of_a_command_are_the_same_in_inches():
    assert place("4in,-2 1/2in") == pytest.approx((101.6, -63.5))
    assert length('1/32"') == pytest.approx(0.79375)
    hole, shown = touch("-36in,10in:-35 7/8in,254")
    assert hole == pytest.approx((-914.4, 254)) and shown == pytest.approx((-911.225, 254))
