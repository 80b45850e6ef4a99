"""Files that an owner opens or has are never replaced, and readings find the settings of their
marks."""

import pytest
from folder import (
    EXAMPLE,
    asked,
    choose,
    compared,
    example_form,
    got,
    type_in,
    with_marks,
    with_settings,
)
from plumb.settings.files import read_settings

INI = (EXAMPLE / "groundcontrol.ini").read_bytes()
OTHER = INI.replace(b"2978.4", b"2990.0")


def open_file(client, content, name="groundcontrol.ini"):
    return got(client.post("/api/settings", files={"file": (name, content)}))["choices"]["settings"]


def choices(client):
    return got(client.get("/api/project"))["choices"]


def test_another_file_is_opened_next_to_the_first_and_the_first_is_opened_again(tmp_path):
    client = with_settings(tmp_path)
    assert open_file(client, OTHER) == "groundcontrol-2.ini"
    assert (tmp_path / "groundcontrol.ini").read_bytes() == INI
    assert open_file(client, INI) == "groundcontrol.ini"
    assert open_file(client, OTHER, "my machine.INI") == "groundcontrol-2.ini"
    assert sorted(path.name for path in tmp_path.glob("*.ini")) == [
        "groundcontrol-2.ini",
        "groundcontrol.ini",
    ]


def test_readings_count_after_another_file_was_opened_and_go_back_leads_to_the_first(tmp_path):
    client = with_marks(tmp_path)
    project = choose(client, accepted=["motor_gap"])
    known = {
        "settings": project["files"]["groundcontrol.ini"],
        "choices": project["choices_digest"],
    }
    written = got(client.post("/api/correction", json=known))["file"]
    open_file(client, OTHER)
    assert choices(client)["settings_before"] == ["groundcontrol.ini"]
    body = {"settings": "", "choices": got(client.get("/api/project"))["choices_digest"]}
    assert got(client.post("/api/correction/undo", json=body))["file"] == "groundcontrol.ini"
    assert read_settings(tmp_path / "groundcontrol.ini").motor_gap == 2978.4
    assert (tmp_path / written).exists()
    assert compared(tmp_path).rms > 0


@pytest.mark.parametrize("then", ["replaced", "taken away"])
def test_readings_find_their_settings_though_a_program_replaced_the_file(tmp_path, then):
    client = with_settings(tmp_path)
    got(client.post("/api/grid"))
    type_in(client, "marks.toml", (0, 0))
    first = compared(tmp_path).rms
    path = tmp_path / "groundcontrol.ini"
    if then == "replaced":
        path.write_bytes(OTHER)  # as GroundControl does when its owner types a number
    else:
        open_file(client, OTHER)
        path.unlink()
    second = compared(tmp_path).rms
    # The marks were sent by the first numbers; where the second put them is another place.
    assert second == pytest.approx(first, abs=12) and second != first
    (form,) = (tmp_path / "marks.toml",)
    assert 'cut_with = "groundcontrol.ini"' in form.read_text()
    assert len(list(tmp_path.glob(".settings-*.ini"))) == 1


def test_settings_that_nobody_kept_are_missed_as_before(tmp_path):
    client = with_settings(tmp_path)
    got(client.post("/api/grid"))
    type_in(client, "marks.toml", (0, 0))
    for kept in tmp_path.glob(".settings-*"):
        kept.unlink()
    (tmp_path / "groundcontrol.ini").write_bytes(OTHER)
    said = got(client.get("/api/bench"), 422)["error"]
    assert "was cut with groundcontrol.ini, which has changed since" in said


def test_a_program_of_the_owner_is_not_replaced_by_that_of_a_grid(tmp_path):
    (tmp_path / "grid.nc").write_text("G21\nG0 X10\n")
    client = with_settings(tmp_path)
    assert got(client.get("/api/grid"))["program"] == "grid-2.nc"
    got(client.post("/api/grid"))
    assert (tmp_path / "grid.nc").read_text() == "G21\nG0 X10\n"
    assert (tmp_path / "marks-2.toml").exists()


@pytest.mark.parametrize("name", ["machine.nc", "machine-groundcontrol.ini"])
def test_a_correction_replaces_no_file_at_all(tmp_path, name):
    (tmp_path / name).write_text("mine")
    (tmp_path / "marks.toml").write_text(example_form(read=99))
    with asked(tmp_path) as client:
        open_file(client, INI)
        project = got(client.get("/api/project"))
        wanted = {**project["choices"], "marks": ["marks.toml"], "accepted": ["motor_gap"]}
        got(client.put("/api/choices", json={"choices": wanted, "read": project["choices_digest"]}))
        project = got(client.get("/api/project"))
        known = {"choices": project["choices_digest"]}
        known["settings"] = project["files"]["groundcontrol.ini"]
        assert got(client.post("/api/correction", json=known))["file"] == "machine-2.toml"
    assert (tmp_path / name).read_text() == "mine"
