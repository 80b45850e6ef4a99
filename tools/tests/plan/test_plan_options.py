"""Options and proposals: marks, weights, minutes, form, words; what a plan promises."""

import dataclasses
from dataclasses import replace
from math import sqrt
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.diagnosis.diagnosis import NOTHING
from plumb.diagnosis.evidence import (
    LinearBoard,
    Metric,
    Noises,
    accounts_of,
    asked_for,
    clean_of,
    fitted,
)
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.posterior import listing, posterior_of
from plumb.diagnosis.priors import turned
from plumb.diagnosis.readings import Outlier
from plumb.fit.fit import Checked
from plumb.fit.inputs import Stated
from plumb.fit.observations import model_and_observations
from plumb.marks.form import read_form
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import EVERY_MACHINE
from plumb.model.plain import noun_of
from plumb.plan.case import (
    Case,
    Hypothesis,
    Outlooks,
    PlannedCheck,
    PlannedMeasurement,
    _is_right,
    _shown,
    hidden_hypotheses,
)
from plumb.plan.planned_visits import (
    BELOW,
    joined,
    marks_file,
    nowhere,
    proof_places,
    refuse_way,
    sent,
    usable,
)
from plumb.plan.planned_visits import grid as places_over
from plumb.plan.preview import POWER, preview
from plumb.plan.proposal import (
    BESIDE,
    CONFIRM,
    EXPLORE,
    FEW,
    FIND,
    FRAME_CHECKS,
    HANGING,
    MARK,
    READ_AGAIN,
    READING,
    REREAD,
    ROOM_FOR_A_SECOND,
    ROUND,
    SETTLE,
    SHARPER,
    SURE,
    Option,
    RoomThen,
    checks_for,
    effect_checks,
    for_slips,
    many_marks,
    near_the_worst,
    options,
    spots,
    worth,
)
from plumb.plan.proposal import READ_AGAIN as AGAIN
from plumb.settings import GRAVITY
from plumb.text.errors import InputError
from plumb.text.values import MM
from plumb.words.proposals import ProposalInWords, other_ways, percent
from synthetic import BELIEVED, EFFECTS, distances_between, grid, marks_on, read_elsewhere

SIGMA = 0.5
# With sag and stretch: the chains give, so friction is felt.
MACHINE = replace(BELIEVED, effects=EFFECTS)


def nine(**how):
    """Nine marks that lie where the machine sends them but for noise, come to from below."""
    marks = marks_on(MACHINE, MACHINE, grid(3, 3), noise=SIGMA, **how)
    return Measurements(tuple(replace(mark, approach=(0.0, 1.0)) for mark in marks))


def case_on(measurements, *effects, verdict="cannot_tell", checked=(), machine=MACHINE):
    """The case of marks of which these effects are the suspects, as likely each."""
    model, rows = model_and_observations(machine, measurements)
    board = Board.of(model, rows, sigma=SIGMA, checked=checked)
    posterior = posterior_of(board, Stated(SIGMA, is_final=True))
    frame = posterior.frame
    parts = [(name, explain(board, (name,), start=frame)) for name in effects]
    fitted = tuple(Hypothesis((name,), each, 1 / len(effects)) for name, each in parts)
    return Case(
        settings=machine,
        controller="plumb",
        verdict=verdict if effects else "nothing_provable",
        posterior=posterior,
        frame=frame,
        best=fitted[0].at if fitted else frame,
        hypotheses=fitted or hidden_hypotheses(frame),
    )


USUAL = MACHINE.sled_weight


@pytest.fixture(scope="module")
def clean():
    return case_on(nine(), "sled_friction", "chain_pitch")


@pytest.fixture(scope="module")
def by_kind(clean):
    kinds = {}
    for option in options(clean):
        kinds.setdefault(option.kind, []).append(option)
    return kinds


