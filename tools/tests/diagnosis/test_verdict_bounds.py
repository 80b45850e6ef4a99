"""The verdict, a reading of the posterior: each line of its table on both sides of its bound."""

from types import SimpleNamespace

import numpy as np
import pytest
from plumb.diagnosis.diagnosis import MISFIT, NOTHING, UNKNOWN, is_silent, judge
from plumb.diagnosis.evidence import MovedRound
from plumb.diagnosis.posterior import LISTED, Account, Posterior
from plumb.diagnosis.priors import LIKELIER

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
