"""A cut that is held, stopped or breaks off: the folder knows how far it came, and it goes on."""

import re
from dataclasses import dataclass, field

import pytest
from folder import got, until
from garage_at_port import SPEED
from lab_machine import PATIENCE, bar
from playwright.sync_api import expect
from plumb.lab.broken_cut import begin, how_far
from plumb.lab.project import Project
from plumb.line.worker import LineState
from screens import fitted_machine
from served_lab import serve

LINES = [
    "G21",
    "G90",
    "G0 Z5",
    "G0 X1 Y1",
    "G1 Z-1",
    "G0 Z5",
    "G0 X2 Y1",
    "G1 Z-1",
    "G0 Z5",
    "G0 X0",
]


@dataclass
class Line:
    """A line that hears what it is to send."""

    state: LineState = field(default_factory=lambda: LineState("ready"))
    virtual: object = None
    sent: dict = field(default_factory=dict)

    @property
    def worker(self):
        return self

    def send(self, title, lines, **hearing):
        self.sent = {"title": title, "lines": list(lines), **hearing}

    def read_numbers(self):
        return {}


def test_a_mark_counts_as_cut_or_perhaps_cut_and_never_back(tmp_path):
    project, text, line = Project(tmp_path), "\n".join(LINES), Line()

    def far(program="grid.nc", text=text):
        now = how_far(project, line, program, text)
        return now.broke_off, now.perhaps

    begin(project, line, "grid.nc", text)
    came = line.sent["came"]
    for done, begun, *expected in ((0, 4, 0, 0), (4, 5, 0, 1), (5, 7, 1, 0), (5, 8, 1, 1)):
        came(done, begun)
        assert far() == tuple(expected)
    came(5, 7)  # it was stopped before it began the second
    assert far() == (1, 0)
    begin(project, line, "grid.nc", text, on_sheet=1)
    line.sent["came"](3, 4)  # its modes come again
    assert far() == (1, 0)
    assert far("grid-2.nc") == far(text=text + "G0") == (None, 0)
    begin(project, line, "proof.nc", text)
    line.sent["came"](0, 5)
    assert (far(), far("proof.nc")) == ((1, 0), (0, 1))
    line.sent["then"](None)
    assert (far(), far("proof.nc")) == ((1, 0), (2, 0))  # all are cut


def test_proof_marks_that_broke_off_are_asked_for_too(lab, page):
    fitted_machine(lab.folder)
    with lab.client() as client:
        got(client.post("/api/rounds/proof"))
        # It is sent as it was made; in the folder it names its form too.
        told = (lab.folder / "proof.nc").read_text().splitlines(keepends=True)
        line = Line()
        sent = "".join(line for line in told if not line.startswith("("))
        begin(Project(lab.folder), line, "proof.nc", sent)
        line.sent["came"](0, 7)  # the first plunge has left
        check = got(client.get("/api/proof"))["round"]
        assert (check["broke_off"], check["perhaps"], check["goes_on"]) == (0, 1, True)
        assert (
            "no machine is connected"
            in got(client.post("/api/rounds/proof/go-on", json={"cut": 0}), 422)["error"]
        )
    page.goto(f"{lab.url}#/prove")
    said = "Cut 0 of 2 marks, then it broke off. The machine may have cut mark 1 too."
    expect(page.get_by_text(said)).to_be_visible()
    line.sent["came"](0, len(sent.splitlines()))
    page.reload()
    expect(page.get_by_text("The machine may have cut marks 1 and 2 too.")).to_be_visible()


def test_hold_waits_and_a_stopped_cut_goes_on_from_the_next_mark(lab, page, garage):
    with lab.client() as client:
        connect(client, garage)
        got(client.post("/api/machine/settings"))
        page.goto(f"{lab.url}#/cut")
        page.get_by_role("button", name="Move the sled and cut 9 marks").click()
        until(client, lambda machine: garage.marks >= 2)
        garage.run_at(1)  # so that it still cuts then
        page.keyboard.press("Escape")
        go_on = bar(page).get_by_role("button", name="Go on")
        go_on.wait_for(timeout=PATIENCE)
        garage.run_at(10)
        until(client, lambda machine: machine["holds"] and not machine["moves"])
        expect(bar(page)).to_contain_text("holds")
        go_on.click()
        until(client, lambda machine: machine["moves"] and machine["place"][2] > 3)
    bar(page).get_by_role("button", name="Stop").click()
    expect(page.get_by_text(re.compile("Cut [2-8] of 9 marks, then it broke off"))).to_be_visible()
    expect(page.get_by_role("button", name="Begin again on a fresh sheet: move")).to_be_visible()
    garage.run_at(SPEED)
    page.get_by_role("button", name=re.compile("Go on: move the sled and cut from mark")).click()
    expect(page.get_by_text("All marks are cut.")).to_be_visible(timeout=PATIENCE)
    assert garage.marks == 9


