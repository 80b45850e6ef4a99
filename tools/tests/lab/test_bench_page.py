"""The bench for effects in a real browser."""

import re
import tomllib

import pytest
from playwright.sync_api import expect
from screens import at_rest, measured_machine

STAIRS = ".stairs tbody td:nth-of-type(2)"


@pytest.fixture
def bench(lab, page):
    """The bench of the example's marks."""
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/bench")
    at_rest(page)
    return page


def stairs(page):
    """The errors of the fit, stair by stair."""
    at_rest(page)
    return [float(text) for text in page.locator(STAIRS).all_inner_texts()]


def test_an_effect_is_added_and_the_error_falls(bench, lab):
    as_set, frame = stairs(bench)
    bench.get_by_role("checkbox", name="chains too long").check()
    *_, fitted = stairs(bench)
    assert as_set > frame > 2 * fitted
    places, ghosts = bench.locator(".sheet circle.place"), bench.locator(".sheet path.ghost")
    expect(ghosts).to_have_count(23)  # the state before, below that of now
    expect(places).to_have_count(23)
    slider = bench.get_by_role("slider", name="left chain too long")
    slider.press("Home")
    bench.get_by_role("button", name="Fit: left chain too long").wait_for()
    assert stairs(bench)[2] > 1.5 * fitted
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
    shown = plots.count()
    assert shown >= 8
    dots = plots.first.locator("path.dots.left").get_attribute("d")
    x, y = map(float, re.match(r"M(\S+) (\S+)h0", dots).groups())
    box = plots.first.bounding_box()
    scale = box["width"] / 250
    plots.first.click(position={"x": x * scale, "y": y * scale})
    expect(bench.locator(".sheet circle.lit")).to_have_count(1)
    for i in range(shown):
        expect(plots.nth(i).locator("circle.lit")).to_have_count(2)  # left and right, or x and y
    expect(bench.locator(".card-of-mark")).to_contain_text("Mark 1")


def test_every_state_has_the_same_scale_and_an_effect_lies_over_what_the_frame_leaves(bench):
    plot = bench.locator("svg.plot").nth(2)
    axes = plot.locator(".axes")
    states = bench.get_by_role("group", name="What is drawn")
    bench.get_by_role("checkbox", name="chains too long").check()
    at_rest(bench)
    ticks = axes.text_content()
    factor = bench.get_by_label("Arrows longer than life")
    fitted = factor.input_value()
    assert bench.locator("svg.plot .curve.left").count() == 0
    bench.get_by_role("button", name="Lay over the marks: chains too long").click()
    at_rest(bench)
    expect(states.get_by_role("radio", name="frame fitted")).to_be_checked()
    assert bench.locator("svg.plot .curve.left").count() > 0
    expect(bench.locator(".sheet .print path")).to_have_count(23)
    assert (factor.input_value(), axes.text_content()) == (fitted, ticks)
    states.get_by_role("radio", name="as set").check()
    assert int(factor.input_value()) < int(fitted)
    expect(bench.locator(".sheet .print path")).to_have_count(0)  # it is drawn into the frame's fit
    bench.get_by_role("button", name="Lay over the marks: chains too long").click()
    expect(bench.locator("svg.plot .curve.left")).to_have_count(0)
