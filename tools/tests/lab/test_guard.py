"""Tests of the guard: no change by GET, no live line of strangers, no names that run, and
no link of the folder.
"""

import json
import os
import re
import stat

import pytest
from attacks import Try, answered, status
from folder import EXAMPLE, asked, with_marks
from plumb.lab import server
from plumb.lab.app import schema
from plumb.lab.server import TOKEN_FILE
from plumb.settings import digest_of, settings_as_they_were
from plumb.text.files import Unlinked, write_whole
from screens import measured_machine, walk
from served_lab import serve
from systems import ON_POSIX
from websockets.exceptions import InvalidStatus


@pytest.fixture
def measured(lab):
    """The lab on a machine that was measured."""
    measured_machine(lab.folder)
    return lab


def snapshot(folder):
    """Each file with its content and the moment at which it was written."""
    return {
        str(path): (path.stat().st_mtime_ns, path.read_bytes())
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_no_route_changes_the_folder_by_get(measured):
    before = snapshot(measured.folder)
    for route, methods in json.loads(schema())["paths"].items():
        assert "get" not in methods or len(methods["get"].get("requestBody", {})) == 0, route
        target = route.replace("{", "").replace("}", "")
        for method in ("GET", "HEAD"):
            answer = answered(measured, Try(method, target, body=b"").bytes(measured))
            assert 200 <= status(answer) < 500, (route, answer[:300])
    assert snapshot(measured.folder) == before


def test_a_live_line_needs_our_page_and_the_key(lab):
    site = lab.site.rstrip("/")
    tries = [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": f"http://127.0.0.1:{lab.port + 1}"},
        {"origin": site, "protocols": None},
        {"origin": site, "protocols": ["plumb"]},
        {"origin": site, "protocols": ["plumb", "x"]},
        {"origin": site, "protocols": [lab.token]},
        {"origin": site, "protocols": [lab.token, "plumb"]},
        {"origin": site, "protocols": ["plumb", "x", lab.token]},
        {"origin": site, "protocols": None, "path": f"api/live?token={lab.token}"},
        {"origin": "http://evil.example", "path": ""},
    ]
    for each in tries:
        with pytest.raises(InvalidStatus) as refused, lab.live(**each):
            pass
        assert refused.value.response.status_code == 403, each


@ON_POSIX
def test_the_key_is_for_its_owner_alone(lab):
    kept = lab.folder / TOKEN_FILE
    assert stat.S_IMODE(kept.stat().st_mode) == 0o600
    assert len(lab.token) == 43


@pytest.mark.parametrize(
    "brought",
    [pytest.param("readable", marks=ON_POSIX), "short", pytest.param("link", marks=ON_POSIX)],
)
def test_a_key_that_others_may_know_is_replaced(tmp_path, monkeypatch, brought):
    folder = tmp_path / "machine"
    folder.mkdir()
    known = "k" * (20 if brought == "short" else 43)
    kept = folder / TOKEN_FILE
    if brought == "link":
        (tmp_path / "elsewhere").write_text(known)
        (tmp_path / "elsewhere").chmod(0o600)
        kept.symlink_to(tmp_path / "elsewhere")
    else:
        kept.write_text(known)
        kept.chmod(0o644 if brought == "readable" else 0o600)
    said = []
    monkeypatch.setattr("uvicorn.Server.run", lambda server, sockets: None)
    server.serve(folder, port=0, browser=False, say=said.append)
    token = " ".join(said).partition("token=")[2].split()[0]
    assert token != known and kept.read_text().strip() == token
    assert brought != "link" or (tmp_path / "elsewhere").read_text() == known


EVIL = "<img src=x onerror=window.ran=1>"


@ON_POSIX
def test_nothing_in_a_name_runs_and_the_name_is_shown(tmp_path, open_page):
    folder = measured_machine(tmp_path / f"garage {EVIL}")
    marks = folder / "marks.toml"
    text = marks.read_text()
    assert 'name = "1"' in text
    marks.write_text(text.replace('name = "1"', f"name = '{EVIL}'"))
    served = serve(folder)
    page = open_page()
    dialogs, shown = [], []
    page.on("dialog", lambda dialog: (dialogs.append(dialog.message), dialog.dismiss()))
    try:
        page.goto(served.url)
        page.get_by_text(f"garage {EVIL}").wait_for()
        for name in walk(page):
            assert page.evaluate("() => window.ran") is None, name
            assert page.locator("img[onerror]").count() == 0, name
            if page.locator("main").get_by_text(EVIL).count():
                shown.append(name)
    finally:
        served.end()
    assert dialogs == []
    assert "readings" in shown


SECRET = "a secret\n"


@pytest.fixture
def outside(tmp_path):
    """A file that is not in the folder."""
    path = tmp_path / "outside.txt"
    path.write_text(SECRET)
    return path


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    return folder


LINKED = ["lab.json", "diary.jsonl", "groundcontrol.ini", "marks.toml", "guide.json"]
LINKED += ["practice.json"]
READING = ["diary", "project", "readings", "rounds/marks", "verdict", "guide", "correction"]


@ON_POSIX
@pytest.mark.parametrize("name", LINKED)
def test_no_route_reads_a_link(folder, outside, name):
    with_marks(folder)
    form = (EXAMPLE / "marks.toml").read_text()
    sought = {"lab.json": '{"edges": "top-right"}', "guide.json": '{"done": ["read"]}'}
    outside.write_text(sought.get(name, form))
    (folder / name).unlink(missing_ok=True)
    (folder / name).symlink_to(outside)
    before = os.stat(outside)
    with asked(folder) as client:
        said = [client.get(f"/api/{route}") for route in READING]
        said.append(client.post("/api/practice/reveal"))
        assert all(each.status_code in (200, 422) for each in said), [each.text for each in said]
        assert not any("top-right" in each.text for each in said)
        assert any(re.search(rf"{name}:? is a link", each.text) for each in said)
    assert os.stat(outside).st_mtime_ns == before.st_mtime_ns


@ON_POSIX
def test_settings_by_their_digest_are_not_sought_through_a_link(folder, outside):
    outside.write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    (folder / "old.ini").symlink_to(outside)
    named = folder / "groundcontrol.ini"
    named.write_bytes(outside.read_bytes().replace(b"2978.4", b"2990.0"))
    assert settings_as_they_were(named, digest_of(outside)) is None
    (folder / "old.ini").unlink()
    (folder / "old.ini").write_bytes(outside.read_bytes())
    assert settings_as_they_were(named, digest_of(outside)) == folder / "old.ini"


@ON_POSIX
def test_a_result_takes_the_place_of_a_link_and_never_goes_through_it(folder, outside):
    (folder / "machine.nc").symlink_to(outside)
    write_whole(Unlinked(folder) / "machine.nc", b"new")
    assert outside.read_text() == SECRET
    assert not (folder / "machine.nc").is_symlink()
    assert (folder / "machine.nc").read_bytes() == b"new"
