"""What an entry of the diary says in a sentence, on a screen and in a terminal."""

from __future__ import annotations

from plumb.diary.entries import HOME, NUMBERS, PROGRAM
from plumb.diary.file import Entry


def noted(entry: Entry) -> str:
    """What was done, for people; fits have a table."""
    content = entry.content
    if entry.kind == NUMBERS:
        count, machine = len(content["changed"]), content["machine"]
        numbers = f"{count} number{'' if count == 1 else 's'}"
        if content.get("back"):
            return f"took {machine} back: {numbers} as before it"
        return f"{numbers} changed by {machine}"
    if entry.kind == PROGRAM:
        end = "" if content["whole"] else ", not to its end"
        return f"sent {content['program']}{end}"
    if entry.kind == HOME:
        return f"home mark {content['mark']} {'kept' if content['kept'] else 'used'}"
    return str(content.get("sentence", entry.kind))
