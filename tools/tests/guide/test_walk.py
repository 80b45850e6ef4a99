"""The first day of a virtual machine, with an owner who types prepared answers."""

import json
import re

import pytest
from first_day import OWNER
from plumb.bench.causes import Hidden
from plumb.diary.file import read_diary
from plumb.firmware.settings import CLIENT_NUMBERS
from plumb.fit.inputs import settings_in
from plumb.guide.steps import STEPS, Visit, walk
from plumb.guide.talk import Talk, progress_in
from plumb.line.memory import kept_before, read_numbers
from plumb.line.sender import Sender
from plumb.text.errors import InputError
from plumb.text.values import shown_in
from plumb.vm.garage import EXTENDED, Garage
from plumb.vm.owner import InProcessPort


@pytest.fixture
def machine():
    running = Garage(Hidden()).machine()
    running.start()
    return running


def visit_of(machine, folder, answers, *, unit="mm"):
    """A visit whose owner answers by `answers`; what the guide said is in visit.said."""
    said = []

    def answer(question):
        assert said.count(question) < 9, f"asked again and again: {question}"
        said.append(question)
        for piece, text in answers.items():
            if piece in question:
                return text
        raise EOFError

    sender = Sender(InProcessPort(machine))
    sender.await_start()
    sender.stream([f"${number}={value:g}" for number, value in CLIENT_NUMBERS.items()])
    visit = Visit(sender, Talk(said.append, answer, unit=unit), progress_in(folder))
    visit.said = said
    return visit


def hanging(visit, machine):
    """The owner hangs the sled when asked: before, the chains hung free, and as long as ever."""
    prepared = visit.talk.answer

    def answer(question):
        if "Hang the sled" in question:
            machine.slip("left", -EXTENDED)
            machine.slip("right", -EXTENDED)
        return prepared(question)

    visit.talk.answer = answer
    return visit


def test_the_whole_day(machine, tmp_path):
    visit = hanging(visit_of(machine, tmp_path, {**OWNER, "top edge up": "464,5"}), machine)
    assert walk(visit), visit.said[-5:]
    assert progress_in(tmp_path).done == [step.name for step in STEPS]
    settings = settings_in(tmp_path / "machine.toml")
    assert settings.motor_gap == 2980
    said = "\n".join(visit.said)
    assert f"plumb send --undo {tmp_path}/machine.toml brings" in said
    assert f"plumb reach {tmp_path}/machine.toml draws" in said
    assert settings.motor_height == pytest.approx(464.5 + settings.sheet_height / 2)
    assert read_numbers(visit.sender)[2] == 2980
    assert max(map(abs, machine.sled)) < 15  # the true gap is another
    assert machine.cuts()
    (entry,) = read_diary(tmp_path).entries
    assert entry.content["changed"]["$2"] == [2978.4, 2980]
    assert "$2=2978.4" in kept_before(tmp_path / "machine.toml")


def test_nothing_moves_without_a_yes(machine, tmp_path):
    chains = machine.chains
    refused = {piece: "n" if text == "y" else text for piece, text in OWNER.items()}
    visit = visit_of(machine, tmp_path, refused)
    assert not walk(visit)
    for name in ("chains", "mark"):
        assert not walk(visit, first=name)
    assert progress_in(tmp_path).done == ["read"]
    assert machine.chains == pytest.approx(chains, abs=0.02)


def visit_at_twelve(visit):
    """A visit whose owner leaves when the sprockets have to be turned."""
    prepared = visit.talk.answer
    visit.talk.answer = lambda question: "q" if "sprocket turns" in question else prepared(question)
    return visit


def test_a_step_that_was_left_is_taken_up_again(machine, tmp_path):
    visit = visit_of(machine, tmp_path, {"RIGHT motor winds": "q", **OWNER})
    assert not walk(visit)
    assert progress_in(tmp_path).done == ["read"]
    again = visit_of(machine, tmp_path, {**OWNER, "turn": "q"})
    assert not walk(again)
    assert progress_in(tmp_path).done == ["read", "wires", "numbers", "reach"]
    assert not any("numbers are in machine.toml" in line for line in again.said)
    assert progress_in(tmp_path).sigmas["motor_gap"] == 4


def test_a_wire_that_is_wrong_keeps_the_step_open(machine, tmp_path):
    machine.set_wire("right", "encoder_reversed", True)
    visit = visit_of(machine, tmp_path, OWNER)
    assert not walk(visit)
    assert any("encoder of the right motor counts backwards" in line for line in visit.said)
    assert progress_in(tmp_path).done == ["read"]


def test_inches_and_fractions(machine, tmp_path):
    answers = {
        **OWNER,
        "left motor's shaft": "118 1/8",
        "top edge up": "18.5",
        "may that be wrong": "1/4",
    }
    answers["end of a chain"] = "5 1/2"
    visit = visit_of(machine, tmp_path, {**answers, "turn": "q"}, unit="inch")
    with shown_in("inch"):
        assert not walk(visit)
    assert any("winds 0.79 inch of its chain in" in line for line in visit.said)
    assert not [line for line in visit.said if re.search(r"\bmm\b", line)]
    assert settings_in(tmp_path / "machine.toml").motor_gap == pytest.approx(118.125 * 25.4)
    assert visit.progress.sigmas["motor_gap"] == pytest.approx(6.35)


def test_a_sled_on_brackets_is_none_of_the_labs(machine, tmp_path):
    visit = visit_of(machine, tmp_path, {**OWNER, "How does the sled hang": "b"})
    numbers = read_numbers(visit.sender)
    assert not walk(visit)
    assert any("brackets tilt the sled" in line for line in visit.said)
    assert read_numbers(visit.sender) == numbers


def test_a_number_that_no_machine_has_is_asked_again(machine, tmp_path):
    typed = iter(["3", "wide", "2980"])
    visit = visit_of(machine, tmp_path, {**OWNER, "turn": "q"})
    prepared = visit.talk.answer

    def answer(question):
        return next(typed) if "left motor's shaft" in question else prepared(question)

    visit.talk.answer = answer
    walk(visit)
    assert settings_in(tmp_path / "machine.toml").motor_gap == 2980
    assert any("not from 1500 to 5000 mm" in line for line in visit.said)


def test_a_first_mark_far_off_is_no_success(machine, tmp_path):
    visit = visit_of(machine, tmp_path, {**OWNER, "left edge to the mark": "1300"})
    walk(visit_at_twelve(visit))
    visit.move(f"B06 L{EXTENDED:g} R{EXTENDED:g}")
    assert not walk(visit, first="mark")
    assert "mark" not in visit.progress.done
    assert any("a tooth off" in line for line in visit.said)


def test_a_damaged_file_is_refused(tmp_path):
    (tmp_path / "guide.json").write_text(json.dumps({"done": 3}))
    with pytest.raises(InputError, match="damaged"):
        progress_in(tmp_path)
