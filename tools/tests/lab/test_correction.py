"""The correction of the lab: number by number, written, opened, and taken back."""

from dataclasses import replace
from itertools import pairwise

import pytest
from folder import EXAMPLE, awaited, choose, compared, type_in, with_marks
from plumb import api
from plumb.cure.machine_file import correct, has_setting
from plumb.diary.file import read_diary
from plumb.settings.files import read_settings


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


@pytest.fixture(scope="module")
def inputs():
    return api.read(EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml")


def shown(client):
    return awaited(client, "correction", lambda answer: answer["correction"])


def known(client):
    project = client.get("/api/project").json()
    settings = project["files"][project["choices"]["settings"]]
    return {"settings": settings, "choices": project["choices_digest"]}


def test_what_is_not_accepted_stays_as_it_is(inputs):
    accepted = ["motor_height", "chain_pitch.left"]
    made = correct(inputs, ("chain_pitch",), accepted).accepted
    before = inputs.model_and_observations()[0]
    assert made.settings.motor_gap == before.motor_gap
    assert made.settings.motor_center_x == before.motor_center_x
    assert made.settings.motor_height != before.motor_height
    assert made.settings.effect("chain_pitch", "right") == before.effect("chain_pitch", "right")
    assert made.settings.effect("chain_pitch", "left") != before.effect("chain_pitch", "left")


def test_with_all_accepted_it_is_the_fit_itself_and_with_none_nothing(inputs):
    made = correct(inputs, ("chain_pitch",), [])
    assert made.accepted is None
    everything = [number.name for number in made.numbers]
    assert "motor_gap" in everything and "chain_pitch.right" in everything
    both = correct(inputs, ("chain_pitch",), everything)
    assert (
        both.accepted.settings == both.whole.settings == api.add(inputs, ["chain_pitch"]).settings
    )


def test_the_more_is_accepted_the_smaller_the_error(inputs):
    order = ["motor_height", "motor_gap", "motor_center_x", "chain_pitch.left", "chain_pitch.right"]
    errors = [
        correct(inputs, ("chain_pitch",), order[: i + 1]).accepted.after.fit_rms
        for i in range(len(order))
    ]
    # Priors are given up for a better fit of the marks only as far as they weigh less.
    assert all(later <= earlier + 0.02 for earlier, later in pairwise(errors))
    assert errors[-1] < 0.5 * errors[0]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("motor_gap", True),
        ("sheet_rotation", False),
        ("chain_pitch.left", True),
        ("tape_scale.error", False),
        ("zero2.left", False),
        ("sheet2.x", False),
    ],
)
def test_what_a_setting_holds(name, expected):
    assert has_setting(name) is expected


def test_written_opened_and_taken_back(client, tmp_path):
    before = shown(client)["correction"]
    assert before["accepted"] is None and not before["is_written"]
    names = [number["name"] for number in before["numbers"]]
    gap = before["numbers"][names.index("motor_gap")]
    assert gap["unit"] == "mm" and float(gap["margin"]) > 0 and gap["possible"]
    choose(client, accepted=names)
    after = shown(client)["correction"]
    assert after["accepted"]["fit_rms"] == pytest.approx(before["whole"]["fit_rms"])
    written = client.post("/api/correction", json=known(client)).json()
    assert set(written["files"]) >= {"machine.toml", "machine.nc", "machine-groundcontrol.ini"}
    project = client.get("/api/project").json()
    assert project["choices"]["settings"] == "machine.toml"
    assert read_settings(tmp_path / "machine.toml").motor_gap == pytest.approx(
        float(gap["after"]), abs=1
    )
    assert compared(tmp_path).rms == pytest.approx(before["whole"]["fit_rms"], abs=0.02)
    (entry,) = read_diary(tmp_path).of_kind("fit")
    assert entry.content["machine"] == "machine.toml"
    assert shown(client)["correction"]["is_written"]
    undone = client.post("/api/correction/undo", json=known(client)).json()
    assert undone["file"] == "groundcontrol.ini"
    assert compared(tmp_path).rms == pytest.approx(before["as_set"]["fit_rms"])
    assert (tmp_path / "machine.toml").exists()


def test_nothing_accepted_is_not_written_and_an_older_page_neither(client, tmp_path):
    assert client.post("/api/correction", json=known(client)).status_code == 422
    old = known(client)
    choose(client, accepted=["motor_gap"])
    assert client.post("/api/correction", json=old).status_code == 409
    assert not (tmp_path / "machine.toml").exists()
    assert client.post("/api/correction/undo", json=known(client)).status_code == 422


def test_a_machine_that_is_as_good_as_its_marks_can_show_is_left_as_it_is(client):
    type_in(client, "marks.toml", (0.3, -0.4), (-0.5, 0.1), (0.2, 0.5), (-0.1, -0.3))
    made = shown(client)["correction"]
    assert (made["nothing"], made["instead"]) == ("Nothing to change", "verdict")
    assert made["reasons"] == [
        "Your machine is as good as these marks can show: nothing to change."
    ]
    assert client.post("/api/correction", json=known(client)).status_code == 422
    verdict = awaited(client, "verdict", lambda answer: answer["verdict"])["verdict"]
    assert verdict["title"] == "As good as these marks can show"


def test_a_slip_is_not_fitted(client, tmp_path):
    form = tmp_path / "marks.toml"
    form.write_text(
        form.read_text().replace("measured = [659.5, 110.5]", "measured = [659.5, 210.5]")
    )
    made = shown(client)["correction"]
    assert made["instead"] == "readings" and made["numbers"] == []
    assert "look at the reading of 2" in made["reasons"][0]
    choose(client, accepted=["motor_gap"])
    assert client.post("/api/correction", json=known(client)).status_code == 422


def test_numbers_held_by_the_owner_stay_held(inputs):
    held = replace(inputs, priors={**inputs.priors, "motor_gap": 0.0})
    made = correct(held, (), ["motor_height"])
    assert "motor_gap" not in [number.name for number in made.numbers]
