"""`plumb send`: streams a program to the machine, or writes its numbers."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from threading import Event, Thread
from time import monotonic

from plumb.cli.arguments import add_port
from plumb.cli.output import say_failure
from plumb.cli.screen import Bar, bar, free_name, next_step, sentences
from plumb.diary.file import PROGRAM, keep, program_entry, write_and_keep
from plumb.firmware.settings import refuse_other_numbers, refuse_other_origin
from plumb.grid.cut_with import form_of
from plumb.job.dry_run import program_in, refuse_other_files
from plumb.job.time_left import TimeLeft, timetable
from plumb.line.memory import Written, kept_before, lines_for, read_numbers
from plumb.line.port import LostError, SerialPort, port_for
from plumb.line.progress import SAID_PAUSED, waits_in
from plumb.line.sender import (
    PAUSED,
    Reached,
    RefusedError,
    Sender,
    Status,
    StoppedError,
    cleaned,
    plain,
)
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.files import read_text
from plumb.text.values import time_text

NOWHERE = Status("", (0.0, 0.0, 0.0))
SETTINGS = (
    "machine.toml",
    "groundcontrol.ini",
    "webcontrol.json",
)  # that a program may be sent with
SHOWN = 20  # changed numbers in the answer
RENEWED = 0.5  # [s] between two looks in a terminal
SAID = 60.0  # [s] between two lines elsewhere


def run(arguments: argparse.Namespace) -> int:
    """Send it, print what the machine says, and return the exit code."""
    what = arguments.what
    numbers = _numbers(what, back=arguments.undo)
    text = _program(what) if numbers is None else []
    marks_of = None if arguments.force else _cut_with(what, text)
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port, said=_say)
        sender.await_start()
        if marks_of:
            name = marks_of.file.name if marks_of.file else what
            refuse_other_numbers(marks_of, read_numbers(sender), file=name)
        if numbers is not None:
            if not (arguments.undo or arguments.force):
                refuse_other_origin(read_settings(what), read_numbers(sender), file=what)
            written = _write(sender, what, numbers, back=arguments.undo)
            _print_written(arguments, written)
            return 0
        return _stream_and_note(sender, arguments, text)
    finally:
        port.close()


def _numbers(what: str, *, back: bool) -> list[str] | None:
    """Return the numbers of a machine.toml, or those before it was sent; None for a program."""
    if back:
        return kept_before(what)
    if not what.endswith(".toml"):
        return None
    refuse_other_files(what, read_text(what))
    return lines_for(read_settings(what), what)


def _program(what: str) -> list[str]:
    """Return the lines of a program, or a single line; all is read before the line is opened, which
    resets the board. InputError for what cannot be sent.
    """
    looks_like_file = what.endswith((".nc", ".gcode", ".ngc")) or "/" in what
    is_file = looks_like_file or Path(what).exists()
    lines = program_in(what) if is_file else [what]
    list(cleaned(lines))
    return lines


def _cut_with(what: str, text: Sequence[str]) -> MachineSettings | None:
    """Return what the marks of a program are to be cut with, as their form says; None if nothing
    does.
    """
    form = form_of("\n".join(text), what)
    if form is None or not Path(form).is_file():
        return None
    measurements = read_form(form, sheet=(0.0, 0.0), known=known_effects()).measurements
    file_round = measurements.rounds[0]
    if file_round.changed:
        why = f"was made for {file_round.changed}, which has changed since"
        raise InputError(form, why, remedy="make form and program again, or send with --force")
    return file_round.cut_with


def _write(sender: Sender, path: str, lines: list[str], *, back: bool) -> tuple[Written, str]:
    """Write numbers; the file that keeps the numbers before."""
    written, kept, failure = write_and_keep(sender, path, lines, back=back)
    say_failure(failure)
    return written, kept


def _say(line: str) -> None:
    """Print what the machine says, on lines that fit the screen."""
    print(sentences([line], mark=""))


def _print_written(arguments: argparse.Namespace, done: tuple[Written, str]) -> None:
    written, kept = done
    rows = [f"${number}: {old:g} -> {new:g}" for number, (old, new) in written.changed.items()]
    more = len(rows) - SHOWN
    rows = rows[:SHOWN] + ([f"and {more} more"] if more > 0 else [])
    print("The machine holds the numbers; each was read back.")
    print(sentences(rows) if rows else "- none had to change")
    if arguments.undo:
        print(sentences([f"The numbers that it took back are in {kept}."], mark=""))
    else:
        print(sentences([f"The old numbers are in {kept}."], mark=""))
        port = ["--port", arguments.port] if arguments.port else []
        undo = ["send", "--undo", arguments.what, *port]
        print(next_step("To bring them back:", undo))


def _print_resume(arguments: argparse.Namespace, reached: Reached) -> None:
    """Say how far a program came, and how to go on."""
    job = Path(arguments.what)
    if not job.is_file():
        return
    print(sentences([f"All before line {reached.line} of {job.name} is done."], mark=""))
    known = [job.with_name(name) for name in SETTINGS if job.with_name(name).is_file()]
    port = ["--port", arguments.port] if arguments.port else []
    if not known:
        print(next_step("Read the machine's numbers:", ["read", *port, "-o", SETTINGS[0]]))
    settings = str(known[0]) if known else SETTINGS[0]
    rest = free_name("rest", ".nc")
    resume = ["resume", str(job), settings, "--line", str(reached.line), "-o", rest]
    print(next_step("To go on from there:", resume))


class _Attendant:
    """Attends to a program: Ctrl-C holds it, and a program that waits is asked about."""

    def __init__(self, followed: _Followed, text: Sequence[str], reached: Reached) -> None:
        """`text`: the program with its comments, which say what its pauses are for."""
        self._reached = reached
        self.pressed = Event()  # Ctrl-C
        self._followed = followed
        self._waits = {wait.lines: wait.do for wait in waits_in(text)}
        self._done = 0
        self._waits_now = False
        self._question: Question | None = None

    def answered(self, done: int) -> None:
        """Note that the machine took this many lines."""
        self._done = done
        self._reached.note(done)
        self._followed.answered(done)

    def hear(self, line: str) -> None:
        """Print what the machine says, and note that it waits."""
        if line == SAID_PAUSED:
            self._waits_now = True
        else:
            _say(line)

    def attend(self, sender: Sender) -> None:
        """Hold, ask, and do what is answered; called again and again."""
        waits = self._question is not None or self._waits_now
        self._followed.look(pauses=waits or (sender.status or NOWHERE).state == PAUSED)
        if self._question:
            self._settle(sender, self._question)
        elif self._waits_now:
            self._waits_now = False
            self._ask(f"The program waits: {self._waits.get(self._done) or 'it does not say why'}.")
        elif self.pressed.is_set():
            self.pressed.clear()
            sender.hold()
            self._ask("The machine holds.")

    def _ask(self, why: str) -> None:
        self._followed.clear()
        self._question = Question(f"{why} Enter goes on; s and Enter stops: ")

    def _settle(self, sender: Sender, question: Question) -> None:
        """Do what was answered. Ctrl-C, and an input that has ended, stop the machine."""
        if question.answer is None and not self.pressed.is_set():
            return
        self._question = None
        gives_up = self.pressed.is_set() or question.is_unheard
        if gives_up or (question.answer or "").lower().startswith("s"):
            self._reached.end()
            sender.stop()
        sender.go_on()


class _Followed:
    """Says how far a program is: line, percent and the time that is left.

    In a terminal that is a line that renews itself; elsewhere a line now and then.
    """

    def __init__(self, text: Sequence[str], left: TimeLeft | None) -> None:
        """`left` is None for a single line, and where no dry run says how long it takes."""
        self._left = left
        self._numbers = [number for number, line in enumerate(text, start=1) if plain(line)]
        self._total = len(text)
        self._line = 0
        self._bar = Bar("sending", patience=0.5)
        self._shown_at = self._said_at = monotonic()

    def answered(self, done: int) -> None:
        """Note that the machine took this many lines."""
        self._line = self._numbers[done - 1]

    def look(self, *, pauses: bool) -> None:
        """Note the time, and show how far the program is; called again and again."""
        now = monotonic()
        if self._left is None:
            return
        self._left.note(now, self._line, pauses=pauses)
        if pauses or not self._line:
            return
        if now - self._shown_at >= RENEWED:
            self._shown_at = now
            self._bar.show(self._left.share, self._words())
        if now - self._said_at >= SAID and not sys.stderr.isatty():
            self._said_at = now
            print(f"{self._words()}, {100 * self._left.share:.0f} % done", file=sys.stderr)

    def _words(self) -> str:
        left = time_text(self._left.seconds) if self._left else ""
        return f"line {self._line} of {self._total}, {left} left"

    def clear(self) -> None:
        """Leave nothing behind."""
        self._bar.clear()


def _time_left(sender: Sender, numbers: dict[int, float], text: Sequence[str]) -> TimeLeft | None:
    if sum(1 for _ in cleaned(text)) < 2:
        return None
    place = (sender.status or NOWHERE).place
    times = timetable(numbers, text, place, progress=bar("working out how long it takes"))
    return TimeLeft(times, ahead=sender.ahead) if times else None


def _stream_and_note(sender: Sender, arguments: argparse.Namespace, text: Sequence[str]) -> int:
    """Stream a program; that goes into the diary of the program's folder, if there is such."""
    code, what = 1, arguments.what
    try:
        code = _stream(sender, arguments, text)
    finally:
        is_file = Path(what).is_file()
        entry = program_entry(
            Path(what).name if is_file else what, list(cleaned(text)), whole=code == 0
        )
        say_failure(keep(what if is_file else ".", PROGRAM, entry, begin=False))
    return code


