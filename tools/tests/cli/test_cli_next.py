"""`plumb next`, `plumb grid --details` and --checked: what they print, write and refuse."""

import dataclasses
import re
import shutil

import numpy as np
import pytest
from example_machine import EXAMPLE, INI
from plumb.model.catalogue import effect_names
from plumb.settings import digest_of, write_machine_toml
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE, csv_of, grid, marks_on
from systems import widest

FILL = "# measured = [ , ]"


def test_the_preparation_is_printed_first(run):
    code, said, complaint = run("next", INI, EXAMPLE / "marks.toml")
    assert code == 0 and complaint == ""
    assert "\nNext: " in said and "about" in said and "minutes" in said
    assert "--checked" in said and "VALUE" in said
    assert widest(said) <= 100


def test_a_proposal_waits_for_the_tape(run, ask, file, maker, tmp_path):
    marks = marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3, seed=2)
    path, form = file("m.csv", csv_of(marks)), tmp_path / "next.toml"
    code, answer = ask("next", maker, path, "--sigma", "0.3", "--marks", form)
    assert code == 0 and answer["written"] == [str(form)]
    chosen = next(each for each in answer["next"] if each["marks"])
    text = form.read_text()
    assert text.count(FILL) == len(chosen["marks"])
    # As it is, it waits; with readings it is a file like any other.
    code, _, complaint = run("diagnose", maker, path, form)
    assert code == 2 and "no measured mark" in complaint
    for line in [line for line in text.splitlines() if line.startswith("target")]:
        text = text.replace(FILL, line.replace("target", "measured"), 1)
    form.write_text(text)
    code, after = ask("diagnose", maker, path, form, "--sigma", "0.3")
    assert code in (0, 1) and after["verdict"]


def test_a_proposal_is_cut_by_a_program(run, ask, file, maker, tmp_path):
    marks = marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3, seed=2)
    path, cut = file("m.csv", csv_of(marks)), tmp_path / "more.nc"
    for _ in range(2):  # a second run replaces the first
        code, answer = ask("next", maker, path, "--sigma", "0.3", "--output", cut)
        assert code == 0 and answer["written"] == [str(cut)]
    # What is only read again is not cut.
    cut_ones = (each for each in answer["next"] if each["marks"] and each["kind"] != "repeats")
    chosen = next(cut_ones)
    text = cut.read_text()
    touched = re.findall(r"G1 X(\S+) Y(\S+) F\S+\nG1 Z-0\.5 ", text)
    targets = [mark["target"] for mark in chosen["marks"]]
    assert np.array(touched, dtype=float) == pytest.approx(np.array(targets), abs=0.001)
    # GroundControl sends no line that is longer than the machine's buffer.
    assert max(map(len, text.splitlines())) <= 80
    assert all(line.count("(") == line.count(")") <= 1 for line in text.splitlines())
    assert chosen["do"][0][:20] in text
    assert run("check", cut, maker)[0] == 0
    numbers = [i for i, each in enumerate(answer["next"], 1) if each["marks"]]
    other = answer["next"][numbers[-1] - 1]
    written = ("--choose", numbers[-1], "--marks", tmp_path / "more.toml")
    _, said, _ = run("next", maker, path, "--sigma", "0.3", *written)
    assert f"Next: {other['title']}" in said and f"Written: {tmp_path / 'more.toml'}" in said


def test_marks_that_are_only_read_again_are_not_cut(run, ask, file, maker, tmp_path):
    path = file("m.csv", csv_of(marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3, seed=2)))
    command = ["next", maker, path]
    _, answer = ask(*command)
    again = [each["kind"] for each in answer["next"]].index("repeats") + 1
    form, cut = tmp_path / "more.toml", tmp_path / "more.nc"
    code, _, complaint = run(*command, "--choose", again, "--output", cut)
    assert code == 2 and "the proposals that are cut are" in complaint and not cut.exists()
    assert run(*command, "--choose", again, "--marks", form)[0] == 0
    assert form.read_text().count(FILL) == 27


