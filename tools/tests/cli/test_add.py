"""plumb add and diagnose: what they say and write; numbers that were checked; files for clients."""

import configparser
import contextlib
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE, INI, checked
from hidden_boards import board
from plumb import _core, api
from plumb.cli.main import main
from plumb.firmware.settings import every_setting, firmware_numbers, machine_of
from plumb.hidden import MAKER, plan
from plumb.marks.form import marks_toml
from plumb.model.catalogue import effect_names
from plumb.model.predict import chain_lengths, lengths, library
from plumb.settings import machine_toml, read_settings, write_machine_toml
from plumb.text.errors import InputError
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE, csv_of, grid, marks_on
from systems import words_of

BOARD = [str(SETTINGS), str(MARKS)]
EFFECTS = ["--effect", "chain_pitch", "chain_sag"]
ADDED = ("chain_pitch", "chain_sag", "chain_stretch")


def test_the_worst_marks_stand_next_to_the_conclusion_of_compare(run):
    lengths = [float(line.split()[-1]) for line in run("compare", *BOARD)[1].splitlines()[1:9]]
    assert lengths == sorted(lengths)


def test_add_writes_settings_that_explain_the_marks(ask, tmp_path):
    new, ini = tmp_path / "machine.toml", tmp_path / "machine-groundcontrol.ini"
    options = ("--client", "groundcontrol", "--firmware", "published")
    # These marks ask for a sag below zero, which only --force writes.
    code, answer = ask("add", *BOARD, *EFFECTS, "-o", new, *options)
    assert (code, answer["written"], list(tmp_path.iterdir())) == (1, [], [])
    code, answer = ask("add", *BOARD, *EFFECTS, "-o", new, *options, "--force")
    assert code == 1 and answer["written"] == [str(new), str(ini)]
    assert answer["effects_added"] == ["chain_pitch", "chain_sag"]
    assert answer["raw"]["rms_mm"] > answer["before"]["fit_rms_mm"] > answer["after"]["fit_rms_mm"]
    assert answer["after"]["fit_rms_mm"] < answer["after"]["priced_rms_mm"] < 0.9
    *plausible, sag = answer["parameters"]
    assert all(each["plausible"] for each in plausible)
    assert sag["name"] == "chain_sag.weight_ratio_squared" and sag["unit"] == "1/mm^2"
    assert sag["low"] < sag["value"] < sag["high"] < 0 and sag["plausible"] is False
    assert any("off the middle" in line for line in answer["unsaid"])
    _, again = ask("compare", new, MARKS, "--cut-with", SETTINGS)
    # All but the sheet's rotation is in the settings.
    assert again["shape_rms_mm"] == pytest.approx(answer["after"]["shape_rms_mm"], abs=1e-3)
    assert again["rms_mm"] < 0.75
    _, published = ask("compare", ini, MARKS, "--cut-with", SETTINGS)
    assert published["shape_rms_mm"] < 0.9


def test_add_prints_the_fall_the_doubts_and_the_files(run, tmp_path):
    new, picture = tmp_path / "machine.toml", tmp_path / "fall.png"
    written = ("-o", new, "--picture", picture)
    code, said, _ = run("add", *BOARD, *EFFECTS, *written)
    assert code == 1 and "Do not set the machine by" in said and "Nothing is written" in said
    code, said, _ = run("add", *BOARD, *EFFECTS, *written, "--details", "--force")
    assert code == 1 and "The error falls from 7.29 to 0.6" in " ".join(said.split())
    assert "impossible" in said and "measure it again" in said
    assert str(new) in said and picture.read_bytes().startswith(b"\x89PNG")


def test_add_of_an_effect_that_does_not_pay_is_bad_news(run, tmp_path):
    settings, marks = tmp_path / "machine.toml", tmp_path / "marks.csv"
    write_machine_toml(settings, BELIEVED)
    marks.write_text(csv_of(marks_on(BELIEVED, BELIEVED, grid(3, 3), noise=0.5, seed=5)))
    code, said, _ = run("add", settings, marks, "--effect", *ADDED, "--details")
    assert code == 1 and "NOT better" in said and "do not keep" in said


def test_effects_names_every_effect_with_its_look_alikes(run):
    code, said, _ = run("effects")
    assert code == 0
    assert all(name in said for name in effect_names())
    assert said.count("looks like") == len(effect_names())


