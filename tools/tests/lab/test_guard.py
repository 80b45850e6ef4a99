"""What the guard lets through: nothing that changes a folder by GET, no live line of strangers."""

import json
import stat
from pathlib import Path

import pytest
from attacks import Try, answered, status
from plumb.lab.app import schema
from plumb.lab.server import TOKEN_FILE
from screens import measured_machine
from served_lab import serve
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
ROUTES = json.loads(schema())["paths"]


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab on a machine that was measured."""
    served = serve(measured_machine(tmp_path_factory.mktemp("machine")))
    yield served
    served.end()


def snapshot(folder):
    """Each file with its content and the moment at which it was written."""
    return {
        str(path): (path.stat().st_mtime_ns, path.read_bytes())
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_no_route_changes_the_folder_by_get(lab):
    before = snapshot(lab.folder)
    for route, methods in ROUTES.items():
        assert "get" not in methods or len(methods["get"].get("requestBody", {})) == 0, route
        target = route.replace("{", "").replace("}", "")
        for method in ("GET", "HEAD"):
            answer = answered(lab, Try(method, target, body=b"").bytes(lab))
            assert 200 <= status(answer) < 500, (route, answer[:300])
    assert snapshot(lab.folder) == before


def line(lab, *, origin=None, protocols=None, host=None, path="/api/live"):
    """The page's live line to the machine, opened in some other way than the page does."""
    headers = {"Host": host} if host else {}
    return connect(
        f"ws://127.0.0.1:{lab.port}{path}",
        origin=origin,
        subprotocols=protocols,
        additional_headers=headers,
        open_timeout=120,
    )


def test_a_live_line_needs_our_page_and_the_key(lab):
    site = lab.site.rstrip("/")
    right = ["plumb", lab.token]
    tries = [
        {"origin": "http://evil.example", "protocols": right},
        {"origin": "null", "protocols": right},
        {"origin": f"http://127.0.0.1:{lab.port + 1}", "protocols": right},
        {"origin": site},
        {"origin": site, "protocols": ["plumb"]},
        {"origin": site, "protocols": ["plumb", "x"]},
        {"origin": site, "protocols": [lab.token]},
        {"origin": site, "protocols": [lab.token, "plumb"]},
        {"origin": site, "protocols": ["plumb", "x", lab.token]},
        {"origin": site, "path": f"/api/live?token={lab.token}"},
        {"origin": "http://evil.example", "protocols": right, "path": "/"},
    ]
    for each in tries:
        with pytest.raises(InvalidStatus) as refused, line(lab, **each):
            pass
        assert refused.value.response.status_code == 403, each


def test_the_key_is_for_its_owner_alone(lab):
    kept = lab.folder / TOKEN_FILE
    assert stat.S_IMODE(kept.stat().st_mode) == 0o600
    assert len(lab.token) == 43


@pytest.mark.parametrize("brought", ["readable", "short", "link"])
def test_a_key_that_others_may_know_is_replaced(tmp_path, brought):
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
    served = serve(folder)
    served.end()
    assert served.token != known
    assert kept.read_text().strip() == served.token
    assert brought != "link" or (tmp_path / "elsewhere").read_text() == known
