"""The lab under a kill, a full disk, a second server; no file of the owner's is replaced."""

import json
import random
import signal
import socket
import subprocess
import threading
from contextlib import suppress
from urllib.request import urlopen

import pytest
from attacks import Try, answered, status
from folder import (
    EXAMPLE,
    asked,
    choose,
    compared,
    example_form,
    got,
    type_in,
    with_settings,
    write_correction,
)
from plumb.lab.project import digest_of
from screens import measured_machine
from served_lab import PLUMB, serve
from systems import ON_POSIX


def save_choices(lab, choices, read):
    """Save choices that replace those of this digest."""
    body = json.dumps({"choices": choices, "read": read}).encode()
    return answered(lab, Try(body=body).bytes(lab))


def kept(folder):
    """The folder's choices, which can always be read."""
    return json.loads((folder / "lab.json").read_text())


def test_a_server_killed_in_the_middle_of_saves_leaves_whole_files(tmp_path):
    """Saves of half a megabyte, one after the other; the kill comes at any moment."""
    lab = serve(tmp_path)
    try:
        assert save_until_killed(lab, random.Random(1).uniform(0, 0.5)) >= 1
        assert len(kept(tmp_path)["known"]) in (5_000, 5_001)
        lab = serve(tmp_path, port=lab.port)
    finally:
        lab.end()
    leftovers = [path.name for path in tmp_path.iterdir()]
    assert {"lab.json", ".lab.token", ".lab.lock"} <= {*leftovers}, leftovers


def save_until_killed(lab, seconds):
    """Long saves, each building on the last; the kill comes so long after the first. How many."""
    file = lab.folder / "lab.json"
    ending = threading.Timer(seconds, lab.process.kill)
    saves = 0
    with suppress(OSError):
        while lab.process.poll() is None:
            names = [f"{saves} {n}" for n in range(5_000 + saves % 2)]
            known = {name: {"value": 1, "sigma": 1} for name in names}
            read = digest_of(file.read_bytes() if file.exists() else None)
            if status(save_choices(lab, {"known": known}, read)) != 200:
                break
            saves += 1
            if saves == 1:
                ending.start()
    if saves:
        ending.join()
    lab.process.kill()
    lab.process.wait()
    return saves


@ON_POSIX
def test_a_full_disk_changes_nothing_and_is_shown_until_there_is_room(lab):
    import resource

    _, most = resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE)
    try:
        assert status(save_choices(lab, {"fineness": 1.0}, "")) == 200
        before = (lab.folder / "lab.json").read_bytes()
        large = {"known": {f"{n}": {"value": 1, "sigma": 1} for n in range(100)}}
        resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE, (1000, most))
        refused = save_choices(lab, large, digest_of(before))
        assert status(refused) == 507, refused
        assert b"lab.json" in refused
        assert (lab.folder / "lab.json").read_bytes() == before
        names = {path.name for path in lab.folder.iterdir()}
        assert names == {"lab.json", ".lab.token", ".lab.lock"}
        resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE, (most, most))
        assert status(save_choices(lab, large, digest_of(before))) == 200
    finally:
        resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE, (most, most))


