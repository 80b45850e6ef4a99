"""The lab under a kill, a full disk, a second server: files stay whole, and it says why."""

import json
import os
import random
import resource
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from urllib.request import urlopen

import pytest
from attacks import Try, answered, status
from plumb.lab.project import digest_of
from screens import measured_machine
from served_lab import PLUMB, serve


def choose(lab, choices, read):
    """Save choices that replace those of this digest."""
    body = json.dumps({"choices": choices, "read": read}).encode()
    return answered(lab, Try(body=body).bytes(lab))


def kept(folder):
    """What the folder's choices are; they can always be read."""
    return json.loads((folder / "lab.json").read_text())


@pytest.mark.parametrize("kills", [1, pytest.param(6, marks=pytest.mark.slow)])
def test_a_server_killed_in_the_middle_of_saves_leaves_whole_files(tmp_path, kills):
    """Saves of half a megabyte, one after the other; the kill comes at any moment."""
    chance = random.Random(1)
    lab = serve(tmp_path)
    try:
        for _ in range(kills):
            assert save_until_killed(lab, chance.uniform(0, 0.5)) >= 1
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
            if status(choose(lab, {"known": known}, read)) != 200:
                break
            saves += 1
            if saves == 1:
                ending.start()
    if saves:
        ending.join()
    lab.process.kill()
    lab.process.wait()
    return saves


def test_a_full_disk_changes_nothing_and_is_said_until_there_is_room(tmp_path):
    lab = serve(tmp_path)
    try:
        assert status(choose(lab, {"fineness": 1.0}, "")) == 200
        before = (tmp_path / "lab.json").read_bytes()
        large = {"known": {f"{n}": {"value": 1, "sigma": 1} for n in range(100)}}
        _, most = resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE, (1000, most))
        refused = choose(lab, large, digest_of(before))
        assert status(refused) == 507, refused
        assert b"lab.json" in refused
        assert (tmp_path / "lab.json").read_bytes() == before
        assert {path.name for path in tmp_path.iterdir()} == {"lab.json", ".lab.token", ".lab.lock"}
        resource.prlimit(lab.process.pid, resource.RLIMIT_FSIZE, (most, most))
        assert status(choose(lab, large, digest_of(before))) == 200
    finally:
        lab.end()


def test_two_servers_on_a_folder_never_overwrite_each_other(tmp_path):
    labs = [serve(tmp_path), serve(tmp_path)]
    saved = []

    def save(lab):
        """Counts up: reads, adds a place, saves, and tries again if somebody was faster."""
        while len(saved) < 40:
            content = (tmp_path / "lab.json").read_bytes()
            planned = json.loads(content)["planned"]
            choices = {"planned": [*planned, [len(planned), lab.port]]}
            if status(choose(lab, choices, digest_of(content))) == 200:
                saved.append(lab.port)

    try:
        assert labs[0].token == labs[1].token
        assert status(choose(labs[0], {"planned": []}, "")) == 200
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


def started(*arguments, **environment):
    """`plumb lab` with these arguments, to its end."""
    return subprocess.run(
        [*PLUMB, "lab", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
    )


def test_a_port_that_is_taken_is_said(tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        done = started(tmp_path, "--no-browser", "--port", port)
    assert done.returncode == 2
    assert f"plumb: port {port} is not free" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_folder_that_cannot_be_written_is_refused_at_the_start(tmp_path):
    done = started("/proc", "--no-browser", "--port", "0")
    assert done.returncode == 2
    assert done.stderr.startswith("plumb: /proc: cannot be written")


def test_a_folder_that_is_not_there_is_made_and_said(tmp_path):
    """As in the example of its help."""
    folder = tmp_path / "shop/my-maslow"
    words = [*PLUMB, "lab", folder, "--no-browser", "--port", "0"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    made, _, address = (process.stdout.readline() for _ in range(3))
    assert made == f"{folder}: a new folder, made for this machine\n" and folder.is_dir()
    assert address.startswith("http://")
    process.terminate()
    process.wait()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_lab_ends_quietly(tmp_path, number):
    lab = serve(measured_machine(tmp_path / "garage"))
    assert status(answered(lab, Try("GET", "/api/project", body=b"").bytes(lab))) == 200
    lab.process.send_signal(number)
    said, complained = lab.process.communicate(timeout=120)
    assert lab.process.returncode == (0 if number == signal.SIGINT else -signal.SIGTERM)
    assert (said, complained) == ("", "")


def test_without_a_browser_the_address_is_enough(tmp_path):
    process = subprocess.Popen(
        [*PLUMB, "lab", str(tmp_path), "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env={"PATH": "/nowhere", "HOME": str(tmp_path)},
    )
    try:
        said = [process.stdout.readline() for _ in range(3)]
        address = said[1].partition("?")[0]
        assert urlopen(address, timeout=120).status == 200
        assert said[2] == "No browser opened; copy the address into yours.\n"
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(120) == 0


def test_a_damaged_file_of_choices_is_named(tmp_path):
    (tmp_path / "lab.json").write_text('{"units": "cubit"}')
    lab = serve(tmp_path)
    try:
        answer = answered(lab, Try("GET", "/api/project", body=b"").bytes(lab))
        assert status(answer) == 422
        assert b"lab.json, units" in answer
    finally:
        lab.end()


def test_python_knows_the_limit_of_a_file():
    """The test of the full disk needs a limit that ends a write, not the process."""
    assert signal.getsignal(signal.SIGXFSZ) == signal.SIG_IGN, sys.version