def test_minutes_count_the_round_its_marks_and_the_preparation(by_kind):
    (marks,), (again,) = (by_kind[kind] for kind in ("marks", "repeats"))
    assert marks.minutes == ROUND + FEW * MARK
    assert again.minutes == ROUND + READ_AGAIN * 9 * READING
    for heavier in by_kind["weight"]:
        assert heavier.minutes == ROUND + len(heavier.visits) * MARK + HANGING
    # Reading again is quicker than cutting.
    assert READING < MARK < ROUND < HANGING


def test_extra_weight_counts_for_its_marks(by_kind):
    hung = [(option.visits.sled_weights.max() - USUAL) / GRAVITY for option in by_kind["weight"]]
    # Four marks with each weight that does not double the sled, and all nine with 5 kg.
    assert hung == pytest.approx([2.5, 5.0, 5.0, 10.0])
    for option, kilograms in zip(by_kind["weight"], hung, strict=True):
        assert np.ptp(option.visits.sled_weights) == 0
        assert f"Hang {kilograms:g} kg more" in option.do[0]
        assert option.title.endswith(f"with {kilograms:g} kg more")
    near = by_kind["weight"][2].visits
    gaps = np.abs(near.targets - grid(3, 3))
    assert gaps == pytest.approx(np.full((9, 2), ROOM_FOR_A_SECOND))
    assert (np.abs(near.targets) <= np.abs(grid(3, 3)) + ROOM_FOR_A_SECOND).all()


def test_two_marks_close_together_are_touched_from_opposite_sides(by_kind):
    (sides,) = by_kind["approach"]
    visits = sides.visits
    assert len(visits) == FEW and sides.minutes == ROUND + FEW * MARK
    assert np.hypot(*visits.approaches.T) == pytest.approx(np.ones(FEW))
    ways = {tuple(map(abs, side)) for side in visits.approaches.tolist()}
    assert ways <= {(1.0, 0.0), (0.0, 1.0)}
    for first, second in ((0, 1), (2, 3)):
        assert visits.approaches[first] == pytest.approx(-visits.approaches[second])
        gap = np.abs(visits.targets[first] - visits.targets[second])
        assert gap == pytest.approx((ROOM_FOR_A_SECOND, ROOM_FOR_A_SECOND))
    apart = np.linalg.norm(visits.targets[0] - visits.targets[2])
    assert apart > 2 * ROOM_FOR_A_SECOND
    assert "opposite sides" in sides.do[0] and spots(visits, MM) in sides.do[0]


def test_every_mark_is_read_again_as_it_was_made(by_kind, clean):
    (again,) = by_kind["repeats"]
    assert not again.is_cut and by_kind["marks"][0].is_cut
    assert not by_kind["check"][0].is_cut
    assert again.visits.names == clean.board.rows.names * READ_AGAIN
    assert again.visits.chains == pytest.approx(np.tile(clean.board.rows.chains, (READ_AGAIN, 1)))
    assert again.do == ("Read each of the 9 marks 3 more times with a newly laid tape.",)


def test_a_number_is_checked_only_if_the_check_is_better_than_what_is_known():
    sigma = FRAME_CHECKS["motor_gap"].sigmas["motor_gap"]
    for known, is_offered in ((1.01 * SHARPER * sigma, True), (0.99 * SHARPER * sigma, False)):
        made = [Checked("motor_gap", MACHINE.motor_gap, known)]
        offered = checks_for(case_on(nine(), "chain_pitch", checked=made))
        names = [check.name for option in offered for check in option.checks]
        assert ("motor_gap" in names) == is_offered and "motor_height" in names
        # The radius is a solid part that no fit moves.
        assert "rotation_radius" not in names


def test_checks_of_suspects_have_their_numbers_and_words():
    (check,) = [each for each in checks_for(case_on(nine(), "chain_pitch")) if each.kind == "check"]
    direct = effect_checks()["chain_pitch"]
    assert {each.name: each.sigma for each in check.checks} == {
        f"chain_pitch.{side}": sigma for side, sigma in direct.sigmas.items()
    }
    assert (check.title, check.minutes) == (direct.title, direct.minutes)
    assert check.do == (direct.steps,)


