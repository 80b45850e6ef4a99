"""The numbers of a machine against those of the open file: marks are cut with neither of two, and
the page asks which hold.
"""

import re

import pytest
from folder import EXAMPLE, asked, choose, example_form, got, until, write_correction
from lab_machine import start_virtual
from playwright.sync_api import expect
from plumb.firmware.settings import differences, numbers_in_force
from plumb.settings import read_settings

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


def test_accepted_marks_are_cut_only_with_the_settings_of_their_form(client, folder):
    other = (folder / "machine.toml").read_text().replace("2978.4", "3008.4")
    (folder / "other.toml").write_text(other)
    choose(client, layout="own", planned=[[0.0, 0.0]])
    got(client.post("/api/rounds/marks"))
    form = (folder / "marks.toml").read_text().replace("-40.0]", "-1.0]").splitlines()
    form = [line for line in form if not line.startswith("cut_with")]
    place = form.index('frame = "sheet-top-left"') + 1
    form.insert(place, 'cut_with = "other.toml"')
    (folder / "more.toml").write_text("\n".join(form) + "\n")
    (folder / "more.nc").write_bytes((folder / "grid.nc").read_bytes())
    choose(client, proposed="more.toml")
    assert got(client.get("/api/rounds/marks"))["origin"] == "proposed"
    refused = got(client.post("/api/rounds/marks/cut"), 422)["error"]
    assert "3008.4 in other.toml and 2978.4 in the machine" in refused


def test_no_correction_is_written_while_the_question_is_open(client, folder):
    file = open_other(client, folder)
    (folder / "marks.toml").write_text(example_form(read=99))
    choose(client, marks=["marks.toml"], accepted=["motor_gap"])
    refused = write_correction(client, 422)["error"]
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
    assert [row[1].split()[0] for row in held["said"]] == ["$37", "$160", "$170"]


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


GAP = re.compile(r"motor_gap\s*\$2 = 3008\.4 mm\s*\$2 = 2978\.4 mm")


def question(page):
    return page.get_by_role("alert", name="Which numbers hold?")


def with_another_file(lab, page):
    """A virtual machine is connected, and a file with another gap between the motors opened."""
    start_virtual(page, lab)
    other = lab.folder / "machine.toml"
    content = other.read_text().replace("2978.4", "3008.4").encode()
    picked = {"name": "other.toml", "mimeType": "text/plain", "buffer": content}
    page.locator("input[type=file]").first.set_input_files(picked)
    expect(question(page)).to_contain_text(GAP)


def test_nothing_is_cut_before_the_owner_says_which_numbers_hold(lab, page):
    with_another_file(lab, page)
    page.goto(f"{lab.site}#/cut")
    expect(question(page)).to_contain_text(GAP)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    said = page.get_by_text(re.compile(r"is 3008\.4 in .* and 2978\.4 in the machine"))
    expect(said).to_be_visible()
    assert not (lab.folder / "marks.toml").exists()
    question(page).get_by_role("button", name="The machine's: take them").click()
    expect(question(page)).to_have_count(0)
    expect(page.get_by_text(re.compile("Which holds"))).to_have_count(0)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    page.get_by_text("All marks are cut.").wait_for()


def test_the_files_numbers_go_into_the_machine_as_the_other_answer(lab, page):
    with_another_file(lab, page)
    question(page).get_by_role("button", name="send them to the machine").click()
    expect(question(page)).to_have_count(0)
    (before,) = lab.folder.glob("*-before-*.nc")
    assert "$2=2978.4\n" in before.read_text()
