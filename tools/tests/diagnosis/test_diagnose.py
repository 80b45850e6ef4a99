"""Diagnoses of boards that the judge cut: what is named and what is not, parts, limits."""

from dataclasses import replace

import numpy as np
import pytest
from boards import cut
from chain_views import chain_view
from hidden_boards import HIDDEN, board, size_for
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.diagnosis.diagnosis import hidden_share, room_for, sizes_of
from plumb.diagnosis.evidence import KNOWN, Noise
from plumb.diagnosis.expected_error import drawn_by, expected_error, model_by, rival_error
from plumb.diagnosis.explanation import Board, explain, gaussian_process_columns
from plumb.fit import compare
from plumb.fit.compare import places_over, plausible_range
from plumb.fit.fit import PRIORS, Checked, fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.hidden import MAKER, Hidden, plan
from plumb.marks.read import Distance, Measurements
from plumb.model.catalogue import effect_names
from plumb.model.predict import lengths, places
from plumb.text.errors import InputError
from plumb.words.decision import reason
from scipy import stats
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

WIDE, NINE = plan(5, 5), plan(3, 3)
# A tilt of both motors is a turned sheet, and chain zeros are a frame elsewhere: marks alone hardly
# feel them. Friction is felt in few places and has a separate test.
FELT = sorted(set(HIDDEN) - {"motor_level", "chain_zero", "sled_friction"})
HUGE = ("frame_lean", "sprocket_runout")  # need sizes that no real machine has to move marks so far


@pytest.fixture(scope="module")
def sizes():
    """Sizes that move the marks of 25 by 3 mm RMS, in typical sizes."""
    return {name: size_for(name, WIDE, 3.0) for name in FELT}


def explains(diagnosis, *effects):
    """Whether just these effects are one of the explanations."""
    return any(set(explanation.effects) == set(effects) for explanation in diagnosis.explanations)


def test_the_judge_and_the_laws_agree_where_nothing_is_hidden():
    diagnosis = diagnose(Inputs(MAKER, board({}, WIDE, seed=1, noise=0.0), sigma=0.02))
    assert diagnosis.verdict == "nothing_provable" and diagnosis.rms_before < 0.02


def test_a_hidden_effect_of_three_millimetres_is_found(sizes):
    diagnoses = {
        name: diagnose(Inputs(MAKER, board({name: sizes[name]}, WIDE, seed=100 * i)))
        for i, name in enumerate(FELT)
    }
    count = len(diagnoses)
    inside = sum(explains(diagnosis, name) for name, diagnosis in diagnoses.items())
    usual = {name: diagnosis for name, diagnosis in diagnoses.items() if name not in HUGE}
    first = sum(diagnosis.suspects[:1] == (name,) for name, diagnosis in usual.items())
    silent = sum(diagnosis.verdict == "nothing_provable" for diagnosis in diagnoses.values())
    assert silent == 0
    assert inside >= 0.88 * count
    assert first >= 0.88 * len(usual)
    assert np.mean([len(diagnosis.suspects) for diagnosis in usual.values()]) <= 2.0


def test_look_alikes_are_named_together():
    # A tape that reads long and chains that are long both draw marks farther apart.
    size = size_for("tape_scale", NINE, 2.0)
    several = 0
    for seed in range(1, 6):
        diagnosis = diagnose(Inputs(MAKER, board({"tape_scale": size}, NINE, seed=seed)))
        assert explains(diagnosis, "tape_scale")
        several += len(diagnosis.suspects) > 1
    assert several >= 2


def test_motors_out_of_level_are_not_told_from_a_turned_sheet():
    diagnosis = diagnose(Inputs(MAKER, board({"motor_level": 1.5}, WIDE, seed=2)))
    assert diagnosis.verdict == "nothing_provable"
    shares = {ranked.effect: ranked.hidden_share for ranked in diagnosis.ranking}
    assert shares["motor_level"] > 0.95
    room = next(hidden for hidden in diagnosis.could_hide if hidden.effect == "motor_level")
    assert room.mm > 2 and room.limits[0].largest >= 6.0


def test_friction_needs_approaches():
    layout = plan(5, 3)
    rubbing = board({"sled_friction": 1.0}, layout, seed=1, noise=0.2)
    diagnosis = diagnose(Inputs(MAKER, rubbing, sigma=0.3))
    assert diagnosis.suspects[:1] == ("sled_friction",)
    blind = diagnose(Inputs(MAKER, board({}, plan(5, 3, approached=False), seed=1)))
    room = next(hidden for hidden in blind.could_hide if hidden.effect == "sled_friction")
    assert room.mm is None


STATED = Noise(0.5, KNOWN, "stated")