CUT = Option("marks", "4 more marks", ("Cut four.",), 9.4, nowhere())
ROOMS = (RoomThen("chain_sag", 5.0, 1.24), RoomThen("chain_pitch", 2.0, 1.9))


def proposal(question=SETTLE, chance=0.42, **how):
    return ProposalInWords(CUT, MM, question, chance, None, **how)


@pytest.mark.parametrize(
    ("chance", "said"),
    [
        (None, "-"),
        (0.0, "below 5 %"),
        (0.02, "below 5 %"),
        (0.03, "5 %"),
        (0.42, "40 %"),
        (0.43, "45 %"),
        (0.97, "95 %"),
        (0.98, "above 95 %"),
        (1.0, "above 95 %"),
    ],
)
def test_a_chance_is_shown_in_steps_of_five(chance, said):
    assert percent(chance) == said


@pytest.mark.parametrize(
    ("question", "hope"),
    [
        (SETTLE, ", chance to settle it 40 %"),
        (CONFIRM, ", chance to confirm it 40 %"),
        (REREAD, ", chance to show it 40 %"),
        (EXPLORE, ""),
    ],
)
def test_the_headline_states_minutes_and_chance(question, hope):
    assert proposal(question).headline == f"4 more marks; about 9 minutes{hope}"
    assert proposal(question, None).headline == "4 more marks; about 9 minutes"
    assert worth(proposal(question)) == worth(proposal(question, None)) == "helps"
    assert worth(proposal(question, 0.5)) == "settles" and worth(None) == "nothing_would"


@pytest.mark.parametrize(("question", "columns"), [(SETTLE, 4), (EXPLORE, 3)])
def test_a_look_around_has_no_column_of_promises(question, columns):
    (rows,) = other_ways(SimpleNamespace(proposals=[proposal(question, None)] * 2))
    assert len(rows.header) == len(rows.rows[0]) == columns and all(rows.header[1:])


def test_without_a_proved_effect_the_headline_states_how_much_less_could_hide():
    noun = noun_of("chain_sag")
    said = proposal(FIND, rooms=ROOMS).headline
    hope = f"{noun[0].upper()}{noun[1:]} may act unseen by 5.0 mm now, by 1.2 mm then"
    assert said == f"4 more marks; about 9 minutes. {hope}"
    # Only what becomes clearly less is worth a word.
    assert proposal(FIND, rooms=ROOMS).promise == f"{noun} 5.0 -> 1.2 mm"
    assert proposal(FIND, rooms=ROOMS[1:]).promise == "no change"
    third = RoomThen("motor_level", 9.0, 1.0)
    both = proposal(FIND, rooms=(third, *ROOMS)).promise
    assert both == f"{noun_of('motor_level')} 9.0 -> 1.0 mm, {noun} 5.0 -> 1.2 mm"


def test_a_step_names_each_cause_that_it_tries_once_in_one_sentence():
    assert proposal().steps == ["Cut four."]
    pairs = (
        ("chain_sag + motor_level", "frame_lean + motor_level"),
        ("chain_pitch + tape_scale", "chain_sag"),
        ("chain_sag", "frame_lean + chain_sag"),
        ("", "chain_sag"),
    )
    sag, lean, pitch, tape = map(noun_of, ("chain_sag", "frame_lean", "chain_pitch", "tape_scale"))
    said = f"It shows which of these act: {sag}, {lean}, {pitch}, {tape}."
    assert proposal(parts=pairs).steps == ["Cut four.", said]
    assert proposal(parts=pairs[2:3]).steps[1:] == [f"It shows whether {lean} acts."]
    assert proposal(parts=pairs[3:]).steps[1:] == [f"It shows whether {sag} acts."]
    assert proposal(parts=(("chain_sag", "chain_sag"),)).steps[1:] == []


def slip(name, *offset):
    return Outlier(name, offset, (SIGMA,) * len(offset), (0.0,) * len(offset), offset, "")


