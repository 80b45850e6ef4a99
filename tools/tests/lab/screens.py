"""A walk through every screen of the lab, and what is looked at on each."""

import json
from datetime import UTC, datetime, timedelta
from pathlib import Path

from example_machine import EXAMPLE, ROOT
from folder import got, note_fit, type_in, until

AXE = (ROOT / "tools/page/node_modules/axe-core/axe.min.js").read_text()
SIZES = {"desktop": (1280, 900), "phone": (375, 740)}
SMALLEST_TEXT = 13  # CSS pixels; the body has 15, and 16 on a phone; in drawings 12
SMALLEST_TARGETS = {"desktop": 32, "phone": 44}  # CSS pixels, for a mouse and for a finger

# Text that can be seen and is smaller than it may be, with its size.
SMALL_TEXT = """(smallest) => {
  const small = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const text = walker.currentNode.textContent.trim();
    const parent = walker.currentNode.parentElement;
    if (!text || !parent.checkVisibility({ checkVisibilityCSS: true })) continue;
    const drawn = parent.closest("svg") && parent.getScreenCTM ? parent.getScreenCTM().d : 1;
    const size = parseFloat(getComputedStyle(parent).fontSize) * Math.abs(drawn);
    const least = smallest - (parent.closest("svg") ? 1 : 0);
    if (size < least - 0.01) small.push(`${size.toFixed(1)} px: ${text.slice(0, 40)}`);
  }
  return [...new Set(small)];
}"""

FIRST_MARK = 7  # lines of its program, of 41
MOST_WORDS = 40  # that a screen says before its picture

# Buttons that all want to be pressed next: a screen has a single such button.
WANTED = """() => [...document.querySelectorAll("main .primary")]
  .filter((each) => each.checkVisibility({ checkVisibilityCSS: true }))
  .map((each) => each.innerText)"""

# What can be pressed and is smaller than it may be; links within sentences are text.
SMALL_TARGETS = """(smallest) => {
  const small = [];
  const pressed = "button, a[href], input, select, summary, [role=button], [role=slider]";
  for (const each of document.querySelectorAll(pressed)) {
    if (!each.checkVisibility({ checkVisibilityCSS: true })) continue;
    if (each.closest("p, svg, .skip") || each.getAttribute("aria-hidden") === "true") continue;
    const whole = each.closest("label") ?? each;
    const box = whole.getBoundingClientRect();
    const room = Math.max(box.height, each.getBoundingClientRect().height);
    if (room < smallest - 0.5) small.push(`${room.toFixed(0)} px: ${each.outerHTML.slice(0, 90)}`);
  }
  return small;
}"""

WIDER = """() => [...document.querySelectorAll("body *")]
  .filter((each) => each.getBoundingClientRect().right > innerWidth + 1)
  .filter((each) => each.getBoundingClientRect().left > -500)
  .slice(0, 3).map((each) => each.outerHTML.slice(0, 120))"""


def measured_machine(folder: Path) -> Path:
    """A folder with a machine that was measured, as the page keeps it."""
    folder.mkdir(exist_ok=True)
    for name in ("groundcontrol.ini", "marks.toml"):
        (folder / name).write_bytes((EXAMPLE / name).read_bytes())
    choices = {"settings": "groundcontrol.ini", "marks": ["marks.toml"]}
    (folder / "lab.json").write_text(json.dumps(choices))
    return folder


def fitted_machine(folder: Path) -> Path:
    """A folder with a machine after its second correction, as the page keeps it."""
    folder.mkdir(exist_ok=True)
    for name in ("groundcontrol.ini", "machine.toml", "marks.toml"):
        (folder / name).write_bytes((EXAMPLE / name).read_bytes())
    choices = {"settings": "machine.toml", "marks": ["marks.toml"]}
    choices["settings_before"] = ["groundcontrol.ini"]
    (folder / "lab.json").write_text(json.dumps(choices))
    day = datetime(2026, 5, 1, 12, tzinfo=UTC)
    note_fit(folder, day, 0.9, 2978.0)
    note_fit(folder, day + timedelta(days=30), 0.5, 2984.0)
    return folder


