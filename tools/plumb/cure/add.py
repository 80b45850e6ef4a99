"""Adding effects to a machine: the fit before and after, and what to think of the numbers."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from threading import Lock
from typing import Annotated, Protocol

import numpy as np
from pydantic import computed_field

from plumb.diagnosis.evidence import Noise
from plumb.diagnosis.expected_error import Drawn, drawn_by, left_open
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.readings import clear_outliers, described
from plumb.firmware.settings import Difference, both_values, differences, numbers_in_force
from plumb.fit.compare import (
    PATCH,
    Comparison,
    Covariate,
    PlausibleRange,
    best_patch,
    best_pose,
    chain_errors,
    compare,
    covariates,
    hung_places,
    plausible_range,
)
from plumb.fit.fit import USUAL_SIGMA, Estimate, Fit, fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations, different_numbers, notes_on, rms, unit_of
from plumb.model.catalogue import (
    EDGES,
    LAB_EFFECTS,
    NO_FIRMWARE,
    SLED,
    TAPE,
    effect_names,
    parameter_names,
    parameter_words,
)
from plumb.model.plain import noun_of, plain_name, plain_range, plain_size
from plumb.model.predict import Array, frame_words
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, Number, among, in_json, meant, part
from plumb.text.errors import InputError, to_do
from plumb.text.values import Unit, refuse_unknown

# A board that is read once and refitted often: with these effects, and sizes held by hand.
#
# What does not depend on the effects is worked out once: which chains were paid out, and how good a
# reading is. Fits are kept. A search begins at the numbers of the fit before, unless the last digit
# counts.


MOST_KEPT = 64  # fits


class TooFewError(InputError):
    """The marks are too few for the effects that were chosen."""


class Weighted(Protocol):
    """fit() with all but the effects and the priors."""

    def __call__(self, *, effects: Sequence[str] = (), priors: Mapping[str, float]) -> Fit: ...


@dataclass(frozen=True)
class Chosen:
    """Effects to add, in their order, and parameters of theirs that keep a size."""

    effects: tuple[str, ...] = ()
    held: Mapping[str, float] = field(default_factory=dict)  # by full name, `effect.parameter`

    @property
    def parameters(self) -> tuple[str, ...]:
        """Of its effects, by full name."""
        return tuple(name for effect in self.effects for name in parameter_names(effect))

    def first(self, count: int) -> Chosen:
        """Return the first effects alone."""
        effects = self.effects[:count]
        mine = {
            name: size for name, size in self.held.items() if name.rpartition(".")[0] in effects
        }
        return Chosen(effects, mine)


class LiveBoard:
    """The board of some inputs; several threads may ask it."""

    def __init__(self, inputs: Inputs, *, warm: bool = True, noise: Noise | None = None) -> None:
        """warm: a search begins at the last fit. noise: that of a diagnosis, if it is known.
        Raises InputError for marks out of reach.
        """
        self.inputs = inputs
        self._warm = warm
        model, rows = inputs.model_and_observations()
        self.model: MachineSettings = model
        self.rows: Observations = rows
        sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
        # Checks of effects count in a fit of these effects: the noise is the same for every fit.
        frame = [check for check in inputs.checked if "." not in check.name]
        board = Board.of(
            model, rows, sigma=sigma, priors=inputs.priors, checked=frame, unit=inputs.unit
        )
        self.noise, self.said = (noise, noise.notes) if noise else noise_of(inputs, board)
        self._fits: dict[object, Fit] = {}
        self._last: Fit | None = None
        self._fitting = Lock()

    def refuse(self, chosen: Chosen) -> None:
        """Raise InputError for what these marks cannot settle, and for unknown names."""
        refuse_unknown_effects(chosen.effects)
        try:
            refuse_unknown(chosen.held, chosen.parameters)
        except ValueError as error:
            held = to_do("--hold", page="a held size:")
            raise InputError(held + f" {error}") from None
        self._refuse_too_few(chosen)
        self._refuse_unfelt(chosen.effects)

    def weighted(self, held: Mapping[str, float], near: Fit | None = None) -> Weighted:
        """fit() on this board, with all but the effects and the priors."""
        return partial(
            fit,
            self.model,
            self.rows,
            sigma=self.noise.sigma,
            degrees=self.noise.degrees,
            checked=self.inputs.checked,
            held=held,
            near=near,
        )

    def fit(self, chosen: Chosen) -> Fit:
        """Return the frame with the chosen effects; from what is kept, if it was fitted before."""
        key = (chosen.effects, tuple(sorted(chosen.held.items())))
        with self._fitting:
            if key not in self._fits:
                self._fits[key] = self._fit(chosen)
                while len(self._fits) > MOST_KEPT:
                    self._fits.pop(next(iter(self._fits)))
            self._last = self._fits[key]
            return self._last

    @cached_property
    def frame(self) -> Explanation:
        """The frame alone, with slopes by every effect."""
        return explain(
            Board.of(
                self.model,
                self.rows,
                sigma=self.noise.sigma,
                priors=self.inputs.priors,
                checked=self.inputs.checked,
                unit=self.inputs.unit,
            )
        )

    def _fit(self, chosen: Chosen) -> Fit:
        weighted = self.weighted(chosen.held, near=self._last if self._warm else None)
        return weighted(effects=chosen.effects, priors=self.inputs.priors)

    def _refuse_too_few(self, chosen: Chosen) -> None:
        measurements = self.inputs.measurements
        count = different_numbers(measurements, self.rows)
        frame = sum(sigma > 0 for sigma in self.inputs.priors.values())
        free = len([name for name in chosen.parameters if name not in chosen.held])
        if count < frame + free:
            raise TooFewError(
                f"{measurements.source}: {count} measured numbers cannot settle {frame + free} "
                f"unknowns ({frame} of frame and sheet, {free} of the effects); measure more "
                "marks, add fewer effects, or "
                + to_do(
                    "hold numbers that you know with --prior NAME=0",
                    page="write the numbers that you measured under What you know",
                )
            )

    def _refuse_unfelt(self, effects: Sequence[str]) -> None:
        """Refuse a lab effect that changes none of the measured numbers."""
        rows = self.rows
        approached = bool(rows.approaches[[*rows.mark_rows, *rows.distance_rows.ravel()]].any())
        felt = {SLED: approached, EDGES: len(rows.mark_rows) > 0, TAPE: True}
        for effect in LAB_EFFECTS:
            if effect.name in effects and not felt[effect.acts_on]:
                raise InputError(
                    f"{self.inputs.measurements.source}: {effect.name} needs {effect.needs}: "
                    "nothing here depends on it"
                )


def refuse_unknown_effects(names: Sequence[str]) -> None:
    """Raise InputError for an effect that is not in the catalogue."""
    known = effect_names()
    for name in names:
        if name == PATCH:
            raise InputError(
                to_do(
                    f"--effect {name}: it is not an effect; give --patch to choose it knowingly",
                    page=f"{name} is not an effect: choose others",
                )
            )
        if name not in known:
            option = to_do("--effect ", page="")
            raise InputError(
                option + f"{name}: there is no effect of that name; known are {', '.join(known)}"
            )


# The noise of the readings to which effects are fitted, by the rule of the diagnosis.


def noise_of(inputs: Inputs, board: Board) -> tuple[Noise, tuple[str, ...]]:
    """Return the noise by the posterior of the diagnosis, and a sentence for each reading that
    is likelier off than not, and for what does not go together.
    """
    shifts, posterior = clear_outliers(board, inputs.stated)
    said = [described(shift, inputs).sentence for shift in shifts]
    return posterior.noise, (*said, *posterior.noise.notes)


# What the bench of the lab draws of a board: its errors in chain, covariates, suspects.
#
# Marks hang where the frame's fit has them. A few mm more or less turn no chain, so dots only rise
# and fall when an effect is added.


class BoardView:
    """The view of a board."""

    def __init__(self, board: LiveBoard) -> None:
        rows = board.rows
        self.board = board
        self.model = board.fit(Chosen()).settings
        self._places = hung_places(self.model, rows)[rows.mark_rows]

    @cached_property
    def covariates(self) -> tuple[Covariate, ...]:
        """Those of the marks."""
        marked = self.board.rows.mark_rows
        return tuple(
            replace(each, values=each.values[marked])
            for each in covariates(self.model, self.board.rows)
        )

    def chains(self, errors: Array) -> Array:
        """Errors of the marks (k, 2) [mm] as those of left and right chain; nan: out of reach."""
        rows = self.board.rows
        return chain_errors(self.model, self._places, errors, rows.sled_weights[rows.mark_rows])

    def drawn(self, *effects: str) -> Drawn:
        """Return what effects draw into the marks once the frame is refitted with them."""
        frame, rows = self.board.frame, self.board.rows
        explanation = explain(frame.board, effects, start=frame)
        return drawn_by(frame, explanation, rows)


# Whether the settings to be corrected are those of the machine that cut the marks.


def refuse_other_origin(inputs: Inputs) -> None:
    """InputError with both values if all marks say that another machine cut them than the settings
    say, or any that the settings were fitted to."""
    settings, record = inputs.settings, inputs.settings.fitted
    rounds = inputs.measurements.rounds
    named = [each.cut_with for each in rounds if each.cut_with]
    if inputs.cut_with or len(named) < len(rounds) or not named:
        return  # the settings in force are stated, or not known
    boards = record.boards if record else ()
    machines = [settings, *(board.cut_with for board in boards)]
    if any(not _apart(machine, cut_with) for machine in machines for cut_with in named):
        return
    file, newest = settings.file, named[-1]
    name, other = file.name if file else "the settings", newest.file
    was = other.name if other else "what its marks name"
    raise InputError(
        rounds[-1].name or inputs.measurements.source,
        f"was cut with another machine than {name}: "
        + both_values(_apart(settings, newest), name, was),
        remedy=to_do(
            f"give {was} instead of {name}, or say with --cut-with what the machine held",
            page=f"open {was}, or name in the form, as cut_with, what the machine held",
        ),
    )


def _apart(settings: MachineSettings, cut_with: MachineSettings) -> tuple[Difference, ...]:
    return differences(settings, numbers_in_force(cut_with))


LEFT_BY_NOISE = "What noise alone would leave of that fit."
Sizes = Mapping[str, Mapping[str, float]]  # of parameters, effect by effect
RESTLESS = "the fit did not come to rest: do not trust these numbers; add fewer effects at once"
FAR = 2.0  # [prior sigmas] a stated number that moved farther was probably measured wrongly


@dataclass(frozen=True)
class Quality:
    """The errors of a fit [mm]; left out: each mark predicted by a fit that did not see it."""

    fit: Internal[Fit]

    fit_rms = part("fit.rms", float, name="fit_rms_mm")
    noise_rms = part("fit.noise_rms", float, LEFT_BY_NOISE, name="noise_rms_mm")
    corrected_rms = part("fit.corrected_rms", Number, name="priced_rms_mm")
    left_out_rms = part("fit.left_out_rms", float, name="left_out_rms_mm")

    @computed_field(alias="worst_mm")
    @property
    def worst(self) -> float:
        """The largest error."""
        x, y = self.fit.errors.T
        return float(np.max(np.hypot(x, y) if len(x) else np.abs(self.fit.distance_errors)))

    @computed_field(alias="shape_rms_mm")
    @property
    def shape_rms(self) -> float | None:
        """What is left when the sheet is laid at its best."""
        pose = best_pose(self.fit.predicted, self.fit.predicted + self.fit.errors)
        return rms(pose.errors) if pose else None


@dataclass(frozen=True)
class FitStep(Quality):
    """The fit after another effect."""

    effect: str
    only_fit: bool  # the fit got better, what it did not see got worse


@dataclass(frozen=True)
class Parameter:
    """One fitted number with its 95 % interval, and the range that a real machine can have."""

    name: str
    value: float
    low: float
    high: float
    unit: str
    before: float
    prior_sigma: Annotated[float | None, meant("Null: free.")]
    plausible_range: Internal[PlausibleRange]

    limits = part("plausible_range.limits", tuple[float | None, float | None], name="possible")

    @property
    def of_patch(self) -> bool:
        """Whether it is a term of the residual patch, which means nothing by itself."""
        return self.name.startswith(f"{PATCH}.")

    @in_json
    def plausible(self) -> bool:
        """Whether a real machine can have this value."""
        return self.plausible_range.holds(self.value)

    @property
    def possible(self) -> bool:
        """Whether the interval reaches what a real machine may have."""
        return bool(self.plausible_range.is_near(self.low, self.high))


@dataclass(frozen=True)
class AsSet:
    """The errors as the settings stand."""

    rms_mm: float
    worst_mm: float
    shape_rms_mm: float | None


WEIGHTS = ("stop", "by_hand", "promise", "doubt", "hint")


@dataclass(frozen=True)
class Note:
    """Something to know of new numbers, in a sentence."""

    weight: Annotated[
        str,
        among(WEIGHTS),
        meant("A stop forbids the numbers; without what is done by hand no promise holds."),
    ]
    text: str


@dataclass(frozen=True)
class Addition:
    """A machine before and after its effects were added."""

    raw: Internal[Comparison]
    before: Annotated[Quality, meant("With the frame fitted.")]
    after: Annotated[Quality, meant("With the effects too.")]
    parameters: tuple[Parameter, ...]
    effects_added: tuple[str, ...]  # those of the lab too
    doubts: Internal[tuple[str, ...]]  # the heaviest first
    by_effect: tuple[FitStep, ...]  # in the order given; the last is `after`
    sigma_from: str  # where the sigma of the fits comes from: noise_sources.py, or "residuals"
    unit: Internal[Unit]  # of the lengths in what is said of it

    effects = part("settings.effects", Sizes)
    lab_effects = part("after_fit.lab_effects", Sizes)
    frame = part("settings.frame", dict[str, float])
    sigma_mm = part("after_fit.sigma", Number)

    @property
    def after_fit(self) -> Fit:
        """The fit of the new machine."""
        return self.after.fit

    @property
    def settings(self) -> MachineSettings:
        """The new machine."""
        return self.after_fit.settings

    @computed_field(alias="raw")
    @property
    def as_set(self) -> AsSet:
        """The errors before anything was fitted."""
        return AsSet(self.raw.rms, self.raw.worst, self.raw.shape_rms)

    @in_json
    def sheet_rotation(self) -> float | None:
        """The rotation of the sheet [rad]; null where the marks do not show it."""
        return self.after_fit.sheet_rotation if self.after_fit.shows_sheet_rotation else None

    @in_json
    def sheet_rise_mm(self) -> float | None:
        """The rise of the last sheet; null where the marks do not show it."""
        return self.sheet_rise if self.after_fit.shows_sheet_rotation else None

    @in_json
    def cures(self) -> tuple[str, ...]:
        """A sentence for each lab effect that was fitted: no setting holds it."""
        return tuple(
            _cure(name, parameters, self.unit)
            for name, parameters in self.after_fit.lab_effects.items()
        )

    @property
    def by_hand(self) -> tuple[str, ...]:
        """Work by hand without which the numbers do not keep their promise, in sentences."""
        return (*_turn_sentences(self), *self.cures)

    @in_json
    def warnings(self) -> tuple[str, ...]:
        """Reasons not to use the numbers, and doubts about them."""
        return (*self.stops, *self.doubts)

    @property
    def notes(self) -> tuple[Note, ...]:
        """Notes on the numbers, the heaviest first."""
        return (
            *(Note("stop", each) for each in self.stops),
            *(Note("by_hand", each) for each in self.by_hand),
            *(Note("hint" if i else "doubt", each) for i, each in enumerate(self.doubts)),
        )

    @property
    def sheet_rise(self) -> float:
        """The height by which to raise the last sheet's right end [mm] to undo its rotation."""
        return float(np.tan(self.after_fit.last_sheet_rotation)) * self.settings.sheet_width

    @property
    def stops(self) -> tuple[str, ...]:
        """The reason not to use these numbers in a machine; empty if there is none."""
        wrong = (_impossible(each, self.unit) for each in self.parameters if not each.possible)
        return (*([] if self.after_fit.settled else [RESTLESS]), *wrong)

    @property
    def pays(self) -> bool:
        """Whether sizes that can be predict marks better that the fit did not see."""
        return not self.stops and self.after.left_out_rms < self.before.left_out_rms


