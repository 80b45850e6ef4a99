"""The sheet, which every screen draws alike: what it names, and how it is enlarged."""

import math
import re
from xml.etree import ElementTree

import pytest
from folder import choose, finished
from playwright.sync_api import expect
from screens import at_rest, await_question, axe_findings, measured_machine
from synthetic import SHEET

SVG = "{http://www.w3.org/2000/svg}"
NOISE = 2.45  # sigmas: noise alone makes a longer error at 5 % of the marks
FRAME = ".sheet .frame"
CARD = ".card-of-mark"
OVERLAPPING = """() => {
  const boxes = [...document.querySelectorAll(".sheet .names text")].map((text) =>
    text.getBoundingClientRect());
  return boxes.filter((box, i) => boxes.some((other, j) => i < j && box.left < other.right &&
    other.left < box.right && box.top + 3 < other.bottom - 3 && other.top + 3 < box.bottom - 3));
}"""


def at_verdict(lab, page):
    """The page at the verdict on the example's marks."""
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/verdict")
    page.locator(FRAME).wait_for()
    at_rest(page)
    return page


@pytest.fixture
def verdict(lab, page):
    return at_verdict(lab, page)


def ticks(page):
    """The labels of the axes, as numbers."""
    said = page.locator(".sheet .axes text").all_text_contents()
    return [float(each.replace("−", "-")) for each in said if each not in {"mm", "inch"}]


def test_a_mark_can_be_chosen_by_mouse_finger_and_keys(verdict):
    card, place = verdict.locator(CARD), verdict.locator(".sheet circle.place").first
    place.hover(force=True)
    expect(card).to_contain_text(re.compile(r"Mark 1 \d\.\d\d mm off"))
    said = card.inner_text()
    for word in ("target", "read", "error", "chains"):
        assert word in said
    assert re.search(r"left [+−]\d\.\d\d, right [+−]\d\.\d\d", said)
    verdict.mouse.move(5, 300)
    expect(card).to_be_hidden()
    verdict.locator(FRAME).focus()
    verdict.keyboard.press("Home")
    assert card.inner_text() == said
    verdict.keyboard.press("ArrowDown")
    expect(card).to_contain_text("Mark 6")
    verdict.keyboard.press("Escape")
    expect(card).to_be_hidden()
    place.click(force=True)
    verdict.mouse.move(5, 300)
    assert card.inner_text() == said  # a press keeps it


def test_states_are_compared(verdict):
    page = verdict
    states = page.get_by_role("group", name="What is drawn").get_by_role("radio")
    last = states.count() - 1
    small = [each.get_attribute("d") for each in page.locator(".states path").all()]
    assert len(set(small)) == states.count() and {each.count("L") for each in small} == {23}
    # Where the model fails is seen first: what the fitted frame leaves.
    expect(states.nth(1)).to_be_checked()
    states.nth(last).check()
    arrows = page.locator(".sheet path.arrow.beyond, .sheet path.arrow.within").first
    drawn = arrows.get_attribute("d")
    states.nth(last).focus()
    page.keyboard.press("ArrowLeft")
    expect(states.nth(last - 1)).to_be_checked()
    assert arrows.get_attribute("d") != drawn
    for label, rms in zip(states.locator("..").all(), ("8.91", "1.78", "0.65"), strict=True):
        expect(label).to_contain_text(rms)


def drawn_on(page):
    """What each mark shows: its circle and its arrow [mm], and whether the arrow is beyond noise;
    how much larger than life arrows are [px of the drawing].
    """
    legend = page.locator(".legend-of-sheet").text_content()
    wide = page.locator(".sheet .wood").evaluate("(wood) => wood.width.baseVal.value")
    scale = float(re.search(r"(\d+)× life", legend)[1]) * wide / SHEET[0]
    marks = []
    for group in page.locator(".sheet svg g:has(> circle.place)").all():
        arrow = group.locator("path.arrow:not(.ghost)")
        path = [float(each) for each in re.findall(r"-?[\d.]+", arrow.get_attribute("d"))]
        error = ((path[4] - path[0]) / scale, (path[1] - path[5]) / scale) if path else (0.0, 0.0)
        circle = float(group.locator("circle.noise").get_attribute("r")) / scale
        marks.append((circle, error, "beyond" in arrow.get_attribute("class")))
    return marks, scale


