"""docs/written_by/write.py: pages are written, and stale pages told."""

import pytest
import write

TEXTS, PICTURE = {"docs/a.md": "# A\n"}, "docs/pictures/a/one.png"


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Writes a page and its picture below a folder; gives the exit code."""
    monkeypatch.setattr(write, "PAGES", (lambda: TEXTS,))
    monkeypatch.setattr(write.effects_page, "pictures", lambda: {PICTURE: b"drawn"})
    return lambda *options: write.main([*options, "--folder", str(tmp_path)])


def test_a_changed_or_missing_page_is_reported(written, tmp_path, capsys):
    assert written() == written("--check") == 0
    assert capsys.readouterr().out == "" and (tmp_path / PICTURE).read_bytes() == b"drawn"
    for change in (lambda path: path.write_text("other"), lambda path: path.unlink()):
        change(tmp_path / "docs/a.md")
        assert written("--check") == 1
        assert capsys.readouterr().out.startswith("docs/a.md: stale; run ")
        assert written() == written("--check") == 0


def test_a_folder_that_cannot_be_written_is_refused(written, tmp_path, capsys):
    (tmp_path / "docs").write_text("a file")
    assert written() == 2
    assert capsys.readouterr().err.startswith("write.py: ")
