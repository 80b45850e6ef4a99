"""A folder from elsewhere may hold links: none is followed, in reading or in writing."""

import os

import pytest
from folder import EXAMPLE, asked, with_settings
from plumb.diary.file import NUMBERS, append, keep, read_diary
from plumb.grid.cut_with import digest_of, settings_as_they_were
from plumb.text.errors import InputError
from plumb.text.files import links_refused, read_bytes, read_text, write_all, write_whole

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


@pytest.mark.parametrize("is_there", [True, False])
def test_a_diary_that_is_a_link_is_neither_written_nor_read(folder, outside, is_there):
    if not is_there:
        outside.unlink()
    (folder / "diary.jsonl").symlink_to(outside)
    with pytest.raises(InputError, match=r"diary\.jsonl: is a link"):
        append(folder, NUMBERS, {})
    with pytest.raises(InputError, match=r"diary\.jsonl: is a link"):
        read_diary(folder)
    assert "is a link" in keep(str(folder), NUMBERS, {})
    assert (outside.read_text() == SECRET) if is_there else not outside.exists()


def test_the_page_says_that_the_diary_is_a_link(folder, outside):
    (folder / "diary.jsonl").symlink_to(outside)
    answer = with_settings(folder).get("/api/diary")
    assert answer.status_code == 422 and "diary.jsonl: is a link" in answer.json()["error"]


LINKED = ["lab.json", "groundcontrol.ini", "marks.toml", "guide.json", "practice.json"]
ROUTES = ["project", "readings", "grid", "verdict", "guide", "correction"]


@pytest.mark.parametrize("name", LINKED)
def test_no_route_reads_a_link(folder, outside, name):
    with_settings(folder)
    form = (EXAMPLE / "marks.toml").read_text()
    (folder / "marks.toml").write_text(form)
    sought = {
        "lab.json": '{"edges": "top-right"}',
        "guide.json": '{"done": ["read"], "sigmas": {}}',
    }
    outside.write_text(sought.get(name, form))
    (folder / name).unlink(missing_ok=True)
    (folder / name).symlink_to(outside)
    before = os.stat(outside)
    with asked(folder) as client:
        said = [client.get(f"/api/{route}") for route in ROUTES]
        assert all(each.status_code in (200, 422) for each in said), [each.text for each in said]
        refused = [each.text for each in said if each.status_code == 422]
        assert not any("top-right" in each.text for each in said)
        if name in ("lab.json", "guide.json"):
            assert any(
                f"{name}: is a link" in text or f"{name} is a link" in text for text in refused
            )
    assert os.stat(outside).st_mtime_ns == before.st_mtime_ns


def test_settings_that_a_form_names_are_not_read_through_a_link(folder, outside):
    client = with_settings(folder)
    outside.write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    (folder / "cut.ini").symlink_to(outside)
    form = (EXAMPLE / "marks.toml").read_text()
    (folder / "marks.toml").write_text(f'cut_with = "cut.ini"\n{form}')
    answer = client.get("/api/readings", params={"file": "marks.toml"})
    assert answer.status_code == 422


def test_settings_by_their_digest_are_not_sought_through_a_link(folder, outside):
    outside.write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    (folder / "old.ini").symlink_to(outside)
    named = folder / "groundcontrol.ini"
    named.write_bytes(outside.read_bytes().replace(b"2978.4", b"2990.0"))
    assert settings_as_they_were(named, digest_of(outside)) is None
    (folder / "old.ini").unlink()
    (folder / "old.ini").write_bytes(outside.read_bytes())
    assert settings_as_they_were(named, digest_of(outside)) == str(folder / "old.ini")


def test_a_result_takes_the_place_of_a_link_and_never_goes_through_it(folder, outside):
    (folder / "machine.nc").symlink_to(outside)
    with links_refused():
        write_all({str(folder / "machine.nc"): b"new"})
    assert outside.read_text() == SECRET
    assert not (folder / "machine.nc").is_symlink()
    assert (folder / "machine.nc").read_bytes() == b"new"


def test_a_link_that_the_owner_names_in_a_terminal_is_followed(folder, outside):
    link = folder / "machine.toml"
    link.symlink_to(outside)
    assert read_text(link) == SECRET
    write_whole(link, b"new")
    assert outside.read_bytes() == b"new" and link.is_symlink()
    with links_refused(), pytest.raises(InputError, match="is a link"):
        read_bytes(link)