def add(
    inputs: Inputs,
    *,
    effects: Sequence[str],
    held: Mapping[str, float] | None = None,
    patch: bool = False,
    noise: Noise | None = None,
) -> Addition:
    """Fit frame and effects to the marks; effects that the settings have already stay as they are.

    held: parameters of the effects, by full name, that keep these sizes. patch: with them a
    residual patch, if marks left out are then predicted better. noise: that of a diagnosis, if
    there is one.

    Raises InputError for unknown effects, too few marks, and marks that cannot be reached.
    """
    chosen = Chosen(tuple(dict.fromkeys(effects)), held or {})
    refuse_unknown_effects(chosen.effects)
    raw = compare(inputs)
    board = LiveBoard(inputs, warm=False, noise=noise)
    board.refuse(chosen)
    added = add_to(board, raw, chosen, patch=patch)
    reach = left_open(board.frame).sentence
    return replace(added, doubts=(reach, *added.doubts)) if reach else added


def add_to(board: LiveBoard, raw: Comparison, chosen: Chosen, *, patch: bool = False) -> Addition:
    """Return the same on a board that is at hand, for a choice that it does not refuse."""
    noise, unit, names = board.noise, board.inputs.unit, chosen.effects
    before = Quality(board.fit(Chosen()))
    fits = [board.fit(chosen.first(i + 1)) for i in range(len(names))]
    if patch:
        last = fits[-1] if fits else before.fit
        weighted = board.weighted(chosen.held)
        patched = best_patch(weighted, effects=names, priors=board.inputs.priors, without=last)
        if patched:
            fits, names = [*fits, patched.fit], (*names, PATCH)
    steps = _steps(names, before, fits)
    after = steps[-1] if steps else before
    after_fit = after.fit
    parameters = tuple(_parameter(each) for each in after_fit.estimates if each.felt)
    known = {check.name for check in board.inputs.checked}
    return Addition(
        raw=raw,
        before=before,
        after=after,
        parameters=parameters,
        effects_added=tuple(
            name for name in names if not any(board.model.effects.get(name, {}).values())
        ),
        doubts=(
            *raw.warnings,
            *board.said,
            *_unfelt(after_fit),
            *notes_on(parameter.name for parameter in parameters),
            *_surprises(parameters, known, unit),
            *_bad_bargains(
                before, after, [step for step in steps if not _is_known(step, known)], unit
            ),
        ),
        by_effect=steps,
        sigma_from=noise.source,
        unit=unit,
    )


