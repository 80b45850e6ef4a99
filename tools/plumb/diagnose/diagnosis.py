"""The diagnosis: slips first, then the gate, the suspects, and what could still hide."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.board.observations import Observations, model_and_observations
from plumb.diagnose.exchanged import exchange_slips, find_exchanged
from plumb.diagnose.explanation import Board, Explanation, explain
from plumb.diagnose.gain import Search, search
from plumb.diagnose.halves import half_warnings, round_warnings
from plumb.diagnose.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnose.misfit import misfit_chance
from plumb.diagnose.noise import Noise
from plumb.diagnose.signs import sign_warning
from plumb.diagnose.sizes import Room, Size, hidden_share, room_for, sizes_of
from plumb.diagnose.slip_guess import Slip, described
from plumb.diagnose.slips import clear_slips
from plumb.diagnose.suspects import Suspects, best_at_hand, evidence, find_suspects
from plumb.fit.problem import PRIORS, USUAL_SIGMA, Checked
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Array = np.ndarray
FEWEST_NUMBERS = 6  # three marks: below that the frame explains everything
VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")


@dataclass(frozen=True)
class Ranked:
    """One effect of the library by itself."""

    effect: str
    gain: float  # drop of chi-square when it is added to the frame and all is refitted
    surprise: float  # -log of the chance of that gain from noise: the order of the ranking
    sizes: tuple[Size, ...]
    rms_after: float  # [mm]
    hidden_share: float | None

    @property
    def plausible(self) -> bool:
        """Whether a real machine can have these sizes."""
        return all(one.plausible for one in self.sizes)


@dataclass(frozen=True)
class Together:
    """An explanation that stood its test: one effect, or several that act at once."""

    effects: tuple[str, ...]
    sizes: Mapping[str, tuple[Size, ...]]
    rms_after: float  # [mm]

    @property
    def possible(self) -> bool:
        """Whether the intervals of all sizes reach what a real machine can have."""
        return all(one.possible for own in self.sizes.values() for one in own)


@dataclass(frozen=True)
class Diagnosis:
    """What the marks prove, and what they do not."""

    verdict: str  # one of VERDICTS
    noise: Noise
    limit: float  # of the gate: the surprise that noise hardly ever exceeds (gain.LEVEL)
    rms_before: float  # [mm] with the frame fitted
    explanations: tuple[Together, ...]  # best first
    differences: Mapping[tuple[int, int], float]  # [mm] RMS between two explanations' marks
    ranking: tuple[Ranked, ...]
    library_fits: bool  # whether all effects of the library at once could draw the marks
    chance: float  # that so many effects at once would explain what none of them made
    to_add: tuple[str, ...]  # effects to go on with: the first explanation, or the best at hand
    slips: tuple[Slip, ...]
    could_hide: tuple[Room, ...]
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...] = ()  # rounds, or halves of the sheet, that do not go together

    @property
    def suspects(self) -> tuple[str, ...]:
        """The effects in the explanations, best first."""
        return tuple(dict.fromkeys(name for one in self.explanations for name in one.effects))


def diagnose(
    settings: MachineSettings,
    measurements: Measurements,
    *,
    cut_with: MachineSettings | None = None,
    controller: str | None = None,
    priors: Mapping[str, float] = PRIORS,
    sigma: float | None = None,
    checked: Sequence[Checked] = (),
) -> Diagnosis:
    """Find what the model of these settings misses in the marks, and in numbers checked directly.

    Raises InputError for too few marks, and marks that cannot be reached.
    """
    model, rows = model_and_observations(
        settings, measurements, cut_with=cut_with, controller=controller
    )
    _refuse_too_few(measurements, rows)
    stated = sigma or measurements.tape_sigma
    first = Board.of(model, rows, sigma=stated or USUAL_SIGMA, priors=priors, checked=checked)
    felt = felt_effects(explain(first))
    exchanged = find_exchanged(first)
    cleared = clear_slips(exchanged.board, felt, stated=stated)
    noise, frame = cleared.noise, cleared.frame
    board = frame.board
    singles = {one.effects[0]: one for one in cleared.singles}
    for name in effect_names():
        # What the marks do not feel needs no search, but is listed too.
        if name not in singles:
            singles[name] = explain(board, (name,), start=frame)
    gate = search(frame, felt, noise)
    slips = (
        *exchange_slips(exchanged, measurements),
        *(described(one, measurements, settings.sheet) for one in cleared.slips),
    )
    suspects, verdict = Suspects((), True), "slip"
    if not slips:
        suspects, verdict = _judge(frame, [singles[name] for name in felt], gate, noise)
    kept = tuple(one.explanation for one in suspects.survivors)
    possible = not kept or any(one.possible for one in suspects.survivors)
    ranking = _ranking(frame, singles, noise)
    return Diagnosis(
        verdict=verdict,
        noise=noise,
        limit=gate.limit,
        rms_before=frame.rms,
        explanations=tuple(_together(one, noise) for one in kept),
        differences=_differences(kept),
        ranking=ranking,
        library_fits=suspects.library_fits,
        chance=suspects.chance,
        to_add=_to_add(frame, felt, kept, verdict),
        slips=slips,
        could_hide=tuple(room_for(name, kept or (frame,), noise) for name in effect_names()),
        warnings=(
            *noise.notes,
            *([] if possible else [_IMPOSSIBLE]),
            *_warnings(frame, gate, ranking, kept),
            *_signs(board, felt, noise, kept, verdict),
        ),
        disagreements=()
        if slips
        else _parts_that_differ(kept[0] if kept else frame, noise, measurements),
    )


_IMPOSSIBLE = (
    "every explanation needs sizes that no real machine has, so each takes the place of another "
    "cause: check which settings were in force, the signs of the marks, the stated frame, and that "
    "the sled hangs on one ring, not on two brackets"
)


def felt_effects(frame: Explanation) -> tuple[str, ...]:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(name for name in effect_names() if np.any(frame.slopes[:, board.columns([name])]))


def _judge(
    frame: Explanation, singles: list[Explanation], gate: Search, noise: Noise
) -> tuple[Suspects, str]:
    """Suspects and verdict where no slip is in the way."""
    if not gate.proved:
        missing = misfit_chance(frame, noise) <= MISFIT_LEVEL
        return Suspects((), not missing), "not_in_library" if missing else "nothing_provable"
    felt = [one.effects[0] for one in singles]
    suspects = find_suspects(frame, singles, felt, noise)
    if not suspects.believable:
        return suspects, "not_in_library"
    return suspects, "one_suspect" if len(suspects.survivors) == 1 else "cannot_tell"


def _to_add(
    frame: Explanation, felt: tuple[str, ...], kept: tuple[Explanation, ...], verdict: str
) -> tuple[str, ...]:
    """What to add to the machine; nothing where a slip comes first or nothing is provable."""
    if verdict in ("slip", "nothing_provable"):
        return ()
    return kept[0].effects if kept else best_at_hand(frame, felt)


def _refuse_too_few(measurements: Measurements, rows: Observations) -> None:
    """Repeats do not count: they tell of the noise, not of another place."""
    spans = {frozenset(one.between) for one in measurements.distances}
    count = 2 * len(set(rows.names)) + len(spans)
    if count < FEWEST_NUMBERS:
        raise InputError(
            f"{measurements.source}: {count} measured numbers are too few for a diagnosis; measure "
            "at least three marks, better nine or more all over the sheet"
        )


def _ranking(
    frame: Explanation, singles: Mapping[str, Explanation], noise: Noise
) -> tuple[Ranked, ...]:
    ranked = [
        Ranked(
            effect=name,
            gain=max(frame.cost - single.cost, 0.0),
            surprise=evidence(single, frame, noise),
            sizes=sizes_of(single, name, noise),
            rms_after=single.rms,
            hidden_share=hidden_share(frame, name),
        )
        for name, single in singles.items()
    ]
    return tuple(sorted(ranked, key=lambda one: -one.surprise))


def _together(explanation: Explanation, noise: Noise) -> Together:
    return Together(
        effects=explanation.effects,
        sizes={name: sizes_of(explanation, name, noise) for name in explanation.effects},
        rms_after=explanation.rms,
    )


def _signs(
    board: Board,
    felt: tuple[str, ...],
    noise: Noise,
    kept: tuple[Explanation, ...],
    verdict: str,
) -> list[str]:
    """What the other sign of y would change, where the verdict leaves doubts."""
    if verdict in ("slip", "nothing_provable"):
        return []
    said = sign_warning(board, felt, noise, kept)
    return [said] if said else []


def _parts_that_differ(
    best: Explanation, noise: Noise, measurements: Measurements
) -> tuple[str, ...]:
    """Rounds that do not go together, else halves of the sheet."""
    rounds = round_warnings(best, noise, [one.name for one in measurements.rounds])
    return tuple(rounds or half_warnings(best, noise))


def _differences(kept: tuple[Explanation, ...]) -> dict[tuple[int, int], float]:
    """RMS between what two explanations leave of the readings [mm]."""
    found = {}
    for i, one in enumerate(kept):
        for j in range(i):
            apart = one.numbers - kept[j].numbers
            marks = one.board.rows.measured.size
            own = apart[:marks] if marks else apart
            count = len(one.board.rows.measured) or len(own)
            found[j, i] = float(np.sqrt(own @ own / count))
    return found


def _warnings(
    frame: Explanation, gate: Search, ranking: tuple[Ranked, ...], kept: tuple[Explanation, ...]
) -> list[str]:
    said = []
    if gate.gains and gate.proved and gate.gains[0].effect != ranking[0].effect:
        said.append(
            f"the full refit puts {ranking[0].effect} before {gate.gains[0].effect}, which the "
            "slopes at the frame's fit put first: the error is large; fit one and diagnose again"
        )
    unsettled = [" + ".join(one.effects) for one in (frame, *kept) if not one.settled]
    if unsettled:
        names = ", ".join(name or "frame" for name in unsettled)
        said.append(f"the fit did not come to rest: {names}")
    return said