def test_clean_marks_are_called_clean(run, file, maker):
    clean = marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.5, seed=4)
    words = ("diagnose", maker, file("clean.csv", csv_of(clean)), "--sigma", "0.5")
    code, said, _ = run(*words)
    assert code == 0 and said.startswith("The machine is as good as")
    said = run(*words, "--details")[1]
    assert "may act too" in said and "These marks say nothing of a sled that rubs" in said


def test_a_slip_is_bad_news(run, ask, file, maker):
    marks = list(marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.3, seed=4))
    marks[7] = replace(marks[7], measured=tuple(np.add(marks[7].measured, (5.1, 0.0))))
    path = file("slip.csv", csv_of(marks))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and "One reading disagrees with every explanation" in said
    assert "off to the right" in said
    code, said, _ = run("add", maker, path, "--effect", "auto", "--sigma", "0.3", "--details")
    assert code == 1 and "off to the right" in said and "Write it" not in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and answer["suspects"] == [] and answer["slips"][0]["name"] == "7"
    assert np.hypot(*answer["slips"][0]["offset_mm"]) == pytest.approx(5.1, abs=1.2)


def test_a_patch_is_offered_and_what_it_gains_is_said(run, tmp_path):
    settings, marks = tmp_path / "machine.toml", tmp_path / "marks.toml"
    write_machine_toml(settings, MAKER)
    marks.write_text(marks_toml(board({}, plan(5, 5), seed=8, bump=3.0)))
    words = ("add", settings, marks, "--effect", "auto", "--details")
    fall = "the error at marks not used from 2.69 to 1.65 mm."
    said = " ".join(run(*words)[1].split())
    assert f"A residual patch (--patch) would lower {fall} It is not physics" in said
    said = " ".join(run(*words, "--patch")[1].split())
    assert f"The residual patch lowers {fall}" in said


def test_suspects_come_with_size_and_remedy(run, ask, file, maker):
    path = file("m.csv", csv_of(marks_on(TRUE, BELIEVED, grid(5, 5), noise=0.2, seed=1)))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.2", "--details")
    assert code == 0 and "To be sure" in said and "over 100 to 1" in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.2")
    assert answer["sigma_mm"] == 0.2 and answer["sigma_from"] == "stated"
    assert set(answer["suspects"]) >= {"chain_pitch", "chain_sag"}


BOARDS = {"the example": (INI, EXAMPLE / "marks.toml"), "nine marks": (SETTINGS, MARKS)}


@pytest.mark.parametrize("board", BOARDS)
def test_each_size_lies_in_its_interval(ask, board):
    """Also a size that no real machine has, such as a sag below zero."""
    _, answer = ask("diagnose", *BOARDS[board])
    sizes = [size for each in answer["ranking"] for size in each["parameters"]]
    assert sizes
    for size in sizes:
        if size["low"] is not None:
            assert size["low"] <= size["value"] <= size["high"], size


FULL = replace(
    TRUE,
    effects={
        effect["name"]: {each["name"]: each["typical"] for each in effect["parameters"]}
        for effect in library()
    },
)


@pytest.mark.parametrize("machine", [TRUE, FULL], ids=["three effects", "every effect"])
def test_the_firmware_reads_the_lines_as_the_machine_that_was_fitted(machine):
    numbers = {row.number: float(row.text) for row in firmware_numbers(machine)}
    theirs = machine_of(numbers, sheet=machine.sheet)
    places = grid(7, 5)
    ours, _ = lengths(machine, places)
    paid_out, outcome = lengths(theirs, places)
    assert not outcome.any() and np.abs(ours - paid_out).max() < 0.003


def test_a_size_that_the_firmware_does_not_take_is_refused():
    wild = replace(TRUE, effects={"chain_pitch": {"left": 5.0, "right": 0.0}})
    with pytest.raises(InputError, match="firmware"):
        firmware_numbers(wild)


def test_published_settings_are_left_to_their_own_program(capsys):
    assert main(["settings", str(SETTINGS)]) == 2
    assert "machine.toml" in capsys.readouterr().err


