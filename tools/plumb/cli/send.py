"""The progress of a program that is being sent: its line, its share, and the time left."""

import argparse
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import nullcontext, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event
from time import monotonic
from typing import Annotated

from plumb.cli.arguments import add_shared
from plumb.cli.output import say_failure
from plumb.cli.screen import Bar, Prompt, bar, free_name, next_step, print_json, sentences
from plumb.diary.file import PROGRAM, keep, program_entry, write_and_keep
from plumb.firmware.settings import refuse_other_numbers, refuse_other_origin
from plumb.firmware.telemetry import telemetry_in, warnings
from plumb.job.dry_run import TimeLeft, program_in, refuse_other_files, timetable
from plumb.line.memory import WrittenNumbers, kept_before, lines_for, read_numbers
from plumb.line.port import LostError, SerialPort, port_for
from plumb.line.sender import (
    PAUSED,
    SAID_PAUSED,
    RefusedError,
    Sender,
    Status,
    StoppedError,
    SureLines,
    cleaned,
    plain,
    waits_in,
)
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.settings import MachineSettings, form_of, read_settings
from plumb.text.answers import meant
from plumb.text.errors import InputError
from plumb.text.files import ReadOnce, read_text
from plumb.text.values import time_text

NOWHERE = Status("", (0.0, 0.0, 0.0))
RENEWED = 0.5  # [s] between two looks in a terminal
SAID = 60.0  # [s] between two lines elsewhere


class Followed:
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


def time_left(sender: Sender, numbers: dict[int, float], text: Sequence[str]) -> TimeLeft | None:
    """Return what is left of a program, by a dry run with the machine's numbers; None for a single
    line, and where there is no dry run.
    """
    if sum(1 for _ in cleaned(text)) < 2:
        return None
    place = (sender.status or NOWHERE).place
    times = timetable(numbers, text, place, progress=bar("working out how long it takes"))
    return TimeLeft(times, ahead=sender.ahead) if times else None


# `plumb send`: streams a program to the machine, or writes its numbers.


SETTINGS = (
    "machine.toml",
    "groundcontrol.ini",
    "webcontrol.json",
)  # that a program may be sent with
EARLY = 3  # reports after which a line is surely the operator's, and none of the program's
STOPS = ("s", "stop")  # in place of Enter
SHOWN = 20  # changed numbers in the answer


@dataclass
class SendAnswer:
    """Outcome of sending."""

    lines: Annotated[int, meant("Of the program, or numbers, without comments.")] = 0
    stopped_at: Annotated[
        int | None, meant("First line of the file that is not done; null: all was done.")
    ] = None
    said: Annotated[list[str], meant("What the machine said by itself.")] = field(
        default_factory=list
    )
    changed: Annotated[
        dict[int, tuple[float, float]], meant("Numbers before and after, by $-number.")
    ] = field(default_factory=dict)
    kept: Annotated[str | None, meant("The file of the numbers before.")] = None
    warnings: Annotated[list[str], meant("What deserves a look after a program.")] = field(
        default_factory=list
    )

    def hear(self, line: str) -> None:
        """Note what the machine says, and print it on lines that fit the screen."""
        self.said.append(line)
        print(sentences([line], mark=""))


def run(arguments: argparse.Namespace) -> int:
    """Send it, print what the machine says, and return the exit code."""
    answer = SendAnswer()
    with redirect_stdout(sys.stderr) if arguments.json else nullcontext():
        is_done = _send(arguments, answer)
    if arguments.json:
        print_json(answer)
    return int(not is_done)


def _send(arguments: argparse.Namespace, answer: SendAnswer) -> bool:
    """Send it and note what comes of it; whether all was done."""
    what = ReadOnce(arguments.what)
    numbers = _numbers(what, back=arguments.undo) if not arguments.more else None
    text = _program(what, arguments.more) if numbers is None else []
    marks_of = None if arguments.force else _cut_with(what, text)
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port, said=answer.hear)
        sender.await_start()
        if marks_of:
            name = marks_of.file.name if marks_of.file else what
            refuse_other_numbers(marks_of, read_numbers(sender), file=name)
        if numbers is not None:
            if not (arguments.undo or arguments.force):
                refuse_other_origin(read_settings(what), read_numbers(sender), file=what)
            back = arguments.undo
            written, kept, failure = write_and_keep(sender, Path(what), numbers, back=back)
            say_failure(failure)
            answer.lines, answer.kept = len(numbers), str(kept)
            answer.changed = dict(written.changed)
            _print_written(arguments, written, kept)
            return True
        answer.lines = sum(1 for _ in cleaned(text))
        answer.stopped_at = _stream_and_note(sender, arguments, text, answer)
        return answer.stopped_at is None
    finally:
        port.close()


