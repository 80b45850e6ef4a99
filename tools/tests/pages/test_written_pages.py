"""docs/written_by/write.py: pages are written, and stale pages told."""

import pytest
import write

TEXTS = {"docs/a.md": "# A\n", "docs/pictures/a/one.svg": "<svg/>\n"}


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Writes a page and its picture below a folder; gives the exit code."""
    monkeypatch.setattr(write, "PAGES", (lambda: TEXTS,))
    return lambda *options: write.main([*options, "--folder", str(tmp_path)])


@pytest.mark.parametrize("name", TEXTS)
def test_a_changed_or_missing_page_is_reported(written, tmp_path, capsys, name):
    assert written() == written("--check") == 0
    assert capsys.readouterr().out == ""
    for change in (lambda path: path.write_text("other"), lambda path: path.unlink()):
        change(tmp_path / name)
        assert written("--check") == 1
        assert capsys.readouterr().out.startswith(f"{name}: stale; run ")
        assert written() == written("--check") == 0


def test_a_folder_that_cannot_be_written_is_refused(written, tmp_path, capsys):
    (tmp_path / "docs").write_text("a file")
    assert written() == 2
    assert capsys.readouterr().err.startswith("write.py: ")