def rows_of(*, noise=0.5, seed=1, columns=5, rows=3, true=TRUE):
    marks = marks_on(true, BELIEVED, grid(columns, rows), noise=noise, seed=seed)
    return observe(BELIEVED, Measurements(marks))


def board_of(**options):
    return Board.of(BELIEVED, rows_of(**options), sigma=0.5)


BENT = replace(BELIEVED, effects={"chain_plane": {"gap_squared": 60000.0}})  # beyond belief


@pytest.mark.parametrize(
    ("effects", "true", "believable"),
    [
        ((), TRUE, True),
        (("chain_pitch",), TRUE, True),
        (("chain_sag", "chain_stretch"), TRUE, True),
        (("tape_scale",), TRUE, True),
        (("chain_plane",), BENT, False),
    ],
)
def test_an_explanation_is_the_fit_of_plumb_add(effects, true, believable):
    rows = rows_of(true=true)
    ours = explain(Board.of(BELIEVED, rows, sigma=0.5), effects)
    theirs = fit(BELIEVED, rows, effects=effects, sigma=0.5)
    assert ours.settled and ours.rms == pytest.approx(theirs.rms, abs=1e-4)
    sizes = [size for name in effects for size in sizes_of(ours, name, STATED)]
    wanted = theirs.estimates[len(theirs.estimates) - len(sizes) :]
    for size, estimate in zip(sizes, wanted, strict=True):
        width = estimate.high - estimate.low
        assert size.value == pytest.approx(estimate.value, abs=1e-3 * width)
        assert size.high == pytest.approx(estimate.high, abs=1e-3 * width)
        # An interval ends where no machine can be, unless the size lies beyond.
        real = plausible_range(estimate.name)
        least = 0.0 if min(real.low, size.value) >= 0 else -np.inf
        assert size.low == pytest.approx(max(estimate.low, least), abs=1e-3 * width)
        assert size.plausible == real.holds(estimate.value)
        assert size.possible == real.is_near(estimate.low, estimate.high)
    assert believable == all(size.possible for size in sizes)


def test_the_frame_swallows_what_it_can():
    frame = explain(board_of(columns=5, rows=5))
    shares = {name: hidden_share(frame, name) for name in effect_names()}
    assert shares["sled_friction"] is None  # no mark has an approach
    assert shares["sprocket_runout"] < 0.2 < shares["motor_level"]
    assert shares["frame_flex"] > 0.8 and shares["chain_stretch"] > 0.5


def board_made_by(true, *, marks=None, **how):
    made = marks or marks_on(true, BELIEVED, grid(7, 5), **how)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(tuple(made))), sigma=0.5)


@pytest.fixture(scope="module")
def stretched():
    """A board of a machine with three effects, its frame fitted, and two of them with it."""
    board = board_made_by(TRUE, rotation=0.001, noise=0.2)
    frame = explain(board)
    return frame, explain(board, ("chain_pitch", "chain_stretch"), start=frame)


def test_the_suspects_share_and_the_rest_add_up_to_what_the_frame_leaves(stretched):
    frame, both = stretched
    rows = frame.board.rows
    added = drawn_by(frame, both, rows).chains
    assert np.abs(added).max() > 0.5
    alone, less = (
        chain_view(*problem.values(each.unknowns), rows, problem.settings).chains
        for each in (frame, both)
        for problem in (each.board.problem,)
    )
    assert alone == pytest.approx(added + less, abs=0.02)


def pulled(effect, sigmas):
    """The frame's explanation of marks that an effect of one parameter pulls by this many sigma."""
    rows = observe(BELIEVED, Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 4))))
    frame = explain(Board.of(BELIEVED, rows, sigma=0.5))
    (beyond,) = frame.beyond_fit([effect]).T
    size = np.linalg.norm(beyond)
    scale = frame.board.problem.scale[frame.board.columns([effect])[0]]
    rest = replace(frame, at=replace(frame.at, residual=sigmas * beyond / size))
    return rest, scale / size


@pytest.mark.parametrize("effect", ["sheet_skew", "tape_scale"])
def test_a_limit_reaches_as_far_below_zero_as_above(effect):
    # One-sided 95 % of what is measured as 4 sigma, whichever way it points.
    for sigmas in (4.0, -4.0):
        frame, sigma_of_size = pulled(effect, sigmas)
        (limit,) = room_for(effect, (frame,), STATED).limits
        assert limit.largest == pytest.approx((4 + stats.norm.isf(0.05)) * sigma_of_size, rel=0.01)