def test_a_second_reading_shows_a_slip_as_often_as_noise_allows():
    case = case_on(nine(), "chain_pitch")
    even = SURE * sqrt(2) * SIGMA  # as often as not
    far = -even - 2 * sqrt(2) * SIGMA
    several = [slip("3", even, 0.0), slip("3", 0.0, far), slip("3", 0.0, 0.0)]
    chances = [chance for _, chance in for_slips(several, case.board.rows, case.noise)]
    assert chances == pytest.approx([0.5, 0.9772, 0.00135], abs=1e-3)


def test_marks_around_the_worst_place_lie_inwards_of_it():
    case = case_on(read_elsewhere(nine(), 8, (6.0, 0.0)), "chain_pitch")
    again, near = near_the_worst(case)
    worst, second = list(dict.fromkeys(again.visits.names))
    assert worst == "8" and len(again.visits) == 2 * AGAIN
    assert again.minutes == ROUND + READING * 2 * AGAIN
    assert near.minutes == ROUND + MARK * len(near.visits)
    assert f"around {worst}, {second}" in near.do[0]
    places = {tuple(place) for place in near.visits.targets.tolist()}
    assert {(1100.0 - BESIDE, -500.0), (1100.0, -500.0 + BESIDE)} <= places
    half = np.array(MACHINE.sheet) / 2
    assert (np.abs(near.visits.targets) <= half - 50).all()
    assert (near.visits.targets % 10 == 0).all()


def test_the_worst_distances_are_measured_again():
    board = distances_between(marks_on(MACHINE, MACHINE, grid(3, 3), noise=0.2))
    spans = list(board.distances)
    spans[5] = replace(spans[5], length=spans[5].length + 9.0)
    case = replace(
        case_on(replace(board, distances=tuple(spans)), "chain_pitch"),
        spans=tuple(" - ".join(each.between) for each in spans),
    )
    (again,) = near_the_worst(case)
    said = again.do[0].removeprefix("Measure these distances 3 more times: ")
    assert said.startswith(f"{case.spans[5]}, ")
    assert again.do[0].count(" - ") == 4 and "3 more times" in again.do[0]
    assert again.minutes == ROUND + READING * 3 * 4 and len(again.visits) == 0


def test_proof_marks_lie_far_from_what_was_fitted_and_from_each_other():
    known = grid(3, 3)
    first, second = proof_places(MACHINE, known)
    places = places_over(MACHINE.sheet, 15, 9)
    places = places[usable(MACHINE, places, MACHINE.sled_weight)]
    places = places[usable(MACHINE, places - [0.0, BELOW], MACHINE.sled_weight)]

    def gap(place, marks):
        return np.linalg.norm(marks - place, axis=1).min()

    assert gap(first, known) == max(gap(place, known) for place in places)
    both = np.vstack([known, first])
    assert gap(second, both) == max(gap(place, both) for place in places)
    assert len(proof_places(MACHINE, np.zeros((0, 2)))) == 2


def test_a_form_keeps_place_side_and_weight(file):
    targets = np.array([(-1000.0, 480.0), (20.0, -300.0)])
    sides = np.array([(0.0, 1.0), (0.6, -0.8)])
    visits = sent(BELIEVED, targets, controller="plumb", sled_weight=147.0, approaches=sides)
    text = marks_file(
        visits, sheet=BELIEVED.sheet, controller="plumb", said=("Four marks.",), unit=MM
    )
    read = read_form(file("form.toml", text), sheet=BELIEVED.sheet).measurements
    assert read.controller == "plumb" and len(read.marks) == 2
    for mark, target, side in zip(read.marks, targets, sides, strict=True):
        assert mark.target == pytest.approx(tuple(target), abs=0.001)
        assert mark.approach == pytest.approx(tuple(side), abs=0.001)
        assert mark.sled_weight == 147.0