def _stream(sender: Sender, arguments: argparse.Namespace, text: Sequence[str]) -> int:
    """Stream a program, and wait until the place is kept; Ctrl-C holds the machine where it is."""
    # They also tell the sender how long the motors hold, and how far ahead answers come.
    numbers = read_numbers(sender)
    lines = list(cleaned(text))
    reached = Reached(sender, text)
    followed = _Followed(text, _time_left(sender, numbers, text))
    attendant = _Attendant(followed, text, reached)
    sender.attend, sender.said = attendant.attend, attendant.hear
    before = signal.signal(signal.SIGINT, lambda *_: attendant.pressed.set())
    try:
        sender.stream(lines, answered=attendant.answered)
        sender.await_rest(attended=True)
    except StoppedError:
        print("The machine has stopped. It knows where it is; the rest was not sent.")
        _print_resume(arguments, reached)
        return 1
    except RefusedError:
        reached.end()
        sender.brake()
        sender.await_rest()
        _print_resume(arguments, reached)
        raise
    except LostError:
        _print_resume(arguments, reached)
        raise
    finally:
        followed.clear()
        signal.signal(signal.SIGINT, before)
    if len(lines) > 1:
        print(f"{len(lines)} lines were sent, and the machine took each.")
    return 0


# The arguments of `plumb send`.