def test_lines_can_be_sent_as_they_are(tmp_path, capsys):
    machine = tmp_path / "machine.toml"
    machine.write_text(machine_toml(TRUE))
    assert main(["settings", str(machine), "--client", "none", "-o", "-"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.startswith("$") and " " not in line for line in lines)
    assert main(["settings", str(machine), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["settings"]) == len(lines)


OURS = (str(EXAMPLE / "groundcontrol.ini"), str(EXAMPLE / "marks.toml"))
PITCH = (*OURS, "--effect", "chain_pitch")
COMMAND = re.compile(r"^  plumb (?:.*\\\n)*.*", re.MULTILINE)


def next_command(said):
    return words_of(COMMAND.findall(said)[-1])[1:]


def test_auto_uses_checked_numbers(ask, run):
    _, free = ask("add", *OURS, "--effect", "auto")
    code, taken = ask("add", *OURS, "--effect", "auto", *checked())
    assert free["auto"]["verdict"] == "cannot_tell" and free["auto"]["rivals"] and code == 0
    assert taken["auto"]["verdict"] == "one_suspect" and not taken["auto"]["rivals"]
    assert taken["effects_added"] == ["chain_pitch", "chain_stretch"]


def test_a_choice_states_whether_it_matters(run, ask):
    apart = ask("add", *OURS, "--effect", "auto")[1]["auto"]["apart"]
    assert apart["mm"] == pytest.approx(2.1, abs=0.1)
    for words in (("add", *OURS, "--effect", "auto"), ("calibrate", *OURS, "--details")):
        assert apart["sentence"] in " ".join(run(*words)[1].split())
    # Rivals that cut alike are no reason to wait.
    alike = ("add", *OURS, "--effect", "auto", *checked("tape_scale.strain"))
    assert ask(*alike)[1]["auto"]["apart"] is None and ask(*alike)[1]["auto"]["rivals"]
    said = " ".join(run(*alike, "--details")[1].split())
    assert "Added: chains too long or too short and chain stretch, the likeliest of several" in said
    assert "For cutting it hardly matters" in said and "(chain_" not in said[: said.index("To be")]


def test_usual_effects_are_added_with_a_note_and_no_doubt(run, ask, tmp_path):
    clean = tmp_path / "clean.csv"
    stretch = {"chain_stretch": {"compliance": 5.2e-6}}
    machine = replace(BELIEVED, effects=stretch)
    clean.write_text(csv_of(marks_on(machine, BELIEVED, grid(3, 3), noise=0.9, seed=5)))
    settings = tmp_path / "machine.toml"
    sag = {"chain_sag": {"weight_ratio_squared": 8.2e-12}}
    write_machine_toml(settings, replace(BELIEVED, effects=sag))
    words = ("add", settings, clean, "--effect", "auto")
    said = " ".join(run(*words, "--details")[1].split())
    assert "Every machine has chain stretch, and these settings leave it out." in said
    assert "this may be zero" not in said and "do not keep it" not in said
    assert "this may be zero" in run("add", settings, clean, "--effect", "chain_stretch")[1]
    _, answer = ask(*words)
    fitted = next(n for n in answer["parameters"] if n["name"] == "chain_stretch.compliance")
    assert 0 < fitted["value"] < 1e-5 and fitted["low"] < 0


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["tape_scale.strain=0+-0.0001"], "tape_scale is not fitted here; name it with --effect"),
        (["nonsense=1+-1"], "nonsense"),
        (["rotation_radius=139+-1"], "no such number is fitted"),
        (["motor_gap=2980+-1", "--prior", "motor_gap=0"], "no such number is fitted"),
        (["motor_gap=2980+-1", "--checked", "motor_gap=2981+-1"], "twice"),
        (["tape_scale.strain=0.1+-0.0001"], "0.1 mm per metre is 0.0001"),
        (["tape_scale.strain=-0.0096+-0.0001"], "real machines have -0.003 to 0.003"),
        (["frame_flex.inward=8+-0.1"], "write it in mm/N"),
        (["motor_gap=298+-1"], "far from the 2978.4 of the settings"),
        (["motor_gap=29784+-1"], "far from the 2978.4 of the settings"),
        (["tape_scale.strain=0,0001+-0.0001"], "write a point, not a comma"),
        (["motor_gap=5+-1kg"], "it is read in mm, not in kg"),
        (["motor_height=1069.6+-1mm"], "far from the 1072.6 of the settings"),
        (["frame_lean.tangent_squared=1/0+-1in"], "not like"),
        (["motor_gap=VALUE+-1"], "put your number in place of VALUE"),
        (["chain_pitch.left=0.002+-0.001", "--hold", "chain_pitch.left=0.002"], "--hold keeps it"),
    ],
)
def test_checks_that_cannot_count_are_refused_in_one_line(run, options, complaint):
    code, said, refused = run("add", *PITCH, "--checked", *options)
    assert code == 2 and said == "" and complaint in refused and refused.count("\n") == 1