def test_the_limit_of_a_size_that_cannot_be_negative_is_its_upper_end():
    for sigmas, left in ((4.0, 4 + stats.norm.isf(0.05)), (-4.0, 0.0)):
        frame, sigma_of_size = pulled("chain_plane", sigmas)
        (limit,) = room_for("chain_plane", (frame,), STATED).limits
        assert limit.largest == pytest.approx(left * sigma_of_size, rel=0.01, abs=1e-12)


def test_repeats_do_not_count_as_further_marks():
    twice = marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5)
    marks = twice + marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=2)
    marks += marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=3)
    with pytest.raises(InputError, match="4 measured numbers"):
        diagnose(Inputs(BELIEVED, Measurements(marks, source="two marks")))


def test_a_distance_is_the_same_from_both_ends():
    spans = distances_between(marks_on(BELIEVED, BELIEVED, grid(3, 1), noise=0.5))
    back = tuple(Distance(span.between[::-1], span.length + 0.3) for span in spans.distances)
    with pytest.raises(InputError, match="3 measured numbers"):
        diagnose(Inputs(BELIEVED, replace(spans, distances=spans.distances + back)))


def test_three_marks_are_enough_to_begin_with():
    marks = marks_on(BELIEVED, BELIEVED, np.array([(-900.0, 400.0), (900.0, 400.0), (0.0, -400.0)]))
    assert diagnose(Inputs(BELIEVED, Measurements(marks))).verdict == "nothing_provable"


def open_of(layout, *, noise=0.5, seed=3, settings=MAKER):
    board = cut(Hidden(), layout, seed=seed, noise=noise, tape_sigma=noise, settings=settings)
    return diagnose(Inputs(settings, board.measurements)).left_open


@pytest.mark.parametrize(("grid", "is_much"), [((9, 1), True), ((2, 2), True), ((3, 2), False)])
def test_a_row_of_marks_leaves_too_much_open(grid, is_much):
    assert open_of(plan(*grid)).is_too_much is is_much


def test_distances_settle_the_shape_but_not_the_sheets_place():
    by_places, by_spans = (open_of(plan(3, 3, spans=spans)) for spans in (False, True))
    assert by_spans.now < by_places.now and not by_spans.is_too_much


def test_better_readings_and_more_of_them_leave_less():
    sizes = [open_of(plan(3, 3), noise=noise).now for noise in (1.0, 0.5, 0.2)]
    assert sizes == sorted(sizes, reverse=True) and sizes[0] > 1.5 * sizes[2]
    assert open_of(plan(5, 5)).now < open_of(plan(3, 3)).now
    # Read to a tenth of a millimetre, marks all over the sheet still cannot tell all effects apart.
    assert open_of(plan(5, 5), noise=0.1).now > 0.1


def test_before_any_mark_the_expected_error_is_the_normal_one():
    bare = replace(MAKER, effects={})
    normal = compare.expected_error(bare, PRIORS)
    before = open_of(plan(3, 3), settings=bare).before
    assert before == pytest.approx(normal.among_marks_mm, rel=0.1)


def test_no_command_fits_too_few_marks():
    marks = cut(Hidden(), plan(3, 1), seed=3, settings=MAKER).measurements
    result = decide(Inputs(MAKER, marks))
    assert result.addition is None and result.chosen == () and not result.done
    said = reason(result)
    assert "leave 1.2 mm open" in said and "2.5 mm by" in said


def test_a_number_that_is_known_leaves_less_open():
    marks = cut(Hidden(), plan(3, 1), seed=3, settings=MAKER).measurements
    inputs = Inputs(MAKER, marks)
    known = replace(inputs, priors={**PRIORS, "motor_gap": 0.1})
    assert diagnose(known).left_open.before < diagnose(inputs).left_open.before
    assert np.isfinite(diagnose(replace(inputs, priors={**PRIORS, "motor_gap": 0})).left_open.now)
    checks = [Checked(f"chain_pitch.{side}", 0.0, 1e-5) for side in ("left", "right")]
    checked = diagnose(replace(inputs, checked=checks)).left_open
    assert checked.before < 0.9 * diagnose(inputs).left_open.before
    assert checked.now < 0.95 * diagnose(inputs).left_open.now


SIGMA = 0.5


def noisy_board(seed, *, columns=5, rows=3, noise=SIGMA, sigma=SIGMA):
    marks = marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=noise, seed=seed)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=sigma)


def errors_with_the_sheet_laid_anew(spots, there):
    """How far places (n, 2) are from spots (n,) [mm], after the best shift and turn of them."""
    middle, centre = spots.mean(axis=0), there.mean(axis=0)
    left, _, right = np.linalg.svd((there - centre).T @ (spots - middle))
    return np.linalg.norm((there - centre) @ (left @ right) - (spots - middle), axis=1)


