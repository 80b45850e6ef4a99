"""The numbers of a machine against those of the open file: marks are cut with neither of two."""

import tomllib

import pytest
from folder import EXAMPLE, asked, choose, example_form, got, until
from plumb.firmware.settings import differences, digest_of_numbers, numbers_in_force
from plumb.settings.files import read_settings

SHORT = {"noise": 0.1, "hides": "nothing", "speed": 1000}


@pytest.fixture(scope="module")
def client(tmp_path_factory):
    """A lab with a virtual machine, whose gap is 2978.4 mm."""
    with asked(tmp_path_factory.mktemp("held")) as client:
        got(client.post("/api/machine/virtual", json=SHORT))
        until(client, lambda state: state["phase"] == "ready")
        yield client


@pytest.fixture
def folder(client):
    """The lab's folder; what the machine holds is open in it."""
    folder = client.app.app.state.project.folder
    for path in folder.iterdir():
        path.unlink()
    until(client, lambda state: state["phase"] == "ready" and not state["moves"])
    got(client.post("/api/machine/settings"))
    return folder


def open_other(client, folder, gap="3008.4"):
    """Open a file of a machine with another gap."""
    text = (folder / "machine.toml").read_text().replace("2978.4", gap)
    files = {"file": ("other.toml", text.encode())}
    return got(client.post("/api/settings", files=files))["machine"]["file"]


def test_a_file_with_another_gap_is_said_with_both_values_and_nothing_is_cut(client, folder):
    assert got(client.get("/api/machine/held"))["numbers"] == []
    file = open_other(client, folder)
    held = got(client.get("/api/machine/held"))
    (gap,) = held["numbers"]
    assert (gap["number"], gap["in_file"], gap["in_machine"]) == (2, 3008.4, 2978.4)
    assert held["file"] == file and held["is_written_here"]
    refused = got(client.post("/api/grid/cut"), 422)["error"]
    assert f"motor_gap ($2) is 3008.4 in {file} and 2978.4 in the machine" in refused
    assert "Which holds?" in refused
    assert not (folder / "marks.toml").exists()
    assert got(client.get("/api/machine"))["program"] is None


def test_what_the_marks_say_they_were_cut_with_is_what_the_machine_has(client, folder):
    file = open_other(client, folder)
    got(client.post("/api/grid/cut"), 422)
    replaces = got(client.get("/api/machine"))["numbers_digest"]
    written = got(client.post("/api/machine/numbers", json={"file": file, "replaces": replaces}))
    assert [each["number"] for each in written["changed"]] == [2]
    assert got(client.get("/api/machine"))["numbers_digest"] != replaces
    assert got(client.get("/api/machine/held"))["numbers"] == []
    try:
        got(client.post("/api/grid/cut"))
        named = tomllib.loads((folder / "marks.toml").read_text())["cut_with"]
        held = client.app.app.state.line.state.numbers
        assert named == file and differences(read_settings(folder / named), held) == ()
    finally:
        got(client.post("/api/machine/stop"))
        until(client, lambda state: state["phase"] == "ready" and not state["moves"])
        got(client.post("/api/machine/undo", json={"file": file}))


def test_the_machines_numbers_are_taken_into_the_folder_as_the_other_answer(client, folder):
    file = open_other(client, folder)
    project = got(client.post("/api/machine/settings"))
    assert project["machine"]["frame"]["motor_gap"] == 2978.4
    assert project["choices"]["settings"] != file and (folder / file).exists()
    assert got(client.get("/api/machine/held"))["numbers"] == []


def test_marks_that_somebody_took_are_cut_only_with_what_their_form_names(client, folder):
    other = (folder / "machine.toml").read_text().replace("2978.4", "3008.4")
    (folder / "other.toml").write_text(other)
    choose(client, layout="own", planned=[[0.0, 0.0]])
    got(client.post("/api/grid"))
    form = (folder / "marks.toml").read_text().replace("-40.0]", "-1.0]").splitlines()
    form = [line for line in form if not line.startswith("cut_with")]
    place = form.index('frame = "sheet-top-left"') + 1
    form.insert(place, 'cut_with = "other.toml"')
    (folder / "more.toml").write_text("\n".join(form) + "\n")
    (folder / "more.nc").write_bytes((folder / "grid.nc").read_bytes())
    choose(client, proposed="more.toml")
    assert got(client.get("/api/grid"))["is_proposed"]
    refused = got(client.post("/api/grid/cut"), 422)["error"]
    assert "3008.4 in other.toml and 2978.4 in the machine" in refused


def test_no_correction_is_written_while_the_question_is_open(client, folder):
    file = open_other(client, folder)
    (folder / "marks.toml").write_text(example_form(read=99))
    choose(client, marks=["marks.toml"], accepted=["motor_gap"])
    project = got(client.get("/api/project"))
    body = {"settings": project["files"][file], "choices": project["choices_digest"]}
    refused = got(client.post("/api/correction", json=body), 422)["error"]
    assert f"is 3008.4 in {file} and 2978.4 in the machine" in refused
    assert "Answer the question above, or disconnect" in refused


def test_an_answer_to_older_numbers_writes_nothing(client, folder):
    file = open_other(client, folder)
    body = {"file": file, "replaces": "0" * 16}
    refused = got(client.post("/api/machine/numbers", json=body), 422)["error"]
    assert "other numbers by now" in refused
    assert client.app.app.state.line.read_numbers()[2] == 2978.4


def test_a_clients_file_is_compared_by_what_its_client_sends(client, folder):
    name = EXAMPLE / "groundcontrol.ini"
    files = {"file": ("groundcontrol.ini", name.read_bytes())}
    got(client.post("/api/settings", files=files))
    held = got(client.get("/api/machine/held"))
    assert not held["is_written_here"]
    assert [each["number"] for each in held["numbers"]] == [37, 160, 170]


@pytest.fixture
def machine():
    return read_settings(EXAMPLE / "groundcontrol.ini")


def listed(settings, **changed):
    return {**numbers_in_force(settings), 62: 97.9, 63: 0.0} | {
        int(number.removeprefix("n")): value for number, value in changed.items()
    }


def test_a_client_that_sent_its_file_made_the_machine_of_that_file(machine):
    assert differences(machine, listed(machine)) == ()
    # Rounding to what a client keeps moves no chain.
    assert differences(machine, listed(machine, n2=machine.motor_gap + 0.0004)) == ()
    radius = machine.rotation_radius
    assert differences(machine, listed(machine, n8=radius + 0.005)) == ()
    assert [each.number for each in differences(machine, listed(machine, n8=radius + 0.05))] == [8]
    assert [each.number for each in differences(machine, listed(machine, n37=0.0))] == [37]
    assert [each.number for each in differences(machine, listed(machine, n40=0.2))] == [40]


def test_a_correction_that_a_client_does_not_know_is_a_difference(machine):
    assert [each.number for each in differences(machine, listed(machine, n180=0.001))] == [180]
    assert [each.number for each in differences(machine, listed(machine, n64=2.0))] == [64]


def test_a_sled_on_brackets_is_another_machine(machine):
    assert [each.number for each in differences(machine, listed(machine, n7=1))] == [7]


def test_digests_go_by_the_numbers_alone():
    assert digest_of_numbers({1: 2.0, 3: 4.0}) == digest_of_numbers({3: 4.0, 1: 2.0})
    assert digest_of_numbers({1: 2.0}) != digest_of_numbers({1: 2.5})
