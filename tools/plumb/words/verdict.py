"""Where and why? The verdict in at most forty words, the likely causes, and what is odd."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from plumb.diagnosis.diagnosis import UNKNOWN, Diagnosis, Together
from plumb.diagnosis.evidence import ORIGINS
from plumb.diagnosis.priors import LIKELIER
from plumb.model.catalogue import every_effect
from plumb.model.plain import noun_of, plainly, ranked
from plumb.text.answers import in_json
from plumb.text.errors import to_do
from plumb.text.values import Unit
from plumb.words import Part, Rows, Sentences, filled, paragraph
from plumb.words.states import STATES


@dataclass(frozen=True)
class DiagnosisInWords(Diagnosis):
    """The diagnosis and its verdict."""

    @in_json
    def title(self) -> str:
        """What the marks come to, in a few words."""
        return title(self)

    @in_json
    def sentence(self) -> str:
        """The verdict for people."""
        return sentence(self)


def in_words(diagnosis: Diagnosis) -> DiagnosisInWords:
    """Return a diagnosis with its verdict."""
    return DiagnosisInWords(**vars(diagnosis))


SHOWN = 8  # explanations that a screen names; a Diagnosis holds all
MOST_NAMED = 2  # causes in a sentence


def title(diagnosis: Diagnosis) -> str:
    """Return what the marks come to, in a few words."""
    if diagnosis.disagreements and not diagnosis.outliers:
        return "The rounds do not go together"
    match diagnosis.state:
        case "frame_only":
            may_act = diagnosis.nothing_chance <= LIKELIER
            return "Something may act" if may_act else "The frame may be all of it"
        case "several_causes":
            return sentence(diagnosis).partition(".")[0]
        case "unknown_cause":
            known = diagnosis.field_chance <= LIKELIER
            odds = odds_words(diagnosis.field_chance)
            return "Something is left over" if known else f"Something unknown acts, odds {odds}"
        case "one_cause" | "impossible":
            return f"It is most likely {called(diagnosis, diagnosis.explanations[0])}"
    return STATES[diagnosis.state].title


def sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict in a sentence or two."""
    match diagnosis.verdict:
        case "slip":
            return _slip(diagnosis)
        case "nothing_provable":
            return _nothing_provable(diagnosis)
        case "not_in_library":
            return _finding(diagnosis) if diagnosis.is_finding else _not_in_library(diagnosis)
        case "one_suspect":
            return _one_suspect(diagnosis)
    return _cannot_tell(diagnosis)


def _slip(diagnosis: Diagnosis) -> str:
    names = list(dict.fromkeys(outlier.called for outlier in diagnosis.outliers))
    shown = names[:MOST_NAMED]
    more = f" and {len(names) - len(shown)} more" if len(names) > len(shown) else ""
    which = "One reading disagrees" if len(diagnosis.outliers) == 1 else "Some readings disagree"
    against = {outlier.against for outlier in diagnosis.outliers}
    what = against.pop() if len(against) == 1 else "every explanation or with their repeats"
    what = "their repeats" if what == "its repeats" and len(diagnosis.outliers) > 1 else what
    return f"{which} with {what}: look at {', '.join(shown)}{more} again before anything else."


def _nothing_provable(diagnosis: Diagnosis) -> str:
    if diagnosis.is_good:
        good = "as good as these marks can show."
        said = f"Cured: the machine is now {good}"
        said = said if diagnosis.is_cured else f"The machine is {good}"
    elif diagnosis.nothing_chance > LIKELIER:
        said = "The marks show no cause: all that is wrong may be the frame's numbers."
    else:
        said = "Something may act, but the marks do not show what."
    return f"{said} With the frame fitted {_left(diagnosis, None)}."


def _finding(diagnosis: Diagnosis) -> str:
    """Return how the error falls, and what stays that no effect draws."""
    falls, unit = diagnosis.falls, diagnosis.unit
    share = "Most" if diagnosis.takes_most else "Part"
    which = f"{share} of it is {plainly(diagnosis.likely)}"
    if len(falls) > 1:
        count = {2: "Two", 3: "Three", 4: "Four"}.get(len(falls), len(falls))
        which = f"{count} things are wrong at once"
    steps = ", ".join(
        unit.bare(each) for each in [diagnosis.rms_before, *(f.rms for f in falls[:-1])]
    )
    said = f"{which}. The error falls from {steps} to {unit.worded(falls[-1].rms)} RMS"
    return f"{said}; a pattern of {unit.worded(diagnosis.pattern_mm)} stays that no effect draws."


