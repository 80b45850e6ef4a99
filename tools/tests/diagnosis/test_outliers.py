"""What a slip most likely was, in words; and the pieces that only slow boards would feel."""

from types import SimpleNamespace

import numpy as np
import pytest
from plumb.diagnosis.answer import verdict_sentence
from plumb.diagnosis.clean import Reading, Shift
from plumb.diagnosis.explanation import KNOWN, Board, explain, span
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.outliers import described
from plumb.diagnosis.sizes import sizes_of
from plumb.fit.observations import observe
from plumb.marks.read import Distance, Mark, Measurements
from synthetic import BELIEVED, SHEET, TRUE, grid, marks_on


def slip_of(read, expected, sigma=0.3):
    """The slip of a mark that was read here and expected there."""
    marks = Measurements((Mark("A", (0.0, 0.0), read),))
    offset = np.subtract(read, expected)
    return described(Shift(Reading(0, True), offset, np.full(2, sigma), 99.0), marks, SHEET)


def slip_of_distance(read, expected):
    """The slip of a distance."""
    ends = (Mark("A", (0.0, 0.0)), Mark("B", (900.0, 0.0)))
    marks = Measurements(ends, (Distance(("A", "B"), read),))
    offset = np.array([read - expected])
    return described(Shift(Reading(0, False), offset, np.array([0.3]), 99.0), marks, SHEET)


@pytest.mark.parametrize(
    ("read", "expected", "guess"),
    [
        ((412.0, 100.0), (421.0, 100.0), "412 written for 421?"),
        ((300.0, -200.0), (-200.0, 300.0), "x and y may be exchanged"),
        ((410.0, 100.0), (400.0, 100.0), "misread by 10 mm in x?"),
        ((400.0, 125.4), (400.0, 100.0), "misread by an inch in y?"),
        ((407.3, 107.3), (400.0, 100.0), ""),
    ],
)
def test_usual_mistakes_are_guessed(read, expected, guess):
    slip = slip_of(read, expected)
    assert slip.guess == guess and slip.expected == pytest.approx(expected)
    assert slip.length == pytest.approx(np.hypot(*np.subtract(read, expected)))


def test_digits_on_both_sides_of_the_point_are_neighbours():
    assert slip_of((412.3, 100.0), (413.2, 100.0), sigma=0.05).guess == "412.3 written for 413.2?"
    # With a digit between them they are not.
    assert slip_of((214.0, 100.0), (412.0, 100.0)).guess == ""


def test_five_deviations_are_surely_wrong():
    assert slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 5.5).guess == "412 written for 421?"
    assert "written" not in slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 4.5).guess


def test_a_distance_has_no_axis():
    slip = slip_of_distance(925.4, 900.0)
    assert slip.guess == "misread by an inch?" and slip.way == "too long"
    assert slip_of_distance(890.0, 900.0).way == "too short"


@pytest.mark.parametrize(
    ("count", "words"), [(1, "One reading disagrees"), (2, "Some readings disagree")]
)
def test_the_sentence_counts_the_slips(count, words):
    slips = [SimpleNamespace(name=name, against="every explanation") for name in "AB"[:count]]
    sentence = verdict_sentence(SimpleNamespace(verdict="slip", outliers=slips))
    assert sentence.startswith(words) and "A" in sentence


def explained(*effects, possible=True, rms_after=0.5, share=None):
    return SimpleNamespace(effects=effects, possible=possible, rms_after=rms_after, share=share)


@pytest.mark.parametrize(
    ("verdict", "explanations", "words"),
    [
        ("nothing_provable", (), "Nothing is provable: the fitted frame leaves 2.00 mm RMS"),
        ("one_suspect", (explained("sag"),), "One suspect: sag. The error falls from 2.00 to 0.50"),
        ("one_suspect", (explained("sag", "lean"),), "Several effects at once: sag and lean."),
        ("one_suspect", (explained("sag", possible=False),), "no real machine has"),
        ("cannot_tell", (explained("sag", possible=False),), "no real machine has"),
        ("cannot_tell", (explained("a"), explained("b")), "cannot tell which: a; or b."),
        ("cannot_tell", (explained("a"),) * 8, "a; a; a; a; a; a; a; or a."),
        ("cannot_tell", (explained("a"),) * 10, "a; a; a; a; a; a; a; a; or 2 more."),
        (
            "cannot_tell",
            (explained("a", "b", share=0.8), explained("c", share=0.2)),
            "Most likely: a and b (odds 4 to 1); next, c (1 to 4).",
        ),
        ("cannot_tell", tuple(explained("a", share=s) for s in (0.6, 0.3, 0.1)), ", and 1 more."),
        ("not_in_library", (), "alone or up to three together (unless more than three"),
        ("not_in_library", (explained("a"),), "A could be it, but here one effect explains 40 %"),
        ("not_in_library", (explained("a", "b"),), "here 2 effects explain 40 %"),
    ],
)
def test_each_verdict_has_its_sentence(verdict, explanations, words):
    diagnosis = SimpleNamespace(
        verdict=verdict, explanations=explanations, rms_before=2.0, chance=0.4, library_fits=True
    )
    assert words in verdict_sentence(diagnosis)


def test_a_span_sees_short_columns_and_drops_what_repeats():
    assert span(np.diag([1.0, 1e-8])).shape == (2, 2)
    assert span(np.array([[1.0, 2.0], [1.0, 2.0]])).shape == (2, 1)
    tiny = np.array([[1e-9], [0.0]])
    assert span(tiny).shape == (2, 1) and span(tiny, against=np.eye(2)[:, :1]).shape == (2, 0)


def test_sizes_come_with_names_units_and_intervals():
    rows = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.2, seed=3)))
    fitted = explain(Board.of(BELIEVED, rows, sigma=0.2), ("chain_pitch",))
    sizes = sizes_of(fitted, "chain_pitch", Noise(0.2, KNOWN, "stated"))
    assert [size.name for size in sizes] == ["left", "right"]
    column = fitted.board.columns(["chain_pitch"])[0]
    curvature = fitted.slopes[:, fitted.free].T @ fitted.slopes[:, fitted.free]
    deviation = np.sqrt(np.linalg.inv(curvature)[len(fitted.board.frame), len(fitted.board.frame)])
    half = 1.96 * deviation * fitted.board.problem.scale[column]
    assert sizes[0].high - sizes[0].value == pytest.approx(half, rel=1e-6)
    assert sizes[0].value - sizes[0].low == pytest.approx(half, rel=1e-6)
