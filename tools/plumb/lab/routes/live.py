"""The live line: how the machine is, all the time; and Stop and Hold, which wait for no request.

A browser sends six requests at a time, and more wait for those: this line is none of them.
"""

from __future__ import annotations

import asyncio
import json
import re
from time import monotonic

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from plumb.lab.editor import Editor, editor_of
from plumb.lab.guard import PROTOCOL
from plumb.lab.machine_line import MachineLine, line_of
from plumb.lab.routes.machine import MachineAnswer, machine
from plumb.text.errors import InputError

router = APIRouter(tags=["machine"])
LOOK_EVERY = 0.1  # [s] between two looks at the machine
SAID_EVERY = 1.0  # [s] between two messages at most, so that a page notices silence
PRESS = re.compile(r"(stop|hold) (\d{1,9})")  # what is pressed, and the number of the press


@router.websocket("/live")
async def live(websocket: WebSocket) -> None:
    """Says how the machine is when something changes, and each second; answers what is pressed.

    It says, too, which tab edits.
    """
    line, editor = line_of(websocket), editor_of(websocket)
    tab = websocket.query_params.get("tab", "")[:64]
    await websocket.accept(subprotocol=PROTOCOL)
    editor.opened(tab)
    try:
        await _say(websocket, line, editor)
    finally:
        editor.closed(tab)


async def _say(websocket: WebSocket, line: MachineLine, editor: Editor) -> None:
    """Says what changes, until the page has left."""
    answers: list[str] = []
    gone = asyncio.create_task(_heard(websocket, line, answers))
    said: MachineAnswer | None = None
    said_editor: str | None = None
    said_at = 0.0
    while not gone.done():
        now = machine(line)
        if editor.tab != said_editor:
            said_editor = editor.tab
            await websocket.send_text(json.dumps({"editor": said_editor}))
        for answer in _taken(answers):
            await websocket.send_text(answer)
        if now != said or monotonic() - said_at >= SAID_EVERY:
            await websocket.send_text(now.model_dump_json())
            said, said_at = now, monotonic()
        await asyncio.wait([gone], timeout=LOOK_EVERY)


def _taken(answers: list[str]) -> list[str]:
    taken = answers[:]
    answers.clear()
    return taken


async def _heard(websocket: WebSocket, line: MachineLine, answers: list[str]) -> None:
    """Does what is pressed; ends when the page has left. Whatever else it sends is ignored."""
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
        line.stop() if what == "stop" else line.hold()
    except InputError as error:
        return str(error)
    return ""
