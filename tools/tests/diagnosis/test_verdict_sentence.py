"""A verdict has forty words at most, however many effects are to be named."""

import re
from contextlib import nullcontext
from types import SimpleNamespace

import pytest
from plumb.diagnosis.answer import verdict_sentence
from plumb.text.errors import read_on_page


def account(*effects, possible=True, share=None):
    return SimpleNamespace(effects=effects, possible=possible, rms_after=0.5, share=share)


LONG = "chain_plane", "chain_zero", "sheet_skew"  # effects with the longest nouns
PAIR = LONG[:2]


@pytest.mark.parametrize(
    ("verdict", "explanations", "words"),
    [
        ("one_suspect", [account(*LONG)], "at once: chains that are not parallel"),
        ("one_suspect", [account(*LONG, possible=False)], "it: 3 effects at once. Look"),
        (
            "cannot_tell",
            [account(*PAIR, possible=False)] * 6,
            "it: 2 effects at once; or 5 more. Look",
        ),
        ("cannot_tell", [account(*PAIR)] * 12, "right; or 11 more."),
        ("cannot_tell", [account("chain_sag")] * 12, "chain sag; chain sag; or"),
        ("cannot_tell", [account(*LONG, share=s) for s in (0.6, 0.3, 0.1)], "and 2 more."),
        (
            "cannot_tell",
            [account("chain_stretch", name, share=0.5) for name in ("tape_scale", "chain_pitch")]
            + [account("chain_sag", share=0.1)],
            "; next, chain stretch and chains too long or too short (1 to 1), and 1 more.",
        ),
        (
            "cannot_tell",
            [account("chain_sag", share=0.5), account(share=0.3)],
            "Something may be missing: the fitted frame leaves 2.00 mm RMS. Most likely: "
            "chain sag (odds 1 to 1); next, the frame alone (1 to 2).",
        ),
        ("not_in_library", [], "more than noise."),
        ("not_in_library", [account(*LONG)] * 3, "3 effects at once; or 2 more could be it"),
        ("not_in_library", [account(*PAIR)] * 6, "2 effects at once; or 5 more could be it"),
        ("not_in_library", [account("chain_sag")] * 12, "chain sag; or 8 more could be it"),
    ],
)
@pytest.mark.parametrize("reader", [read_on_page, nullcontext], ids=["page", "terminal"])
def test_a_verdict_has_forty_words_at_most(verdict, explanations, words, reader):
    diagnosis = SimpleNamespace(
        verdict=verdict, explanations=explanations, rms_before=2.0, chance=0.4, library_fits=True
    )
    with reader():
        said = re.sub(r" \(\w+_\w+\)", "", verdict_sentence(diagnosis))
    assert len(said.split()) <= 40 and words in said, said


def test_of_many_slips_the_first_are_named():
    slips = [SimpleNamespace(name=f"{i} - 5", against=f"{i % 2}") for i in range(30)]
    said = verdict_sentence(SimpleNamespace(verdict="slip", outliers=slips))
    assert len(said.split()) <= 40 and "0 - 5, 1 - 5," in said and " more again before" in said
