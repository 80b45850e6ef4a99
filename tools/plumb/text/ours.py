"""Whether a file was written by the lab, so that the next run may replace it."""

from __future__ import annotations

import re
from pathlib import Path

PRACTICE_MARKS = b"# Marks of a virtual machine, cut for practice.\n"
DEMO_MARKS = b"# Marks of a virtual machine, read by the demo.\n"
# How our text files begin: a machine.toml, a grid's program, that of proposed marks, a job's
# outline, a program for known holes, the page of the bench, the marks of a demo or of practice,
# a report.
BEGINNINGS = (
    b"# Settings of one hanging machine, for plumb.",
    b"(Plumb calibration grid)",
    b"(Plumb: ",
    b"(plumb: ",
    b"# How often the diagnosis is right",
    b"# How often the closed loop finds what is hidden",
    DEMO_MARKS,
    PRACTICE_MARKS,
    b"<!doctype html>\n<!-- A report of Plumb. -->",
)
MAKER = "Plumb"  # what a picture says of the program that drew it
# Where the forms of a picture say it.
PICTURES = (
    (b"\x89PNG", b"Software\0Plumb"),
    (b"<?xml", b"<dc:title>Plumb</dc:title>"),
    (b"%PDF", b"/Creator (Plumb)"),
)
LINES = re.compile(rb"(\$\d+=[-+.\de]+\n)+")  # for the machine
CLIENT_FILES = ("-groundcontrol.ini", "-webcontrol.json")  # how the names of clients' files end


def picture_metadata(form: str) -> dict[str, str | None]:
    """What a picture says of itself; no date, so that the same data give the same bytes."""
    words: dict[str, dict[str, str | None]] = {
        "png": {"Software": MAKER},
        "svg": {"Creator": MAKER, "Date": None},
        "pdf": {"Creator": MAKER, "CreationDate": None},
    }
    return words[form]


def is_ours(path: Path) -> bool:
    """Whether the lab wrote this file, or nobody wrote anything into it."""
    content = path.read_bytes()
    if not content or content.startswith(BEGINNINGS) or LINES.fullmatch(content):
        return True
    if any(content.startswith(form) and said in content for form, said in PICTURES):
        return True
    return path.name.endswith(CLIENT_FILES) and b"maslow settings" in content.lower()
