"""The first day on the page: its steps on a virtual machine, by the routes."""

import json
from threading import Event

import pytest
from first_day import OWNER
from folder import PATIENCE, asked, awaited, choose, got, until
from plumb.diary.file import read_diary
from plumb.guide.steps import STEPS
from plumb.guide.talk import progress_in
from plumb.line.memory import kept_before


@pytest.fixture
def lab(tmp_path):
    with asked(tmp_path) as client:
        got(client.post("/api/machine/virtual", json={"hides": "nothing", "speed": 1000}))
        until(client, lambda machine: machine["phase"] == "ready")
        yield client
        client.post("/api/machine/disconnect")


def machine_of(client):
    return client.app.app.state.line.virtual.machine


def next_question(client):
    """What the guide asks next; None if the step has ended."""
    return awaited(client, "guide", lambda guide: guide["question"] or not guide["here"])[
        "question"
    ]


def ended(client):
    awaited(client, "guide", lambda guide: not guide["here"])


def reply(client, question, text, status=200):
    body = {"number": question["number"], "reply": text}
    return got(client.post("/api/guide/answer", json=body), status)


def take(client, step, answers=OWNER, *, last=""):
    """Take a step by these answers, up to a question that has `last` in it; what was asked."""
    got(client.post("/api/guide/begin", json={"step": step}))
    questions = []
    while question := next_question(client):
        questions.append(question)
        if last and last in question["text"]:
            break
        known = f"{question['text']} {question['kind']}"
        reply(client, question, next(text for piece, text in answers.items() if piece in known))
    return questions


def test_the_whole_day(lab, tmp_path):
    for step in STEPS:
        questions = take(lab, step.name)
        guide = got(lab.get("/api/guide"))
        assert guide["trouble"] == "", guide
        moving = [question for question in questions if question["kind"] == "go"]
        assert all(question["act"] for question in moving)
    assert progress_in(tmp_path).done == [step.name for step in STEPS] and guide["open"] == ""
    choices = got(lab.get("/api/project"))["choices"]
    assert choices["settings"] == "machine.toml"
    assert choices["known"]["motor_gap"] == {"value": 2980.0, "sigma": 4.0}
    assert set(choices["known"]) == {"motor_gap", "motor_height", "rotation_radius", "sled_weight"}
    assert lab.app.app.state.line.virtual.settings.motor_gap == 2980
    machine = machine_of(lab)
    assert max(map(abs, machine.sled)) < 30 and machine.cuts()
    assert "the mark is" in guide["said"][-1].lower()
    (entry,) = read_diary(tmp_path).entries
    assert entry.content["changed"]["$2"] == [2978.4, 2980]
    assert "$2=2978.4" in kept_before(tmp_path / "machine.toml")


def test_moves_are_said_in_the_unit_of_the_page(lab):
    choose(lab, units="inch")
    take(lab, "read")
    questions = take(lab, "wires")
    assert "winds 0.79 inch of its chain in" in questions[0]["text"]
    assert not any(" mm" in question["text"] for question in questions)


def test_nothing_moves_before_a_yes_and_a_no_leaves_the_step_open(lab, tmp_path):
    take(lab, "read")
    before = machine_of(lab).chains
    (question,) = take(lab, "wires", {"LEFT motor winds": "n"})
    assert question["act"] == "Wind 20 mm of the left chain in"
    assert machine_of(lab).chains == pytest.approx(before, abs=0.02)
    assert progress_in(tmp_path).done == ["read"]


def test_a_reversed_motor_is_found_and_its_wire_named(lab):
    take(lab, "read")
    machine_of(lab).set_wire("left", "motor_reversed", True)
    take(lab, "wires", {**OWNER, "What did you see": "l"})
    guide = got(lab.get("/api/guide"))
    assert "The power wires of the left motor are swapped" in guide["said"][-1]
    assert [step["done"] for step in guide["steps"]][:2] == [True, False]
    machine_of(lab).set_wire("left", "motor_reversed", False)
    take(lab, "wires")
    assert got(lab.get("/api/guide"))["open"] == "numbers"


def test_a_step_is_left_and_taken_up_again(lab, tmp_path):
    take(lab, "read")
    take(lab, "wires", last="RIGHT motor winds")
    assert got(lab.post("/api/guide/leave"))["question"] is None
    ended(lab)
    guide = got(lab.get("/api/guide"))
    assert "You left this step" in guide["trouble"] and guide["open"] == "wires"
    assert json.loads((tmp_path / "guide.json").read_text())["done"] == ["read"]
    take(lab, "wires")
    assert got(lab.get("/api/guide"))["open"] == "numbers"


def test_steps_come_in_order_one_at_a_time(lab):
    refused = got(lab.post("/api/guide/begin", json={"step": "chains"}), 422)
    assert "first Read the machine's numbers" in refused["error"]
    got(lab.post("/api/guide/begin", json={"step": "wrong"}), 422)
    take(lab, "read")
    question = take(lab, "wires", last="LEFT motor winds")[-1]
    assert (
        "finish or leave it"
        in got(lab.post("/api/guide/begin", json={"step": "read"}), 422)["error"]
    )
    assert "busy" in got(lab.post("/api/machine/line", json={"text": "B05"}), 422)["error"]
    reply(lab, question, "perhaps", 422)
    reply(lab, {"number": question["number"] + 1}, "y", 422)
    reply(lab, question, "n")
    reply(lab, question, "n", 422)


def test_stop_ends_a_step_that_waits_and_the_line_is_free(lab):
    take(lab, "read")
    take(lab, "wires", last="LEFT motor winds")
    got(lab.post("/api/machine/stop"))
    ended(lab)
    assert "Stop was pressed" in got(lab.get("/api/guide"))["trouble"]
    until(lab, lambda machine: machine["phase"] == "ready")


def test_a_step_lasts_until_the_line_is_free(lab, monkeypatch):
    work_has_ended, line_is_free = Event(), Event()

    def working(works):
        if not works:
            work_has_ended.set()
            line_is_free.wait(PATIENCE)

    monkeypatch.setattr(lab.app.app.state.line._worker, "_working", working)
    got(lab.post("/api/guide/begin", json={"step": "read"}))
    assert work_has_ended.wait(PATIENCE)
    assert got(lab.get("/api/guide"))["here"] == "read"
    line_is_free.set()
    ended(lab)
    got(lab.post("/api/guide/begin", json={"step": "wires"}))


def test_sizes_out_of_range_are_refused(lab):
    take(lab, "read")
    take(lab, "wires")
    question = take(lab, "numbers", last="left motor's shaft")[-1]
    assert question["kind"] == "length" and question["low"] < 2978 < question["high"]
    for text in ("10", "99999", "nan", "much"):
        reply(lab, question, text, 422)
    reply(lab, question, "2978.4")
    assert next_question(lab)["text"] == "How far may that be wrong"


def test_without_a_machine_no_step_begins(tmp_path):
    with asked(tmp_path) as client:
        refused = got(client.post("/api/guide/begin", json={"step": "read"}), 422)
        assert "connect it first" in refused["error"]
        assert got(client.get("/api/guide"))["here"] == ""
