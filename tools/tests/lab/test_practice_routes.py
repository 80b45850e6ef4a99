"""Practice in the lab: the game of `plumb practice`, played by the page's routes."""

import json
import time

import pytest
from folder import asked, with_settings
from plumb.cli.main import main
from plumb.lab.project import Project
from plumb.vm import practice_folder
from plumb.vm.practice_file import game_in

SEED = 3


@pytest.fixture
def client(tmp_path):
    client = asked(tmp_path)
    posted(client, "start", {"level": 1, "seed": SEED})
    return client


def posted(client, step, body=None, status=200):
    answer = client.post(f"/api/practice/{step}", json=body)
    assert answer.status_code == status, answer.text
    return answer.json()


def shown(client):
    return client.get("/api/practice").json()


def rested(client):
    """The game once the machine has done what it was doing."""
    for _ in range(600):
        if not (answer := shown(client))["doing"]:
            assert not answer["trouble"]
            return answer["game"]
        time.sleep(0.2)
    raise AssertionError("the machine does not come to rest")


def test_a_game_of_the_lab_is_a_game_of_the_command_line(client, tmp_path, capsys, monkeypatch):
    assert posted(client, "cut", {"grid": "3x3"})["doing"]["of"] == 9
    game = rested(client)
    assert (game["marks_left"], game["minutes_left"]) == (36, 150 - 3 - 9 * 1.5)
    assert len(game["names"]) == 9
    monkeypatch.chdir(tmp_path.parent)
    main(["practice", "start", "theirs", "--level", "1", "--seed", str(SEED)])
    main(["practice", "measure", "theirs", "3x3"])
    theirs = tmp_path.parent / "theirs"
    for name in ("machine.toml", "marks.toml", "game.json"):
        assert (tmp_path / name).read_bytes() == (theirs / name).read_bytes()
    choices = client.get("/api/project").json()["choices"]
    assert (choices["settings"], choices["marks"]) == ("machine.toml", ["marks.toml"])
    assert client.get("/api/comparison").json()["rms"] > 1
    main(["practice", "hint", str(tmp_path)])  # the other way round
    assert len(shown(client)["game"]["hints"]) == 1


def test_a_game_that_somebody_moved_on_meanwhile_keeps_its_marks(client, tmp_path, monkeypatch):
    posted(client, "cut", {"grid": "3x3"})
    rested(client)
    marks = (tmp_path / "marks.toml").read_bytes()
    begun = practice_folder.begun

    def begun_late(game):
        main(["practice", "hint", str(tmp_path)])
        return begun(game)

    monkeypatch.setattr(practice_folder, "begun", begun_late)
    refused = posted(client, "start", {"level": 2}, 409)
    assert "game.json has changed" in refused["error"]
    assert (tmp_path / "marks.toml").read_bytes() == marks
    monkeypatch.undo()
    posted(client, "start", {"level": 2})
    assert not (tmp_path / "marks.toml").exists()


def test_a_file_that_is_just_taken_away_is_no_machine(client, monkeypatch):
    names = Project.names
    monkeypatch.setattr(Project, "names", lambda project: [*names(project), "gone.toml"])
    assert shown(client)["game"]["machines"] == []


def test_a_game_is_played_to_its_score(client, tmp_path):
    refused = posted(client, "solve", {"machine": "machine.toml"}, 422)
    assert "marks first" in refused["error"]
    posted(client, "cut", {"grid": "5x3"})
    busy = posted(client, "cut", {"grid": "3x3"}, 422)
    assert "wait" in busy["error"]
    rested(client)
    first = shown(client)["game"]["names"][0]
    assert posted(client, "read", {"names": [first]})["game"]["minutes_left"] == 150 - 25.5 - 0.75
    assert (tmp_path / "marks.toml").read_text().count("[[mark]]") == 16
    hints = posted(client, "hint")["game"]["hints"]
    assert hints == ["It is one effect, large."]
    named = posted(client, "hint")["game"]["hints"][1]
    posted(client, "check", {"name": "motor_gap"})
    known = client.get("/api/project").json()["choices"]["known"]
    assert known["motor_gap"]["sigma"] == 1.0
    clear = posted(client, "hint")["game"]
    hidden = clear["hints"][2].removeprefix("It is ").partition(" ")[0]
    assert hidden in named
    assert not clear["more_hints"]
    save = client.post("/api/bench/machine", json={"effects": [hidden], "read": ""})
    assert save.status_code == 200, save.text
    assert shown(client)["game"]["machines"] == ["new.toml"]
    posted(client, "solve", {"machine": "new.toml"})
    score = rested(client)["score"]
    assert score["named"] == [hidden]
    assert score["false"] == score["missed"] == []
    assert score["after"] < 0.5 * score["before"]
    assert score["hints"] == 3
    assert score["sentence"].startswith("You found ")
    assert shown(client)["game"]["score"] == score
    assert "solved" in posted(client, "hint", status=422)["error"]
    assert posted(client, "start", {"level": 2, "seed": 5})["game"]["score"] is None
    assert not (tmp_path / "marks.toml").exists()
    assert client.get("/api/project").json()["choices"]["known"] == {}


def test_places_of_choice_are_cut_under_names_of_their_own(client):
    posted(client, "cut", {"places": [[0, 0], [500, -300]]})
    assert rested(client)["names"] == ["p1", "p2"]
    posted(client, "cut", {"places": [[-500, 300]]})
    assert rested(client)["names"] == ["p1", "p2", "p3"]
    far = posted(client, "cut", {"places": [[90000, 0]]}, 422)
    assert "p4" in far["error"]


def test_what_the_budget_does_not_allow_is_refused_before_the_machine_moves(client, tmp_path):
    game = json.loads((tmp_path / "game.json").read_text())
    game["spent"]["marks"] = 40
    (tmp_path / "game.json").write_text(json.dumps(game))
    assert [cost["allowed"] for cost in shown(client)["game"]["cuts"]] == [False, False, False]
    assert "5 marks" in posted(client, "cut", {"grid": "3x3"}, 422)["error"]
    assert shown(client)["doing"] is None


def test_a_game_never_writes_over_a_machine_of_its_owner(tmp_path):
    client = with_settings(tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert "empty folder" in shown(client)["taken"]
    assert "empty folder" in posted(client, "start", {"level": 1}, 422)["error"]
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_looking_changes_nothing_and_the_secret_stays_secret(client, tmp_path):
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    said = client.get("/api/practice").text
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    hidden = game_in(str(tmp_path)).secret.hidden.effects[0]
    assert f'"{hidden} (' not in said
    assert "It is" not in said


def test_a_folder_of_another_level_or_seed_is_refused(tmp_path):
    client = asked(tmp_path)
    posted(client, "start", {"level": 6}, 422)
    posted(client, "start", {"level": 1, "seed": -1}, 422)
    assert not (tmp_path / "game.json").exists()