def _not_in_library(diagnosis: Diagnosis) -> str:
    nearest = diagnosis.explanations[0] if diagnosis.explanations else None
    what, left = _unknown(diagnosis), _left(diagnosis, nearest)
    if nearest is None or not nearest.effects:
        return f"{what}. With the frame fitted {left}."
    return f"{what}. What comes nearest is {named(nearest.effects)}: with that {left}."


def _unknown(diagnosis: Diagnosis) -> str:
    """Return why the library does not explain the marks, without the full stop."""
    if diagnosis.disagreements:
        return "The rounds do not go together"
    if diagnosis.field_chance < UNKNOWN:
        return "Even the likeliest cause leaves more than noise would"
    does = "does" if diagnosis.field_chance > LIKELIER else "may do"
    return (
        f"The machine {does} something that the library does not know: the odds are "
        f"{odds_words(diagnosis.field_chance)}"
    )


def _left(diagnosis: Diagnosis, fitted: Together | None) -> str:
    """Return what an account leaves, or the frame alone, and what it would leave of noise."""
    sizes = fitted.rms_after if fitted else diagnosis.rms_before, (fitted or diagnosis).noise_rms
    rms, by_noise = map(diagnosis.unit.worded, sizes)
    return f"{rms} RMS is left; noise alone leaves {by_noise}"


def _one_suspect(diagnosis: Diagnosis) -> str:
    (first,), unit = diagnosis.explanations, diagnosis.unit
    causes = "The cause is" if len(first.effects) == 1 else "The causes are"
    return (
        f"{causes} most likely {named(first.effects)}: the odds are {odds_words(first.share)}. "
        f"The error falls from {unit.bare(diagnosis.rms_before)} to "
        f"{unit.worded(first.rms_after)} RMS; noise alone leaves {unit.worded(first.noise_rms)}."
    )


def _cannot_tell(diagnosis: Diagnosis) -> str:
    first, second, *others = diagnosis.explanations
    sure = [
        name
        for name in first.effects
        if all(name in each.effects for each in diagnosis.explanations)
    ]
    if sure:
        causes = "One cause is" if len(sure) == 1 else "Two causes are"
        causes = causes if len(sure) <= MOST_NAMED else "The causes are"
        said = f"{causes} most likely {named(sure)}. In addition: "
    else:
        said = "The marks cannot tell yet. Most likely it is "
    said += f"{_open(first, sure)}, at odds of {odds_words(first.share)}"
    if len({*first.effects, *second.effects} - {*sure}) <= MOST_NAMED:
        said += f", or {_open(second, sure)}, at {odds_words(second.share)}"
    else:
        others = [second, *others]
    are = "is" if len(others) == 1 else "are"
    return f"{said}. {len(others)} more {are} possible." if others else f"{said}."


def _open(together: Together, sure: Sequence[str]) -> str:
    """Return an account but for what is sure."""
    effects = [name for name in together.effects if name not in sure]
    return named(effects) if effects or not sure else "nothing else"


def named(effects: Sequence[str]) -> str:
    """Return effects by their nouns; by their number where there are many."""
    return plainly(effects) if len(effects) <= MOST_NAMED else f"{len(effects)} causes at once"


def called(diagnosis: Diagnosis, together: Together) -> str:
    """Return an explanation by the nouns of its effects."""
    is_unknown = diagnosis.verdict == "not_in_library" and diagnosis.field_chance > LIKELIER
    if is_unknown and not together.effects:
        return "only what no known effect draws"
    return plainly(together.effects)


MOST_ODDS = 100.0  # beyond which they were not checked
FINE_ODDS = 20.0  # beyond which they are said in tens


def odds_words(share: float) -> str:
    """Return how likely something is, as odds against all else."""
    odds = share / (1 - share) if share < 1 else inf
    if odds > MOST_ODDS:
        return f"over {MOST_ODDS:.0f} to 1"
    if odds < 1 / MOST_ODDS:
        return f"under 1 to {MOST_ODDS:.0f}"
    larger = max(odds, 1 / odds)
    if 1.25 <= larger < 1.75:
        sides = "3", "2"
    else:
        sides = f"{round(larger, -1 if larger > FINE_ODDS else 0):.0f}", "1"
    return " to ".join(sides if odds >= 1 else sides[::-1])


# Below the verdict: the likely causes, and what is odd, in a few rows or all.

FEW, SIZES, NOTES = 3, 4, 2  # accounts, sizes and sentences of a short answer
HEADER = ["cause", "odds", "leaves", "noise"]
COLUMNS = (
    "Odds: that this is right, against all else. Leaves: the RMS error once it is added. Noise: "
    "what reading errors alone would leave."
)
UNKNOWN_ADVICE = (
    "Does the sled hang on a ring or linkage? On two brackets it leans and errs in another way.",
    "Were the marks cut with these settings? If not, name the others"
    + to_do(" with --cut-with.", page=" in the form, as cut_with."),
    "Does y run the way the file says? Measure a mark again.",
)
MOST_ALIKE = 3
UNSEEN = (
    "Up to: by how much each may move the marks unseen, RMS. Taken up: the share of it that other "
    "numbers of the motors would make up for."
)


