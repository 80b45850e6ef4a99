"""The first day, by the routes and on the page: a reversed motor is found, and its wire named."""

import json
from threading import Event

import pytest
from first_day import OWNER
from folder import PATIENCE, asked, awaited, got, until
from playwright.sync_api import expect
from plumb.diary.file import read_diary
from plumb.guide import STEPS, progress_in
from plumb.line.memory import kept_before
from screens import at_rest, await_question

PHONE = {"width": 375, "height": 812}


@pytest.fixture
def first_day(page, lab, cable):
    """The first page with the machine at its port connected."""
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label("Its name").fill(cable.path)
    page.get_by_role("button", name="Connect", exact=True).click()
    page.get_by_role("heading", name="Its first day, step by step").wait_for()
    return page


def test_a_reversed_motor_is_found_on_the_first_page(first_day, lab, cable):
    page = first_day
    page.get_by_role("button", name="Begin: Read the machine's numbers").click()
    page.get_by_text("The machine answers, and its numbers are in machine.toml.").wait_for()
    page.get_by_role("heading", name="This machine is open").wait_for()
    cable.owner.machine.set_wire("left", "motor_reversed", True)
    page.get_by_role("button", name="Begin: Does each motor turn the right way?").click()
    page.get_by_text("The LEFT motor winds 20 mm of its chain in").wait_for()
    page.set_viewport_size(PHONE)
    press = page.get_by_role("button", name="Wind 20 mm of the left chain in")
    assert press.bounding_box()["height"] >= 44
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    assert not page.get_by_role("button", name="Begin: What do you know").count()
    page.reload()  # the question waits
    page.get_by_role("button", name="Wind 20 mm of the left chain in").click()
    page.get_by_role("button", name="the left chain got longer").click()
    page.get_by_text("The power wires of the left motor are swapped").wait_for()
    assert progress_in(lab.folder).done == ["read"]
    cable.owner.machine.set_wire("left", "motor_reversed", False)
    page.get_by_role("button", name="Begin: Does each motor turn the right way?").click()
    for side in ("left", "right"):
        page.get_by_role("button", name=f"Wind 20 mm of the {side} chain in").click()
        page.get_by_role("button", name=f"the {side} chain got shorter").click()
    page.get_by_role("button", name="Raise the router by 1 mm").click()
    page.get_by_role("button", name="it went up").click()
    page.get_by_role("button", name="Begin: What do you know of the machine?").wait_for()
    assert progress_in(lab.folder).done == ["read", "wires"]
    page.get_by_role("button", name="Begin: What do you know of the machine?").click()
    page.get_by_role("button", name="on a ring").click()
    gap = page.get_by_label("From the middle of the left motor's shaft")
    gap.fill("9")
    expect(page.get_by_role("button", name="Keep it")).to_be_disabled()
    gap.fill("2980,5")
    page.get_by_role("button", name="Keep it").click()
    page.get_by_label("How far may that be wrong").wait_for()
    page.get_by_role("button", name="Leave this step").click()
    page.get_by_text("You left this step.").wait_for()


def test_an_answer_from_before_a_press_is_not_taken_for_the_state_after_it(first_day):
    page, looks, held = first_day, [], [True]

    def hold(route):
        answer = route.fetch()
        if held:
            looks.append((route, answer))
        else:
            route.fulfill(response=answer)

    page.route("**/api/guide", hold)
    await_question(page, looks)  # the page looks every few seconds
    page.get_by_role("button", name="Begin: Read the machine's numbers").click()
    page.get_by_text("The machine works …").wait_for()
    route, before = looks[0]
    with page.expect_response("**/api/guide") as shown:
        route.fulfill(response=before)
    shown.value.finished()
    at_rest(page)
    assert page.get_by_text("The machine works …").is_visible()
    held.clear()
    for route, answer in looks[1:]:
        route.fulfill(response=answer)
    page.get_by_text("The machine answers, and its numbers are in machine.toml.").wait_for()
    page.get_by_role("button", name="Begin: Does each motor").wait_for()


@pytest.fixture
def day(tmp_path):
    with asked(tmp_path) as client:
        got(client.post("/api/machine/virtual", json={"hides": "nothing", "speed": 1000}))
        until(client, lambda machine: machine["phase"] == "ready")
        yield client
        client.post("/api/machine/disconnect")


