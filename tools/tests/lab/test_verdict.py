"""The verdict and the bench by their routes: what the command line says, and refits are quick."""

import time

import numpy as np
import pytest
from folder import PATIENCE, asked, example_form, finished, got, with_marks
from plumb import api
from plumb.cure.add import BoardView, Chosen, LiveBoard
from plumb.fit.fit import Problem
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.hidden import MAKER
from plumb.marks.read import Mark, Measurements


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def test_the_cards_and_what_could_hide_are_those_of_the_diagnosis(client, tmp_path):
    verdict = finished(client, "verdict")["verdict"]
    diagnosis = api.diagnose(api.read(tmp_path / "groundcontrol.ini", tmp_path / "marks.toml"))
    assert verdict["apart"].startswith("On the sheet the likely causes differ by 2.1 mm in")
    assert len(verdict["cards"]) == len(diagnosis.explanations) and verdict["more"] == ""
    first, card = diagnosis.explanations[0], verdict["cards"][0]
    taken = 1 - (first.rms_after / diagnosis.rms_before) ** 2
    assert dict(card["facts"])["explains"].startswith(f"{100 * taken:.0f} % of what the frame")
    size, shown = first.sizes[first.effects[0]][0], card["account"]["parameters"][0]
    assert (shown["value"], shown["low"], shown["high"]) == (size.value, size.low, size.high)
    hidden = [each for each in diagnosis.could_hide if each.effect not in diagnosis.suspects]
    largest = max(each.mm or 0 for each in hidden)
    assert verdict["unseen"][0]["rows"][0][1] == f"{largest:.1f} mm"


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
    assert after["warned"] and [state["title"] for state in after["states"]] == ["as set"]


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


PITCH = {"effects": ["chain_pitch"]}


def posted(client, path, body, status=200):
    return got(client.post(f"/api/bench/{path}", json=body), status)


def test_the_bench_opens_with_phases_in_degrees_and_possible_sizes(client):
    bench = client.get("/api/bench").json()
    covariates = {each["name"]: each for each in bench["covariates"]}
    phase, same = covariates["phase"], [each["same"] for each in covariates.values()]
    assert [each for each in same if each] == ["last move is 90 ° for all marks"]
    assert phase["unit"] == "°" and 6.3 < max(map(max, phase["values"])) <= 360
    parameters = [each for effect in bench["effects"] for each in effect["parameters"]]
    assert all(each["low"] <= 0 <= each["high"] for each in parameters)


def test_a_size_of_no_fitted_effect_or_of_no_number_cannot_be_held(client):
    refused = posted(client, "fit", {"effects": [], "held": {"chain_pitch.left": 0.1}}, 422)
    assert "chain_pitch.left" in refused["error"]
    posted(client, "fit", {**PITCH, "held": {"chain_pitch.left": "much"}}, 422)


def test_each_effect_shows_the_error_that_it_would_leave(client):
    left = posted(client, "gains", PITCH)
    assert "chain_pitch" not in left and len(left) > 8
    both = {"effects": ["chain_pitch", "tape_scale"]}
    assert left["tape_scale"] == pytest.approx(posted(client, "fit", both)["fit_rms"], abs=1e-3)


def test_another_board_is_not_answered_from_the_old(client, tmp_path):
    before = posted(client, "fit", {"effects": []})["fit_rms"]
    marks = tmp_path / "marks.toml"
    farther = marks.read_text().replace("measured = [98, 106]", "measured = [99, 106]")
    marks.write_text(farther)
    assert posted(client, "fit", {"effects": []})["fit_rms"] != pytest.approx(before, rel=1e-4)


def test_without_marks_the_bench_says_what_is_missing(tmp_path):
    assert "settings" in asked(tmp_path).get("/api/bench").json()["error"]


def board_of(columns, rows):
    """A board of the usual machine with long chains, a skewed sheet and the noise of a tape."""
    noise = np.random.default_rng(columns)
    across, up = np.linspace(-1100, 1100, columns), np.linspace(-500, 500, rows)
    marks = []
    for i, (x, y) in enumerate((x, y) for y in up for x in across):
        dx, dy = noise.normal(0, 0.4, 2)
        read = (x + 0.001 * y + dx, y - 0.0008 * x + 2e-6 * x * x + dy)
        marks.append(Mark(str(i), (x, y), read, approach=(1.0, 0.0)))
    return LiveBoard(Inputs(MAKER, Measurements(tuple(marks))))


WALK = (
    Chosen(("chain_pitch",)),
    Chosen(("chain_pitch", "frame_flex")),
    Chosen(("chain_pitch", "frame_flex", "sheet_skew")),
    *(
        Chosen(("chain_pitch", "frame_flex", "sheet_skew"), {"chain_pitch.left": left})
        for left in (0.0, 0.0004, 0.0008, 0.0012)
    ),
    Chosen(("chain_pitch", "sheet_skew", "tape_scale", "sled_friction")),
)


def test_a_refit_asks_the_model_only_a_few_times(monkeypatch):
    """The time of a refit is the time of these."""
    board = board_of(27, 15)
    view = BoardView(board)
    asked_at = []
    at = Problem.at
    monkeypatch.setattr(Problem, "at", lambda *given: asked_at.append(1) or at(*given))
    for chosen in WALK:
        asked_at.clear()
        view.chains(board.fit(chosen).errors)
        assert len(asked_at) <= 5, chosen
