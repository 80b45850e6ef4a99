"""Tables of what the diagnosis believes before the marks, and of the odds of its verdict."""

from __future__ import annotations

from collections.abc import Sequence

from plumb.diagnosis import answer, every_machine, posterior, priors, readings
from plumb.fit.problem import PRIORS, USUAL_SIGMA
from tables import markdown_table

STRETCH, SAG = priors.USUAL.values()


def verdict_table() -> str:
    """Return the table of verdicts with their odds."""
    rows = [
        ("a reading is off", f"more than {_odds(readings.DOUBTED)}", "`slip`",
         "it is read again in a minute"),
        ("a field acts too, or a round moved", f"more than {_odds(answer.UNKNOWN)}",
         "`not_in_library`", "an unknown cause costs a wrong cure"),
        ("noise leaves as much as the best account does",
         f"a chance below {100 * answer.MISFIT:g} %", "`not_in_library`",
         "even the best account is wrong then"),
        ("no effect acts", f"more than {_odds(answer.NOTHING)}", "`nothing_provable`",
         "a cause that is named is believed"),
        ("fewest accounts that hold all others together", _odds(posterior.LISTED),
         "`one_suspect` if it is a single account, else `cannot_tell`",
         "as every interval of the lab holds"),
        ("what every machine has is not as the settings say",
         f"densities of {every_machine.ONE_IN:g} to 1", "it is named in the account",
         "as for a cause that is named"),
    ]  # fmt: skip
    return markdown_table(("if", "odds", "verdict", "because"), rows)


def priors_table() -> str:
    """Return the table of priors by their names in the code."""
    rows = [
        ("`ACTS`", f"{priors.ACTS:g}", "chance that an effect acts", "a guess"),
        ("`UNUSUAL`", f"{priors.UNUSUAL:g}", "that stretch, sag or pitch is far from usual",
         "a guess"),
        ("`ALL`", f"{priors.ALL:g}", "odds of all effects at once against none", "a guess"),
        ("`FIELD`", f"{priors.FIELD:g}", "odds of a field against none", "a guess"),
        ("`FIELD_SPREADS`", f"{_list(priors.FIELD_SPREADS)} mm", "a of the field", "a guess"),
        ("`FIELD_WIDTHS`", _list(priors.FIELD_WIDTHS), "w of the field, in halves of what the "
         "marks span", "a guess"),
        ("`OUTLIER`", f"{priors.OUTLIER:g}", "odds that a reading is off, over all readings",
         "a guess"),
        ("`OUTLIER_SPREADS`", f"{_list(priors.OUTLIER_SPREADS)} mm", "l of a shift",
         "a tick, a hook, exchanged digits"),
        ("`MOVED`", f"{priors.MOVED:g}", "odds that a later round moved, over all rounds and ways",
         "a guess"),
        ("`TURNED`", f"{priors.TURNED:g}", "odds that all y errors have the wrong sign", "a guess"),
        ("`STATED_SPREAD`", f"{priors.STATED_SPREAD:g}", "spread of log s around what is stated",
         "people know their noise to a quarter"),
        ("`UNSTATED_SPREAD`", f"{priors.UNSTATED_SPREAD:g}", f"the same around {USUAL_SIGMA:g} mm",
         "tapes in general"),
        ("`USUAL`, stretch", _usual(STRETCH), "typical sizes on every machine; the second spread "
         "where the settings have it", "makers and owners state 4.1e-6 to 8.1e-6 1/N"),
        ("`USUAL`, sag", _usual(SAG), "the same", "chains differ by a tenth in weight"),
        ("`PITCH_CHANCE`, `PITCH_SPREAD`", f"{priors.PITCH_CHANCE:g}, {priors.PITCH_SPREAD:g}",
         "that chains are a little off, and by how much", "ANSI allows 0.26 % too long"),
        ("`PITCH_CORRELATION`", f"{priors.PITCH_CORRELATION:g}", "of both chains' pitches where "
         "they are far from usual", "one machine: 0.35 and 0.36 %"),
        ("`PRIORS` of the frame", ", ".join(f"{name} {spread:g}" for name, spread in
         PRIORS.items()), "standard deviations [mm, rad]", "a tape, a pulled chain"),
    ]  # fmt: skip
    return markdown_table(("name", "value", "says", "source"), rows)


def _odds(chance: float) -> str:
    odds = chance / (1 - chance)
    return f"{odds:.3g} to 1" if odds >= 1 else f"1 to {1 / odds:.3g}"


def _list(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values)


def _usual(usual: priors.Usual) -> str:
    return f"{usual.mean:g} +- {usual.spread:g}, {usual.known:g}"
