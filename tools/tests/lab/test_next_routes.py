"""Taking a proposal: the files of its command, byte for byte; cut, typed and counted."""

import json
import shlex
from contextlib import contextmanager

import pytest
from folder import asked, finished, got, type_in, until
from plumb.cli.main import main
from plumb.lab.broken_cut import digest_of_sent
from plumb.lab.project import CUT
from plumb.marks.form import marks_toml, read_form
from plumb.marks.read import Measurements
from plumb.settings import write_machine_toml
from plumb.vm.garage import VirtualOwner
from synthetic import BELIEVED, SHEET, TRUE, grid, marks_on

MARKS = "marks.toml"
BEFORE = {"machine.toml", MARKS, "lab.json"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A machine whose nine marks leave a question open."""
    path = tmp_path_factory.mktemp("garage")
    write_machine_toml(path / "machine.toml", BELIEVED)
    marks = marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3, seed=2)
    (path / MARKS).write_text(marks_toml(Measurements(marks)))
    return path


@pytest.fixture(scope="module")
def kept(folder):
    """Its lab, which works a proposal out once for each state of the folder."""
    with asked(folder) as client:
        yield client


@pytest.fixture
def client(kept, folder, monkeypatch):
    """The lab with the folder as it was."""
    monkeypatch.chdir(folder)
    # What the page leaves out for brevity can be taken like the rest.
    monkeypatch.setattr("plumb.lab.routes.next.MOST_OTHERS", 99)
    kept.post("/api/machine/disconnect")
    for path in folder.iterdir():
        if path.name not in ("machine.toml", MARKS):
            path.unlink()
    choose(folder)
    return kept


def choose(folder, **choices):
    said = {"settings": "machine.toml", "marks": [MARKS], **choices}
    (folder / "lab.json").write_text(json.dumps(said))


def takings(client):
    """What can be taken, by its title."""
    offers = finished(client, "next")["offers"]
    return {each["proposal"]["title"]: each["taking"] for each in offers if each["taking"]}


def wanted(taking):
    return {"choose": taking["choose"], "digest": taking["digest"]}


def take(client, title):
    taking = takings(client)[title]
    got(client.post("/api/next", json=wanted(taking)))
    return taking


def names(folder):
    names = {path.name for path in folder.iterdir()} - {".lab.lock"}
    # The lab keeps the settings of each form by their digest.
    return {name for name in names if not name.startswith(".settings-")}


@contextmanager
def virtual_machine(client, *, speed=1000):
    """The lab with a virtual machine that is ready."""
    got(client.post("/api/machine/virtual", json={"seed": 9, "speed": speed}))
    until(client, lambda state: state["phase"] == "ready")
    yield
    got(client.post("/api/machine/disconnect"))


def test_an_accepted_proposal_is_what_the_command_writes(client, folder):
    choose(folder, units="inch", known={"motor_gap": {"value": 2979.0, "sigma": 0.5}})
    each = takings(client)
    assert {"4 marks with 5 kg more", "every mark read again"} <= {*each}
    for title, taking in each.items():
        got(client.post("/api/next", json=wanted(taking)))
        files = [name for name in (taking["form"], taking["program"]) if name]
        assert names(folder) == BEFORE | {*files}
        here = {name: (folder / name).read_bytes() for name in files}
        for name in files:
            (folder / name).unlink()
        assert main(shlex.split(taking["command"])[1:]) == 0
        assert {name: (folder / name).read_bytes() for name in files} == here, title
        assert bool(taking["program"]) is (title != "every mark read again")
        got(client.delete("/api/next"))
        assert names(folder) == BEFORE


def test_accepted_marks_are_cut_read_and_counted(client, folder):
    before = got(client.get("/api/rounds/marks"))
    assert (before["program"], before["origin"], before["pauses"]) == ("grid-2.nc", "chosen", [])
    take(client, "4 marks with 5 kg more")
    shown = got(client.get("/api/rounds/marks"))
    assert (shown["program"], shown["form"], shown["origin"]) == (
        "more.nc",
        "more.toml",
        "proposed",
    )
    assert shown["trouble"] == "" and shown["waits"] == len(shown["marks"]) == 4
    assert [pause["do"] for pause in shown["pauses"]] == [
        "let 5.0 kg more hang on the sled, low and in the middle",
        "take off what hangs on the sled",
    ]
    lines = shown["lines"]
    first, last = (pause["lines"] for pause in shown["pauses"])
    assert first < lines[0] and lines == sorted(lines) and lines[-1] < last
    assert got(client.get("/api/readings"))["file"] == "more.toml"
    type_in(client, "more.toml", (2.0, 0))
    assert got(client.get("/api/project"))["choices"]["marks"] == [MARKS, "more.toml"]
    assert len(got(client.get("/api/bench"))["marks"]) == 13
    assert got(client.get("/api/rounds/marks"))["program"] == "grid-2.nc"
    assert got(client.delete("/api/next"), 422)["error"] == "more.toml has readings, so it stays"
    assert (folder / "more.toml").exists() and (folder / "more.nc").exists()


def test_nothing_in_the_folder_is_overwritten(client, folder):
    (folder / "more.toml").write_text("mine")
    (folder / "more-2.nc").write_text("mine too")
    taking = take(client, "4 more marks")
    assert (taking["form"], taking["program"]) == ("more-3.toml", "more-3.nc")
    assert (folder / "more.toml").read_text() == "mine"
    again = take(client, "4 more marks")
    assert again["form"] == "more-3.toml" and again["is_saved"] and not taking["is_saved"]
    assert not (folder / "more-4.toml").exists()
    other = take(client, "4 marks with 5 kg more")
    assert other["form"] == "more-4.toml"
    got(client.delete("/api/next"))
    assert names(folder) == BEFORE | {"more.toml", "more-2.nc", "more-3.toml", "more-3.nc"}


def test_a_proposal_that_the_page_did_not_show_is_refused(client, folder):
    taking = takings(client)["4 more marks"]
    other = takings(client)["4 marks with 5 kg more"]
    for changed in ({"digest": "0" * 64}, {"choose": other["choose"]}):
        refused = got(client.post("/api/next", json={**wanted(taking), **changed}), 409)
        assert "has changed in the meantime" in refused["error"]
    for number in (0, 99):
        body = {**wanted(taking), "choose": number}
        assert "no proposal number" in got(client.post("/api/next", json=body), 422)["error"]
    check = next(i for i in range(1, 9) if i not in {t["choose"] for t in takings(client).values()})
    body = {"choose": check, "digest": ""}
    assert "has no marks" in got(client.post("/api/next", json=body), 422)["error"]
    choose(folder, known={"motor_gap": {"value": 2979.0, "sigma": 0.4}})
    body = wanted(taking)
    assert "still worked out" in got(client.post("/api/next", json=body), 422)["error"]
    assert names(folder) == BEFORE


@pytest.mark.parametrize("name", [MARKS, "more.toml.bak"])
def test_only_a_form_of_a_proposal_can_be_removed(client, folder, name):
    (folder / "machine.nc").write_text("mine")
    (folder / "more.toml.bak").write_text("mine")
    choose(folder, proposed=name)
    assert "no proposal was taken" in got(client.delete("/api/next"), 422)["error"]
    assert got(client.get("/api/rounds/marks"))["origin"] == "chosen"
    assert {name, "machine.nc"} <= names(folder)


def test_after_a_correction_the_form_names_the_settings_that_are_open(client, folder):
    text = (folder / "machine.toml").read_text()
    (folder / "machine-2.toml").write_text(text.replace("2978.4", "2981.0"))
    marks = (folder / MARKS).read_text()
    try:
        (folder / MARKS).write_text(f'cut_with = "machine.toml"\n{marks}')
        choose(folder, settings="machine-2.toml")
        taking = take(client, "4 more marks")
        assert "--cut-next-with machine-2.toml" in taking["command"]
        form = (folder / "more.toml").read_bytes()
        assert b'cut_with = "machine-2.toml"' in form
        (folder / "more.toml").unlink()
        assert main([*shlex.split(taking["command"])[1:], "--json"]) == 0
        assert (folder / "more.toml").read_bytes() == form
        rounds = read_form(folder / "more.toml", sheet=SHEET).measurements.rounds
        assert rounds[0].cut_with.motor_gap == 2981.0
    finally:
        (folder / MARKS).write_text(marks)


def test_a_virtual_machine_bears_the_weight_from_pause_to_pause(client, folder, monkeypatch):
    borne, weigh_down = [], VirtualOwner.weigh_down

    def weighing(owner, weight):
        borne.append(round(weight - owner.settings.sled_weight, 1))
        weigh_down(owner, weight)

    monkeypatch.setattr(VirtualOwner, "weigh_down", weighing)
    take(client, "4 marks with 5 kg more")
    with virtual_machine(client):
        got(client.post("/api/machine/numbers", json={"file": "machine.toml"}))
        got(client.post("/api/rounds/marks/cut"))
        waiting = until(client, lambda state: state["waits_for"])
        assert waiting["waits_for"].startswith("let 5.0 kg more hang") and waiting["holds"]
        assert borne == [0.0, pytest.approx(5 * 9.81, abs=0.1)]
        got(client.post("/api/machine/go-on"))
        until(client, lambda state: state["waits_for"].startswith("take off"))
        assert borne[2:] == [0.0]
        assert got(client.get("/api/machine"))["program"]["outcome"] == "running"
        got(client.post("/api/machine/go-on"))
        until(client, lambda state: state["program"]["outcome"] == "done")
        got(client.post("/api/rounds/marks/cut"))
        until(client, lambda state: state["waits_for"])
        got(client.post("/api/machine/stop"))
        until(client, lambda state: state["phase"] == "ready")
        got(client.post("/api/rounds/marks/cut"))  # whoever gave up begins with nothing on the sled
        assert borne[3:5] == [0.0, pytest.approx(5 * 9.81, abs=0.1)] and borne[5] == 0.0


def test_a_broken_off_proposal_goes_on_with_its_extra_weight(client, folder, monkeypatch):
    borne = []
    monkeypatch.setattr(VirtualOwner, "weigh_down", lambda owner, weight: borne.append(weight))
    taking = take(client, "4 marks with 5 kg more")
    with virtual_machine(client, speed=50):
        got(client.post("/api/machine/numbers", json={"file": "machine.toml"}))
        got(client.post("/api/rounds/marks/cut"))
        until(client, lambda state: state["waits_for"])
        got(client.post("/api/machine/go-on"))
        lines = got(client.get("/api/rounds/marks"))["lines"]
        until(client, lambda state: state["program"]["done"] > lines[1])
        got(client.post("/api/machine/stop"))
        until(client, lambda state: state["phase"] == "ready")
        shown = got(client.get("/api/rounds/marks"))
        on_sheet = shown["broke_off"] + shown["perhaps"]
        assert shown["goes_on"] and 1 <= on_sheet < 4
        borne.clear()
        got(client.post("/api/rounds/marks/go-on", json={"cut": on_sheet}))
        for asks, more in (("let 5.0 kg more hang", 5 * 9.81), ("take off", 0.0)):
            until(client, lambda state, asks=asks: state["waits_for"].startswith(asks))
            assert borne[-1] == pytest.approx(BELIEVED.sled_weight + more, abs=0.1)
            got(client.post("/api/machine/go-on"))
        until(client, lambda state: state["program"]["outcome"] == "done")
        assert len(borne) == 2
        got(client.post("/api/machine/readings", json={"form": taking["form"]}))


def test_a_proposal_with_a_pause_between_its_marks_does_not_go_on(client, folder):
    taking = take(client, "4 more marks")
    head, mark, rest = (folder / taking["program"]).read_text().rpartition("(mark ")
    text = f"{head}(let 5.0 kg more hang on the sled)\nM0\n{mark}{rest}"
    (folder / taking["program"]).write_text(text)
    note = {"digest": digest_of_sent(text), "marks": 1, "begun": 1, "is_virtual": False}
    (folder / CUT).write_text(json.dumps({taking["program"]: note}))
    shown = got(client.get("/api/rounds/marks"))
    assert shown["broke_off"] == 1 and not shown["goes_on"]