def short(diagnosis: Diagnosis) -> list[Part]:
    """Return the likeliest accounts in a few rows, the sizes of the first, and what is odd."""
    odd, notes = _odd(diagnosis), diagnosis.warnings[:NOTES]
    if diagnosis.is_finding:
        return filled(falls(diagnosis), Sentences(notes))
    shown = diagnosis.explanations[:FEW]
    rows = [[called(diagnosis, each), *_numbers(diagnosis, each)] for each in shown]
    sizes = [size.said for each in shown[:1] for size in each.parameters]
    if odd != UNKNOWN_ADVICE:
        odd = [*odd, *notes][:NOTES]
    return filled(
        Rows(HEADER, rows), Sentences(sizes if len(sizes) <= SIZES else (), "  "), Sentences(odd)
    )


def full(diagnosis: Diagnosis) -> list[Part]:
    """Return all that the marks say."""
    is_open = diagnosis.verdict == "cannot_tell"
    near = [
        f"{i + 1} and {j + 1} look alike: they move these marks alike to {how_near} RMS"
        for i, j, how_near in _alike(diagnosis)
        if j < SHOWN and is_open
    ]
    abouts = map(about, diagnosis.suspects[:SHOWN])
    return filled(
        falls(diagnosis),
        Sentences(_odd(diagnosis)),
        accounts(diagnosis),
        Sentences(near[:MOST_ALIKE]),
        Sentences([f"{noun}: {what}. To be sure: {how}" for noun, what, how in abouts]),
        paragraph(noise_sentence(diagnosis.noise.sigma, diagnosis.noise.source, diagnosis.unit)),
        *unseen(diagnosis),
        Sentences(diagnosis.warnings),
    )


def _odd(diagnosis: Diagnosis) -> Sequence[str]:
    """Return what is wrong with the marks, or what to ask where no cause explains them."""
    odd = [slip.sentence for slip in diagnosis.outliers] + [*diagnosis.disagreements]
    return odd or (UNKNOWN_ADVICE if diagnosis.verdict == "not_in_library" else ())


def falls(diagnosis: Diagnosis) -> Rows:
    """Return how the error falls, effect by effect, where causes are named beside what no effect
    draws.
    """
    unit = diagnosis.unit
    rows = [["the frame alone", unit.worded(diagnosis.rms_before)]]
    rows += [[f"+ {noun_of(each.effect)}", unit.worded(each.rms)] for each in diagnosis.falls]
    return Rows(["wrong at once", "leaves"], rows if diagnosis.is_finding else ())


def accounts(diagnosis: Diagnosis) -> Rows:
    """Return the accounts of the marks, the likeliest first, with the sizes of their effects."""
    rows: list[list[str]] = []
    for number, each in enumerate(diagnosis.explanations[:SHOWN], 1):
        rows.append([f"{number}. {called(diagnosis, each)}", *_numbers(diagnosis, each)])
        for size in each.parameters:
            wrong = [] if size.possible else ["impossible: something else looks like it"]
            rows += [[f"  {said}", "", "", ""] for said in (size.said, *wrong)]
    return Rows(["cause, with its 95 % interval", *HEADER[1:]], rows, note=COLUMNS)


def _numbers(diagnosis: Diagnosis, explanation: Together) -> list[str]:
    """Return the odds, what is left of the error, and what noise alone would leave."""
    sizes = (explanation.rms_after, explanation.noise_rms)
    return [_odds(diagnosis, explanation) or "-", *map(diagnosis.unit.worded, sizes)]


def _odds(diagnosis: Diagnosis, explanation: Together) -> str:
    """Return its odds; none where causes are named by what they predict."""
    return "" if diagnosis.is_finding else odds_words(explanation.share)


def _alike(diagnosis: Diagnosis) -> list[tuple[int, int, str]]:
    """Return which accounts move the marks alike to within the noise, and to what, the nearest
    first.
    """
    near = ranked(diagnosis.differences.items(), lambda pair: pair[1])
    return [
        (i, j, diagnosis.unit.worded(apart))
        for (i, j), apart in near
        if apart <= diagnosis.explanations[i].noise_rms
    ]


def about(effect: str) -> tuple[str, str, str]:
    """Return the noun of an effect, what it is, and how it is looked at directly."""
    words = next(each for each in every_effect() if each["name"] == effect)
    return words["noun"], words["summary"], words["remedy"]


