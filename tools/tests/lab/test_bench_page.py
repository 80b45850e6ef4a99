"""The bench for effects in a real browser, also of distances; how soon it is answered."""

import json
import math
import re
import socket
import time
import tomllib
from dataclasses import replace

import plumb.lab.rounds
import pytest
from folder import EXAMPLE, got, with_marks
from playwright.sync_api import expect
from plumb.marks.form import marks_toml
from plumb.marks.read import Distance, Measurements, read_marks
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


def test_a_chosen_mark_is_highlighted_in_every_plot_and_on_the_sheet(bench):
    plots = bench.locator("svg.plot")
    shown = plots.count()
    assert shown >= 8
    dots = plots.first.locator("path.dots.left").get_attribute("d")
    x, y = map(float, re.match(r"M(\S+) (\S+)h0", dots).groups())
    box = plots.first.bounding_box()
    scale = box["width"] / 148
    plots.first.click(position={"x": x * scale, "y": y * scale})
    expect(bench.locator(".sheet circle.lit")).to_have_count(1)
    for i in range(shown):
        expect(plots.nth(i).locator("circle.lit")).to_have_count(2)  # left and right, or x and y
    expect(bench.locator(".card-of-mark")).to_contain_text("Mark 1")


MOST_S = 0.03  # after its header; a body that waits for a receipt comes after 0.04


def body_after_header(lab):
    """How long the body of an answer comes after its header [s]."""
    with socket.create_connection(("127.0.0.1", lab.port)) as line:
        head = f"GET /api/project HTTP/1.1\r\nHost: 127.0.0.1:{lab.port}\r\n"
        line.sendall(f"{head}X-Plumb-Token: {lab.token}\r\n\r\n".encode())
        text = b""
        while b"\r\n\r\n" not in text:
            text += line.recv(65536)
        start = time.monotonic()
        head, _, body = text.partition(b"\r\n\r\n")
        length = int(head.lower().split(b"content-length: ")[1].split(b"\r\n")[0])
        while len(body) < length:
            body += line.recv(65536)
        json.loads(body)
        return time.monotonic() - start


def test_a_body_is_sent_together_with_its_header(lab):
    measured_machine(lab.folder)
    assert min(body_after_header(lab) for _ in range(20)) < MOST_S


def test_a_refit_reads_no_marks_again(tmp_path, monkeypatch):
    client = with_marks(tmp_path)
    body = {"effects": ["chain_pitch"], "held": {"chain_pitch.left": 0.001}}
    first = got(client.post("/api/bench/fit", json=body))
    assert "groundcontrol.ini marks.toml" in first["command"]
    monkeypatch.setattr(plumb.lab.rounds, "read_form", None)
    monkeypatch.setattr(plumb.lab.rounds, "settings_in", None)
    body["held"]["chain_pitch.left"] = 0.002
    assert got(client.post("/api/bench/fit", json=body))["fit_rms"] != first["fit_rms"]


LINES = ".sheet .span-errors line"
SMALL = (0.9, -0.7, 0.3, -1.4, 0.1, 0.8, -0.2, 1.1, -0.6, 0.5, -0.9, 0.4)  # [mm] off, in turn


def taped(folder, *, slip=0.0, marks=False):
    """A folder whose form has twelve distances, the third read off by a slip [mm]."""
    measured_machine(folder)
    read = read_marks(EXAMPLE / "marks.toml", sheet=(2440.0, 1220.0)).measured_marks[:9]
    spans = []
    for i, (first, second) in enumerate([(i, i + step) for step in (1, 4) for i in range(9)][:12]):
        ends = read[first], read[second % 9]
        length = math.dist(*(end.measured for end in ends)) + SMALL[i] + slip * (i == 2)
        spans.append(Distance(tuple(end.name for end in ends), round(length, 1)))
    taped = read if marks else [replace(mark, measured=None) for mark in read]
    measurements = Measurements(tuple(taped), tuple(spans), tape_sigma=0.5)
    (folder / "marks.toml").write_text(marks_toml(measurements))


def test_each_distance_is_a_line_by_its_error(lab, page):
    taped(lab.folder)
    page.goto(f"{lab.url}#/verdict")
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


def test_a_correction_draws_the_distances_too(lab, page):
    taped(lab.folder, marks=True)
    page.goto(f"{lab.url}#/correct")
    at_rest(page)
    expect(page.locator(LINES)).to_have_count(12)
    expect(page.get_by_role("img", name=re.compile("9 marks and 12 distances"))).to_have_count(1)


def test_a_distance_in_doubt_is_ringed_and_makes_no_other_line_thinner(lab, page):
    taped(lab.folder, slip=100.0, marks=True)
    page.goto(f"{lab.url}#/bench")
    at_rest(page)
    page.get_by_role("radio", name="as set").check()
    expect(page.locator(".sheet .span-errors .doubted circle.doubt")).to_have_count(1)
    expect(page.locator(".taped-errors tr.doubted")).to_contain_text("3 and 4")
    widths = [float(each.get_attribute("stroke-width")) for each in page.locator(LINES).all()]
    assert sorted(widths)[-1] == 12 and sorted(widths)[6] > 4