def _numbers(what: str, *, back: bool) -> list[str] | None:
    """Return the numbers of a machine.toml, or those before it was sent; None for a program."""
    if back:
        return kept_before(Path(what))
    if not what.endswith(".toml"):
        return None
    refuse_other_files(what, read_text(what))
    return lines_for(read_settings(what), what)


def _program(what: str, more: Sequence[str]) -> list[str]:
    """Return the lines of a program, or the lines that were typed; all is read before the line is
    opened, which resets the board. InputError for what cannot be sent.
    """
    files = [word for word in (what, *more) if _is_file(word)]
    if files and more:
        why = "goes alone; several lines can go together"
        raise InputError(files[0], why, remedy=f"plumb send {files[0]}")
    lines = program_in(what, say=say_failure) if files else [what, *more]
    list(cleaned(lines))
    return lines


def _is_file(what: str) -> bool:
    endings = (".nc", ".gcode", ".ngc", ".toml")
    return what.endswith(endings) or "/" in what or Path(what).exists()


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


def _print_written(arguments: argparse.Namespace, written: WrittenNumbers, kept: Path) -> None:
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


def _watched(sender: Sender, numbers: dict[int, float]) -> list[str]:
    """Print what deserves a look, before the line is closed: the next program that opens it resets
    the board, which then has forgotten what it saw.
    """
    telemetry = telemetry_in("\n".join(sender.ask("B30")))
    if telemetry is None:
        return []
    said = list(warnings(telemetry, rate_hz=int(numbers.get(69, 100))))
    if said:
        print(sentences(said))
    return said


def _print_resume(arguments: argparse.Namespace, reached: SureLines) -> None:
    """Say how far a program came, and how to go on."""
    job = Path(arguments.what)
    if not job.is_file():
        return
    far = f"All before line {reached.line} of {job.name} is done."
    print(sentences([far if reached.done else f"Nothing of {job.name} is surely done."], mark=""))
    known = [job.with_name(name) for name in SETTINGS if job.with_name(name).is_file()]
    port = ["--port", arguments.port] if arguments.port else []
    if not known:
        print(next_step("Read the machine's numbers:", ["read", *port, "-o", SETTINGS[0]]))
    settings = str(known[0]) if known else SETTINGS[0]
    rest = free_name("rest", ".nc")
    resume = ["resume", str(job), settings, "--line", str(reached.line), "-o", rest]
    print(next_step("To go on from there:" if reached.done else "To begin again:", resume))


class _Attendant:
    """Attends to a program: Ctrl-C holds it, and a program that waits is asked about."""

    def __init__(
        self,
        followed: Followed,
        text: Sequence[str],
        reached: SureLines,
        said: Callable[[str], None],
    ) -> None:
        """`text`: the program with its comments, which say what its pauses are for; `said`: called
        with what the machine says.
        """
        self._reached = reached
        self._said = said
        self.pressed = Event()  # Ctrl-C
        self._followed = followed
        self._waits = {wait.lines: wait.do for wait in waits_in(text)}
        self._done = 0
        self._waits_now = False
        self._has_slipped_in = False
        self._question: Prompt | None = None
        self._asked_at = 0  # reports that had come then

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
            self._said(line)

    def attend(self, sender: Sender) -> None:
        """Hold, ask, and do what is answered; called again and again."""
        waits = self._question is not None or self._waits_now
        self._followed.look(pauses=waits or (sender.status or NOWHERE).state == PAUSED)
        if self._question:
            self._settle(sender, self._question)
        elif self._has_slipped_in and sender.has_answered:
            self._has_slipped_in = False
            self._ask(sender, "The machine waits.")
        elif self._waits_now:
            self._waits_now = False
            why = self._waits.get(self._done) or "it does not say why"
            self._ask(sender, f"The program waits: {why}.")
        elif self.pressed.is_set():
            self.pressed.clear()
            sender.hold()
            self._ask(sender, "The machine holds.")

    def _ask(self, sender: Sender, why: str) -> None:
        self._asked_at = sender.reports
        self._followed.clear()
        self._question = Prompt(f"{why} Enter goes on; s and Enter stops: ")

    def _slip_in(self, sender: Sender, typed: str) -> None:
        """Send what was typed to a machine that waits; once that is answered, ask again."""
        try:
            sender.slip_in(typed)
        except InputError as error:
            print(error)
        self._has_slipped_in = True

    def _settle(self, sender: Sender, question: Prompt) -> None:
        """Do what was answered. Ctrl-C, and an input that has ended, stop the machine."""
        is_early = sender.reports - self._asked_at < EARLY
        if not self.pressed.is_set() and (question.answer is None or is_early):
            return
        self._question = None
        gives_up, typed = self.pressed.is_set() or question.is_unheard, question.answer or ""
        if gives_up or typed.lower() in STOPS:
            self._reached.end()
            sender.stop()
        if typed:
            self._slip_in(sender, typed)
        else:
            sender.go_on()