def test_a_number_that_was_checked_is_not_proposed_again(ask):
    gap = "the gap between the motors"
    code, answer = ask("next", INI, EXAMPLE / "marks.toml")
    assert code == 0 and gap in [each["title"] for each in answer["next"]]
    # What is known of the account that holds comes with each proposal, in bits.
    assert all(each["bits"] > 0 and 0 <= each["chance"] <= 1 for each in answer["next"][:3])
    assert answer["next"][0]["chance"] > 0
    code, answer = ask("next", INI, EXAMPLE / "marks.toml", "--checked", "motor_gap=2980.4±0.5")
    titles = [each["title"] for each in answer["next"]]
    assert code == 0 and gap not in titles
    assert "100 links of each chain" in titles


def test_marks_that_were_read_are_never_overwritten(run, file, maker):
    path = file("m.csv", csv_of(marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3)))
    before = path.read_bytes()
    code, _, complaint = run("next", maker, path, "--marks", path)
    assert code == 2 and "is read here and kept" in complaint and path.read_bytes() == before


def test_a_grid_says_what_its_marks_could_tell_before_it_is_cut(ask, run, maker, tmp_path):
    details = ("grid", "--settings", maker, "--preset", "twenty-five", "--details")
    answer = ask(*details)[1]["details"]
    outlines = {each["effect"]: each for each in answer["outlines"]}
    assert answer["marks"] == 25 and outlines["motor_level"]["smallest"] > 20
    assert "frame_lean" in outlines["chain_sag"]["alike"]
    code, said, _ = run(*details)
    assert code == 0 and said.startswith("25 marks read to 0.50 mm: of 13 causes in their usual")
    assert "◐  chain sag" in said and max(map(len, said.splitlines())) <= 80
    code, with_file, _ = run(*details, "--output", tmp_path / "grid.nc")
    assert code == 0 and with_file.endswith(said) and (tmp_path / "grid.nc").exists()
    assert ask("grid", "--preset", "nine")[1]["details"] is None


def test_a_form_names_the_settings_that_its_marks_are_cut_with(run, tmp_path):
    form = tmp_path / "forms" / "more.toml"
    form.parent.mkdir()
    settings = shutil.copy(SETTINGS, tmp_path)
    assert run("next", settings, MARKS, "--marks", form)[0] == 0
    head = form.read_text().split("[[mark]]")[0]
    assert 'cut_with = "../groundcontrol.ini"' in head
    assert f'cut_with_digest = "{digest_of(SETTINGS)}"' in head


def test_a_form_names_the_machines_present_settings_if_asked(run, maker, file, tmp_path):
    marks = file("marks.csv", csv_of(marks_on(TRUE, BELIEVED, grid(3, 3))))
    now, form = tmp_path / "now.toml", tmp_path / "more.toml"
    write_machine_toml(now, dataclasses.replace(BELIEVED, sheet_width=2400.0))
    command = ["next", maker, marks, "--marks", form, "--cut-next-with"]
    assert run(*command, now)[0] == 0
    assert 'cut_with = "now.toml"' in form.read_text()
    # The form counts from the edges of the sheet of those settings.
    name, target = re.search(r'name = "(\S+)/.*"\ntarget = \[(\S+),', form.read_text()).groups()
    assert float(target) == pytest.approx(float(name) + 2400.0 / 2, abs=1)
    code, _, complaint = run(*command, tmp_path / "nothing.toml")
    assert code == 2 and "nothing.toml" in complaint


def test_sentences_and_tables_name_effects_as_makers_do(run):
    for words in (
        ["grid", "--settings", SETTINGS, "--preset", "nine", "--details"],
        ["next", SETTINGS, MARKS],
        ["add", SETTINGS, MARKS, "--effect", "auto"],
    ):
        said = " ".join(run(*words)[1].split("\n  plumb ")[0].split())
        # A name in brackets is what --effect takes.
        bare_names = [name for name in effect_names() if re.search(rf"(?<!\(){name}\b", said)]
        assert bare_names == [], words[0]