def test_the_next_command_repeats_a_check_with_all_its_digits(run, here):
    check = ("--checked", "motor_gap=2978.4375+-0.3", "--checked", "chain_pitch.left=0.0018+-0.001")
    code, said, _ = run("add", *PITCH, *check, "--prior", "motor_height=12.3456789")
    again = next_command(said)
    assert code == 0 and again[-2:] == ["-o", "machine.toml"]
    for words in (check[:2], check[2:], ("--prior", "motor_height=12.3456789")):
        assert " ".join(words) in " ".join(again)
    assert main(again) == 0


def test_the_frame_alone_can_be_fitted(ask, run):
    code, answer = ask("add", *OURS, "--effect", "none")
    wanted = api.add(api.read(*OURS))
    assert code == 0 and answer["after"]["fit_rms_mm"] == wanted.after.fit_rms
    assert answer["effects_added"] == []
    assert "--effect none" in run("add", *OURS, "--effect", "none")[1]
    code, _, refused = run("add", *OURS, "--effect", "none", "chain_pitch")
    assert code == 2 and "name no effects with it" in refused


def test_diagnose_hands_its_checks_to_the_command_that_adds(run):
    words = next_command(run("diagnose", *OURS, *checked())[1])
    assert words[0] == "add" and words[words.index("--effect") + 1] == "auto"
    given = [words[i + 1] for i, word in enumerate(words) if word == "--checked"]
    assert given == checked()[1::2]


def with_readings(text, moved):
    """The text of a marks.toml with each reading moved."""

    def replaced(match):
        x, y = moved(float(match[1]), float(match[2]))
        return f"measured = [{x:.3f}, {y:.3f}]"

    return re.sub(r"measured = \[(\S+), (\S+)\]", replaced, text)


def filled_in(form):
    """The text of a form with every reading at its target."""
    return re.sub(r"target = (.*)\n(.*\n)# measured.*", r"target = \1\n\2measured = \1", form)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a machine fitted to the example's marks."""
    folder = tmp_path_factory.mktemp("fitted")
    shutil.copy(EXAMPLE / "groundcontrol.ini", folder)
    # A sheet that hangs askew by 12 mm over its width: no setting holds that.
    text = (EXAMPLE / "marks.toml").read_text()
    turned = with_readings(text, lambda x, y: (x - 0.005 * y, y + 0.005 * x))
    (folder / "marks.toml").write_text(turned)
    with contextlib.chdir(folder):
        files = ["groundcontrol.ini", "marks.toml", "-o", "machine.toml"]
        assert main(["add", *files, "--effect", "chain_pitch"]) == 0
    return folder


@pytest.fixture
def fitted(folder, here):
    """A copy of it as the current folder; the error that the fit promised [mm]."""
    shutil.copytree(folder, here, dirs_exist_ok=True)
    return round(read_settings("machine.toml").fitted.rms, 2)


def test_compare_finds_the_error_that_add_promised(fitted, ask, run):
    _, answer = ask("compare", "machine.toml", "marks.toml")
    assert answer["rms_mm"] == pytest.approx(answer["promised_rms_mm"], abs=1e-9)
    assert round(answer["rms_mm"], 2) == fitted
    assert abs(answer["rotation"]) < 1e-4
    _, same = ask("compare", "machine.toml", "marks.toml", "--cut-with", "groundcontrol.ini")
    assert same["rms_mm"] == pytest.approx(answer["rms_mm"], abs=1e-9)
    residuals = [mark["left_chain_residual"] for mark in answer["marks"]]
    assert max(map(abs, residuals)) < 2
    said = run("compare", "machine.toml", "marks.toml", "--details")[1]
    assert "cut with groundcontrol.ini" in said and "turned by" in said
    _, old = ask("compare", "groundcontrol.ini", "marks.toml")
    assert old["promised_rms_mm"] is None and old["rms_mm"] > 5