def test_joined_visits_keep_everything():
    sides = np.array([(1.0, 0.0), (0.0, 0.0), (0.0, -1.0)])
    targets = [(-300.0, 100.0), (0.0, 100.0), (300.0, 100.0)]
    how = {"controller": "plumb", "sled_weight": 120.0, "approaches": sides}
    visits = sent(BELIEVED, targets, **how)
    back = joined(visits.taken([2]), nowhere(), visits.taken([0, 1]))
    assert back.names == ("300/100", "-300/100", "0/100") and len(back) == 3
    assert back.targets.tolist() == [list(targets[i]) for i in (2, 0, 1)]
    assert back.chains[1:] == pytest.approx(visits.chains[:2])
    read = back.marks(np.add(back.targets, (1.0, 2.0)))
    assert [mark.approach for mark in read] == [(0.0, -1.0), (1.0, 0.0), None]
    assert read[0].measured == (301.0, 102.0) and read[0].target == (300.0, 100.0)
    assert {mark.sled_weight for mark in read} == {120.0}
    rows = back.rows()
    assert rows.count == 6 and rows.mark_rows.tolist() == [0, 1, 2] and not rows.measured.any()


UP, LEFT = (0.0, 1.0), (-1.0, 0.0)


@pytest.mark.parametrize("side", [None, UP, LEFT])
def test_marks_on_the_sheet_are_reached(side):
    refuse_way(BELIEVED, [Mark("1", (-1000, 500), approach=side), Mark("2", (0, -500))])


@pytest.mark.parametrize(
    ("place", "side", "why"),
    [
        ((0.0, -600.0), None, "leaves the sheet"),  # 40 mm below it there is no sheet
        ((1190.0, 0.0), LEFT, "leaves the sheet"),
        ((0.0, 620.0), None, "leaves the sheet"),
    ],
)
def test_a_path_off_the_sheet_is_refused(place, side, why):
    with pytest.raises(InputError, match=f"mark far {why}"):
        refuse_way(BELIEVED, [Mark("near", (0.0, 0.0)), Mark("far", place, approach=side)])


def test_the_weight_on_the_sled_counts():
    mark = Mark("1", (0.0, 560.0))
    refuse_way(BELIEVED, [mark])
    with pytest.raises(InputError, match="where the sled cannot hang well"):
        refuse_way(BELIEVED, [dataclasses.replace(mark, sled_weight=400.0)])


def test_the_way_between_two_marks_counts():
    low = dataclasses.replace(BELIEVED, motor_height=700.0)
    corners = [Mark("left", (-1000.0, 400.0)), Mark("right", (1000.0, 400.0))]
    for corner in corners:
        refuse_way(low, [corner])
    with pytest.raises(InputError, match="mark right passes where the sled cannot hang well"):
        refuse_way(low, corners)


NOISES = Noises(np.array([SIGMA]), np.zeros(1))
PITCH = ("chain_pitch.left", "chain_pitch.right")


@pytest.fixture(scope="module")
def case():
    """Nine marks of a machine with chains longer than its settings say: a tape draws that too."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": 0.0032, "right": 0.0022}}
    machine = replace(MACHINE, effects=effects)
    marks = marks_on(machine, MACHINE, grid(3, 3), noise=SIGMA, seed=1)
    return case_on(Measurements(marks), "chain_pitch", "tape_scale")


@pytest.fixture(scope="module")
def stock():
    """The same of a machine whose settings know nothing of its chains."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": 0.0016, "right": 0.0011}}
    stretched = replace(MACHINE, effects=effects)
    marks = marks_on(stretched, BELIEVED, grid(3, 3), noise=SIGMA, seed=1)
    return case_on(Measurements(marks), "chain_pitch", "tape_scale", machine=BELIEVED)


def checks(*names, sigma):
    return PlannedMeasurement(nowhere(), [PlannedCheck(name, sigma) for name in names])


def test_measuring_the_cause_itself_settles_what_marks_leave_open(case):
    outlooks = Outlooks(case)
    before = outlooks.of(PlannedMeasurement(nowhere()))
    sharp, less = (outlooks.of(checks(*PITCH, sigma=sigma)) for sigma in (5e-5, 1e-3))
    assert sharp.chance > before.chance + 0.3 and sharp.bits > less.bits > before.bits
    assert 1 <= sharp.left < less.left <= before.left + 0.1  # as far as draws tell


