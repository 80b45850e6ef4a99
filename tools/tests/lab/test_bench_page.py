"""The bench for effects in a real browser."""

import re
import tomllib

import pytest
from playwright.sync_api import expect
from screens import measured_machine


@pytest.fixture
def bench(lab, page):
    """The bench of the example's marks."""
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/bench")
    page.get_by_role("checkbox", name="chains too long").wait_for()
    return page


def stairs(page, count):
    """The errors of the fit, stair by stair, once there are this many."""
    rows = page.locator(".stairs tbody tr")
    rows.nth(count - 1).wait_for()
    return [float(text) for text in rows.locator("td:nth-of-type(2)").all_inner_texts()]


def test_an_effect_is_added_and_the_error_falls(bench, lab):
    as_set, frame = stairs(bench, 2)
    bench.get_by_role("checkbox", name="chains too long").check()
    *_, fitted = stairs(bench, 3)
    assert as_set > frame > 2 * fitted
    arrows = bench.locator(".bench-sheet polygon")
    marks = bench.locator("#bench-mark option").count() - 1
    expect(arrows).to_have_count(2 * marks)  # those of now, and ghosts of the state before
    slider = bench.get_by_role("slider", name="left chain too long")
    slider.press("Home")
    bench.get_by_role("button", name="Fit: left chain too long").wait_for()
    bench.wait_for_function(
        "fit => Number(document.querySelector('.stairs tr:nth-child(3) td:nth-of-type(2)')"
        ".textContent) > 1.5 * fit",
        arg=fitted,
    )
    bench.get_by_text("In a terminal").click()
    command = bench.locator("details.command code")
    expect(command).to_contain_text("--hold chain_pitch.left=-0.001")
    bench.get_by_role("button", name="Write these numbers").click()
    bench.get_by_text("new.toml is written.").wait_for()
    written = tomllib.loads((lab.folder / "new.toml").read_text())
    assert written["effects"]["chain_pitch"]["left"] == -0.001
    bench.reload()
    bench.get_by_role("button", name="Fit: left chain too long").wait_for()  # nothing is lost


def test_a_dot_lights_in_every_plot_and_on_the_sheet(bench):
    plots = bench.locator("svg.plot")
    plots.first.wait_for()
    shown = plots.count()
    assert shown >= 6
    dots = plots.first.locator("path.dots.left").get_attribute("d")
    x, y = map(float, re.match(r"M(\S+) (\S+)h0", dots).groups())
    box = plots.first.bounding_box()
    scale = box["width"] / 320
    plots.first.click(position={"x": x * scale, "y": y * scale})
    bench.locator(".bench-sheet circle.lit").wait_for()
    expect(bench.locator(".bench-sheet circle.lit")).to_have_count(1)
    for i in range(shown):
        expect(plots.nth(i).locator("circle.lit")).to_have_count(2)  # left and right chain
    assert bench.locator("#bench-mark").input_value() == "0"
    lit = bench.locator(".bench-sheet circle.lit")
    first = lit.get_attribute("cx")
    bench.get_by_label("Mark", exact=True).select_option("5")
    expect(lit).not_to_have_attribute("cx", first)
    expect(bench.locator(".mark-picker")).to_contain_text("left chain")
    expect(lit).to_have_count(1)
    before = lit.get_attribute("cx")
    bench.get_by_label("Mark", exact=True).select_option("6")  # by keyboard as by mouse
    expect(lit).not_to_have_attribute("cx", before)


def test_every_view_has_the_same_scale(bench):
    bench.locator("svg.plot").first.wait_for()
    ticks = bench.locator("svg.plot").first.locator(".axes").text_content()
    for view in ("before", "difference", "drawn", "now"):
        bench.get_by_label("Show").select_option(view)
        bench.locator(".bench-sheet polygon").first.wait_for(state="attached")
        assert bench.locator(".exaggeration").inner_text().startswith("Arrows longer than life")
        assert bench.locator("svg.plot").first.locator(".axes").text_content() == ticks
    bench.get_by_label("Show").select_option("drawn")
    bench.get_by_label("Effect", exact=True).select_option("chain_pitch")
    bench.locator("svg.plot .curve").first.wait_for()
