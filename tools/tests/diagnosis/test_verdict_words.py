"""The verdict: each line of its table on both sides of its bound, and its words."""

from types import SimpleNamespace

import numpy as np
import pytest
from plumb.diagnosis.diagnosis import MISFIT, NOTHING, UNKNOWN, is_silent, judge
from plumb.diagnosis.evidence import MovedRound
from plumb.diagnosis.posterior import LISTED, Account, Posterior
from plumb.diagnosis.priors import LIKELIER
from plumb.text.values import MM
from plumb.words.verdict import odds_words, sentence

TINY = 1e-12


def judged(shares, monkeypatch, *, field=TINY, moved=TINY, misfit=0.5, outliers=()):
    """The verdict on accounts with these shares of what is clean; field and moved of the whole."""
    unknown = field + moved
    accounts = tuple(
        Account(effects, effects, np.log(share * (1 - unknown)), np.log(field / len(shares)))
        for effects, share in sorted(shares.items(), key=lambda each: -each[1])
    )
    posterior = Posterior(
        frame=None,
        felt=("a", "b", "c"),
        accounts=accounts,
        moved=((MovedRound(1, "", None), np.log(moved)),),
        outliers=np.full(3, -np.inf),
        turned=None,
        noise=None,
        noises=None,
        with_fields=SimpleNamespace(spot=None),
    )
    monkeypatch.setattr("plumb.diagnosis.diagnosis.misfit_chance", lambda fitted, stated: misfit)
    monkeypatch.setattr("plumb.diagnosis.diagnosis.nearest", lambda frame, posterior: ("a",))
    fit = SimpleNamespace(rms=1.0)  # takes nothing of the error
    readings = SimpleNamespace(
        posterior=posterior, frame=fit, outliers=outliers, explained=lambda account: fit
    )
    return judge(readings, None)


def both(bound):
    """A little on both sides of a bound, with whether it is beyond."""
    return [(bound + 0.01, True), (bound - 0.01, False)]


def test_an_outlier_comes_before_all_else(monkeypatch):
    said = judged({("a",): 1.0}, monkeypatch, field=0.9, outliers=("one",))
    assert said.verdict == "slip" and said.listed == () and said.best.effects == ("a",)


@pytest.mark.parametrize(("chance", "is_beyond"), both(UNKNOWN))
@pytest.mark.parametrize("what", ["field", "moved"])
def test_an_unknown_cause_is_named_once_it_is_likely_enough(what, chance, is_beyond, monkeypatch):
    said = judged({("a",): 0.99, (): 0.01}, monkeypatch, **{what: chance})
    assert said.verdict == ("not_in_library" if is_beyond else "one_suspect")


@pytest.mark.parametrize(("chance", "is_beyond"), both(MISFIT))
def test_an_error_larger_than_noise_ever_leaves_is_the_last_guard(chance, is_beyond, monkeypatch):
    said = judged({("a",): 0.99, (): 0.01}, monkeypatch, misfit=chance)
    assert said.verdict == ("one_suspect" if is_beyond else "not_in_library")
    assert said.best.effects == ("a",)  # and what pays is added all the same


@pytest.mark.parametrize(("chance", "is_beyond"), both(NOTHING))
def test_nothing_is_named_where_nothing_is_likely_enough(chance, is_beyond, monkeypatch):
    said = judged({("a",): 1 - chance, (): chance}, monkeypatch)
    assert is_silent(chance) == is_beyond
    if is_beyond:
        assert (said.verdict, said.listed) == ("nothing_provable", ())
    else:
        # It is not hidden: that nothing acts stays an account.
        assert said.verdict == "cannot_tell"
        assert [each.account.effects for each in said.listed] == [("a",), ()]


@pytest.mark.parametrize(("chance", "is_beyond"), both(LIKELIER))
def test_effects_more_likely_than_not_are_used_though_not_named(chance, is_beyond, monkeypatch):
    said = judged({("a",): chance, (): 1 - chance}, monkeypatch)
    assert (said.verdict, said.listed) == ("nothing_provable", ())
    assert said.best.effects == (("a",) if is_beyond else ())


@pytest.mark.parametrize(("share", "is_beyond"), both(LISTED))
def test_one_account_stands_alone_once_it_holds_nearly_all(share, is_beyond, monkeypatch):
    said = judged({("a",): share, ("b",): 1 - share}, monkeypatch)
    assert said.verdict == ("one_suspect" if is_beyond else "cannot_tell")
    assert len(said.listed) == (1 if is_beyond else 2) and said.best.effects == ("a",)


