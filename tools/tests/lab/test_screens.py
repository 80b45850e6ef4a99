"""Every screen, wide and narrow, light and dark: accessible, readable, no wider than the page."""

import pytest
from screens import (
    MOST_WORDS,
    REACHABLE,
    SIZES,
    SMALL_TARGETS,
    SMALL_TEXT,
    SMALLEST_TARGETS,
    SMALLEST_TEXT,
    WANTED,
    WIDER,
    at_rest,
    axe_findings,
    fitted_machine,
    measured_machine,
    tabbed,
    walk,
    with_proof_marks,
    with_virtual_machine,
)

FEWEST_SCREENS = 12
WHEN_FITTED = ("correct", "prove", "diary")
AT_FIRST = ("open", "practice")
IN_MID_CUT = ("open", "measure", "cut", "readings")


def corrected(lab):
    fitted_machine(lab.folder)
    with_proof_marks(lab)


STATES = {
    "measured": lambda lab: measured_machine(lab.folder),
    "cutting": with_virtual_machine,
    "corrected": corrected,
    "empty": lambda lab: None,
}


@pytest.fixture
def shown(open_page, lab, request):
    """The page of a lab in a state, in a width and a scheme."""
    state, size, scheme = request.param
    STATES[state](lab)
    width, height = SIZES[size]
    page = open_page(
        viewport={"width": width, "height": height},
        color_scheme=scheme,
        reduced_motion="reduce",
        has_touch=size == "phone",
    )
    page.goto(lab.url)
    page.locator("nav").wait_for()
    page.size, page.color_scheme = size, scheme
    return page


def ways(state, *each):
    """A state in some widths and schemes."""
    shown = [(state, *way.split("-")) for way in each]
    return pytest.mark.parametrize("shown", shown, indirect=True, ids=each)


def by_keyboard(page):
    """Elements that the keyboard does not reach in order, or that show no focus."""
    stops = tabbed(page)
    places = [stop["place"] for stop in stops]
    yield from (f"keyboard: not seen: {stop['html']}" for stop in stops[1:] if not stop["seen"])
    if places != sorted(set(places)):
        yield "keyboard: out of order"
    if len(stops) != page.evaluate(REACHABLE):
        yield f"keyboard: {len(stops)} of {page.evaluate(REACHABLE)} reached"


def faults(page):
    """Faults of a screen: text and targets too small, a sideways scroll."""
    yield from axe_findings(page)
    if page.evaluate("() => document.documentElement.scrollWidth > innerWidth"):
        yield f"wider than the page: {page.evaluate(WIDER)}"
    wanted = page.evaluate(WANTED)
    if len(wanted) > 1:
        yield f"wanted next: {wanted}"
    for said in page.locator("main .say").all_inner_texts():
        if len(said.split()) > MOST_WORDS:
            yield f"more than {MOST_WORDS} words: {said}"
    for what, script, least in (
        ("text", SMALL_TEXT, SMALLEST_TEXT),
        ("target", SMALL_TARGETS, SMALLEST_TARGETS[page.size]),
    ):
        yield from (f"{what}: {each}" for each in page.evaluate(script, least))


@ways("measured", "desktop-light", "phone-dark")
def test_every_screen_is_accessible_and_fits(shown):
    findings, names = [], []
    for name in walk(shown):
        names.append(name)
        findings += [f"{name}: {each}" for each in faults(shown)]
        if shown.color_scheme == "light" and shown.size == "desktop":
            findings += [f"{name}: {each}" for each in by_keyboard(shown)]
    assert len(names) >= FEWEST_SCREENS, names
    assert findings == [], "\n".join(findings)


@ways("cutting", "phone-light")
def test_the_machine_in_mid_cut_is_in_view_on_every_screen(shown):
    page, findings = shown, []
    for place in IN_MID_CUT:
        page.evaluate("(place) => { location.hash = `#/${place}` }", place)
        at_rest(page)
        bar = page.get_by_role("region", name="The machine", exact=True)
        assert "runs grid.nc" in bar.inner_text()
        for press in ("Hold", "Stop"):
            assert bar.get_by_role("button", name=press).is_visible()
        findings += [f"{place}: {each}" for each in faults(page)]
    assert findings == [], "\n".join(findings)


def faults_at(page, places):
    """The faults of some screens."""
    for place in places:
        page.evaluate("(place) => { location.hash = `#/${place}` }", place)
        at_rest(page)
        yield from (f"{place}: {each}" for each in faults(page))


@ways("corrected", "desktop-dark")
def test_screens_after_a_correction(shown):
    findings = list(faults_at(shown, WHEN_FITTED))
    assert shown.locator(".course.moved").count() == 1
    assert findings == [], "\n".join(findings)


@ways("empty", "phone-dark")
def test_screens_at_the_first_visit(shown):
    findings = list(faults_at(shown, AT_FIRST))
    assert findings == [], "\n".join(findings)


@pytest.mark.parametrize("shown", [("measured", "desktop", "light")], indirect=True)
def test_all_steps_can_be_done_by_keyboard_alone(shown):
    shown.keyboard.press("Tab")
    shown.keyboard.press("Enter")  # past the list of steps
    assert shown.evaluate("() => document.activeElement.id") == "screen"
    shown.get_by_role("link", name="What you know →").focus()
    shown.keyboard.press("Enter")
    at_rest(shown)
    assert "What you know" in shown.title()
    assert shown.evaluate("() => document.activeElement.id") == "screen"
