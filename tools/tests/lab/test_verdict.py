"""The verdict of the lab: what the command line says, for each state of the folder."""

import time

import numpy as np
import pytest
from folder import PATIENCE, example_form, finished, with_marks
from plumb import api
from plumb.fit.observations import rms


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def test_the_cards_and_what_could_hide_are_those_of_the_diagnosis(client, tmp_path):
    verdict = finished(client, "verdict")["verdict"]
    diagnosis = api.diagnose(api.read(tmp_path / "groundcontrol.ini", tmp_path / "marks.toml"))
    assert verdict["apart"].startswith("On the sheet the likely causes differ by 2.1 mm in")
    assert len(verdict["cards"]) + verdict["more_cards"] == len(diagnosis.explanations)
    first, card = diagnosis.explanations[0], verdict["cards"][0]
    left = (first.rms_after / diagnosis.rms_before) ** 2
    assert card["share"] == pytest.approx(1 - left)
    size, shown = first.sizes[first.effects[0]][0], card["effects"][0]["sizes"][0]
    assert (shown["value"], shown["low"], shown["high"]) == (size.value, size.low, size.high)
    largest = max(
        each.mm or 0 for each in diagnosis.could_hide if each.effect not in diagnosis.suspects
    )
    assert verdict["unseen"]["causes"][0]["mm"] == pytest.approx(largest)


def test_each_state_has_all_marks_with_what_is_left_of_them(client, tmp_path):
    verdict = finished(client, "verdict")["verdict"]
    count = len(verdict["marks"])
    as_set, frame, added = verdict["states"]
    assert [as_set["title"], frame["title"]] == ["as set", "frame fitted"]
    assert added["title"] == "+ a tape that reads wrong and chain stretch"
    assert as_set["noise_rms"] is None and frame["noise_rms"] > added["noise_rms"]
    for state in verdict["states"]:
        errors = np.array(state["errors"])
        assert errors.shape == np.shape(state["chains"]) == (count, 2)
        assert rms(errors) == pytest.approx(state["fit_rms"])
        # An error on the sheet is an error of the chains of about its length.
        assert rms(np.array(state["chains"])) == pytest.approx(state["fit_rms"], rel=0.5)
    assert added["fit_rms"] < frame["fit_rms"] < as_set["fit_rms"]


def test_a_changed_reading_is_never_answered_by_the_verdict_before(client, tmp_path):
    before = finished(client, "verdict")["verdict"]
    form = tmp_path / "marks.toml"
    form.write_text(
        form.read_text().replace("measured = [659.5, 110.5]", "measured = [659.5, 210.5]")
    )
    after = finished(client, "verdict")["verdict"]
    assert before["title"] == "Several things could be it"
    assert after["title"] == "A reading disagrees: look at it first"
    assert after["slips"] and [state["title"] for state in after["states"]] == ["as set"]


def test_too_few_marks_are_refused_in_one_line(client, tmp_path):
    (tmp_path / "marks.toml").write_text(
        example_form(read=1).replace("# measured", "unread = true\n# measured")
    )
    end = time.monotonic() + PATIENCE
    answer = client.get("/api/verdict")
    while answer.status_code == 200 and time.monotonic() < end:
        time.sleep(0.05)
        answer = client.get("/api/verdict")
    assert answer.status_code == 422
    assert "too few" in answer.json()["error"]