def test_marks_that_took_no_part_are_named(fitted, run):
    options = ("--effect", "chain_pitch", "--without", "13", "--without", "7")
    assert run("add", "groundcontrol.ini", "marks.toml", *options, "-o", "less.toml")[0] == 0
    said = " ".join(run("compare", "less.toml", "marks.toml", "--details")[1].split())
    assert "RMS was left, without 13, 7" in said


def test_diagnose_finds_no_more_to_add(fitted, ask):
    both = ("--effect", "chain_pitch", "chain_stretch", "-o", "both.toml")
    ask("add", "groundcontrol.ini", "marks.toml", *both)
    _, answer = ask("diagnose", "both.toml", "marks.toml")
    assert (answer["verdict"], answer["state"]) == ("nothing_provable", "good")
    assert not answer["explanations"]


def test_marks_of_unknown_settings_are_asked_about(fitted, ask, run):
    text = Path("marks.toml").read_text()
    Path("second.toml").write_text(with_readings(text, lambda x, y: (x + 0.1, y)))
    code, _, complaint = run("compare", "machine.toml", "second.toml")
    assert code == 2 and complaint.count("\n") == 1
    assert "machine.toml was fitted to marks that were cut with groundcontrol.ini" in complaint
    for command in (["diagnose"], ["next"], ["add", "--effect", "chain_pitch"]):
        assert run(*command[:1], "machine.toml", "second.toml", *command[1:])[0] == 2
    for cut_with, least, most in (("groundcontrol.ini", 0, 8), ("machine.toml", 8, 20)):
        _, answer = ask("compare", "machine.toml", "second.toml", "--cut-with", cut_with)
        assert least < answer["rms_mm"] < most
    # Reported chains need no settings, and settings that were never fitted ask nothing.
    chains = re.sub(r"(approach = .*)", r"\1\nchains = [1700, 1700]", text)
    Path("chains.toml").write_text(chains)
    assert run("compare", "machine.toml", "chains.toml")[0] == 0
    assert run("compare", "groundcontrol.ini", "second.toml")[0] == 0


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        (r"^rms = .*", "", "[fit]: rms is missing"),
        (r"^sheet = .*", "sheet = [1, 2]", "[[board]] number 1 sheet: an array of 3 numbers"),
        (r"^\[board.cut_with.frame\]", "[board.cut_with.fram]", "unknown name 'fram'"),
        (r"^\[\[board\]\]", "[board]", "[board]: needs double brackets; write [[board]]"),
    ],
)
def test_a_damaged_record_is_refused_with_its_place(old, new, hint, fitted, run):
    text = Path("machine.toml").read_text()
    Path("machine.toml").write_text(re.sub(old, new, text, count=1, flags=re.MULTILINE))
    code, _, complaint = run("compare", "machine.toml", "marks.toml")
    assert code == 2 and complaint.startswith("plumb: machine.toml") and hint in complaint


def test_two_sheets_keep_their_poses_and_zeros(run, ask, fitted):
    text = Path("marks.toml").read_text()
    moved = with_readings(text, lambda x, y: (x + 6, y - 4))
    Path("second.toml").write_text(f"new_sheet = true\nchains_rezeroed = true\n{moved}")
    both = ("marks.toml", "second.toml")
    options = ("--effect", "chain_pitch", "-o", "two.toml")
    assert run("add", "groundcontrol.ini", *both, *options)[0] == 0
    _, answer = ask("compare", "two.toml", *both)
    assert answer["rms_mm"] == pytest.approx(answer["promised_rms_mm"], abs=1e-9)
    assert answer["rms_mm"] < 2
    # Either sheet alone lies where it lay.
    for name in both:
        _, alone = ask("compare", "two.toml", name)
        assert alone["rms_mm"] < 2 and alone["promised_rms_mm"] is None
        assert max(map(abs, alone["shift"])) < 0.5