def _turn_sentences(addition: Addition) -> list[str]:
    """Return what to do about the sheet's rotation, if the marks prove it."""
    if not addition.after_fit.proves_sheet_rotation:
        return []
    rise, unit = addition.sheet_rise, addition.unit
    which = "raise" if rise > 0 else "lower"
    return [
        f"no setting holds the sheet's rotation: {which} the right end of the next sheet by "
        f"{unit.worded(abs(rise))} over its width of "
        f"{unit.worded(addition.settings.sheet_width, 0)}"
    ]


def _cure(name: str, parameters: Mapping[str, float], unit: Unit) -> str:
    """Return what to do about a lab effect that was fitted."""
    remedy = next(each.words["remedy"] for each in LAB_EFFECTS if each.name == name)
    sizes = ", ".join(
        plain_size(f"{name}.{each}", size, unit=unit) for each, size in parameters.items()
    )
    return f"{sizes}: {NO_FIRMWARE}. {remedy[0].upper()}{remedy[1:]}"


def _parameter(estimate: Estimate) -> Parameter:
    units = {number["name"]: number["unit"] for number in frame_words()}
    units |= {name: words["unit"] for name, words in parameter_words().items()}
    return Parameter(
        name=estimate.name,
        value=estimate.value,
        low=estimate.low,
        high=estimate.high,
        unit=units.get(estimate.name, unit_of(estimate.name) or "rad"),
        before=estimate.before,
        prior_sigma=estimate.prior_sigma,
        plausible_range=plausible_range(estimate.name),
    )


