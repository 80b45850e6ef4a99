"""demo: what is hidden in a virtual machine is named, and the error falls on a new sheet."""

import pytest
from plumb.cli.demo import main
from plumb.settings.files import read_settings
from systems import ON_POSIX


def test_a_folder_that_cannot_be_made_is_refused_in_one_line(tmp_path, capsys):
    (tmp_path / "file").write_text("no folder")
    assert main(["--folder", str(tmp_path / "file" / "demo")]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.startswith("demo: ") and said.err.count("\n") == 1


@ON_POSIX
def test_mega_alone_runs_the_program_that_was_built(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("plumb.cli.demo.BUILT", "absent.elf")
    assert main(["--folder", str(tmp_path), "--mega"]) == 2
    said = capsys.readouterr().err
    assert said == "demo: cannot read absent.elf; build it with pio run\n"


@pytest.mark.slow
def test_the_demo_ends_with_the_hidden_effect_named(tmp_path, capsys):
    assert main(["--folder", str(tmp_path), "--seed", "1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "Hidden was sled_swing (right and up). The lab named it."
    assert "sled_swing (right" not in "\n".join(lines[:-1])
    rows = {line.split("  ")[0]: line.split() for line in lines}
    before, promised, after = (
        rows[name] for name in ("before", "promised", "measured on the new sheet")
    )
    assert float(after[-3]) < 0.2 * float(before[-3])
    assert float(after[-2]) < 1.3 * float(promised[-2])
    assert set(read_settings(tmp_path / "machine.toml").effects) >= {"sled_swing"}
    assert (tmp_path / "marks-2.toml").read_text().count("\nmeasured = ") == 33
    assert max(map(len, lines[: lines.index("Written:")])) <= 80
