"""The verdict of the lab: what the command line says, for each state of the folder."""

import time

import pytest
from folder import PATIENCE, choose, example_form, finished, got, with_marks
from plumb import api
from plumb.cli.main import main
from plumb.diagnosis.answer import verdict_sentence
from plumb.text.errors import read_on_page


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def test_it_says_what_the_command_line_says(client, tmp_path):
    verdict = finished(client, "verdict")["verdict"]
    inputs = api.read(tmp_path / "groundcontrol.ini", tmp_path / "marks.toml")
    diagnosis = api.diagnose(inputs)
    with read_on_page():
        assert verdict["sentence"] == verdict_sentence(diagnosis)
    assert "(chain_" not in verdict["sentence"]
    assert verdict["apart"].startswith("On the sheet the likely causes differ by 2.1 mm in")
    assert len(verdict["cards"]) + verdict["more_cards"] == len(diagnosis.explanations)
    first, card = diagnosis.explanations[0], verdict["cards"][0]
    assert card["rms_after"] == pytest.approx(first.rms_after)
    assert card["noise_after"] == pytest.approx(first.noise_rms)
    left = 1 - card["share"]
    assert left == pytest.approx((first.rms_after / diagnosis.rms_before) ** 2)
    name = first.effects[0]
    size, shown = first.sizes[name][0], card["effects"][0]["sizes"][0]
    assert (shown["value"], shown["low"], shown["high"]) == (size.value, size.low, size.high)
    assert shown["possible"] is size.possible is True
    largest = max(
        each.mm or 0 for each in diagnosis.could_hide if each.effect not in diagnosis.suspects
    )
    assert verdict["could_hide"][0]["mm"] == pytest.approx(largest)


def test_the_maps_hold_the_same_marks_before_and_after(client, tmp_path):
    verdict = finished(client, "verdict")["verdict"]
    assert [arrow["name"] for arrow in verdict["before"]] == [
        arrow["name"] for arrow in verdict["after"]
    ]

    def rms(arrows):
        squares = [x * x + y * y for x, y in (arrow["error"] for arrow in arrows)]
        return (sum(squares) / len(squares)) ** 0.5

    assert rms(verdict["before"]) == pytest.approx(verdict["rms_set"])
    assert rms(verdict["after"]) == pytest.approx(verdict["rms_added"])
    assert verdict["rms_added"] < verdict["rms_set"]


def test_what_the_frame_leaves_is_the_same_number_in_sentence_and_map(client, tmp_path):
    board = [str(tmp_path / name) for name in ("groundcontrol.ini", "marks.toml")]
    both = ["--effect", "chain_pitch", "chain_stretch", "-o", str(tmp_path / "both.toml")]
    assert main(["add", *board, *both]) == 0
    choose(client, settings="both.toml")
    verdict = finished(client, "verdict")["verdict"]
    assert verdict["verdict"] == "nothing_provable" and verdict["added"] == ""
    left, noise = (f"{verdict[key]:.2f} mm" for key in ("rms_added", "noise_added"))
    assert (
        f"With the frame fitted {left} RMS is left; noise alone leaves {noise}"
        in (verdict["sentence"])
    )


def test_a_changed_reading_is_never_answered_by_the_verdict_before(client, tmp_path):
    before = finished(client, "verdict")["verdict"]
    form = tmp_path / "marks.toml"
    form.write_text(
        form.read_text().replace("measured = [659.5, 110.5]", "measured = [659.5, 210.5]")
    )
    after = finished(client, "verdict")["verdict"]
    assert (before["verdict"], after["verdict"]) == ("cannot_tell", "slip")
    assert after["slips"] and after["after"] == [] and after["rms_added"] is None


def test_the_next_measurement_has_its_steps_and_places(client):
    proposal = finished(client, "next")["next"]
    assert "minutes" in proposal["headline"]
    assert proposal["steps"]
    assert proposal["others"]


def test_a_form_that_waits_beside_the_readings_does_no_harm(client, tmp_path):
    (tmp_path / "more.toml").write_text(example_form())
    choose(client, marks=["marks.toml", "more.toml"])
    got(client.get("/api/bench"))


def test_too_few_marks_are_refused_in_a_line(client, tmp_path):
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
