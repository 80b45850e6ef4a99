"""The picture stays in view while the controls scroll next to it; a phone has one column."""

import re
from functools import partial

import pytest
from folder import asked, finished, got
from lab_machine import AT_REST, with_machine
from playwright.sync_api import expect
from plumb.lab.broken_cut import NOTES, BrokenCut, digest_of_sent
from plumb.lab.project import CUT
from screens import at_rest, fitted_machine, measured_machine, with_proof_marks

WIDE, NARROW = {"width": 1280, "height": 800}, {"width": 390, "height": 844}
SMALLER, LEAST_WIDE = {"width": 375, "height": 740}, {"width": 1024, "height": 768}
# What each screen of a machine that was measured has first: a field or a button.
FIRST = {"open": ".pick", "known": ".known input", "measure": ".layouts label"}
FIRST |= {"cut": ".act button", "readings": ".cells input", "verdict": ".act button"}
FIRST |= {"correct": ".numbers input"}
ON_PHONE = ("known", "cut", "readings", "verdict", "correct")


@pytest.fixture
def measured(lab, page):
    """The page of a machine whose marks are read."""
    measured_machine(lab.folder)
    page.set_viewport_size(WIDE)
    page.goto(f"{lab.url}#/open")
    page.get_by_role("heading", level=1).wait_for()

    def opened(step):
        page.goto(f"{lab.url}#/{step}")
        at_rest(page)
        return page

    return opened


def test_the_error_stays_in_view_down_to_the_last_effect(measured):
    page = measured("bench")
    number = page.locator(".fall-now output")
    expect(number).to_contain_text("mm")
    before = number.inner_text()
    for size in (WIDE, NARROW):
        page.set_viewport_size(size)
        last = page.locator(".effect").last
        last.scroll_into_view_if_needed()
        expect(number).to_be_in_viewport(ratio=0.95)
    page.set_viewport_size(WIDE)
    page.get_by_role("checkbox", name="chains too long").check()
    expect(number).not_to_have_text(before)
    expect(page.locator(".sheet svg")).to_be_in_viewport(ratio=0.9)
    fallen = page.locator(".stairs tbody tr").nth(2).locator("td:nth-of-type(2)")
    expect(fallen).to_have_text(number.inner_text().removesuffix(" mm"))


def test_the_steps_fold_on_a_phone_when_the_open_step_is_chosen_again(measured):
    page = measured("known")
    page.set_viewport_size(NARROW)
    steps = page.get_by_role("navigation", name="Steps")
    for step in ("What you know", "Reach"):  # the step that is open, and another
        steps.get_by_role("button").click()
        steps.get_by_role("link", name=step).click()
        expect(steps.get_by_role("button")).to_have_attribute("aria-expanded", "false")
        expect(steps.get_by_role("link", name=step)).to_be_hidden()


# What each screen of a machine that was measured wants: its button, or the way to the next screen.
WANTED = {
    "open": "What you know →",
    "known": "Reach →",
    "reach": "Choose marks →",
    "measure": re.compile("^Take .* minutes$"),
    "cut": "Save grid-2.nc; nothing moves",
    "readings": "Go to the verdict",
    "verdict": "Find the best next measurement",
    "correct": "Accept a number first",
    "prove": "To the correction",
    "bench": "Write these numbers to new.toml",
    "practice": "To the machines: start a virtual machine there",
}
# Which of its middle and its corners lie outside of the window, or below something else.
HIDDEN = """(act) => {
  const { left, right, top, bottom } = act.getBoundingClientRect();
  const [x, y] = [(left + right) / 2, (top + bottom) / 2];
  const corners = [left + 4, right - 4].flatMap((x) => [top + 4, bottom - 4].map((y) => [x, y]));
  const hidden = ([x, y]) => !act.contains(document.elementFromPoint(x, y));
  const outside = left < 0 || top < 0 || right > innerWidth || bottom > innerHeight;
  return [...(outside ? [`from ${top} to ${bottom}`] : []), ...[[x, y], ...corners].filter(hidden)];
}"""
# A computer's page does not scroll, and Stop is in the same corner of each screen.
MOVED = """() => {
  const { scrollHeight, scrollWidth } = document.documentElement;
  const stop = document.querySelector(".stop")?.getBoundingClientRect();
  if (stop && (stop.bottom > 52 || innerWidth - stop.right > 16)) return "Stop has left its corner";
  const [steps, units] = ["nav", ".segments"].map((each) =>
    document.querySelector(each).getBoundingClientRect());
  if (units.bottom > steps.top) return "the units lie over the steps";
  const stage = document.querySelector(".stage");
  if (stage && stage.scrollHeight > stage.clientHeight + 1) return "its picture scrolls";
  return scrollHeight > innerHeight || scrollWidth > innerWidth ? "it scrolls" : "";
}"""
# How much of the window the bars take that stay while the screen scrolls.
BARS = """() => [...document.querySelectorAll("header, nav, .act, .way-on, .machine-bar")]
  .filter((each) => ["sticky", "fixed"].includes(getComputedStyle(each).position))
  .reduce((sum, each) => sum + each.getBoundingClientRect().height, 0)"""