def drawn_machines(board, accounts, count, source):
    """Sets of effects and unknowns of machines, as often as the marks so far make them likely.

    The frame, then the effects: by the textbook's covariance, and drawn again until all signs are
    possible. Half of all chains are a little long or short.
    """
    variants, weights, pitch = [], [], board.sizes.pitch
    for drifts in {False, bool(pitch.any())}:
        metric = Metric.of(board, NOISES.sigmas, pitch=drifts)
        for part in accounts.parts:
            weights.append(fitted(part, metric).evidence[0])
            variants += [(part, a, pitch if drifts else 0 * pitch) for a in range(len(part.sets))]
    weights = np.concatenate(weights)
    frame, least = board.frame.shape[1], board.sizes.least - board.sizes.mean
    noise = np.r_[np.full(board.measured, SIGMA), np.ones(len(board.frame) - board.measured)]
    for i in source.choice(len(variants), count, p=np.exp(weights - np.logaddexp.reduce(weights))):
        part, a, drift = variants[i]
        index = part.index[a]
        slopes = np.hstack([board.frame, board.effects * drift, board.effects[:, index]])
        slopes /= noise[:, np.newaxis]
        prior = np.r_[np.ones(frame + len(drift)), 1 / part.variance[a]]
        covariance = np.linalg.inv(slopes.T @ slopes + np.diag(prior))
        mean = covariance @ slopes.T @ (board.read[:, 0] / noise)
        unknowns = source.multivariate_normal(mean, covariance, size=200, method="cholesky")
        of_frame, drifts, sizes = np.split(unknowns, [frame, frame + len(drift)], axis=1)
        possible = np.all(sizes >= least[index], axis=1)
        where = np.argmax(possible) if possible.any() else 0
        every = drift * drifts[where]
        every[index] += sizes[where]
        yield int(part.sets[a]), of_frame[where], every


@pytest.mark.parametrize("what", ["marks", "check"])
@pytest.mark.parametrize("machine", ["case", "stock"])
def test_promised_chances_come_true_on_machines_drawn_from_the_posterior(machine, what, request):
    case = request.getfixturevalue(machine)
    marks = PlannedMeasurement(many_marks(case).visits.taken(range(0, 28, 3)))
    planned = marks if what == "marks" else checks(*PITCH, sigma=5e-5)
    known = LinearBoard.of(case.frame, case.posterior.felt)
    accounts = accounts_of(known)
    truths, sizes, then = boards_then(case, known, planned.ahead(case.frame), accounts, 300)
    shown = _shown(then, SIGMA, sizes)
    clean = clean_of(then, accounts, NOISES)
    settled = [
        is_settled(then, accounts, clean.on(i), acting, [name for name in acting if shown[name][i]])
        for i, truth in enumerate(truths)
        for acting in [accounts.effects[truth]]
    ]
    promised = Outlooks(case, draws=600).of(planned)
    assert promised.chance == pytest.approx(np.mean(settled), abs=0.08)
    # Information is the entropy that goes.
    gone = entropy(clean_of(known, accounts, NOISES).total[:, 0]) - entropy(clean.total)
    assert promised.bits == pytest.approx(gone.mean(), abs=0.15) and promised.bits > 0.1


def boards_then(case, known, rows, accounts, count):
    """The sets behind some machines, and the boards of the marks so far with what is new."""
    source, board = np.random.default_rng(7), case.board
    is_read = rows.marks[rows.so_far :]
    noise = np.where(is_read, SIGMA, 1.0)
    new = rows.slopes[rows.so_far :] * noise[:, np.newaxis]
    columns = board.columns(known.columns)
    frame, effects = new[:, board.frame], turned(board, columns, new[:, columns])
    truths, read, of_acting = [], [], []
    for truth, of_frame, sizes in drawn_machines(known, accounts, count, source):
        truths.append(truth)
        moved = frame @ of_frame + effects @ sizes + noise * source.standard_normal(len(new))
        read.append(np.r_[known.read[:, 0], moved])
        acting = [known.columns[name] for name in accounts.effects[truth]]
        is_acting = np.isin(np.arange(len(sizes)), np.concatenate([[-1], *acting]))
        of_acting.append(np.where(is_acting, sizes, 0.0))
    then = replace(
        known,
        measured=known.measured + int(is_read.sum()),
        frame=np.vstack([known.frame, frame]),
        effects=np.vstack([known.effects, effects]),
        read=np.array(read).T,
    )
    return truths, np.array(of_acting).T, then