def test_settings_that_changed_since_the_cut_are_noticed(run, ask, fitted):
    grid = ("grid", "--settings", "groundcontrol.ini", "--marks", "f.toml", "--output", "g")
    assert run(*grid)[0] == 0
    Path("f.toml").write_text(filled_in(Path("f.toml").read_text()))
    assert run("compare", "groundcontrol.ini", "f.toml")[0] == 0
    old = Path("groundcontrol.ini").read_text()
    # GroundControl keeps its windows in the same file, and writes numbers as it likes.
    kept = old.replace("viewscale = .45", "viewscale = .5").replace("= 463", "= 463.0")
    Path("groundcontrol.ini").write_text(kept)
    assert run("compare", "groundcontrol.ini", "f.toml")[0] == 0
    Path("groundcontrol.ini").write_text(old.replace("= 463", "= 460"))
    code, _, complaint = run("compare", "groundcontrol.ini", "f.toml")
    assert code == 2 and "groundcontrol.ini, which has changed since" in complaint
    assert run("compare", "groundcontrol.ini", "f.toml", "--cut-with", "machine.toml")[0] == 0


def test_effects_of_the_lab_are_named_where_the_error_counts_them(run, fitted):
    add = ("add", "groundcontrol.ini", "marks.toml", "--effect", "tape_scale", "-o", "tape.toml")
    assert run(*add)[0] == 0
    counted = "The error counts what the fit found: tape reads 0.1"
    for command in ("compare", "calibrate"):
        assert counted in " ".join(run(command, "tape.toml", "marks.toml")[1].split())
        assert "counts what" not in run(command, "machine.toml", "marks.toml")[1]


ADD = ("add", INI, EXAMPLE / "marks.toml", "--effect", "chain_pitch")
WORDS = {"Triangular": 2, "Top": 1, "Bottom": 2, "None": 0, "490Hz": 3}
NEAR = 0.01  # [mm] of chain


def dump_of(ini):
    """{number: value} of all that a client keeps in this file."""
    parser = configparser.RawConfigParser()
    parser.read(ini)
    sent = {}
    for setting in every_setting():
        section, _, key = setting.key.partition(": ")
        if key and parser.has_option(f"{section} Settings", key):
            value = parser.get(f"{section} Settings", key)
            sent[setting.number] = float(WORDS.get(value, value))
    return sent


def lines_of(path):
    """{number: value} of the lines for the machine."""
    pairs = re.findall(r"^\$(\d+)=(\S+)$", Path(path).read_text(), re.MULTILINE)
    return {int(number): float(value) for number, value in pairs}


def states(old, new, lines):
    """The firmware's numbers in the end, whichever file came first: named, by number."""
    yield "first the client, then the lines", {**old, **new, **lines}
    yield "and the client once more", {**old, **new, **lines, **new}
    yield "first the lines, while the old client is there", {**old, **lines, **old, **lines, **new}


def apart(settings, numbers):
    """[mm] by which the firmware's chains differ from the fitted machine's, over the sheet."""
    ours, _ = lengths(settings, grid(13, 9))
    theirs, outcome = lengths(machine_of(numbers, sheet=settings.sheet), grid(13, 9))
    assert not outcome.any()
    return np.abs(ours - theirs).max()


def expect_safe(machine, lines, new, *, old=INI):
    settings = read_settings(machine)
    for when, numbers in states(dump_of(old), new, lines_of(lines)):
        assert _core.carried_twice(numbers) == [], when
        assert apart(settings, numbers) < NEAR, when


def test_files_for_two_firmwares_would_double_and_the_check_sees_it(run, tmp_path):
    ours, published = tmp_path / "ours.toml", tmp_path / "published.toml"
    assert run(*ADD, "-o", ours, "--client", "groundcontrol")[0] == 0
    options = ("--client", "groundcontrol", "--firmware", "published")
    assert run(*ADD, "-o", published, *options)[0] == 0
    mixed = {**lines_of(tmp_path / "ours.nc"), **dump_of(tmp_path / "published-groundcontrol.ini")}
    assert _core.carried_twice(mixed) == [(37, 160), (40, 180), (41, 181)]
    assert apart(read_settings(ours), mixed) > 3


def test_settings_and_add_write_the_fitted_machine_alike(run, tmp_path):
    machine = tmp_path / "machine.toml"
    assert run(*ADD, "-o", machine, "--client", "groundcontrol")[0] == 0
    new = dump_of(tmp_path / "machine-groundcontrol.ini")
    expect_safe(machine, tmp_path / "machine.nc", new)
    options = ("--client", "groundcontrol", "--original", INI)
    code, said, _ = run("settings", machine, *options, "-o", tmp_path / "again.nc")
    assert code == 0 and "in place of its groundcontrol.ini" in said
    for name in (".nc", "-groundcontrol.ini"):
        written = (tmp_path / f"machine{name}").read_bytes()
        assert (tmp_path / f"again{name}").read_bytes() == written


