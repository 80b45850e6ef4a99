"""Each attack is refused, changes nothing and shows nothing; the page of the guard counts them."""

import re
from pathlib import Path

import pytest
from attacks import ATTACKS, Try, answered, status
from published_marks import SETTINGS
from served_lab import serve
from systems import ON_POSIX

PAGE = Path(__file__).resolve().parents[3] / "docs/decisions/0009-who-may-ask-the-lab.md"
SECRET = "what nobody may see"


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab whose folder has a machine, next to a secret."""
    outside = tmp_path_factory.mktemp("outside")
    (outside / "secret.ini").write_text(SECRET)
    folder = outside / "machine"
    folder.mkdir()
    served = serve(folder)
    yield served
    served.end()
    assert served.process.stderr.read() == ""  # its owner sees nothing of an attack


def contents(lab):
    """Everything around the lab, the folder above it included."""
    return {
        str(path): path.read_bytes()
        for path in sorted(lab.folder.parent.rglob("*"))
        if path.is_file() and path.name != ".lab.lock"
    }


@pytest.mark.parametrize("every", [7, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("attack", ATTACKS)
def test_each_try_is_refused_and_changes_nothing(lab, attack, every):
    before = contents(lab)
    for each in ATTACKS[attack][::every]:
        answer = answered(lab, each.bytes(lab))
        sent = each.bytes(lab)[:300]
        assert status(answer) == 0 or 400 <= status(answer) < 500, (sent, answer[:600])
        assert SECRET.encode() not in answer and lab.token.encode() not in answer, sent
        assert b"access-control-allow" not in answer.lower(), answer[:600]
    assert contents(lab) == before
    assert lab.process.poll() is None


def test_the_request_that_the_attacks_change_is_answered(lab):
    folder = Path(lab.folder)
    answer = answered(lab, Try().bytes(lab))
    assert status(answer) == 200, answer
    assert (folder / "lab.json").exists()
    (folder / "lab.json").unlink()
    assert status(answered(lab, Try("GET", "/api/project", body=b"").bytes(lab))) == 200
    assert status(answered(lab, Try("GET", "/", body=b"").bytes(lab))) == 200


def test_the_page_of_the_guard_counts_these_attacks():
    rows = dict(re.findall(r"^\| ([^|]+?) \| (\d+) \| \d+ \|$", PAGE.read_text(), re.MULTILINE))
    assert {attack: int(rows.get(attack, 0)) for attack in ATTACKS} == {
        attack: len(tries) for attack, tries in ATTACKS.items()
    }


@ON_POSIX
@pytest.mark.parametrize("name", ["groundcontrol.ini", "lab.json", ".lab.lock"])
def test_nothing_is_saved_through_a_link(lab, name):
    target = lab.folder.parent / "secret.ini"
    (lab.folder / name).unlink(missing_ok=True)
    (lab.folder / name).symlink_to(target)
    form = (
        b'--x\r\nContent-Disposition: form-data; name="file"; filename="groundcontrol.ini"\r\n\r\n'
    )
    body = form + SETTINGS.read_bytes() + b"\r\n--x--\r\n"
    kind = (("Content-Type", "multipart/form-data; boundary=x"),)
    try:
        answer = answered(lab, Try("POST", "/api/settings", kind, body).bytes(lab))
        assert status(answer) in (422, 507), answer
        assert target.read_text() == SECRET
    finally:
        (lab.folder / name).unlink()
