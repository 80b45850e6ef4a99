"""sheet_geometry: repeats are one mark, nothing leaves the picture, and no word covers another."""

import numpy as np
import pytest
from plumb.pictures.scale import HEAD, Panel, View, exaggeration, round_down, spots_of, view_of
from plumb.pictures.sheet import label_boxes

SHEET = (2438.4, 1219.2)


def grid_panel(columns, rows, error, names=()):
    x, y = np.meshgrid(np.linspace(-1119, 1119, columns), np.linspace(-509, 509, rows))
    places = np.column_stack([x.ravel(), y.ravel()])
    return Panel("", places, np.array([error(*place) for place in places]), names=names)


def outward(x, y):
    return (x / 100, y / 50)


def upward(x, y):
    return (0.2, 12.0)


def test_repeats_are_their_mean_with_their_spread():
    places = np.array([[0.0, 0.0], [500.0, 0.0], [0.0, -20.0], [524.0, 0.0]])
    errors = np.array([[1.0, 2.0], [3.0, 0.0], [3.0, 2.0], [3.0, 4.0]])
    spots = spots_of(Panel("", places, errors, names=("1", "2", "1", "3")))
    assert spots.names == ("1", "2")
    assert spots.places.tolist() == [[0.0, -10.0], [512.0, 0.0]]
    assert spots.errors.tolist() == [[2.0, 2.0], [3.0, 2.0]]
    assert spots.spreads.tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("apart", "names", "marks"),
    [
        (24.0, ("1", "2"), 1),
        (26.0, ("1", "2"), 2),
        (59.0, ("1", "1"), 1),
        (61.0, ("1", "1"), 2),
        (26.0, (), 2),
    ],
)
def test_marks_far_apart_stay_themselves(apart, names, marks):
    places = np.array([[0.0, 0.0], [apart, 0.0]])
    assert len(spots_of(Panel("", places, 0 * places, names=names))) == marks


def test_a_row_of_near_marks_is_not_one_long_mark():
    places = np.array([[20.0 * i, 0.0] for i in range(6)])
    assert len(spots_of(Panel("", places, 0 * places))) == 3


@pytest.mark.parametrize("count", [(3, 3), (5, 5), (40, 25)])
@pytest.mark.parametrize("error", [outward, upward])
@pytest.mark.parametrize("size", [0.02, 1.0, 20.0])
def test_no_arrow_and_no_mark_is_cut_off(count, error, size):
    spots = spots_of(grid_panel(*count, lambda x, y: np.multiply(size, error(x, y))))
    factor = exaggeration([spots], SHEET)
    view = view_of([spots], SHEET, factor)
    for ends in (spots.places, spots.tips(factor)):
        assert view.holds(ends, 0.99 * HEAD)
    if factor > 1:
        assert view.width <= 1.1 * SHEET[0] + 1 and view.height <= 1.6 * SHEET[1] + 1


def test_a_view_leaves_room_for_the_spread():
    panel = Panel("", np.array([[1300.0, 0.0]] * 2), np.array([[1.0, -3.0], [1.0, 3.0]]))
    assert view_of([spots_of(panel)], SHEET, 30.0).right == 1300 + 30 + 90 + HEAD


def test_arrows_that_would_leave_the_picture_are_drawn_shorter():
    inside, outside = (
        spots_of(Panel("", np.array([[x, 0.0]]), np.array([[10.0, 0.0]]))) for x in (0.0, 1100.0)
    )
    assert exaggeration([inside], SHEET) == 30
    assert exaggeration([outside], SHEET) == 20
    assert exaggeration([inside, outside], SHEET) == 20


def test_arrows_of_many_marks_do_not_reach_far_past_their_neighbours():
    spots = spots_of(grid_panel(40, 25, upward))
    assert exaggeration([spots], SHEET) * spots.longest < 1.5 * 55


@pytest.mark.parametrize("largest", [0.2, 1.0, 15.0, 80.0])
def test_the_longest_arrow_is_long_but_stays_near_the_sheet(largest):
    spots = spots_of(Panel("", np.zeros((1, 2)), np.array([[0.0, largest]])))
    assert 0.15 < exaggeration([spots], SHEET) * largest / SHEET[1] < 0.4


@pytest.mark.parametrize(
    ("value", "rounded"), [(1.0, 1), (9.99, 5), (0.034, 0.03), (2.4, 2), (1200, 1000)]
)
def test_factors_are_round(value, rounded):
    assert round_down(value) == pytest.approx(rounded)


@pytest.mark.parametrize("error", [outward, upward, lambda x, y: (0.0, 0.0)])
def test_words_keep_clear_of_each_other_of_arrows_and_of_the_edge(error):
    spots = spots_of(grid_panel(5, 5, error))
    factor = exaggeration([spots], SHEET)
    view = view_of([spots], SHEET, factor)
    words = ["12.5"] * len(spots)
    boxes = label_boxes(spots, words, factor=factor, view=view, size=52, gap=35)
    assert len(boxes) == 25
    lows, highs = boxes[:, :2], boxes[:, 2:]
    assert view.holds(np.vstack([lows, highs]))
    for i in range(25):
        over = ((lows[i] < highs) & (highs[i] > lows)).all(axis=1)
        assert over.sum() == 1
        near = np.hypot(*((lows[i] + highs[i]) / 2 - spots.places[i])) < 200
        assert near
    shares = np.linspace(0, 1, 24)[:, None, None]
    points = (spots.places + shares * factor * spots.errors).reshape(-1, 2)
    covered = [
        ((points > low) & (points < high)).all(axis=1).any()
        for low, high in zip(lows, highs, strict=True)
    ]
    assert not any(covered)


def test_a_word_at_an_edge_goes_inwards():
    spots = spots_of(Panel("", np.array([[90.0, 90.0]]), np.array([[-1.0, -1.0]])))
    view = View(-100, 100, -100, 100)
    (box,) = label_boxes(spots, ["wide"], factor=1, view=view, size=12, gap=8)
    assert view.holds(box.reshape(2, 2))