def unseen(diagnosis: Diagnosis) -> list[Part]:
    """Return how large effects could still be that are no suspects, the largest first."""
    rooms = [room for room in diagnosis.could_hide if room.effect not in diagnosis.suspects]
    shares = {each.effect: each.hidden_share for each in diagnosis.ranking}
    rows = [
        [noun_of(room.effect), diagnosis.unit.worded(room.mm, 1), share_words(shares[room.effect])]
        for room in ranked(rooms, lambda room: -(room.mm or 0.0))
        if room.mm
    ]
    silent = [room.effect for room in rooms if room.mm is None]
    return filled(
        Rows(["may act too", "up to", "taken up"], rows[:SHOWN], note=UNSEEN),
        paragraph(f"These marks say nothing of {plainly(silent)}." if silent else ""),
    )


def noise_sentence(sigma: float, source: str, unit: Unit) -> str:
    """Return the noise of a reading [mm], where it is from, and which intervals hold for it."""
    return f"Noise of a reading: {unit.worded(sigma)} ({ORIGINS[source]}). Intervals: 95 %."


def share_words(share: float | None) -> str:
    """Return a share for people; a dash where no mark feels the cause."""
    return "-" if share is None else f"{100 * share:.0f} %"


# What a screen of the verdict says more.

MOST_CARDS = 6
ALIKE = 0.6  # share of the error that is left where a cause draws nearly the same


@dataclass(frozen=True)
class Suspect:
    """A likely account of the marks, and what is said of it."""

    title: str
    account: Together
    odds: str  # empty where there are none; "no": no real machine has such sizes
    facts: tuple[tuple[str, str], ...]  # a heading, and what stands behind it
    met: tuple[str, ...]  # which sizes real machines have, for each parameter


def suspects(diagnosis: Diagnosis) -> list[Suspect]:
    """Return the likeliest accounts."""
    shares = {each.effect: share_words(each.hidden_share) for each in diagnosis.ranking}
    cards = []
    for index, each in enumerate(diagnosis.explanations[:MOST_CARDS]):
        facts: list[tuple[str, str]] = []
        for name in each.effects:
            noun, what, how = about(name)
            facts += [
                (noun, what),
                ("taken up by other numbers of the motors", shares[name]),
                ("to be sure", how),
            ]
        before = diagnosis.rms_before
        share = max(0.0, 1 - (each.rms_after / before) ** 2) if before else 0.0
        facts.append(
            ("explains", f"{share_words(share)} of what the frame leaves: {_left(diagnosis, each)}")
        )
        near = [
            f"{plainly(diagnosis.explanations[i + j - index].effects)}, {how_near} RMS apart"
            for i, j, how_near in _alike(diagnosis)
            if index in (i, j)
        ]
        facts += [("looks like", "; ".join(near[:MOST_ALIKE]))] if near else []
        odds = _odds(diagnosis, each) if each.possible else "no"
        met = [range_met(size.range_said, possible=size.possible) for size in each.parameters]
        cards.append(Suspect(called(diagnosis, each), each, odds, tuple(facts), tuple(met)))
    return cards


def range_met(range_said: str, *, possible: bool) -> str:
    """Return which sizes real machines have; empty where no limit is known."""
    met = f"real machines have {range_said}" if range_said else ""
    return met if possible or not met else f"impossible: {met}; something else looks like it"


def less_likely(diagnosis: Diagnosis) -> str:
    """Return a sentence on the accounts that are no suspects for want of room; "" for none."""
    more = len(diagnosis.explanations) - MOST_CARDS
    return f"{more} more are less likely." if more > 0 else ""


def ruled_out(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """Return the effects that are no suspects, and why: those that would draw the same in a size
    that no real machine has, and how much all others leave.
    """
    if not diagnosis.explanations:
        return []
    tempting, others = [], []
    for each in diagnosis.ranking:
        absurd = [size for size in each.sizes if not size.possible and size.range_said]
        if each.effect in diagnosis.suspects:
            continue
        if absurd and each.rms_after < ALIKE * diagnosis.rms_before:
            why = f"{absurd[0].said}: real machines have {absurd[0].range_said}."
            tempting.append((noun_of(each.effect), why))
        else:
            others.append(each.rms_after)
    if not others:
        return tempting
    least = diagnosis.unit.worded(min(others))
    if len(others) == 1:
        return [*tempting, ("1 other", f"By itself it leaves {least}.")]
    return [*tempting, (f"{len(others)} others", f"Each by itself leaves {least} or more.")]


def same_for_all(title: str, value: float | None, unit: str) -> str:
    """Return that what errors might depend on is the same for all marks, or not known (None)."""
    if value is None:
        return f"{title} is not known"
    return f"{title} is {value:.5g} {unit} for all marks".replace("  ", " ")
