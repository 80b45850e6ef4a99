"""The line to the machine: connect it, send to it, hold it, stop it, read and write its numbers."""

import asyncio
import json
import re
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import monotonic
from typing import Annotated, Literal

from fastapi import APIRouter, Body, WebSocket, WebSocketDisconnect
from pydantic import BaseModel, Field, TypeAdapter

from plumb.diary.file import write_and_keep
from plumb.firmware.settings import (
    called,
    digest_of_numbers,
    machine_of_numbers,
    number_said,
    setting_said,
)
from plumb.lab.broken_cut import end_virtual
from plumb.lab.guard import PROTOCOL
from plumb.lab.machine_line import MachineLine, Port, TheLine, line_of, ports, refuse_foreign_fit
from plumb.lab.project import Project, save_choices
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.line.bootloader import hex_file, program_in, version_in
from plumb.line.memory import WrittenNumbers, kept_before, lines_for
from plumb.line.sender import Sender
from plumb.line.worker import LineState
from plumb.settings import machine_toml, read_settings
from plumb.text.errors import InputError, on_page
from plumb.vm.garage import RANDOM, VirtualOwner
from plumb.vm.practice import SECRET, Secret
from plumb.words import Heading
from plumb.words import machine as words

router = APIRouter(tags=["machine"])
MACHINE = "machine.toml"
SILENT = 2.0  # [s] a machine reports five times a second


@dataclass(frozen=True, kw_only=True)
class MachineAnswer(LineState):
    """The state of the line and the machine."""

    kind: Literal["none", "board", "virtual"]
    name: str
    subject: str  # what it is called where a sentence begins
    doing: str  # what it does, in a few words
    at_work: Heading  # how a screen begins while it cuts
    silent_s: int  # since the machine last reported; 0 while it does
    numbers_digest: str  # of those that it last listed; empty if it listed none
    brought: str  # our firmware, which can be written to a board; empty if there is none
    written: float | None  # share of it, while it is written


class VirtualRequest(BaseModel):
    """A virtual machine to try: what it hides, drawn by the seed; how fast it works."""

    hides: Literal["random", "nothing"] = "random"
    noise: float = Field(default=0.4, ge=0, le=10)  # [mm] of the tape
    seed: int = Field(default=0, ge=0, le=2**31)
    speed: float = Field(default=100.0, ge=1, le=1000)


class NumbersRequest(BaseModel):
    """The file of the project whose numbers go to the machine.

    `replaces`: the digest of the machine's numbers that the owner gives up for those of the file.
    """

    file: str = MACHINE
    replaces: str = Field(default="", max_length=64)


class NumbersAnswer(BaseModel):
    """Numbers that were written and read back."""

    said: str
    changed: list[tuple[str, str]]  # the name of each that is another now, and what it is
    kept: str  # the file with the numbers before
    failure: str  # why the diary says nothing of it; empty if it does


@router.get("/machine")
def machine(line: TheLine) -> MachineAnswer:
    """Return how the machine is now; the live line says it all the time."""
    state = line.state
    kind: Literal["none", "board", "virtual"] = "virtual" if line.virtual else "board"
    return MachineAnswer(
        **vars(state),
        kind=kind if line.name else "none",
        name=line.name,
        subject=line.subject,
        doing=words.doing(state, line.subject),
        at_work=words.at_work(state),
        silent_s=int(line.silence) if line.silence >= SILENT else 0,
        numbers_digest=digest_of_numbers(state.numbers) if state.numbers else "",
        brought=_brought(),
        written=line.written,
    )


@cache
def _brought() -> str:
    with suppress(InputError):
        return version_in(program_in(hex_file()))
    return ""


@router.get("/machine/ports")
def list_ports() -> list[Port]:
    """Return the serial ports of this computer."""
    return ports()


@router.post("/machine/board")
def connect_board(
    port: Annotated[str, Body(embed=True, max_length=200)], line: TheLine
) -> MachineAnswer:
    """Connect a board."""
    line.connect_board(port)
    return machine(line)


@router.post("/machine/firmware")
def write_firmware(line: TheLine) -> MachineAnswer:
    """Begin to write our firmware to the board; its settings and chain lengths stay."""
    line.flash()
    return machine(line)


@router.post("/machine/virtual")
def connect_virtual(request: VirtualRequest, project: TheProject, line: TheLine) -> MachineAnswer:
    """Switch on a virtual machine; the folder keeps its secret."""
    hides = (RANDOM,) if request.hides == "random" else ()
    secret = Secret(request.seed, hides=hides)
    owner = VirtualOwner(secret.garage, noise=request.noise)
    project.save({SECRET: secret.text.encode()}, read={})
    end_virtual(project)  # with the sheet of the machine before
    line.connect_virtual(owner, speed=request.speed)
    return machine(line)


@router.post("/machine/disconnect")
def disconnect(line: TheLine) -> MachineAnswer:
    """Let go of the line."""
    line.disconnect()
    return machine(line)


@router.post("/machine/line")
def send_line(text: Annotated[str, Body(embed=True, max_length=120)], line: TheLine) -> list[str]:
    """Send a single line, and what the machine says to it."""
    return line.do(lambda sender: sender.ask(text))


