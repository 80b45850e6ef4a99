"""Takes the pictures of the lab that README shows.

    PYTHONPATH=tools/tests .venv/bin/python tools/tests/lab/readme_pictures.py [FOLDER]

It serves the example's machine, opens it in Chromium, and writes the pictures into docs/pictures.
Look at each before you commit it.
"""

import base64
import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from chromium import QUIET
from playwright.sync_api import Browser, Page, sync_playwright
from screens import ROOT, at_rest, measured_machine
from served_lab import ServedLab, serve

PICTURES = ROOT / "docs/pictures"
FRAME = 560  # [px] width of a screen among six
PATIENCE_MS = 25_000  # of a busy computer


def verdict(page: Page) -> None:
    """The sentence, the errors before and after, the suspects."""
    page.get_by_role("heading", name="Suspects").wait_for()


def bench(page: Page) -> None:
    """Two effects, added after each other."""
    stairs = page.get_by_role("table", name="How the error falls")
    for effect in ("a tape that reads wrong", "chain stretch"):
        page.get_by_role("checkbox", name=effect).check()
        stairs.get_by_role("rowheader", name=effect).wait_for()


def correction(page: Page) -> None:
    """All numbers accepted, and what is left then."""
    page.get_by_role("button", name="Accept all").click()
    page.get_by_role("button", name="Write").wait_for()
    page.locator(".numbers[aria-busy=false]").wait_for()


@dataclass(frozen=True)
class Picture:
    """A picture of a screen."""

    name: str
    step: str
    size: tuple[int, int]
    scheme: str
    prepare: Callable[[Page], None]


def frames(page: Page, lab: ServedLab) -> str:
    """Return a page with the way of a calibration: six screens, each with its number."""
    images = []
    for step in ("open", "measure", "cut", "readings", "verdict", "correct"):
        page.goto(f"{lab.url}#/{step}")
        page.get_by_role("heading").first.wait_for()
        at_rest(page)
        images.append(base64.b64encode(page.screenshot()).decode())
    figures = (
        f'<img style="border: 1px solid" width="{FRAME}" src="data:image/png;base64,{image}">'
        for image in images
    )
    style = "display: grid; grid-template-columns: repeat(2, auto); gap: 12px; width: max-content"
    return f'<body style="margin: 0"><div style="{style}">{"".join(figures)}</div></body>'


EACH = (
    Picture("lab-verdict", "verdict", (1280, 1000), "light", verdict),
    Picture("lab-bench", "bench", (1280, 1000), "dark", bench),
    Picture("lab-narrow", "correct", (390, 844), "light", correction),
)


def take(browser: Browser, lab: ServedLab, picture: Picture, folder: Path) -> None:
    """Open the screen, bring it into its state, and write the picture."""
    width, height = picture.size
    context = browser.new_context(
        viewport={"width": width, "height": height},
        color_scheme=picture.scheme,
        reduced_motion="reduce",
    )
    page = context.new_page()
    page.set_default_timeout(PATIENCE_MS)
    page.goto(f"{lab.url}#/{picture.step}")
    picture.prepare(page)
    at_rest(page)
    page.evaluate("() => { document.activeElement.blur(); scrollTo(0, 0); }")
    page.mouse.move(0, 0)
    page.screenshot(path=folder / f"{picture.name}.png")
    context.close()


def main(folder: Path = PICTURES) -> None:
    """Take all of them."""
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as scratch:
        lab = serve(measured_machine(Path(scratch) / "garage"))
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=QUIET, headless=True
        )
        for picture in EACH:
            take(browser, lab, picture, folder)
            print(folder / f"{picture.name}.png")
        page = browser.new_page(viewport={"width": 1280, "height": 800}, reduced_motion="reduce")
        page.set_content(frames(page, lab))
        page.locator("div").screenshot(path=folder / "calibration.png")
        browser.close()
        lab.end()


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