def out_of_view(page, step, wanted):
    """Where the only thing that a screen wants is not in view before anybody scrolls, and where
    the bars take more than a sixth of a phone.
    """
    page.evaluate("(place) => { location.hash = place }", f"#/{step}")
    act = (
        page.locator("main, .machine-bar")
        .locator("button, a, input")
        .and_(
            page.get_by_role("button", name=wanted)
            .or_(page.get_by_role("link", name=wanted))
            .or_(page.get_by_label(wanted))
        )
    )
    for size in (LEAST_WIDE, SMALLER, *[NARROW] * (step in ON_PHONE)):
        page.set_viewport_size(size)
        at_rest(page)
        page.evaluate("() => scrollTo(0, 0)")
        at_rest(page)
        at = f"{step} at {size['width']}"
        primary = page.locator("main .primary, .machine-bar .primary").all_inner_texts()
        if wanted != "Stop" and primary not in ([], [act.inner_text()]):
            yield f"{at}: {act.inner_text()} is wanted, and {primary}"
        if hidden := act.evaluate(HIDDEN):
            yield f"{at}: {act.inner_text()} is hidden: {hidden}"
        if wanted == WANTED.get(step) and step in FIRST and size != SMALLER:
            if page.locator(FIRST[step]).first.evaluate(HIDDEN):
                yield f"{at}: {FIRST[step]} is below the first screen"
            expect(page.get_by_role("heading", level=1)).to_be_in_viewport(ratio=1)
        if size == LEAST_WIDE and (moved := page.evaluate(MOVED)):
            yield f"{at}: {moved}"
        bars = page.evaluate(BARS)
        if size == SMALLER and wanted != LOST and bars > size["height"] / 6:
            yield f"{at}: bars of {bars:.0f} px"


def none_out_of_view(page, wanted):
    assert [fault for step in wanted for fault in out_of_view(page, step, wanted[step])] == []


LOST = "Connect /dev/ttyACM0 again"  # which has a bar with all ports
WITH_MACHINE = {**WANTED, "cut": "Move the sled and cut 9 marks"}
WITH_MACHINE.pop("practice")
RUNS = {"title": "grid-2.nc", "done": 25, "total": 62, "outcome": "running"}


@pytest.fixture
def opened(lab, fresh_page):
    """Opens the page of a folder, with a machine that does something."""

    def open_page(folder=measured_machine, **state):
        folder(lab.folder)
        page = fresh_page
        if state:
            with_machine(page, **state)
        page.goto(f"{lab.url}#/open")
        at_rest(page)
        return page

    return open_page


def test_every_screen_shows_its_next_action_without_scrolling(opened):
    none_out_of_view(opened(), WANTED)


def test_so_does_every_screen_with_a_machine_at_rest(opened):
    none_out_of_view(opened(**AT_REST), WITH_MACHINE)


def test_while_the_machine_cuts_every_screen_shows_stop(opened):
    page = opened(moves=True, phase="busy", program=RUNS, place=[-812.4, -402.1, 13.5])
    none_out_of_view(page, dict.fromkeys(WITH_MACHINE, "Stop"))


def test_so_do_the_screens_of_a_machine_that_was_corrected(opened, lab):
    sends = "Connect the machine, then send machine.toml"
    page = opened(fitted_machine)
    none_out_of_view(page, {"correct": sends, "prove": "Save proof.nc; nothing moves"})
    with_proof_marks(lab)
    page.reload()
    none_out_of_view(page, {"prove": "Diary →"})