LONG = "chain_plane", "chain_zero", "sheet_skew"  # effects with the longest nouns
PAIR = LONG[:2]


def account(*effects, share=0.5):
    return SimpleNamespace(effects=effects, rms_after=0.5, noise_rms=0.4, share=share)


def said_of(verdict, *explanations, nothing=0.7, field=0.0, disagreements=()):
    said = sentence(
        SimpleNamespace(
            verdict=verdict,
            unit=MM,
            explanations=explanations,
            rms_before=2.0,
            noise_rms=0.42,
            nothing_chance=nothing,
            field_chance=field,
            disagreements=disagreements,
            is_finding=False,
            is_good=False,
        )
    )
    assert len(said.split()) <= 40, said
    return said


def test_one_suspect_is_named_with_odds_the_fall_and_the_noise():
    assert said_of("one_suspect", account("chain_sag", share=0.98)) == (
        "The cause is most likely chain sag: the odds are 50 to 1. The error falls from 2.00 to "
        "0.50 mm RMS; noise alone leaves 0.40 mm."
    )
    assert said_of("one_suspect", account(*PAIR)).startswith(
        "The causes are most likely chains that are not parallel to the sheet and chains that "
    )
    assert "3 causes at once" in said_of("one_suspect", account(*LONG))


def test_of_several_the_two_likeliest_are_named():
    rivals = account("chain_sag", share=0.6), account(share=0.3), account("tape_scale", share=0.05)
    assert said_of("cannot_tell", *rivals[:2]) == (
        "The marks cannot tell yet. Most likely it is chain sag, at odds of 3 to 2, or the frame "
        "alone, at 1 to 2."
    )
    assert said_of("cannot_tell", *rivals).endswith("1 to 2. 1 more is possible.")
    assert said_of("cannot_tell", *rivals, rivals[2]).endswith("2 more are possible.")


@pytest.mark.parametrize("sure", [(), ("motor_level",), ("motor_level", "chain_sag")])
def test_no_first_sentence_names_more_than_two_causes(sure):
    said = said_of("cannot_tell", account(*sure, *PAIR), account(*sure, "sheet_skew"))
    assert "sheet edges" not in said and said.endswith("1 more is possible.")
    assert "sheet edges" in said_of(
        "cannot_tell", account(*sure, "tape_scale"), account(*sure, LONG[2])
    )


def test_an_unknown_cause_is_named_with_its_odds():
    does = "The machine does something that the library does not know: the odds are 4 to 1."
    assert said_of("not_in_library", field=0.8).startswith(f"{does} With the frame fitted 2.00 mm")
    assert said_of("not_in_library", account("chain_sag"), field=0.3) == (
        "The machine may do something that the library does not know: the odds are 1 to 2. What "
        "comes nearest is chain sag: with that 0.50 mm RMS is left; noise alone leaves "
        "0.40 mm."
    )
    misfit = said_of("not_in_library", account(), field=0.01)
    assert misfit.startswith("Even the likeliest cause leaves more than noise would.")
    assert "odds" not in misfit and "0.50 mm RMS is left" in misfit
    apart = said_of("not_in_library", field=0.9, disagreements=("b.toml does not go with ...",))
    assert apart.startswith("The rounds do not go together. With the frame fitted")


@pytest.mark.parametrize(
    ("share", "words"),
    [
        (1.0, "over 100 to 1"),
        (0.991, "over 100 to 1"),
        (0.985, "70 to 1"),
        (0.95, "19 to 1"),
        (0.6, "3 to 2"),
        (0.5, "1 to 1"),
        (0.4, "2 to 3"),
        (0.25, "1 to 3"),
        (0.02, "1 to 50"),
        (0.001, "under 1 to 100"),
    ],
)
def test_odds_are_as_fine_as_they_are_known(share, words):
    assert odds_words(share) == words


@pytest.mark.parametrize(
    ("count", "words"), [(1, "One reading disagrees"), (2, "Some readings disagree")]
)
def test_the_sentence_counts_the_slips(count, words):
    names = [f"mark {name}" for name in "AB"[:count]]
    slips = [SimpleNamespace(called=name, against="every explanation") for name in names]
    said = sentence(SimpleNamespace(verdict="slip", outliers=slips))
    assert said.startswith(words) and "A" in said