def with_proof_marks(lab):
    """Two proof marks are cut and read, the second far off."""
    with lab.client() as client:
        got(client.post("/api/rounds/proof"))
        type_in(client, "proof.toml", (0.3, 0), (4.0, 0))
        assert "read mark 2 again" in got(client.get("/api/proof"))["checked"]["sentence"]


def with_virtual_machine(lab, far=lambda program: program["done"] > FIRST_MARK, *, speed=10):
    """A virtual machine that cut the marks so far, and goes on, so many times as fast as a real
    machine.
    """
    with lab.client() as client:
        got(client.post("/api/machine/virtual", json={"seed": 9, "speed": speed}))
        until(client, lambda machine: machine["phase"] == "ready")
        got(client.post("/api/machine/settings"))
        got(client.post("/api/rounds/marks/cut"))
        until(client, lambda machine: far(machine["program"]))


def places(page) -> list[str]:
    """The addresses of all screens that are open, in the order of the way."""
    links = page.locator("nav a").all()
    return list(dict.fromkeys(link.get_attribute("href") for link in links))


def at_rest(page):
    """Wait until the page has nothing to ask, to save or to draw."""
    page.evaluate("() => new Promise(requestAnimationFrame)")  # so that it hears of a new address
    page.locator("html[data-rest]").wait_for(state="attached")


def await_question(page, held, count=1):
    """Wait until the page asks what a test holds back, so many times."""
    while len(held) < count:
        page.evaluate("() => new Promise(requestAnimationFrame)")


def walk(page):
    """Open each screen in turn; yields its name when it has settled."""
    for place in places(page):
        page.evaluate("(place) => { location.hash = place }", place)
        at_rest(page)
        yield place.removeprefix("#/")


def axe_findings(page) -> list[str]:
    """The findings of axe on the page: rule, and the first element."""
    if not page.evaluate("() => 'axe' in window"):
        page.evaluate(AXE)
    run = "() => axe.run(document, {resultTypes: ['violations']}).then((all) => all.violations)"
    return [
        f"{each['id']}: {each['help']}: {len(each['nodes'])}: {each['nodes'][0]['html'][:150]}"
        for each in page.evaluate(run)
    ]


# How much the keyboard should reach; of a group of radio buttons, only that which is chosen.
REACHABLE = """() => {
  const all = "a[href], button, input, select, textarea, summary, [tabindex]";
  return [...document.querySelectorAll(all)].filter((each) =>
    each.tabIndex >= 0 && !each.disabled && each.checkVisibility({ checkVisibilityCSS: true })
    && !(each.type === "radio" && !each.checked)).length;
}"""

# Where the keyboard is: the number of the element on the page, and whether it can be seen there.
FOCUSED = """() => {
  const here = document.activeElement;
  if (!here || here === document.body) return null;
  const marked = here.matches("input[type=radio]") ? here.nextElementSibling ?? here : here;
  const style = getComputedStyle(marked);
  const box = here.getBoundingClientRect();
  const shown = box.width > 0 && box.bottom > 0 && box.top < innerHeight;
  const outlined = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2;
  return { place: [...document.querySelectorAll("*")].indexOf(here), seen: shown && outlined,
           html: here.outerHTML.slice(0, 120) };
}"""


def tabbed(page, most=600) -> list[dict]:
    """Where the keyboard comes, from the top of the page to its end."""
    page.evaluate("() => { document.activeElement.blur(); getSelection().removeAllRanges(); }")
    page.evaluate("() => document.querySelector('.skip').focus()")
    stops = [page.evaluate(FOCUSED)]
    while len(stops) < most:
        page.keyboard.press("Tab")
        stop = page.evaluate(FOCUSED)
        if stop is None or stop["place"] == stops[0]["place"]:
            break
        stops.append(stop)
    return stops
