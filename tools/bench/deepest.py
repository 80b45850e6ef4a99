"""Searches the lines that take the most stack on the Mega: tools/bench/run --deepest.

A candidate is a few lines of the dialogues in the tree, in a drawn order with drawn pauses, on a
machine that has every effect. Each is played on the simulated Mega, which says how deep its stack
was. What is deepest is changed a little and played again. The deepest of all is written as
test/vm/dialogues/deepest.nc, which the bench plays each time.
"""

import random
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import board
from played import play, player

SEED = 20
DRAWN, CHANGED, KEPT = 400, 400, 12  # candidates drawn freely, then changed; the best so far
AT_ONCE = 2
MOST_STEPS = 6
PAUSES = (0, 0.02, 0.1, 0.3)  # [s] between two lines
MOVES = 40  # the queue has room for 16: a line waits in the middle of being done
QUICK = ("!", "~", "^H", "?", "^0", "^1", "^2", "^3", "^4")
DIALOGUES = board.ROOT / "test/vm/dialogues"
RESULT = DIALOGUES / "deepest.nc"
HEAD = """\
; The lines that took the most stack, of {tries} that a search tried on a machine with every effect:
; written by tools/bench/run --deepest. What comes back does not matter here.
"""

Steps = list[str]


def search() -> int:
    """Write the deepest dialogue; returns 0."""
    program, lines, drawn = player(), known_lines(), random.Random(SEED)
    best: list[tuple[int, Steps]] = []
    with ThreadPoolExecutor(AT_ONCE) as pool:
        for tries in range(0, DRAWN + CHANGED, 2 * AT_ONCE):
            batch = [
                one_more(drawn, lines, best if tries >= DRAWN else []) for _ in range(2 * AT_ONCE)
            ]
            names = [f"deepest-{place}.nc" for place in range(len(batch))]
            depths = pool.map(lambda name, steps: depth(program, name, steps), names, batch)
            best = sorted([*best, *zip(depths, batch, strict=True)], reverse=True)[:KEPT]
            print(f"\rbench: {tries + len(batch)} tried, deepest {best[0][0]} bytes", end="")
    print()
    RESULT.write_text(HEAD.format(tries=DRAWN + CHANGED) + text_of(best[0][1]), encoding="utf-8")
    return 0


def known_lines() -> Steps:
    """Return every step that a dialogue in the tree sends, once each."""
    sent: set[str] = set()
    for folder in ("test/dialogues", "test/vm/dialogues"):
        for path in sorted((board.ROOT / folder).glob("*.nc")):
            text = path.read_text(encoding="latin-1")
            sent.update(re.findall(r"^-> [ -~]*$", text, re.MULTILINE))
    return sorted(sent)


def one_more(drawn: random.Random, lines: Steps, best: list[tuple[int, Steps]]) -> Steps:
    """Return a candidate: drawn freely, or one of the best with a step more, less or other."""
    if not best:
        return [a_step(drawn, lines) for _ in range(drawn.randint(1, MOST_STEPS))]
    steps = list(drawn.choice(best)[1])
    place = drawn.randrange(len(steps))
    change = drawn.choice(("more", "less", "other", "other"))
    if change == "more" and len(steps) < 2 * MOST_STEPS:
        steps.insert(place, a_step(drawn, lines))
    elif change == "less" and len(steps) > 1:
        del steps[place]
    else:
        steps[place] = a_step(drawn, lines)
    return steps


def a_step(drawn: random.Random, lines: Steps) -> str:
    """Return a line, a quick character, a pause, or moves that come faster than they are made."""
    kind = drawn.choices(("line", "quick", "pause", "moves"), (6, 2, 2, 2))[0]
    if kind == "line":
        return drawn.choice(lines)
    if kind == "moves":
        return f"~~ stream {MOVES} {drawn.choice(('0.3', 'z 0.3', 'round 0.3'))}"
    return f">> {drawn.choice(QUICK)}" if kind == "quick" else f"~~ wait {drawn.choice(PAUSES)}"


def text_of(steps: Steps) -> str:
    """Return the dialogue of a candidate: its steps, on a machine with every effect at a known
    place.
    """
    return "\n".join(["~~ include every_effect.inc", "~~ stack", *steps, "~~ wait 1", ""])


def depth(program: Path, name: str, steps: Steps) -> int:
    """Bytes of stack that a candidate took."""
    folder = board.ROOT / ".build/vm/deepest"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "every_effect.inc").write_bytes((DIALOGUES / "every_effect.inc").read_bytes())
    (folder / name).write_text(text_of(steps), encoding="utf-8")
    said = re.search(r"^stack (\d+)$", play(program, folder, name).stdout, re.MULTILINE)
    return int(said[1]) if said else 0