def assert_drawn(page, state, sigma):
    """These errors are drawn, each with the circle of its noise; what leaves it is beyond."""
    marks, scale = drawn_on(page)
    usual = NOISE * sigma
    assert [error for _, error, _ in marks] == [
        pytest.approx(error, abs=0.2 / scale) for error in state["errors"]
    ]
    assert [circle for circle, _, _ in marks] == pytest.approx([max(2 / scale, usual)] * len(marks))
    sure = [mark for mark in marks if abs(math.hypot(*mark[1]) - usual) > 1 / scale]
    assert [is_beyond for _, _, is_beyond in sure] == [
        math.hypot(*error) > usual for _, error, _ in sure
    ]
    return sum(is_beyond for _, _, is_beyond in marks), scale


def test_each_state_has_its_arrows_and_the_circles_of_its_noise(lab, verdict):
    with lab.client() as client:
        answer = finished(client, "verdict")["verdict"]
    states = verdict.get_by_role("group", name="What is drawn").get_by_role("radio")
    seen = []
    for index, state in enumerate(answer["states"]):
        states.nth(index).check()
        seen.append(assert_drawn(verdict, state, answer["sigma"]))
    beyond, scales = zip(*seen, strict=True)
    assert beyond[0] == 23 > beyond[1] > beyond[2]  # as set, the frame, and the effect
    assert scales[0] < scales[1]


def test_a_reading_that_disagrees_is_ringed_and_scales_nothing(lab, page):
    measured_machine(lab.folder)

    def seen(step):
        """How far off the marks are said to be, and how much longer than life arrows are."""
        page.goto(f"{lab.url}#/{step}")
        page.reload()
        at_rest(page)
        as_set = page.get_by_role("radio", name="as set")
        if as_set.count():
            as_set.check()
        said = " ".join(page.locator(".count, .states").all_inner_texts())
        figure = re.search(r"(?:off by|as set)\s+(\d+\.\d\d) mm", said)
        factor = re.search(r"(\d+)× life", page.locator(".legend-of-sheet").text_content())[1]
        return float(figure[1]) if figure else None, factor

    before = {step: seen(step) for step in ("verdict", "readings")}
    form = lab.folder / "marks.toml"
    assert "[659.5, 110.5]" in form.read_text()
    form.write_text(form.read_text().replace("[659.5, 110.5]", "[759.5, 110.5]"))
    for step, (figure, factor) in before.items():
        now = seen(step)
        assert page.locator(".sheet circle.doubt").count() == 1
        assert now[1] == factor
        assert now[0] is None or now[0] == pytest.approx(figure, abs=0.2)


def test_correct_compares_the_file_the_accepted_numbers_and_all_numbers(lab, page):
    measured_machine(lab.folder)
    with lab.client() as client:
        made = finished(client, "correction")["correction"]
        choose(client, accepted=[made["numbers"][0]["name"]])
        made = finished(client, "correction")["correction"]
    page.goto(f"{lab.url}#/correct")
    states = page.get_by_role("group", name="What is drawn").get_by_role("radio")
    expect(states).to_have_count(3)
    at_rest(page)
    expect(states.nth(1)).to_be_checked()  # what is accepted
    scales = []
    for index, name in enumerate(("as_set", "accepted", "whole")):
        states.nth(index).check()
        rms = f"{made[name]['fit_rms']:.2f} mm"
        expect(states.nth(index).locator("..")).to_contain_text(f"{made[name]['title']} {rms}")
        if index:
            page.get_by_role("slider").fill("-1220")  # nothing is left of it
        scales.append(assert_drawn(page, made[name], made["sigma"])[1])
    assert len({*scales}) == 1  # what is compared is drawn equally large
    falls = [f"{made['as_set']['fit_rms']:.2f}", f"{made['accepted']['fit_rms']:.2f} mm"]
    assert page.locator(".errors output").all_inner_texts() == falls
    choose_none = page.get_by_role("checkbox").first
    choose_none.uncheck()
    expect(states).to_have_count(2)
    expect(states.nth(1)).to_be_checked()  # all of it


