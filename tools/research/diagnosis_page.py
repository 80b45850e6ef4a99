"""Writes pictures and tables of docs/diagnosis.md into its marked parts; the rest is by hand.

Without options: tables of priors and of the verdict, the picture of evidence, five boards in
words. --gates takes records of evidence_gates.py for the tables before and after, and for the
picture of stated odds. --priors diagnoses boards again with other priors.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from changed_priors import priors_section
from diagnosis_pictures import evidence_picture, reliability_picture
from evidence_gates import Saved, tables_of
from five_boards import BOARDS, SEED, boards_section, lines_of
from gate_boards import board_of
from gate_kinds import KINDS
from gate_records import Record
from plumb.cli.arguments import count
from plumb.text.errors import InputError
from plumb.text.files import read_text, write_all
from prior_tables import priors_table, verdict_table

PAGE = "docs/diagnosis.md"
PICTURES = "docs/pictures/diagnosis"
COMMAND = "tools/research/diagnosis_page.py"
# Tables of the gates that the page shows, and their headings here.
CHOSEN = {
    "Gates": "Lines to reach",
    "If a field were called from other odds": "If a field were called from other odds",
    "Changes beyond chance": "What changed beyond chance",
    "What proposals promise": "What proposals promise",
    "After the best proposal": "After the best proposal",
    "Real sets": "Real sets",
}
SAG = "chain_sag"


def main(arguments: Sequence[str] | None = None) -> int:
    """Write what is asked for, and return the exit code: 0 done, 2 refused."""
    words = argparse.ArgumentParser(prog="diagnosis_page.py", description=__doc__)
    words.add_argument("--gates", metavar="FILE", nargs=2, type=Path, help="before, and after")
    words.add_argument("--priors", metavar="N", type=count, default=0, help="boards of a kind")
    words.add_argument("--folder", metavar="DIR", default=".", help="the project [.]")
    words.add_argument("--check", action="store_true", help="write nothing; 1 if words are stale")
    wanted = words.parse_args(arguments)
    root = Path(wanted.folder)
    try:
        if wanted.check:
            return _checked(read_text(root / PAGE))
        texts = {f"{PICTURES}/evidence.svg": _evidence()}
        parts = _of_today()
        if wanted.priors:
            parts["priors"] = priors_section(wanted.priors)
        if wanted.gates:
            before, after = map(Saved.read, wanted.gates)
            parts["gates"] = gates_section(before, after)
            texts[f"{PICTURES}/reliability.svg"] = reliability_picture(
                [Record.of(each) for each in after.records]
            )
        texts[PAGE] = with_parts(read_text(root / PAGE), parts)
        (root / PICTURES).mkdir(parents=True, exist_ok=True)
        write_all({str(root / name): text.encode() for name, text in texts.items()})
    except (InputError, OSError) as error:
        print(f"diagnosis_page.py: {error}", file=sys.stderr)
        return 2
    return 0


def _of_today() -> dict[str, str]:
    """Return the parts that follow from the tree alone."""
    return {
        "verdict": verdict_table(),
        "table of priors": priors_table(),
        "boards": boards_section(),
    }


def _checked(page: str) -> int:
    if with_parts(page, _of_today()) == page:
        return 0
    print(f"{PAGE}: stale; run .venv/bin/python {COMMAND}")
    return 1


def with_parts(page: str, parts: Mapping[str, str]) -> str:
    """Return a page with other text between the marks of some parts."""
    for name, text in parts.items():
        begin, end = f"<!-- {COMMAND}: {name} -->\n", f"<!-- end of {name} -->"
        before, _, rest = page.partition(begin)
        _, marked, after = rest.partition(end)
        if not marked:
            raise InputError(PAGE, f"has no marks for {name}")
        page = f"{before}{begin}\n{text}\n\n{end}{after}"
    return page


def gates_section(before: Saved, after: Saved) -> str:
    """Return the chosen tables, before and after."""
    whole = tables_of([before, after])
    tables = dict(re.findall(r"^## (.+?)\n\n(.+?)(?=\n\n## |\Z)", whole, re.DOTALL | re.MULTILINE))
    known = {(each["kind"], each["index"]) for each in before.records}
    both = Counter(each["kind"] for each in after.records if (each["kind"], each["index"]) in known)
    said = lines_of(
        f"Boards of each of {len(both)} kinds: {_range(both.values())}, seed {after.seed}; "
        "the same boards before and after. Shares are in percent, with their standard errors. "
        "Bold: changed by more than two of them, board by board. *Known*: settings that know the "
        "chain's sag and stretch. *Stock*: published settings, on a machine that stretches and "
        "whose chains are often too long."
    )
    tables["Changes beyond chance"] = _without_times(tables["Changes beyond chance"])
    shown = [f"### {CHOSEN[name]}\n\n{tables[name]}" for name in CHOSEN if name in tables]
    return "\n\n".join([said, *shown])


def _without_times(table: str) -> str:
    """Return the rows that do not say how busy the computer was; the first table has its time."""
    return "\n".join(line for line in table.splitlines() if "| CPU s |" not in line)


def _range(counts: Collection[int]) -> str:
    least, most = min(counts, default=0), max(counts, default=0)
    return f"{least}" if least == most else f"{least} to {most}"


def _evidence() -> str:
    """Return the picture of the second of the five boards: sag, or a leaning frame."""
    hidden = board_of(KINDS["known/one-9"], 3, seed=SEED).hidden
    truth = hidden.parameters[f"{SAG}.weight_ratio_squared"]
    return evidence_picture(BOARDS[1].inputs(), ((), ("frame_lean",), (SAG,)), truth)


if __name__ == "__main__":
    sys.exit(main())