@pytest.mark.parametrize(
    ("machine", "wanted"),
    [
        ({}, {"open": "Settings' file", "practice": "To the mach"}),
        (AT_REST, {"open": "Begin: Read the machine's numbers"}),
    ],
    ids=["no-machine", "machine"],
)
def test_so_do_the_screens_at_the_first_visit(opened, machine, wanted):
    none_out_of_view(opened(lambda folder: None, **machine), wanted)


def saved(folder):
    """A folder whose marks are to be cut: the program and its form are in it."""
    measured_machine(folder)
    with asked(folder) as client:
        got(client.post("/api/rounds/marks"))


def broken_off(folder, *, marks, begun):
    """A folder whose cut broke off."""
    saved(folder)
    note_break(folder, marks=marks, begun=begun)


def note_break(folder, *, marks, begun):
    """Note how many marks are surely cut, and how many perhaps."""
    with asked(folder) as client:
        text = got(client.get("/api/rounds/marks"))["text"]
    cut = BrokenCut(digest=digest_of_sent(text), marks=marks, begun=begun, is_virtual=False)
    (folder / CUT).write_bytes(NOTES.dump_json({"grid-2.nc": cut}))


def proposed(folder):
    """A folder with the proposal of the verdict."""
    measured_machine(folder)
    with asked(folder) as client:
        each = (offer["taking"] for offer in finished(client, "next")["offers"])
        taking = next(taking for taking in each if taking and taking["program"])
        got(client.post("/api/next", json={key: taking[key] for key in ("choose", "digest")}))


DONE, GONE = ({**RUNS, "outcome": outcome} for outcome in ("done", "lost"))
CUT_STATES = {
    "cut": (saved, {"program": DONE}, "Type what your tape says"),
    "virtually": (saved, {"kind": "virtual", "program": DONE}, "Let a tape read the 9 marks"),
    "broke-off": (
        partial(broken_off, marks=3, begun=3),
        {"program": {**RUNS, "outcome": "stopped"}},
        "Go on: move the sled and cut from mark",
    ),
    "perhaps": (partial(broken_off, marks=3, begun=6), {}, "Go on: say first which mark is the"),
    "place-unknown": (saved, {"knows_place": False}, "Set both lengths; nothing moves"),
    "lost": (partial(broken_off, marks=3, begun=5), {"phase": "lost", "program": GONE}, LOST),
    "waits": (
        saved,
        {"holds": True, "phase": "busy", "program": RUNS, "waits_for": "let 5 kg more hang on it"},
        "Go on",
    ),
    "proposed": (proposed, AT_REST, "Move the sled and cut"),
}


@pytest.mark.parametrize("state", CUT_STATES)
def test_cut_shows_its_next_action_in_each_of_its_states(opened, state):
    folder, machine, wanted = CUT_STATES[state]
    page = opened(folder, **{"place": [0, 0, 5], **machine})
    none_out_of_view(page, {"cut": wanted})


def test_which_mark_is_the_last_is_asked_anew_after_each_break(opened, lab):
    page = opened(partial(broken_off, marks=3, begun=6), **AT_REST)
    page.goto(page.url.replace("open", "cut"))
    page.set_viewport_size(NARROW)
    expect(page.get_by_role("radio", name="mark 6")).to_be_in_viewport(ratio=1)
    page.get_by_role("radio", name="mark 6").check()
    page.get_by_role("button", name="Go on: move the sled").wait_for()
    note_break(lab.folder, marks=4, begun=6)
    page.get_by_label("On another sheet").check()  # and the lab is asked again
    expect(page.get_by_role("radio", name="mark 3")).to_have_count(0)
    page.get_by_role("button", name="Go on: say first").wait_for()
    asks = page.get_by_role("group", name="Look at the sheet")
    expect(asks.get_by_role("radio", checked=True)).to_have_count(0)


def test_the_next_measurement_comes_into_view_with_its_button(opened):
    page = opened()
    page.goto(page.url.replace("open", "verdict"))
    page.set_viewport_size(NARROW)
    page.get_by_role("button", name="Find the best next").click()
    expect(page.get_by_role("heading", name="Next: ")).to_be_in_viewport()
    none_out_of_view(page, {"verdict": "Type what you measured"})
    take = page.get_by_role("button", name=re.compile("^Take: .* kg more"))
    take.first.click()
    expect(page.get_by_role("heading", name=re.compile(r"^Cut \d+ more marks"))).to_be_visible()
    expect(page.locator(".pauses li")).not_to_have_count(0)