@router.post("/machine/hold")
async def hold(line: TheLine) -> MachineAnswer:
    """Stop along the path, without leaving it. No thread has to be free for it."""
    line.worker.hold()
    return machine(line)


@router.post("/machine/go-on")
def go_on(line: TheLine) -> MachineAnswer:
    """Go on after a hold."""
    line.worker.go_on()
    return machine(line)


@router.post("/machine/stop")
async def stop(line: TheLine) -> MachineAnswer:
    """Stop, and give up what was being done. No thread has to be free for it."""
    line.worker.stop()
    return machine(line)


@router.post("/machine/settings")
def read_into_project(project: TheProject, line: TheLine) -> ProjectAnswer:
    """Read the machine's numbers into a machine.toml, and open it; another machine.toml stays."""
    text = machine_toml(machine_of_numbers(line.read_numbers())).encode()
    # Marks that were cut with the old settings need them as they were.
    name = project.place_for(text, "machine", ".toml")
    save_choices(
        project,
        lambda choices: choices.model_copy(update={"settings": name}),
        files={name: text},
        read={name: project.digest(name)},
    )
    return show(project)


@router.post("/machine/numbers")
def write_numbers(request: NumbersRequest, project: TheProject, line: TheLine) -> NumbersAnswer:
    """Write the numbers of a file, read them back, and keep the old numbers in a file."""
    path = project.path(request.file)
    lines = lines_for(read_settings(path), request.file)
    refuse_foreign_fit(project, line, request.file, replaces=request.replaces)
    return _written(line, project, request.file, lines)


@router.post("/machine/undo")
def undo(request: NumbersRequest, project: TheProject, line: TheLine) -> NumbersAnswer:
    """Write back the numbers that the machine had before a file was written to it."""
    lines = kept_before(project.path(request.file))
    return _written(line, project, request.file, lines, back=True)


def _written(
    line: MachineLine, project: Project, file: str, lines: list[str], *, back: bool = False
) -> NumbersAnswer:
    path = project.path(file)

    def write(sender: Sender) -> tuple[WrittenNumbers, Path, str]:
        # With other numbers the reported place is another, which looks like a move.
        sender.await_rest()
        try:
            return write_and_keep(sender, path, lines, back=back)
        finally:
            with suppress(InputError):  # what went wrong with the numbers is said
                line.worker.read_numbers(sender)

    written, kept, failure = line.do(write)
    if line.virtual:
        line.virtual.settings = machine_of_numbers(line.state.numbers)
    changed = []
    for number, (before, after) in written.changed.items():
        name, unit = called(number)
        said = f"{setting_said(number, after, unit)}, was {number_said(before)}"
        changed.append((name or "a setting", said))
    said = words.what_was_sent(len(changed), Path(kept).name, back=back)
    return NumbersAnswer(said=said, changed=changed, kept=Path(kept).name, failure=failure)


# The live line: how the machine is, all the time; and Stop and Hold, which wait for no request.
#
# A browser sends six requests at a time, and more wait for those: this line is none of them.

LOOK_EVERY = 0.1  # [s] between two looks at the machine
SAID_EVERY = 1.0  # [s] between two messages at most, so that a page notices silence
PRESS = re.compile(r"(stop|hold) (\d{1,9})")  # what is pressed, and the number of the press


@router.websocket("/live")
async def live(websocket: WebSocket) -> None:
    """Says how the machine is when something changes, and each second; answers what is pressed."""
    line = line_of(websocket)
    await websocket.accept(subprotocol=PROTOCOL)
    answers: list[str] = []
    gone = asyncio.create_task(_heard(websocket, line, answers))
    said: MachineAnswer | None = None
    said_at = 0.0
    while not gone.done() and not _is_sent_away(websocket):
        now = machine(line)
        while answers:
            await websocket.send_text(answers.pop(0))
        if now != said or monotonic() - said_at >= SAID_EVERY:
            await websocket.send_text(TypeAdapter(MachineAnswer).dump_json(now).decode())
            said, said_at = now, monotonic()
        await asyncio.wait([gone], timeout=LOOK_EVERY)
    if gone.cancel():  # a phone that was sent away: what it presses is no longer heard
        await websocket.close()


def _is_sent_away(websocket: WebSocket) -> bool:
    """Return whether the phone at the other end is not paired any more."""
    is_phone = websocket.scope.get("phone") is not None
    return is_phone and websocket.app.state.phones.of(websocket.scope["key"]) is None


async def _heard(websocket: WebSocket, line: MachineLine, answers: list[str]) -> None:
    """Do what is pressed; ends when the page has left. Whatever else it sends is ignored."""
    try:
        while True:
            press = PRESS.fullmatch(await websocket.receive_text())
            if press:
                answers.append(
                    json.dumps({"press": int(press[2]), "error": _press(line, press[1])})
                )
    except (WebSocketDisconnect, KeyError, RuntimeError):
        return


def _press(line: MachineLine, what: str) -> str:
    """Stop or hold; why that cannot be, empty if it is done."""
    try:
        line.worker.stop() if what == "stop" else line.worker.hold()
    except InputError as error:
        return on_page(error)
    return ""
