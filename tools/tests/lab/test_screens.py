"""Every screen, at each width and in each scheme: accessible, readable, no wider than the page.

Pictures of them lie in .build/lab/screenshots.
"""

import pytest
from screens import (
    MOST_WORDS,
    PICTURES,
    REACHABLE,
    SCHEMES,
    SIZES,
    SMALL_TARGETS,
    SMALL_TEXT,
    SMALLEST_TARGET,
    SMALLEST_TEXT,
    WANTED,
    WIDER,
    at_rest,
    axe_findings,
    fitted_machine,
    measured_machine,
    tabbed,
    walk,
    with_check_marks,
    with_virtual_machine,
)
from served_lab import serve

FEWEST_SCREENS = 12
WHEN_FITTED = ("correct", "check", "diary")
AT_FIRST = ("open", "practice")
IN_MID_CUT = ("open", "measure", "cut", "readings")


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab on a machine that was measured."""
    served = serve(measured_machine(tmp_path_factory.mktemp("lab") / "garage"))
    yield served
    served.end()


@pytest.fixture(scope="module")
def cutting(tmp_path_factory):
    """A lab whose virtual machine cuts, half way through its marks."""
    served = serve(tmp_path_factory.mktemp("cutting"))
    with_virtual_machine(served)
    yield served
    served.end()


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    """A lab on a machine that was corrected and checked."""
    served = serve(fitted_machine(tmp_path_factory.mktemp("fitted") / "garage"))
    with_check_marks(served)
    yield served
    served.end()


@pytest.fixture(scope="module")
def empty(tmp_path_factory):
    """A lab that is opened for the first time."""
    served = serve(tmp_path_factory.mktemp("empty"))
    yield served
    served.end()


@pytest.fixture
def shown_fitted(browser, fitted, request):
    """The page of the corrected machine, in a width and a scheme."""
    yield from seen(browser, fitted, *request.param)


@pytest.fixture
def shown_empty(browser, empty, request):
    """The page at its first visit, in a width and a scheme."""
    yield from seen(browser, empty, *request.param)


@pytest.fixture
def shown(browser, lab, request):
    """The page of the measured machine, in a width and a scheme."""
    yield from seen(browser, lab, *request.param)


@pytest.fixture
def shown_cutting(browser, cutting, request):
    """The page while the machine cuts, in a width and a scheme."""
    yield from seen(browser, cutting, *request.param)


def seen(browser, lab, size, scheme):
    """A page of a lab in a width and a scheme."""
    width, height = SIZES[size]
    context = browser.new_context(
        viewport={"width": width, "height": height},
        color_scheme=scheme,
        reduced_motion="reduce",
        has_touch=size == "phone",
    )
    page = context.new_page()
    page.goto(lab.url)
    page.locator("nav").wait_for()
    page.size, page.color_scheme = size, scheme
    page.picture = lambda name, whole=True: page.screenshot(
        path=PICTURES / f"{name}-{size}-{scheme}.png", full_page=whole
    )
    yield page
    context.close()


def ways(*first):
    """Each width in each scheme; those that come first are in the fast run."""
    return [
        pytest.param(
            (size, scheme),
            id=f"{size}-{scheme}",
            marks=() if f"{size}-{scheme}" in first else pytest.mark.slow,
        )
        for size in SIZES
        for scheme in SCHEMES
    ]


def by_keyboard(page):
    """What the keyboard does not reach in order, or where it cannot be seen."""
    stops = tabbed(page)
    places = [stop["place"] for stop in stops]
    yield from (f"keyboard: not seen: {stop['html']}" for stop in stops[1:] if not stop["seen"])
    if places != sorted(set(places)):
        yield "keyboard: out of order"
    if len(stops) != page.evaluate(REACHABLE):
        yield f"keyboard: {len(stops)} of {page.evaluate(REACHABLE)} reached"


def faults(page):
    """What a screen has wrong for eyes and fingers."""
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
        ("target", SMALL_TARGETS, SMALLEST_TARGET),
    ):
        yield from (f"{what}: {each}" for each in page.evaluate(script, least))


@pytest.mark.parametrize("shown", ways("desktop-light", "phone-dark"), indirect=True)
def test_every_screen_is_accessible_and_fits(shown):
    findings, names = [], []
    for name in walk(shown):
        names.append(name)
        shown.picture(name)
        findings += [f"{name}: {each}" for each in faults(shown)]
        if shown.color_scheme == "light" and shown.size == "desktop":
            findings += [f"{name}: {each}" for each in by_keyboard(shown)]
    assert len(names) >= FEWEST_SCREENS, names
    assert findings == [], "\n".join(findings)


@pytest.mark.parametrize("shown_cutting", ways("phone-light"), indirect=True)
def test_the_machine_in_mid_cut_is_in_view_on_every_screen(shown_cutting):
    page, findings = shown_cutting, []
    for place in IN_MID_CUT:
        page.evaluate("(place) => { location.hash = `#/${place}` }", place)
        at_rest(page)
        bar = page.get_by_role("region", name="The machine", exact=True)
        assert "runs grid.nc" in bar.inner_text()
        for press in ("Hold", "Stop"):
            assert bar.get_by_role("button", name=press).is_visible()
        page.picture(f"{place}-in-mid-cut", whole=False)
        findings += [f"{place}: {each}" for each in faults(page)]
    assert findings == [], "\n".join(findings)


@pytest.mark.parametrize("shown", ways("phone-dark"), indirect=True)
def test_text_on_a_map_has_its_size_before_anybody_watches_the_map_grow(shown):
    shown.add_init_script("""window.ResizeObserver = class {
      observe() {}
      disconnect() {}
    }""")
    shown.reload()
    shown.locator("nav").wait_for()  # else the page may yet open its first screen
    shown.evaluate("() => { location.hash = '#/reach' }")
    at_rest(shown)
    shown.locator(".sheet .names text").first.wait_for()
    assert shown.evaluate(SMALL_TEXT, SMALLEST_TEXT) == []


def faults_at(page, places, when):
    """The faults of some screens, each with its picture."""
    for place in places:
        page.evaluate("(place) => { location.hash = `#/${place}` }", place)
        at_rest(page)
        page.picture(f"{place}-{when}")
        yield from (f"{place}: {each}" for each in faults(page))


@pytest.mark.parametrize("shown_fitted", ways("desktop-dark"), indirect=True)
def test_screens_after_a_correction(shown_fitted):
    findings = list(faults_at(shown_fitted, WHEN_FITTED, "when-fitted"))
    assert shown_fitted.locator(".course.moved").count() == 1
    assert findings == [], "\n".join(findings)


@pytest.mark.parametrize("shown_empty", ways("phone-dark"), indirect=True)
def test_screens_at_the_first_visit(shown_empty):
    findings = list(faults_at(shown_empty, AT_FIRST, "at-first"))
    assert findings == [], "\n".join(findings)


@pytest.mark.parametrize("shown", [("desktop", "light")], indirect=True, ids=["desktop"])
def test_the_way_is_gone_by_keyboard_alone(shown):
    shown.keyboard.press("Tab")
    shown.keyboard.press("Enter")  # past the list of steps
    assert shown.evaluate("() => document.activeElement.id") == "screen"
    shown.get_by_role("link", name="What you know →").focus()
    shown.keyboard.press("Enter")
    at_rest(shown)
    assert "What you know" in shown.title()
    assert shown.evaluate("() => document.activeElement.id") == "screen"
