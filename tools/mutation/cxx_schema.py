"""One C++ text that holds many mutants: a switch at run time chooses which of them lives."""

import re

from cxx_sites import Constexpr, Site

COMMENT = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
SPACE = re.compile(rb"\s+")


def mutated(text: bytes, site: Site) -> bytes:
    """The text with one mutant in place of the original."""
    start, end, new = site.edit
    return text[:start] + new + (b";" if is_removed(site) else b"") + text[end:]


def is_removed(site: Site) -> bool:
    """Whether the mutant is a statement that is left out."""
    return site.is_statement and site.edit[:2] == (site.start, site.end)


def with_switches(text: bytes, sites: dict[int, Site], words: list[Constexpr]) -> bytes:
    """The text with all `sites` in it, by their numbers. No line moves, so errors say where."""
    pieces: dict[tuple[int, int], list[int]] = {}
    for number, site in sites.items():
        pieces.setdefault((site.start, site.end), []).append(number)
    instead = {}
    for word in words:
        first, last = word.declaration
        if any(first <= start and end <= last for start, end in pieces):
            instead[word.start, word.end] = word.instead
    spans = sorted([*pieces, *instead], key=lambda span: (span[0], -span[1]))
    return _rendered(text, 0, len(text), spans, pieces, instead, sites)


def _rendered(text, start, end, spans, pieces, instead, sites) -> bytes:
    """The text from `start` to `end`, whose `spans` all lie in it."""
    out, at, index = [], start, 0
    while index < len(spans):
        span = spans[index]
        inner = index + 1
        while inner < len(spans) and spans[inner][0] < span[1]:
            inner += 1
        out.append(text[at : span[0]])
        if span in instead:
            out.append(instead[span])
        else:
            body = _rendered(text, *span, spans[index + 1 : inner], pieces, instead, sites)
            out.append(_switched(text, body, {each: sites[each] for each in pieces[span]}))
        at, index = span[1], inner
    return b"".join([*out, text[at:end]])


def _switched(text: bytes, body: bytes, sites: dict[int, Site]) -> bytes:
    """An expression or a statement, and its mutants."""
    first = next(iter(sites.values()))
    if first.is_statement:
        test = b" && ".join(b"!MUTANT(%d)" % number for number in sites)
        return b"{ if (%s) { %s } }" % (test, body)
    is_condition = any(site.is_condition for site in sites.values())
    kind = b"bool" if is_condition else b""
    choices = [
        b"%s(%d) ? %s(%s) : "
        % (
            b"MUTANT_KEPT" if site.is_kept else b"MUTANT",
            number,
            kind,
            one_line(alternative(text, site)),
        )
        for number, site in sites.items()
    ]
    return b"(%s%s(%s))" % (b"".join(choices), kind, body)


def alternative(text: bytes, site: Site) -> bytes:
    """The expression with the mutant in it."""
    start, end, new = site.edit
    return text[site.start : start] + new + text[end : site.end]


def one_line(text: bytes) -> bytes:
    """Code without comments and line ends."""
    return SPACE.sub(b" ", COMMENT.sub(b" ", text)).strip()


def shown(text: bytes, site: Site) -> tuple[str, str]:
    """Original and mutant for people: their lines, or the whole expression if it has many."""
    start = text.rfind(b"\n", 0, site.start) + 1
    end = text.find(b"\n", site.end)
    end = len(text) if end < 0 else end
    first, last, new = site.edit
    original = one_line(text[start:end])
    changed = one_line(text[start:first] + new + text[last:end])
    return original.decode(), "(removed)" if is_removed(site) else changed.decode()