def test_webcontrol_gets_numbers_to_type(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    _, answer = ask(*ADD, "-o", machine, "--client", "webcontrol")
    assert answer["written"] == [str(machine), str(tmp_path / "machine.nc")]
    numbers = {setting.key: setting.number for setting in every_setting()}
    typed = {
        numbers[name.replace(" Settings", "")]: float(value)
        for name, value in answer["typed"].items()
    }
    assert set(typed) == {2, 3, 8, 37, 40, 41} and typed[37] == typed[40] == typed[41] == 0
    expect_safe(machine, tmp_path / "machine.nc", {**dump_of(INI), **typed})


def test_a_sender_without_numbers_needs_the_lines_alone(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    _, answer = ask(*ADD, "-o", machine, "--client", "none")
    assert answer["written"] == [str(machine), str(tmp_path / "machine.nc")]
    expect_safe(machine, tmp_path / "machine.nc", {})


def test_lines_alone_are_refused_until_the_client_is_named(run, tmp_path):
    machine, lines = tmp_path / "machine.toml", tmp_path / "machine.nc"
    assert run(*ADD, "-o", machine)[0] == 0
    code, _, complaint = run("settings", machine, "-o", lines)
    assert code == 2 and "twice" in complaint and "--client" in complaint
    for options in (
        ("--client", "groundcontrol", "--original", INI),
        ("--client", "groundcontrol", "-o", lines),
        ("--client", "none", "--original", INI, "-o", lines),
    ):
        assert run("settings", machine, *options)[0] == 2
    assert not lines.exists()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("chainpitch = 6.35", "chainpitch = 6.36", "$13 = 63.6 instead of 63.5"),
        ("chainoversprocket = Top", "chainoversprocket = Bottom", "$38 = 2 instead of 1"),
        ("kinematicstype = Triangular", "kinematicstype = Quadrilateral", "$7 = 1 instead of 2"),
        ("bedheight = 1219.2", "bedheight = 1200", "$1 = 1200 instead of 1219.2"),
        ("gearteeth = 10", "gearteeth = ten", "[Advanced Settings] gearteeth: 'ten' is not a"),
        ("gearteeth = 10\n", "", "gearTeeth is missing"),
    ],
)
def test_a_file_of_another_machine_is_refused(old, new, said, run, file, tmp_path):
    machine = tmp_path / "machine.toml"
    assert run(*ADD, "-o", machine)[0] == 0
    other = file("other.ini", INI.read_text().replace(old, new))
    options = ("--client", "groundcontrol", "--original", other)
    code, _, complaint = run("settings", machine, *options, "-o", tmp_path / "machine.nc")
    assert code == 2 and said in complaint and complaint.count("\n") == 1
    assert not (tmp_path / "machine.nc").exists()


def test_the_published_firmware_gets_all_numbers_through_its_client(run, tmp_path):
    machine, lines = tmp_path / "machine.toml", tmp_path / "machine.nc"
    options = ("--client", "groundcontrol", "--firmware", "published")
    code, said, _ = run(*ADD, "-o", machine, *options)
    assert code == 0 and not lines.exists() and "cannot do" in said
    written = read_settings(machine)
    client = read_settings(tmp_path / "machine-groundcontrol.ini")
    paid_out = chain_lengths(written, grid(13, 9))
    assert np.abs(paid_out - chain_lengths(client, grid(13, 9))).max() < 0.001
    # The next board is cut with these numbers, so this file is what it was cut with.
    assert written.controller == "stock" and client.published.left_tolerance > 0.1
    options = ("--client", "none", "-o", lines)
    code, _, complaint = run("settings", machine, *options)
    assert code == 2 and "published numbers" in complaint and not lines.exists()
    ours = tmp_path / "ours.toml"
    assert run(*ADD, "-o", ours)[0] == 0
    model = read_settings(ours)
    same, _ = lengths(written.as_plumb_model(), grid(13, 9))
    assert np.abs(same - lengths(model, grid(13, 9))[0]).max() < 1e-9
