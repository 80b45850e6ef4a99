"""Who chose distances alone is asked for them one by one, in the order in which he measures."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from folder import choose, got
from plumb.fit.inputs import settings_in
from plumb.grid import spans_in
from plumb.lab.routes.grid import _as_asked
from plumb.vm.tape import Tape

FORM = "marks.toml"
SIDES = [["1", "3"], ["3", "9"], ["9", "7"], ["7", "1"]]


def chosen(client, layout):
    """The form of a layout, as the page shows it."""
    choose(client, layout=layout)
    got(client.post("/api/grid"))
    return client.get("/api/readings").json()


def put(client, form, path, **body):
    body = {"file": form["file"], "digest": form["digest"], **body}
    return got(client.put(f"/api/{path}", json=body))


def test_a_form_of_distances_asks_for_each_in_order_and_keeps_asking(client):
    form = chosen(client, "distances")
    assert form["spans"][:4] == SIDES and len(form["spans"]) == 12
    (layout,) = (each for each in client.get("/api/layouts").json() if each["id"] == "distances")
    assert [[f"{a + 1}", f"{b + 1}"] for a, b in layout["spans"]] == form["spans"]
    assert (form["files"][0]["read"], form["files"][0]["asked"]) == (0, 12)
    lengths = [{"between": SIDES[0][::-1], "length": 2238.0}, {"between": ["2", "9"], "length": 99}]
    typed = put(client, form, "distances", distances=lengths)
    assert typed["spans"] == form["spans"], "a save keeps what is asked"
    assert (typed["files"][0]["read"], typed["files"][0]["asked"]) == (2, 13)
    finer = put(client, typed, "fineness", finest=1.0)
    assert finer["spans"] == form["spans"] and finer["distances"] == typed["distances"]
    whole = [{"between": span, "length": 900.0} for span in form["spans"]]
    done = put(client, finer, "distances", distances=whole)
    assert (done["files"][0]["read"], done["files"][0]["asked"]) == (12, 12)
    place = [{"index": 0, "read": [100, 100]}]
    placed = put(client, done, "readings", edges="top-left", readings=place)
    assert (placed["files"][0]["read"], placed["files"][0]["asked"]) == (13, 21)


def test_what_waits_for_distances_comes_first(client, tmp_path):
    text = chosen(client, "distances") and (tmp_path / FORM).read_text()
    (tmp_path / "whole.toml").write_text(text)
    form = client.get("/api/readings", params={"file": FORM}).json()
    whole = [{"between": span, "length": 900.0} for span in form["spans"]]
    put(client, form, "distances", distances=whole)
    files = client.get("/api/readings").json()["files"]
    assert [each["name"] for each in files] == ["whole.toml", FORM]


def test_other_forms_ask_for_no_distance(client):
    assert chosen(client, "nine")["spans"] == []


def test_the_tape_of_a_virtual_machine_lays_the_distances_that_are_asked(client, tmp_path):
    chosen(client, "distances")
    lengths = [1000.04 + i for i in range(12)]
    owner = SimpleNamespace(tape=SimpleNamespace(lengths=lambda spans: lengths[: len(spans)]))
    settings = settings_in(tmp_path / "groundcontrol.ini")
    text = _as_asked("places", tmp_path / FORM, settings, owner).decode()
    (tmp_path / FORM).write_text(text)
    read = client.get("/api/readings").json()
    assert [each["length"] for each in read["distances"]] == [1000.0 + i for i in range(12)]
    assert [each["between"] for each in read["distances"]] == read["spans"]
    assert all(mark["read"] is None for mark in read["marks"])
    (tmp_path / FORM).unlink()
    chosen(client, "nine")
    assert _as_asked("places", tmp_path / FORM, settings, owner) == b"places"


def test_a_line_of_the_head_says_what_is_asked(client, tmp_path):
    chosen(client, "distances")
    head = (tmp_path / FORM).read_text().splitlines()
    assert "# Lay the tape between these marks, in this order: 1 - 3, 3 - 9, 9 - 7," in head[2]
    assert [[*span] for span in spans_in(head)][:4] == SIDES
    assert spans_in(["# 1 - 3", head[2].replace("1 - 3, ", "")]) == spans_in(head)[1:]


def test_a_tape_reads_a_length_between_the_newest_marks_of_a_name():
    tape = Tape(SimpleNamespace(), np.random.default_rng(3), noise=0.5)
    places = {"1": [(0.0, 0.0), (0.0, 400.0)], "2": [(300.0, 0.0)]}
    tape._places = {name: [*map(np.array, each)] for name, each in places.items()}
    read = tape.lengths([("1", "2")] * 400)
    assert np.mean(read) == pytest.approx(math.hypot(300, 400), abs=0.1)
    assert np.std(read) == pytest.approx(0.5, rel=0.15)