def _stream_and_note(
    sender: Sender, arguments: argparse.Namespace, text: Sequence[str], answer: SendAnswer
) -> int | None:
    """Stream a program; that goes into the diary of the program's folder, if there is such. The
    line where it stopped; None: it did not.
    """
    is_whole, what = False, arguments.what
    try:
        stopped_at = _stream(sender, arguments, text, answer)
        is_whole = stopped_at is None
    finally:
        is_file = Path(what).is_file()
        name = Path(what).name if is_file else "; ".join([what, *arguments.more])
        entry = program_entry(name, list(cleaned(text)), whole=is_whole)
        say_failure(keep(what if is_file else ".", PROGRAM, entry, begin=False))
    return stopped_at


def _stream(
    sender: Sender, arguments: argparse.Namespace, text: Sequence[str], answer: SendAnswer
) -> int | None:
    """Stream a program, and wait until the place is kept; Ctrl-C holds the machine where it is.
    The line where it stopped; None: it did not.
    """
    # They also tell the sender how long the motors hold, and how far ahead answers come.
    numbers = read_numbers(sender)
    lines = list(cleaned(text))
    reached = SureLines(sender, text)
    followed = Followed(text, time_left(sender, numbers, text))
    attendant = _Attendant(followed, text, reached, answer.hear)
    sender.attend, sender.said = attendant.attend, attendant.hear
    before = signal.signal(signal.SIGINT, lambda *_: attendant.pressed.set())
    try:
        sender.stream(lines, answered=attendant.answered)
        sender.await_rest(attended=True)
    except StoppedError:
        print("The machine has stopped. It knows where it is; the rest was not sent.")
        answer.warnings = _watched(sender, numbers)
        _print_resume(arguments, reached)
        return reached.line
    except RefusedError:
        reached.end()
        sender.brake()
        sender.await_rest()
        answer.warnings = _watched(sender, numbers)
        _print_resume(arguments, reached)
        raise
    except LostError:
        _print_resume(arguments, reached)
        raise
    finally:
        followed.clear()
        signal.signal(signal.SIGINT, before)
    if len(lines) > 1:
        answer.warnings = _watched(sender, numbers)
        print(f"{len(lines)} lines were sent, and the machine took each.")
    return None


# The arguments of `plumb send`.

EXAMPLES = ("plumb send pocket.nc", 'plumb send "G0 X0 Y0"')
EXIT = "Exit: 0 all was done; 1 stopped after Ctrl-C; 2 refused, or no machine."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb send`."""
    parser.add_argument(
        "what",
        metavar="FILE|LINE",
        help="a program to run; a machine.toml, whose numbers are written and read back; or a line",
    )
    parser.add_argument(
        "more", metavar="LINE", nargs="*", help="more lines, sent without another reset"
    )
    add_shared(parser, "--port")
    parser.add_argument(
        "--undo",
        action="store_true",
        help="write back the numbers that the machine had before you sent FILE",
    )
    parser.add_argument(
        "--force",
        action="store_true",
        help="send marks or numbers even if the machine does not hold those they were made for",
    )
    add_shared(parser, "--json")
