"""Distances between marks on Verdict and Bench, in a real browser."""

import json
import re

import pytest
from folder import EXAMPLE, asked, finished, got
from playwright.sync_api import expect
from plumb.cure.auto import add_auto
from plumb.lab.project import Project
from plumb.lab.rounds import inputs_of
from plumb.marks.read import read_marks
from screens import at_rest, measured_machine

LINES = ".sheet .span-errors line"
SMALL = (0.9, -0.7, 0.3, -1.4, 0.1, 0.8, -0.2, 1.1, -0.6, 0.5, -0.9, 0.4)  # [mm] off, in turn


def taped(folder, *, slip=0.0, marks=False):
    """A folder whose form has twelve distances, the third read off by a slip [mm]."""
    folder.mkdir(exist_ok=True)
    (folder / "groundcontrol.ini").write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    read = read_marks(EXAMPLE / "marks.toml", sheet=(2440.0, 1220.0)).measured_marks[:9]
    places = {mark.name: mark for mark in read}
    names = [*places]
    spans = [(names[i], names[(i + step) % 9]) for step in (1, 4) for i in range(9)][:12]
    lines = ['frame = "machine"', "tape_sigma_mm = 0.5", ""]
    for name, mark in places.items():
        lines += ["[[mark]]", f'name = "{name}"', f"target = {[*mark.target]}"]
        lines += [f"measured = {[*mark.measured]}"] * marks + [""]
    for i, (first, second) in enumerate(spans):
        (x, y), (u, v) = places[first].measured, places[second].measured
        length = ((x - u) ** 2 + (y - v) ** 2) ** 0.5 + SMALL[i] + slip * (i == 2)
        lines += ["[[distance]]", f'between = ["{first}", "{second}"]', f"mm = {length:.1f}"]
    (folder / "marks.toml").write_text("\n".join([*lines, ""]))
    choices = {"settings": "groundcontrol.ini", "marks": ["marks.toml"]}
    (folder / "lab.json").write_text(json.dumps(choices))


@pytest.mark.parametrize("screen", ["verdict", "bench"])
def test_each_distance_is_a_line_by_its_error(lab, page, screen):
    taped(lab.folder)
    page.goto(f"{lab.url}#/{screen}")
    at_rest(page)
    lines = page.locator(LINES)
    expect(lines).to_have_count(12)
    page.get_by_role("group", name="What is drawn").get_by_role("radio", name="as set").check()
    widths = [float(each.get_attribute("stroke-width")) for each in lines.all()]
    errors = [
        abs(float(text.replace("\u2212", "-")))
        for text in page.locator(".taped-errors td:last-child").all_inner_texts()
    ]
    assert errors == sorted(errors, reverse=True) and len(errors) == 12
    assert max(widths) == 12 and len(set(widths)) > 6
    assert page.locator("svg.plot").count() == 0  # nothing is known of single chains
    assert page.get_by_role("button", name=re.compile("Lay")).count() == 0


@pytest.mark.parametrize("screen", ["verdict", "bench"])
def test_a_distance_in_doubt_is_ringed_and_makes_no_other_line_thinner(lab, page, screen):
    taped(lab.folder, slip=100.0, marks=True)
    page.goto(f"{lab.url}#/{screen}")
    at_rest(page)
    page.get_by_role("radio", name="as set").check() if screen == "bench" else None
    expect(page.locator(".sheet .span-errors .doubted circle.doubt")).to_have_count(1)
    expect(page.locator(".taped-errors tr.doubted")).to_contain_text("3 and 4")
    widths = [float(each.get_attribute("stroke-width")) for each in page.locator(LINES).all()]
    assert sorted(widths)[-1] == 12 and sorted(widths)[6] > 4


@pytest.mark.parametrize("marks", [False, True])
def test_verdict_and_bench_ask_the_same_fit(tmp_path, marks):
    taped(tmp_path, marks=marks)
    same_figures(tmp_path)


def test_what_is_usual_of_a_size_counts_on_the_bench_too(tmp_path):
    measured_machine(tmp_path)
    assert add_auto(inputs_of(Project(tmp_path))).diagnosis.usual
    same_figures(tmp_path)


def same_figures(folder):
    """What the verdict leaves of the readings is what the bench leaves with the same effects."""
    with asked(folder) as client:
        _, *fitted = finished(client, "verdict")["verdict"]["states"]
        chosen = [[], list(add_auto(inputs_of(Project(folder))).chosen)]
        for state, effects in zip(fitted, chosen, strict=False):
            fit = got(client.post("/api/bench/fit", json={"effects": effects}))
            for figure in ("fit_rms", "noise_rms"):
                assert fit[figure] == pytest.approx(state[figure], abs=1e-4), effects