def _unfelt(fitted: Fit) -> list[str]:
    """Return a sentence on what the measured numbers cannot tell at all."""
    names = [plain_name(each.name) for each in fitted.estimates if not each.felt]
    if not names:
        return []
    stays = "this, so it stays as it was" if len(names) == 1 else "these, so they stay as they were"
    return [f"nothing that was measured tells {stays}: {', '.join(names)}"]


def _surprises(parameters: Sequence[Parameter], known: Collection[str], unit: Unit) -> list[str]:
    """Sentences about numbers that moved too far, or that may be zero;
    what is known of a number, measured or usual, holds whether the marks show it or not.
    """
    said = []
    for parameter in parameters:
        if parameter.possible and parameter.name not in known and may_be_zero(parameter):
            size = plain_size(parameter.name, parameter.value, unit=unit)
            said.append(f"this may be zero, too: {size}")
        moved = parameter.value - parameter.before
        trusted = parameter.prior_sigma
        if trusted and not parameter.of_patch and abs(moved) > FAR * trusted:
            now, apart = (
                _finely(size, parameter.unit, unit) for size in (parameter.value, abs(moved))
            )
            said.append(
                f"{plain_name(parameter.name)}: the marks say {now}, {apart} "
                f"{'more' if moved > 0 else 'less'} than your settings. That is much for a misread "
                "tape: measure it again"
            )
    return said


