"""The bench for effects: the numbers are those of `plumb add`, and refits are quick."""

import re
import time
from dataclasses import replace

import numpy as np
import pytest
from chain_views import chain_view
from fingerprints import default_machine
from folder import EXAMPLE, asked, choose, got, with_marks
from plumb import api
from plumb.cure.live_board import BoardView, Chosen, LiveBoard
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.fit.problem import Problem
from plumb.marks.read import Mark, Measurements
from plumb.model.predict import values_of

PITCH = {"effects": ["chain_pitch"]}


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def posted(client, path, body, status=200):
    return got(client.post(f"/api/bench/{path}", json=body), status)


def test_the_bench_opens_with_marks_effects_and_covariates(client):
    bench = client.get("/api/bench").json()
    assert len(bench["marks"]) > 8
    names = {"tension", "length", "angle", "wrap", "phase", "x", "y", "order", "approach"}
    assert names == {each["name"] for each in bench["covariates"]}
    phase = next(each for each in bench["covariates"] if each["name"] == "phase")
    assert phase["unit"] == "°"
    assert 6.3 < max(max(pair) for pair in phase["values"]) <= 360
    pitch = next(each for each in bench["effects"] if each["name"] == "chain_pitch")
    assert [each["label"] for each in pitch["parameters"]] == [
        "left chain too long",
        "right chain too long",
    ]
    assert all(
        each["low"] <= 0 <= each["high"]
        for effect in bench["effects"]
        for each in effect["parameters"]
    )


def test_a_refit_has_the_numbers_of_plumb_add(client, tmp_path):
    inputs = api.read(tmp_path / "groundcontrol.ini", tmp_path / "marks.toml")
    inputs = replace(inputs, checked=api.diagnose(inputs).usual)  # as the command says
    (usual,) = inputs.checked
    command = posted(client, "fit", {"effects": ["chain_stretch"]})["command"]
    assert f"--checked {usual.name}={usual.value:g}+-{usual.sigma:g} " in command
    for effects in [[], ["chain_pitch"], ["chain_stretch", "chain_pitch"], ["chain_stretch"]]:
        fitted, added = posted(client, "fit", {"effects": effects}), api.add(inputs, effects)
        assert fitted["fit_rms"] == pytest.approx(added.after.fit_rms, rel=2e-5)
        assert fitted["noise_rms"] == pytest.approx(added.after.noise_rms, rel=2e-5)
        assert fitted["left_out_rms"] == pytest.approx(added.after.left_out_rms, rel=2e-5)
        np.testing.assert_allclose(fitted["errors"], added.after_fit.errors, atol=2e-5)
        stairs = posted(client, "stairs", {"effects": effects})["stairs"]
        assert [stair["fit_rms"] for stair in stairs[2:]] == pytest.approx(
            [step.fit_rms for step in added.by_effect], rel=2e-5
        )
        assert stairs[0]["fit_rms"] == pytest.approx(added.raw.rms)
        assert [stair["only_fit"] for stair in stairs[2:]] == [s.only_fit for s in added.by_effect]


def test_a_size_held_by_hand_is_used_and_said(client):
    free = posted(client, "fit", PITCH)
    held = posted(client, "fit", {**PITCH, "held": {"chain_pitch.left": 0.004}})
    assert held["sizes"]["chain_pitch.left"] == {
        "value": 0.004,
        "said": "left chain 0.400 % too long",
        "held": True,
        "possible": True,
    }
    assert "(" in free["sizes"]["chain_pitch.left"]["said"]
    assert held["fit_rms"] > free["fit_rms"]
    assert held["command"].endswith("--hold chain_pitch.left=0.004 -o new.toml")
    assert "--checked" not in held["command"] and "--units" not in held["command"]
    refused = posted(client, "fit", {"effects": [], "held": {"chain_pitch.left": 0.1}}, 422)
    assert "chain_pitch.left" in refused["error"]
    posted(client, "fit", {**PITCH, "held": {"chain_pitch.left": "much"}}, 422)