def entropy(total):
    """Of sets by their log weights [bits]."""
    chances = np.exp(total - np.logaddexp.reduce(total, axis=0))
    return -np.sum(chances * np.log2(np.maximum(chances, 1e-300)), axis=0)


def is_settled(board, accounts, clean, acting, shown):
    """Whether all accounts of a board, looked at one by one, name what is shown and acts."""
    together = {}
    asked = asked_for(board, accounts, clean, range(len(accounts.effects)))
    for effects, weight in zip(asked, clean.total, strict=True):
        together[effects] = np.logaddexp(together.get(effects, -np.inf), weight)
    weights = np.array([*together.values()])
    if np.exp(together.get((), -np.inf) - np.logaddexp.reduce(weights)) > NOTHING:
        return not acting
    several = [*together]
    named = listing(several, weights)
    return len(named) == 1 and _is_right([several[named[0][0]]], acting, shown)


def test_where_nothing_is_proved_each_effect_is_looked_for():
    hidden = case_on(nine())
    expected = Outlooks(hidden).of(PlannedMeasurement(many_marks(hidden).visits))
    assert expected.left is None and 0 <= expected.chance <= 1 and expected.bits > 0.1
    less = Outlooks(hidden).of(PlannedMeasurement(nowhere()))
    assert less.chance <= expected.chance and less.bits < expected.bits


def plan_of(columns, rows, **how):
    targets = grid(columns, rows)
    places = enumerate(map(tuple, targets.tolist()))
    return Measurements(tuple(Mark(str(i), at, at, **how) for i, at in places))


@pytest.fixture(scope="module")
def plan_of_nine():
    return preview(MACHINE, plan_of(3, 3, approach=(0.0, 1.0)), sigma=SIGMA)


def outline(seen, effect):
    (only,) = [each for each in seen.outlines if each.effect == effect]
    return only


@pytest.mark.parametrize("effect", ["sheet_skew", "chain_plane"])
def test_the_smallest_size_is_detected_at_the_stated_rate(effect):
    seen = preview(MACHINE, plan_of(5, 5), sigma=SIGMA)
    model, rows = model_and_observations(MACHINE, plan_of(5, 5))
    frame = explain(Board.of(model, rows, sigma=SIGMA))
    board = LinearBoard.of(frame, (*EVERY_MACHINE, effect))
    every = accounts_of(board)
    accounts = every.among(np.array([names in ((), (effect,)) for names in every.effects]))
    source, count = np.random.default_rng(1), 1500
    drawn = board.effects[:, board.columns[effect]] * outline(seen, effect).smallest
    read = drawn + SIGMA * source.standard_normal((len(drawn), count))
    read += board.frame @ source.standard_normal((board.frame.shape[1], count))
    noises = Noises(np.array([SIGMA]), np.zeros(1))
    total = clean_of(replace(board, read=read), accounts, noises).total
    nothing = np.exp(total[0] - np.logaddexp.reduce(total, axis=0))
    assert np.mean(nothing < NOTHING) == pytest.approx(POWER, abs=0.1)


def test_look_alikes_are_named_and_effects_that_show_are_counted(plan_of_nine):
    assert "frame_lean" in outline(plan_of_nine, "chain_sag").alike
    smallest = [each.smallest for each in plan_of_nine.outlines if each.smallest is not None]
    assert plan_of_nine.named <= plan_of_nine.seen == sum(size <= 1 for size in smallest)
    assert plan_of_nine.seen < sum(size <= 2 for size in smallest)