def _finely(size: float, of_unit: str, unit: Unit) -> str:
    """Return a size of the frame with its unit; a length in the unit in which lengths are shown."""
    return unit.worded(size) if of_unit == "mm" else f"{size:.3g} {of_unit}"


def may_be_zero(parameter: Parameter) -> bool:
    """Return whether a free parameter that was absent before may be absent still."""
    free = parameter.prior_sigma is None and parameter.before == 0
    return free and parameter.low < 0 < parameter.high


def _impossible(parameter: Parameter, unit: Unit) -> str:
    plausible = parameter.plausible_range
    size = plain_size(parameter.name, parameter.value, unit=unit)
    return (
        f"{size}: that is impossible for a real machine, which has "
        f"{plain_range(parameter.name, plausible.low, plausible.high, unit)}; it takes the "
        "place of another cause; check which settings were in force and the signs of the marks"
    )


def _steps(names: Sequence[str], before: Quality, fits: Sequence[Fit]) -> tuple[FitStep, ...]:
    then, steps = before, []
    for name, fitted in zip(names, fits, strict=True):
        worse = fitted.rms < then.fit_rms and fitted.left_out_rms > then.left_out_rms
        then = FitStep(fitted, name, worse)
        steps.append(then)
    return tuple(steps)


def _is_known(step: FitStep, known: Collection[str]) -> bool:
    """Return whether all numbers of its effect are known, so that it stays whatever it predicts."""
    names = parameter_names(step.effect) if step.effect in effect_names() else ()
    return bool(names) and all(name in known for name in names)


def _bad_bargains(
    before: Quality, after: Quality, steps: Sequence[FitStep], unit: Unit
) -> list[str]:
    """Sentences about effects that serve the fit alone."""
    if not steps:
        return []
    if after.fit_rms < before.fit_rms and after.left_out_rms > before.left_out_rms:
        return [
            "the fit got better but, checked on marks not used, the error rose from "
            f"{unit.bare(before.left_out_rms)} to {unit.worded(after.left_out_rms)}: the effects "
            "follow the noise, do not keep them"
        ]
    return [
        f"with {noun_of(step.effect)} only the fit got better; marks not used are predicted worse "
        f"({unit.worded(step.left_out_rms)}): it may follow the noise"
        for step in steps
        if step.only_fit
    ]