def test_lengths_are_said_in_the_unit_that_was_chosen(client):
    body = {"effects": ["sled_swing"], "held": {"sled_swing.up": 2.54}}
    choose(client, units="inch")
    assert "0.1" in (said := posted(client, "fit", body)["sizes"]["sled_swing.up"]["said"])
    assert "inch" in said


def test_errors_of_the_chains_are_those_of_the_chain_view(tmp_path):
    inputs = api.read(EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml")
    board = LiveBoard(inputs)
    view, fitted = BoardView(board), board.fit(Chosen(("chain_pitch",)))
    outside = {"sheet_rotation": fitted.sheet_rotation}
    known = chain_view(values_of(fitted.settings), outside, board.rows, fitted.settings)
    np.testing.assert_allclose(view.chains(fitted.errors), known.chains, atol=0.02)
    assert rms(known.chains) > 0.2


def test_what_an_effect_draws_is_what_its_explanation_leaves_less(tmp_path):
    inputs = api.read(EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml")
    view = BoardView(LiveBoard(inputs))
    drawn = view.drawn("chain_pitch")
    added = api.add(inputs, ["chain_pitch"])
    less = added.before_fit.errors - added.after_fit.errors
    np.testing.assert_allclose(drawn.moved, less, atol=0.01)
    assert set(drawn.curves.curves) == {"tension", "length", "angle", "phase", "wrap", "x", "y"}


def test_another_board_is_not_answered_from_the_old(client, tmp_path):
    before = posted(client, "fit", {"effects": []})["fit_rms"]
    marks = tmp_path / "marks.toml"
    farther = re.sub(
        r"measured = \[(\S+),",
        lambda m: f"measured = [{float(m[1]) + 1},",
        marks.read_text(),
        count=1,
    )
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
    return LiveBoard(Inputs(default_machine(), Measurements(tuple(marks))))


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


@pytest.mark.parametrize(("columns", "rows"), [(6, 6), (27, 15)])
def test_a_refit_asks_the_model_only_a_few_times(columns, rows, monkeypatch, capsys):
    """The time of a refit is the time of these; what it was here is printed."""
    board = board_of(columns, rows)
    view = BoardView(board)
    asked_at = []
    at = Problem.at
    monkeypatch.setattr(Problem, "at", lambda *given: asked_at.append(1) or at(*given))
    lines = []
    for chosen in WALK:
        asked_at.clear()
        start = time.process_time()
        view.chains(board.fit(chosen).errors)
        taken = 1000 * (time.process_time() - start)
        lines.append(
            f"{columns * rows} marks, {len(chosen.effects)} effects: {taken:.0f} ms of CPU"
        )
        assert len(asked_at) <= 5, chosen
    with capsys.disabled():
        print("", *lines, sep="\n  ")


def test_files_that_the_board_is_not_made_of_make_no_other_board(client, tmp_path):
    def board():
        return client.get("/api/bench").json()["board"]

    before = board()
    posted(client, "machine", {**PITCH, "read": ""})
    (tmp_path / "notes.toml").write_text("by = 'hand'\n")
    assert board() == before
    marks = (tmp_path / "marks.toml").read_text()
    (tmp_path / "marks.toml").write_text(f"{marks}# looked at again\n")
    assert board() != before


def test_effects_are_drawn_alone_and_together(client):
    def drawn(*effects):
        return got(client.get("/api/bench/drawn", params={"effects": effects}))

    pitch, both = drawn("chain_pitch"), drawn("chain_pitch", "chain_stretch")
    assert both["noun"] == f"{pitch['noun']} and chain stretch"
    assert pitch["moved"] != both["moved"]
    frame = posted(client, "fit", {"effects": []})["errors"]
    fitted = posted(client, "fit", PITCH)["errors"]
    np.testing.assert_allclose(pitch["moved"], np.subtract(frame, fitted), atol=0.01)
    got(client.get("/api/bench/drawn"), 422)