def middle_of(part):
    box = part.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_it_is_enlarged_about_the_pointer_and_dragged(verdict):
    page, wood = verdict, verdict.locator(".sheet .wood")
    place = page.locator(".sheet circle.place").nth(8)
    whole, at = wood.bounding_box(), middle_of(place)

    def enlarged():
        """How much larger it is drawn; text stays as large as it is read."""
        at_rest(page)
        letters = page.locator(".sheet .axes text").first
        assert letters.evaluate("(text) => text.getScreenCTM().a") == pytest.approx(1, abs=0.02)
        return wood.bounding_box()["width"] / whole["width"]

    page.mouse.move(*at)
    page.mouse.wheel(0, -50)
    assert enlarged() == 1  # a wheel without Ctrl scrolls
    page.keyboard.down("Control")
    page.mouse.wheel(0, -50)
    page.keyboard.up("Control")
    assert enlarged() == pytest.approx(2**0.5, rel=0.01)
    page.mouse.dblclick(*at)
    assert enlarged() == pytest.approx(2**0.5 * 2.56, rel=0.01)
    assert middle_of(place) == pytest.approx(at, abs=3)  # a click is at a whole pixel
    at = middle_of(place)
    page.locator(FRAME).press("Escape")
    page.mouse.move(*at)
    page.mouse.down()
    page.mouse.move(at[0] + 40, at[1] - 30, steps=4)
    page.mouse.up()
    assert middle_of(place) == pytest.approx((at[0] + 40, at[1] - 30), abs=1)
    page.mouse.move(5, 300)
    expect(page.locator(".sheet circle.lit")).to_have_count(0)  # a drag chooses no mark
    assert axe_findings(page) == []
    page.get_by_role("button", name="Farther").click()
    page.get_by_role("button", name="All").click()
    assert enlarged() == 1
    page.locator(FRAME).focus()
    for key in ("+", "Home", "End"):
        page.keyboard.press(key)
    assert enlarged() == pytest.approx(1.6, rel=0.01)
    expect(page.locator(".sheet circle.lit")).to_be_in_viewport()
    page.keyboard.press("0")
    at_rest(page)
    assert wood.bounding_box() == whole


def test_a_mark_stays_chosen_when_the_unit_changes(verdict):
    held = []
    verdict.locator(FRAME).focus()
    verdict.keyboard.press("Home")
    verdict.route("**/api/verdict", half_worked(held))
    verdict.get_by_role("radio", name="inch").check()
    expect(verdict.locator(CARD)).to_contain_text(re.compile(r"Mark 1 0\.\d{3} inch off"))
    expect(verdict.locator(".sheet .axes text").last).to_have_text("inch")
    assert 40 <= max(ticks(verdict)) <= 50
    await_question(verdict, held, 2)  # asked again after the answer that is not whole
    expect(verdict.locator(".screen")).to_have_attribute("aria-busy", "true")
    expect(verdict.locator(CARD)).to_contain_text("Mark 1")
    verdict.unroute("**/api/verdict")
    at_rest(verdict)
    expect(verdict.locator(CARD)).to_contain_text("Mark 1")


def half_worked(asked):
    """A route that notes each question, and says that half of its work is done."""
    answer = {"share": 0.5, "command": ""}
    return lambda route: (asked.append(route), route.fulfill(json=answer))


def test_on_a_phone_no_name_lies_over_another_and_two_fingers_enlarge_it(lab, open_page):
    page = at_verdict(lab, open_page(viewport={"width": 390, "height": 844}, has_touch=True))
    names = page.locator(".sheet .names text").all_text_contents()
    assert {"1", "5", "11", "15"} <= set(names)
    assert page.evaluate(OVERLAPPING) == []
    page.locator(".sheet circle.place").first.tap(force=True)
    expect(page.locator(CARD)).to_contain_text("Mark 1")
    place, wood = page.locator(".sheet circle.place").nth(8), page.locator(".sheet .wood")
    (x, y), whole = middle_of(place), wood.bounding_box()["width"]
    fingers = page.context.new_cdp_session(page)
    for apart in (30, 45, 60):
        each = [{"x": x + side * apart, "y": y, "id": side + 1} for side in (-1, 1)]
        kind = "touchStart" if apart == 30 else "touchMove"
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": each})
    fingers.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    at_rest(page)
    assert wood.bounding_box()["width"] == pytest.approx(2 * whole, rel=0.02)
    assert middle_of(place) == pytest.approx((x, y), abs=1)
    assert axe_findings(page) == []


def test_its_picture_is_saved_in_light_colours_with_its_date_and_its_settings(lab, open_page):
    page = at_verdict(lab, open_page(color_scheme="dark", viewport={"width": 1280, "height": 800}))

    def saved(kind):
        with page.expect_download() as download:
            page.get_by_role("button", name=f"{kind}: save the picture").click()
        assert download.value.suggested_filename == f"sheet.{kind.lower()}"
        return download.value.path().read_bytes()

    text = saved("SVG").decode()
    root = ElementTree.fromstring(text)
    assert "var(" not in text and "class=" not in text
    paper = root.find(f"{SVG}rect").get("fill")
    assert sum(map(int, re.findall(r"\d+", paper)[:3])) > 600
    title = root.find(f"{SVG}title").text
    assert re.search(r"Verdict · .* · 20\d\d-\d\d-\d\d · \w+\.\w+ [0-9a-f]{8}$", title), title
    content = saved("PNG")
    assert content.startswith(b"\x89PNG")
    wide = page.locator(".sheet svg").bounding_box()["width"]
    assert int.from_bytes(content[16:20], "big") == pytest.approx(2 * wide, abs=2)