def test_two_servers_on_a_folder_never_overwrite_each_other(tmp_path):
    labs = [serve(tmp_path), serve(tmp_path)]
    saved = []

    def save(lab):
        """Counts up: reads, adds a place, saves, and tries again if somebody was faster."""
        while len(saved) < 40:
            content = (tmp_path / "lab.json").read_bytes()
            planned = json.loads(content)["planned"]
            choices = {"planned": [*planned, [len(planned), lab.port]]}
            if status(save_choices(lab, choices, digest_of(content))) == 200:
                saved.append(lab.port)

    try:
        assert labs[0].token == labs[1].token
        assert status(save_choices(labs[0], {"planned": []}, "")) == 200
        threads = [threading.Thread(target=save, args=(lab,)) for lab in labs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        for lab in labs:
            lab.end()
    planned = kept(tmp_path)["planned"]
    assert [place[0] for place in planned] == [*range(len(saved))]
    assert sorted(place[1] for place in planned) == sorted(saved)


def test_a_port_in_use_is_refused(tmp_path, run):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        code, _, said = run("lab", tmp_path, "--no-browser", "--port", port)
    assert code == 2 and f"plumb: port {port} is not free" in said and said.count("\n") == 1


@ON_POSIX
def test_a_folder_that_cannot_be_written_is_refused_at_the_start(run):
    code, _, said = run("lab", "/proc", "--no-browser", "--port", "0")
    assert code == 2 and said.startswith("plumb: /proc: cannot be written")


@ON_POSIX
def test_the_lab_ends_quietly(tmp_path):
    lab = serve(measured_machine(tmp_path / "garage"))
    assert status(answered(lab, Try("GET", "/api/project", body=b"").bytes(lab))) == 200
    lab.process.send_signal(signal.SIGINT)
    said, complained = lab.process.communicate(timeout=120)
    assert (lab.process.returncode, said, complained) == (0, "", "")


@ON_POSIX
def test_a_missing_folder_is_made_and_the_address_is_printed(tmp_path):
    folder = tmp_path / "shop/my-maslow"
    process = subprocess.Popen(
        [*PLUMB, "lab", str(folder), "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env={"PATH": "/nowhere", "HOME": str(tmp_path)},
    )
    try:
        said = [process.stdout.readline() for _ in range(4)]
        assert said[0] == f"{folder}: a new folder, made for this machine\n" and folder.is_dir()
        assert urlopen(said[2].partition("?")[0], timeout=120).status == 200
        assert said[3] == "No browser opened; copy the address into yours.\n"
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(120) == 0


def test_a_damaged_file_of_choices_is_named(tmp_path):
    (tmp_path / "lab.json").write_text('{"units": "cubit"}')
    assert "lab.json, units" in got(asked(tmp_path).get("/api/project"), 422)["error"]


def test_a_file_of_choices_with_a_layout_that_went_still_opens(tmp_path):
    (tmp_path / "lab.json").write_text('{"layout": "distances"}')
    assert choices(asked(tmp_path))["layout"] == "nine"


INI = (EXAMPLE / "groundcontrol.ini").read_bytes()
OTHER = INI.replace(b"2978.4", b"2990.0")


def open_file(client, content, name="groundcontrol.ini"):
    return got(client.post("/api/settings", files={"file": (name, content)}))["choices"]["settings"]


def choices(client):
    return got(client.get("/api/project"))["choices"]


def test_a_second_file_is_opened_and_the_first_again(tmp_path):
    client = with_settings(tmp_path)
    assert open_file(client, OTHER) == "groundcontrol-2.ini"
    assert (tmp_path / "groundcontrol.ini").read_bytes() == INI
    assert open_file(client, INI) == "groundcontrol.ini"
    assert open_file(client, OTHER, "my machine.INI") == "groundcontrol-2.ini"
    inis = {path.name for path in tmp_path.glob("*.ini")}
    assert inis == {"groundcontrol-2.ini", "groundcontrol.ini"}


@pytest.mark.parametrize("then", ["replaced", "taken away"])
def test_readings_find_their_settings_though_a_program_replaced_the_file(tmp_path, then):
    client = with_settings(tmp_path)
    got(client.post("/api/rounds/marks"))
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


def test_a_program_of_the_owner_is_not_replaced_by_that_of_a_grid(tmp_path):
    (tmp_path / "grid.nc").write_text("G21\nG0 X10\n")
    client = with_settings(tmp_path)
    assert got(client.get("/api/rounds/marks"))["program"] == "grid-2.nc"
    got(client.post("/api/rounds/marks"))
    assert (tmp_path / "grid.nc").read_text() == "G21\nG0 X10\n"
    assert (tmp_path / "marks-2.toml").exists()


@pytest.mark.parametrize("name", ["machine.nc", "machine-groundcontrol.ini"])
def test_a_correction_replaces_no_file_at_all(tmp_path, name):
    (tmp_path / name).write_text("mine")
    (tmp_path / "marks.toml").write_text(example_form(read=99))
    with asked(tmp_path) as client:
        open_file(client, INI)
        choose(client, marks=["marks.toml"], accepted=["motor_gap"])
        assert write_correction(client)["file"] == "machine-2.toml"
    assert (tmp_path / name).read_text() == "mine"
