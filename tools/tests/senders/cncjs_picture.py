"""Takes the picture of CNCjs that docs/senders.md shows.

    PYTHONPATH=tools/tests .venv/bin/python tools/tests/senders/cncjs_picture.py [FOLDER]

It starts a virtual machine and CNCjs, opens CNCjs in Chromium, cuts the example's pocket, and
writes docs/pictures/cncjs.png. Look at it before you commit it.
"""

import json
import shutil
import sys
import tempfile
from pathlib import Path

from cncjs_program import BAUD, ROOT, Cncjs
from grbl_board import Board, until
from playwright.sync_api import Page, sync_playwright

PICTURES = ROOT / "docs/pictures"
POCKET = ROOT / "docs/example/pocket.nc"
SIZE = {"width": 1280, "height": 840}
QUIET = ["--no-sandbox", "--disable-background-networking", "--disable-sync", "--no-first-run"]
# WebGL draws the program; without a graphics card in software.
QUIET += ["--enable-unsafe-swiftshader", "--use-angle=swiftshader"]
PATIENCE_MS = 60_000  # of a busy computer
ZOOMS = 4  # steps out, so that all of the pocket is in view
# The panels that show a machine at work; the others say nothing about this firmware.
RIGHT = ["axes", "gcode"]
LEFT = ["connection", "console"]


def chosen(port: str) -> dict:
    """The state that CNCjs keeps in the browser once port, rate and panels were chosen."""
    grbl = {"controller": {"type": "Grbl"}, "port": port, "baudrate": BAUD}
    panels = {
        side: {"show": True, "widgets": widgets}
        for side, widgets in (("primary", LEFT), ("secondary", RIGHT))
    }
    state = {"workspace": {"container": panels}}
    state["widgets"] = {"connection": {**grbl, "autoReconnect": True}}
    return {"version": "1.11.5", "state": state}


def open_page(page: Page, cncjs: Cncjs, port: str) -> None:
    """Open CNCjs's page as on a later visit."""
    page.set_default_timeout(PATIENCE_MS)
    kept = json.dumps(json.dumps(chosen(port)))
    page.add_init_script(f"localStorage.setItem('cnc', localStorage.getItem('cnc') || {kept});")
    page.goto(cncjs.server.site)
    page.get_by_text("Idle", exact=True).first.wait_for()


def cut(page: Page, cncjs: Cncjs) -> None:
    """Load the pocket and run it to its end."""
    cncjs.run(POCKET.read_text().splitlines())
    until(cncjs.ended, "the pocket is cut")
    page.get_by_text("Idle", exact=True).first.wait_for()
    for _ in range(ZOOMS):
        page.locator("[aria-label='Zoom out']").click()
    page.wait_for_timeout(2000)  # [ms] the page draws the place a little later


def main(folder: Path = PICTURES) -> None:
    """Take it."""
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as scratch:
        board = Board(None)
        cncjs = Cncjs(Path(scratch), [board.port])
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=QUIET, headless=True
        )
        try:
            page = browser.new_page(viewport=SIZE)
            open_page(page, cncjs, board.port)
            cncjs.connect(board.port)
            cut(page, cncjs)
            page.screenshot(path=folder / "cncjs.png")
            print(folder / "cncjs.png")
        finally:
            browser.close()
            cncjs.end()
            board.end()


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