def test_the_error_of_a_fit_is_the_scatter_of_fits_to_noise():
    spots = places_over(BELIEVED.sheet)
    missed = []
    for seed in range(60):
        fitted = model_by(explain(noisy_board(seed)))
        # The true machine is BELIEVED: where it goes when the fitted machine aims at the spots.
        where, _ = places(BELIEVED, lengths(fitted, spots)[0])
        missed.append(errors_with_the_sheet_laid_anew(spots, where))
    scattered, said = np.sqrt(np.mean(np.square(missed))), expected_error(explain(noisy_board(1)))
    # The priors of the frame count as knowledge, though here the frame is exactly as stated.
    assert 0.6 * said < scattered < 1.25 * said


def test_rivals_count_by_their_share_as_far_as_they_lead_elsewhere():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.3)
    board = Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=SIGMA)
    frame = explain(board)
    used = explain(board, ("chain_pitch",), start=frame)
    rival = explain(board, ("chain_stretch",), start=frame)
    alone, half, same = (
        expected_error(used, given) for given in ((), [(rival, 0.5)], [(used, 0.5)])
    )
    assert same == pytest.approx(alone)
    spots = places_over(model_by(used).sheet)
    there = places(model_by(rival), lengths(model_by(used), spots)[0])[0]
    apart = errors_with_the_sheet_laid_anew(spots, there)
    assert half**2 - alone**2 == pytest.approx(0.5 * np.mean(apart**2), rel=1e-3)


# By how much, and where, the settings of rivals differ.


def explained(effects):
    """An explanation in which a machine has these sizes, in typical sizes; nothing else is off."""
    board = noisy_board(1)
    frame = explain(board)
    unknowns = np.zeros(len(frame.unknowns))
    for name, size in effects.items():
        unknowns[board.columns([name])] = size
    at = replace(frame.at, unknowns=unknowns)
    return replace(frame, effects=tuple(effects), at=at)


def test_rivals_differ_by_what_is_left_when_the_sheet_is_laid_anew():
    used, rival = explained({}), explained({"chain_pitch": np.array([2.0, 2.0])})
    difference = rival_error([used, rival], 0.0)
    model, other = model_by(used), model_by(rival)
    spots = places_over(model.sheet)
    there = places(other, lengths(model, spots)[0])[0]
    apart = errors_with_the_sheet_laid_anew(spots, there)
    cells = np.abs(spots) > np.array(model.sheet) / 6
    sides = [
        apart[(np.sign(spots[:, 0]) * cells[:, 0] == x) & (np.sign(spots[:, 1]) * cells[:, 1] == y)]
        for x in (-1, 0, 1)
        for y in (-1, 0, 1)
    ]
    assert difference.mm == pytest.approx(
        max(np.sqrt(np.mean(side**2)) for side in sides), rel=0.02
    )
    assert f"{difference.mm:.1f} mm" in difference.sentence
    assert difference.where in difference.sentence
    assert rival_error([used, rival], difference.mm * 1.01) is None
    assert rival_error([used, rival], difference.mm * 0.99) == difference


HALF = np.array([1100.0, 500.0])  # [mm] that the marks span


def columns_on(layout, width):
    """The targets of a plan, and what a field of this width moves there."""
    rows = observe(MAKER, cut(Hidden(), layout, seed=1).measurements)
    frame = explain(Board.of(MAKER, rows, sigma=0.5))
    (columns,) = gaussian_process_columns(frame, (width,), 1e-8)
    assert len(columns) == rows.count
    return layout.targets, columns


def alike(first, second, width):
    """How alike a field of this width moves two places."""
    return np.exp(-np.sum(((first - second) / HALF) ** 2) / (2 * width**2))


@pytest.mark.parametrize("width", [0.35, 1.4])
def test_marks_are_moved_the_more_alike_the_closer_they_are(width):
    targets, columns = columns_on(plan(3, 3), width)
    covariance = columns @ columns.T
    for i, j in ((0, 0), (0, 1), (0, 4), (2, 6)):
        wanted = alike(targets[i], targets[j], width)
        for axis in (0, 1):
            assert covariance[2 * i + axis, 2 * j + axis] == pytest.approx(wanted, abs=0.01)
        assert covariance[2 * i, 2 * j + 1] == pytest.approx(0.0, abs=1e-9)


def test_a_distance_grows_by_what_its_ends_move_apart():
    targets, columns = columns_on(plan(3, 3, spans=True), 0.7)
    # The first distance goes from the first mark to the second, to its right.
    apart = 2 - 2 * alike(targets[0], targets[1], 0.7)
    assert columns[0] @ columns[0] == pytest.approx(apart, abs=0.01)