EXAMPLES = (
    "plumb send pocket.nc",
    'plumb send "G0 X0 Y0"',
)
EXIT = "Exit: 0 all was done; 1 stopped after Ctrl-C; 2 refused, or no machine."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb send`."""
    parser.add_argument(
        "what",
        metavar="FILE|LINE",
        help="a program to run; a machine.toml, whose numbers are written and read back; or a "
        "single line",
    )
    add_port(parser)
    parser.add_argument(
        "--undo",
        action="store_true",
        help="write back the numbers that the machine had before you sent FILE",
    )
    parser.add_argument(
        "--force",
        action="store_true",
        help="send marks, or numbers, though the machine holds others than those that they were "
        "made for",
    )


# A question in the terminal; whoever asks goes on working, and looks for the answer meanwhile.

STDIN = 0  # not sys.stdin: its lock would be held at the end of the program


class Question:
    """A question whose answer is a line."""

    def __init__(self, text: str) -> None:
        self.answer: str | None = None  # None: not yet; empty: just Enter
        self.is_unheard = False  # nobody can answer: the input has ended
        print(text, end="", flush=True)
        Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        typed = b""
        while not typed.endswith(b"\n"):
            came = os.read(STDIN, 1)
            if not came:
                self.is_unheard = True
                print()
                break
            typed += came
        self.answer = typed.decode(errors="replace").strip()