def machine_of(client):
    return client.app.app.state.line.virtual.machine


def next_question(client):
    """The guide's next question; None if the step has ended."""
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


def test_the_whole_day(day, tmp_path):
    for step in STEPS:
        questions = take(day, step.name)
        guide = got(day.get("/api/guide"))
        assert guide["trouble"] == "", guide
        moving = [question for question in questions if question["kind"] == "go"]
        assert all(question["answers"][0][1] for question in moving)
    assert progress_in(tmp_path).done == [step.name for step in STEPS] and guide["open"] == ""
    choices = got(day.get("/api/project"))["choices"]
    assert choices["settings"] == "machine.toml"
    assert choices["known"]["motor_gap"] == {"value": 2980.0, "sigma": 4.0}
    assert set(choices["known"]) == {"motor_gap", "motor_height", "rotation_radius", "sled_weight"}
    assert day.app.app.state.line.virtual.settings.motor_gap == 2980
    machine = machine_of(day)
    assert max(map(abs, machine.sled)) < 30 and machine.cuts()
    assert "the mark is" in guide["said"][-1].lower()
    (entry,) = read_diary(tmp_path).entries
    assert entry.content["changed"]["$2"] == [2978.4, 2980]
    assert "$2=2978.4" in kept_before(tmp_path / "machine.toml")


def test_nothing_moves_before_a_yes_and_a_no_leaves_the_step_open(day, tmp_path):
    take(day, "read")
    before = machine_of(day).chains
    (question,) = take(day, "wires", {"LEFT motor winds": "n"})
    assert question["answers"][0] == ["y", "Wind 20 mm of the left chain in"]
    assert machine_of(day).chains == pytest.approx(before, abs=0.02)
    assert progress_in(tmp_path).done == ["read"]


def test_a_step_can_be_left_and_continued(day, tmp_path):
    take(day, "read")
    take(day, "wires", last="RIGHT motor winds")
    assert got(day.post("/api/guide/leave"))["question"] is None
    ended(day)
    guide = got(day.get("/api/guide"))
    assert "You left this step" in guide["trouble"] and guide["open"] == "wires"
    assert json.loads((tmp_path / "guide.json").read_text())["done"] == ["read"]
    take(day, "wires")
    assert got(day.get("/api/guide"))["open"] == "numbers"


def test_steps_come_in_order_one_at_a_time(day):
    refused = got(day.post("/api/guide/begin", json={"step": "chains"}), 422)
    assert "first Read the machine's numbers" in refused["error"]
    got(day.post("/api/guide/begin", json={"step": "wrong"}), 422)
    take(day, "read")
    question = take(day, "wires", last="LEFT motor winds")[-1]
    assert (
        "finish or leave it"
        in got(day.post("/api/guide/begin", json={"step": "read"}), 422)["error"]
    )
    assert "busy" in got(day.post("/api/machine/line", json={"text": "B05"}), 422)["error"]
    reply(day, question, "perhaps", 422)
    reply(day, {"number": question["number"] + 1}, "y", 422)
    reply(day, question, "n")
    reply(day, question, "n", 422)


def test_stop_ends_a_step_that_waits_and_the_line_is_free(day):
    take(day, "read")
    take(day, "wires", last="LEFT motor winds")
    got(day.post("/api/machine/stop"))
    ended(day)
    assert "Stop was pressed" in got(day.get("/api/guide"))["trouble"]
    until(day, lambda machine: machine["phase"] == "ready")


def test_a_step_lasts_until_the_line_is_free(day, monkeypatch):
    work_has_ended, line_is_free = Event(), Event()

    def working(works):
        if not works:
            work_has_ended.set()
            line_is_free.wait(PATIENCE)

    monkeypatch.setattr(day.app.app.state.line._worker, "_working", working)
    got(day.post("/api/guide/begin", json={"step": "read"}))
    assert work_has_ended.wait(PATIENCE)
    assert got(day.get("/api/guide"))["here"] == "read"
    line_is_free.set()
    ended(day)
    got(day.post("/api/guide/begin", json={"step": "wires"}))