def test_no_mark_is_cut_twice_after_the_lab_died_in_a_cut(lab, page, garage):
    """A machine goes on with the lines that it has; nobody but its owner sees how far it came."""
    with lab.client() as client:
        connect(client, garage)
        got(client.post("/api/machine/settings"))
        got(client.post("/api/rounds/marks/cut"))
        until(client, lambda machine: garage.marks >= 3)
    lab.process.kill()
    lab.process.wait()
    there = garage.marks_at_rest()
    lab.process = serve(lab.folder, port=lab.port).process
    with lab.client() as client:
        grid = got(client.get("/api/rounds/marks"))
        surely, perhaps = grid["broke_off"], grid["perhaps"]
        assert surely < there <= surely + perhaps
        connect(client, garage)
        for wrong in (surely - 1, surely + perhaps + 1):
            refused = got(client.post("/api/rounds/marks/go-on", json={"cut": wrong}), 422)
            assert "how many marks are on the sheet" in refused["error"]
        page.goto(f"{lab.url}#/cut")
        go_on_from(page, grid["marks"], there)
        until(client, lambda machine: machine["phase"] == "ready" and garage.marks == 9)
    assert garage.marks_at_rest() == 9


def test_a_cut_whose_line_was_lost_goes_on_once_the_machine_knows_its_chains(lab, page, garage):
    """Fields start empty; the last known chain lengths are offered only as such."""
    with lab.client() as client:
        connect(client, garage)
        got(client.post("/api/machine/settings"))
        page.goto(f"{lab.url}#/cut")
        page.get_by_role("button", name="Move the sled and cut 9 marks").click()
        until(client, lambda machine: garage.marks >= 3)
        garage.run_at(1)
        until(client, lambda machine: machine["moves"] and machine["place"][2] > 3)
    garage.pull_out()
    expect(bar(page)).to_contain_text("the line is lost", timeout=PATIENCE)
    garage.plug_in(1)
    page.reload()
    with lab.client() as client:
        connect(client, garage)
        marks = got(client.get("/api/rounds/marks"))["marks"]
    garage.run_at(SPEED)
    there, lengths = garage.marks, garage.lengths
    button = page.get_by_role("button", name="Set both lengths; nothing moves")
    expect(button).to_be_disabled(timeout=PATIENCE)
    fields = page.locator(".set-chains input")
    assert [each.input_value() for each in fields.all()] == ["", "", ""]
    page.get_by_role("button", name="Type these in").click()
    last = [float(each.input_value()) for each in fields.all()]
    assert last != pytest.approx(lengths, abs=1)  # it was moving
    for each, length in zip(fields.all(), lengths, strict=True):
        each.fill(f"{length:.1f}")
    button.click()
    expect(bar(page)).to_contain_text("stands", timeout=PATIENCE)
    go_on_from(page, marks, there)
    assert garage.marks_at_rest() == 9
    # What is cut stays cut when the line is lost once more.
    garage.pull_out()
    garage.plug_in()
    with lab.client() as client:
        connect(client, garage)
    expect(bar(page)).to_contain_text("stands", timeout=PATIENCE)
    expect(page.get_by_role("link", name="Type what your tape says")).to_have_class(
        re.compile("primary")
    )


def connect(client, garage):
    """Connect the machine at its port."""
    got(client.post("/api/machine/board", json={"port": garage.path}))
    until(client, lambda machine: machine["phase"] == "ready")


def go_on_from(page, marks, there):
    """Say how many marks are on the sheet, and go on; nothing is chosen before."""
    go_on = page.get_by_role("button", name=re.compile("^Go on: "))
    expect(go_on).to_have_text("Go on: say first which mark is the last", timeout=PATIENCE)
    expect(go_on).to_be_disabled()
    page.get_by_role("radio", name=f"mark {marks[there - 1]['name']}", exact=True).check()
    expect(go_on).to_have_text(f"Go on: move the sled and cut from mark {marks[there]['name']}")
    go_on.click()
    expect(page.get_by_text("All marks are cut.")).to_be_visible(timeout=PATIENCE)
