"""The command line refuses what cannot be used, in one clear line: words, full disks."""

import codecs
import errno
import functools
import inspect
import json
import os
import re
import shlex
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE, INI, POCKET
from plumb.cli import main
from plumb.cli.main import COMMANDS, GONE, GROUPS, build_parser
from plumb.cli.output import INTERRUPTED, ended
from plumb.settings import read_settings, write_machine_toml
from plumb.text.files import read_text
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE
from systems import ON_POSIX

BOARD = [str(SETTINGS), str(MARKS)]
EFFECTS = ["--effect", "chain_pitch", "chain_sag"]
BAD = [
    ("no marks", ["compare", SETTINGS], "MARKS"),
    ("text for a number", ["check", POCKET, SETTINGS, "--bit", "big"], "--bit"),
    ("a length below zero", ["check", POCKET, SETTINGS, "--bit=-1"], "--bit"),
    ("settings are missing", ["compare", "none.ini", MARKS], "none.ini: there is no such file"),
    ("marks are missing", ["compare", SETTINGS, "none.csv"], "none.csv: there is no such file"),
    ("marks as settings", ["compare", MARKS, MARKS], "holds marks, not settings"),
    ("settings as marks", ["compare", SETTINGS, SETTINGS], "holds settings, not marks"),
    ("program as settings", ["check", SETTINGS, POCKET], "a program, not settings; give JOB first"),
    (
        "program as marks",
        ["compare", SETTINGS, POCKET],
        "holds a program, not marks; give the form",
    ),
    ("holey needs more", ["compare", *BOARD, "--controller", "holey"], "sledWeight"),
    ("a folder", ["compare", SETTINGS.parent, MARKS], "is a folder"),
    ("unknown effect", ["add", *BOARD, "--effect", "chain_sog"], "known are "),
    ("auto", ["add", *BOARD, "--effect", "auto", "chain_sag"], "name no others with it"),
    ("no effect", ["add", *BOARD], "--effect"),
    ("bad prior", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap=near"], "NAME=SIGMA"),
    ("prior without a number", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap"], "NAME=SIGMA"),
    ("infinite prior", ["add", *BOARD, *EFFECTS, "--prior", "motor_gap=inf"], "NAME=SIGMA"),
    ("unknown prior", ["add", *BOARD, *EFFECTS, "--prior", "gap=1"], "unknown name 'gap'"),
    ("no reading error", ["add", *BOARD, *EFFECTS, "--sigma", "0"], "--sigma"),
    ("picture of no form", ["compare", *BOARD, "--picture", "errors.gif"], ".png"),
    ("no place", ["inverse", SETTINGS], "X,Y"),
    ("a place of one", ["inverse", SETTINGS, "1;2"], "'1;2' is not X,Y"),
    ("chains of one", ["forward", SETTINGS, "1,"], "'1,' is not X,Y"),
    (
        "our board",
        ["inverse", SETTINGS, "0,0", "--float32", "--controller", "stock"],
        "--float32 is",
    ),
    ("a place off", ["grid", "--places=0,0 0,700"], "mark 2 at x 0.0 y 660.0 is outside the sheet"),
    (
        "margin of places",
        ["grid", "--places=0,0", "--margin", "3"],
        "--margin is of marks in columns",
    ),
    (
        "a check without error",
        ["next", *BOARD, "--checked", "motor_gap=2981"],
        "motor_gap=2978.4+-1",
    ),
    ("a number of no value", ["check", POCKET, SETTINGS, "--set", "15"], "is not N=VALUE"),
    ("a number below zero", ["check", POCKET, SETTINGS, "--set", "15=-4"], "refuses '$15=-4'"),
    ("a check to nothing", ["next", *BOARD, "--checked", "motor_gap=1+-0"], "above zero"),
    ("a choice of no file", ["next", *BOARD, "--choose", "1"], "--choose"),
    ("no such choice", ["next", *BOARD, "--marks", "x.toml", "--choose", "99"], "--choose 99"),
    ("one file twice", ["next", *BOARD, "--marks", "x.nc", "--output", "x.nc"], "two results"),
]


@pytest.mark.parametrize(("arguments", "hint"), [pytest.param(*b[1:], id=b[0]) for b in BAD])
def test_unusable_input_is_refused_in_one_line(arguments, hint, run, here):
    extra = ["-o", "new.toml", "--client", "groundcontrol"] if arguments[:1] == ["add"] else []
    code, said, complaint = run(*arguments, *extra)
    assert code == 2 and said == ""
    assert complaint.startswith("plumb: ") and complaint.count("\n") == 1
    assert hint in complaint
    assert list(here.iterdir()) == []


@pytest.mark.parametrize(
    "outputs",
    [
        ("-o", "nowhere/machine.toml", "--client", "groundcontrol"),
        ("-o", "new.nc", "--client", "none"),
        ("-o", "new.toml", "--picture", "new.toml"),
        ("--client", "groundcontrol"),
        ("-o", "new.toml", "--client", "none", "--firmware", "published"),
        ("-o", "new.toml", "--original", str(SETTINGS)),
        ("-o", "new.toml", "--picture", "nowhere/fall.png"),
        ("-o", str(SETTINGS)),
        ("-o", "new.toml", "--picture", str(MARKS)),
    ],
)
def test_if_one_result_cannot_be_written_none_is_written(outputs, run, here):
    before = SETTINGS.read_bytes(), MARKS.read_bytes()
    code, said, complaint = run("add", *BOARD, "--effect", "none", *outputs)
    assert code == 2 and said == "" and complaint.count("\n") == 1
    assert list(here.iterdir()) == []
    assert (SETTINGS.read_bytes(), MARKS.read_bytes()) == before


def test_a_groundcontrol_ini_needs_an_old_one(run, tmp_path):
    machine, out = tmp_path / "machine.toml", tmp_path / "new.toml"
    write_machine_toml(machine, BELIEVED)
    options = ("-o", out, "--client", "groundcontrol")
    code, _, complaint = run("add", machine, MARKS, "--effect", "none", *options)
    assert code == 2 and "needs your groundcontrol.ini" in complaint and not out.exists()
    for given in ("--cut-with", "--original"):
        assert run("add", machine, MARKS, "--effect", "none", *options, given, SETTINGS)[0] == 0
        assert (tmp_path / "new-groundcontrol.ini").exists()
        (tmp_path / "new-groundcontrol.ini").unlink()


def test_an_effect_that_the_library_lacks_is_refused_in_settings_too(run, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, BELIEVED)
    with open(machine, "a") as text:
        text.write("\n[effects.chain_sog]\nsize = 1\n")
    code, _, complaint = run("compare", machine, MARKS)
    assert code == 2 and f"{machine}, [effects.chain_sog]" in complaint


def test_distances_cannot_be_drawn(run, tmp_path):
    marks = tmp_path / "d.toml"
    marks.write_text(
        'frame = "machine"\nmark = [{name = "a", target = [0, 0]}, {name = "b", target = [500, 0]}]'
        '\ndistance = [{between = ["a", "b"], mm = 501}]\n'
    )
    picture = tmp_path / "d.png"
    code, _, complaint = run("compare", SETTINGS, marks, "--picture", picture)
    assert code == 2 and "distances only" in complaint and not picture.exists()


FORM = EXAMPLE / "marks.toml"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--lnie", "check"], "there is no option --lnie here; see plumb --help"),
        (["resume", POCKET, INI, "--line", "0"], "--line: '0' is not a whole number from 1 on"),
        (["resume", POCKET, INI, "--line", "two"], "'two' is not a whole number from 1 on"),
        (["check", POCKET, INI, "--start", "1;2"], "'1;2' is not X,Y"),
        (["lab", "--share", "garage"], "name the folder first: plumb lab garage --share"),
    ],
)
def test_a_wrong_word_is_named_and_not_the_words_after_it(run, words, says):
    code, out, complaint = run(*words)
    assert code == 2 and out == "" and says in complaint


@pytest.mark.parametrize("name", GONE)
def test_a_removed_command_names_its_replacement(run, name):
    said = f"there is no command '{name}' any more: {GONE[name]}"
    assert run(name, "--old-option", "1") == (2, "", f"plumb: {said}\n")
    commands = re.findall(r"plumb (\w+)", GONE[name])
    assert name not in COMMANDS and {*commands} <= {*COMMANDS}


@pytest.mark.parametrize(
    ("begin", "says"),
    [
        (b"%PDF-1.4\n1 0 obj", "is a PDF, not a text file"),
        (b"\x89PNG\r\n\x1a\n\0", "is a picture (PNG), not a text file"),
        (b"\xff\xd8\xff\xe0\0", "is a picture (JPEG), not a text file"),
        (b"PK\x03\x04\0", "is an archive (ZIP"),
        (FORM.read_bytes(), "holds marks, not a program; give a program of G-code"),
        (INI.read_bytes(), "holds settings of GroundControl, not a program"),
        ((EXAMPLE / "machine.toml").read_bytes(), "holds settings of a machine; give a program"),
        (b'<?xml version="1.0"?>\n<svg/>', "holds a drawing or a page, not a program; let a CAM"),
        (b"  0\nSECTION\n  2\nHEADER\n", "holds a drawing (DXF), not a program; let a CAM"),
        (b'{"Maslow Settings": [{"key": "bedWidth"}]}', "holds settings of WebControl"),
        (b'{"a": 1}', "holds JSON, not a program"),
        (b"\nhello world\n", "line 2: is not G-code (a number is missing behind H)"),
        (b"# A page\n", "line 1: is not G-code (this begins no word: #)"),
    ],
)
@pytest.mark.parametrize("command", ["check", "resume"])
def test_a_file_that_is_not_a_program_is_named_for_what_it_is(run, tmp_path, command, begin, says):
    path = tmp_path / "file.nc"
    path.write_bytes(begin)
    code, out, complaint = run(command, path, INI, *(["--line", 1] * (command == "resume")))
    assert code == 2 and out == "" and says in complaint and complaint.count("\n") == 1


REACHED = "USB: cannot be opened; check the cable"
BEGUN = ["%\nG21\n", "G5 X1\n", "G1 X1\n", "B05\n", "$$\n", "; nothing\n"]  # the machine's matter


@pytest.mark.parametrize(
    ("what", "says"),
    [
        (INI, "not a program; numbers are sent from a machine.toml"),
        (FORM, "holds marks, not a program; give a program of G-code"),
        (EXAMPLE, "is a folder; name the file inside it"),
        ("nothing.nc", "there is no such file; check the name"),
        ("hello", REACHED),
        (POCKET, REACHED),
    ],
)
def test_what_is_no_program_is_refused_before_the_port_is_opened(run, what, says):
    code, _, complaint = run("send", "--port", "USB", what)
    assert code == 2 and says in complaint and complaint.count("\n") == 1


def test_other_faults_are_left_to_the_machine(run, here):
    numbers = (EXAMPLE / "machine.toml").read_text()
    (here / "machine.toml").write_text(f"# Säge\n{numbers}")  # which is not sent as it is
    for i, text in enumerate(BEGUN):
        (here / f"{i}.nc").write_text(text)
    for path in here.iterdir():
        assert REACHED in run("send", "--port", "USB", path)[2], path.read_text()


@pytest.mark.parametrize(
    ("mark", "coding"), [(codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be")]
)
def test_files_that_notepad_saves_as_unicode_are_read(run, tmp_path, mark, coding):
    for path in (POCKET, INI, FORM):
        (tmp_path / path.name).write_bytes(mark + path.read_text("utf-8").encode(coding))
        assert read_text(tmp_path / path.name) == path.read_text("utf-8")
    assert read_settings(tmp_path / INI.name) == read_settings(INI)
    assert run("check", tmp_path / POCKET.name, tmp_path / INI.name)[0] == 0
    (tmp_path / "half.nc").write_bytes(mark + b"G")
    assert "is not" in run("check", tmp_path / "half.nc", INI)[2]


def test_a_bare_plumb_shows_its_help(run, capsys):
    with pytest.raises(SystemExit) as end:
        run()
    assert end.value.code == 0 and "usage: plumb" in capsys.readouterr().out


def test_inverse_and_forward_of_our_model_undo_each_other(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, TRUE)
    code, answer = ask("inverse", machine, "0,0", "1150,-550", "-900,400")
    assert code == 0 and answer["controller"] == "plumb"
    pairs = [f"{left!r},{right!r}" for left, right in answer["lengths"]]
    code, back = ask("forward", machine, *pairs)
    assert code == 0 and back["found"] == ["yes"] * 3
    places = np.array([[0, 0], [1150, -550], [-900, 400]])
    assert np.array(back["places"]) == pytest.approx(places, abs=1e-4)
    _, board = ask("inverse", machine, "0,0", "1150,-550", "-900,400", "--float32")
    away = np.abs(np.array(board["lengths"]) - answer["lengths"])
    assert 0 < away.max() < 0.002  # as the board computes, in float


def test_a_place_out_of_reach_is_null_and_bad_news(ask, run):
    words = ("inverse", INI, "0,0", "0,5e3", "--controller", "plumb")
    code, answer = ask(*words)
    assert code == 1 and answer["lengths"][1] is None and answer["found"] == ["yes", "out of reach"]
    code, said, _ = run(*words)
    assert code == 1 and said.startswith("1 of 2 places found") and "out of reach" in said


TOOLS = Path(__file__).resolve().parents[2]
PLUMB = [sys.executable, "-m", "plumb.cli.main"]
COMPARE = [*PLUMB, "compare", str(SETTINGS), str(MARKS)]

# A lane of tools/test ignores Ctrl-C, and what it starts would too.
INTERRUPTIBLE = functools.partial(
    subprocess.Popen, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["diagnoze"], "there is no command 'diagnoze'; did you mean diagnose?; see plumb --help"),
        (["xyz"], "there is no command 'xyz'; see plumb --help"),
        (["effects", "--jason"], "no option --jason here; did you mean --json?; see plumb effects"),
        (["effects", "--jason=1"], "no option --jason here; did you mean --json?"),
        (
            ["compare", str(SETTINGS), str(MARKS), "--lnie", "5"],
            "there is no option --lnie here; see plumb compare --help",
        ),
        (["resume", str(SETTINGS), "--lnie", "5"], "no option --lnie here; did you mean --line?"),
        (["effects", "--colour"], "there is no option --colour here; see plumb effects --help"),
        (["effects", "more"], "there is no argument more here; see plumb effects --help"),
        (
            ["compare", str(SETTINGS), str(MARKS), "--controller", "holy"],
            "--controller: 'holy' is not known; did you mean holey?; see plumb compare --help",
        ),
        (
            ["compare", str(SETTINGS), str(MARKS), "--controller", "grbl"],
            "'grbl' is not known; give stock, holey, plumb; see plumb compare --help",
        ),
    ],
)
def test_a_wrong_word_is_answered_with_the_nearest_right_one(words, said, run):
    code, out, complaint = run(*words)
    assert code == 2 and out == "" and complaint.count("\n") == 1
    assert said in complaint


@ON_POSIX
def test_an_interrupt_while_the_package_loads_is_quiet(tmp_path):
    (tmp_path / "plumb/cli").mkdir(parents=True)
    (tmp_path / "plumb/__init__.py").write_text("import os, time; os.kill(os.getpid(), 2)\n")
    command = [sys.executable, "-S", str(TOOLS / "core/plumb"), "effects"]
    look_here = {"PYTHONPATH": str(tmp_path)}
    with INTERRUPTIBLE(command, stderr=subprocess.PIPE, env=look_here) as process:
        _, complaint = process.communicate(timeout=60)
    assert (process.returncode, complaint) == (-signal.SIGINT, b"")
    # In the background of a shell a signal that is ignored stays so.
    ignored = f"trap '' INT; exec {sys.executable} -S {TOOLS / 'core/plumb'} --version"
    done = subprocess.run(["bash", "-c", ignored], env=look_here, capture_output=True, text=True)
    assert "No module named 'plumb.cli.start'" in done.stderr


@ON_POSIX
def test_ctrl_c_ends_quietly(tmp_path):
    pipe = tmp_path / "log"
    os.mkfifo(pipe)
    command = [*PLUMB, "settings", str(pipe)]
    with (
        INTERRUPTIBLE(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started,
        open(pipe, "wb"),  # opens when the command reads
    ):
        started.send_signal(signal.SIGINT)
        said, complaint = started.communicate(timeout=60)
    assert (started.returncode, said, complaint) == (INTERRUPTED, b"", b"")


def test_a_closed_pipe_ends_quietly():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run([*COMPARE, "--json"], stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, b"")


def test_a_full_disk_is_an_object_with_json(run, capsys):
    full = ["add", SETTINGS, MARKS, "--effect", "none", "-o", "/dev/full", "--json"]
    code, said, complaint = run(*full)
    assert code == 2 and complaint.count("\n") == 1
    assert json.loads(said) == {"error": complaint.removeprefix("plumb: ").rstrip()}

    def full_disk() -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "results.json")

    assert ended(full_disk, name="plumb", as_json=True) == 2
    said = capsys.readouterr().out
    assert json.loads(said) == {"error": "results.json: No space left on device"}


# What takes longer to load than the help of all commands may take.
HEAVY = ("numpy", "scipy", "matplotlib")


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_its_file_and_its_names(name):
    module = import_module(f"plumb.cli.{name}")
    assert COMMANDS[name][0].islower() and not COMMANDS[name].endswith(".")
    assert module.EXIT.startswith("Exit: 0 ")
    assert len(module.EXAMPLES) == 2
    assert list(inspect.signature(module.add_arguments).parameters) == ["parser"]
    assert list(inspect.signature(module.run).parameters) == ["arguments"]


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_of_the_help_are_understood(name, capsys, here):
    """Each file that they name is there; nothing is run."""
    for file in ("groundcontrol.ini", "machine.toml", "marks.toml", "pocket.nc"):
        (here / file).write_bytes((EXAMPLE / file).read_bytes())
    for file in ("first.toml", "check.toml", "errors.toml"):
        (here / file).write_text("")
    with pytest.raises(SystemExit):
        main.main([name, "--help"])
    shown = capsys.readouterr().out
    assert import_module(f"plumb.cli.{name}").EXIT in " ".join(shown.split())
    for example in import_module(f"plumb.cli.{name}").EXAMPLES:
        assert f"\n  {example}\n" in shown
        words = shlex.split(example)
        assert build_parser().parse_args(words[1:]).command == name


def test_help_lists_the_commands_in_the_order_of_the_table():
    lines = build_parser().format_help().splitlines()
    listed = [line.split()[0] for line in lines if line.startswith("  ") and line[2:3].isalpha()]
    assert listed == [*COMMANDS]
    titles = [line[:-1] for line in lines if line.endswith(":") and not line.startswith("usage")]
    assert titles == [*GROUPS, "options"]


def test_help_of_all_and_refusals_of_commands_load_no_numerics():
    """One after the other in a fresh program: what a command loads, all later commands have too."""
    commands = [(["--help"], 0), (["--version"], 0), (["diagnoze"], 2)]
    program = (
        "import sys\nfrom plumb.cli.main import main\n"
        f"for command, expected in {commands}:\n"
        "    try:\n        code = main(command)\n"
        "    except SystemExit as end:\n        code = end.code\n"
        f"    heavy = [name for name in {HEAVY} if name in sys.modules]\n"
        "    assert (code, heavy) == (expected, []), (command, code, heavy)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_linear_algebra_has_one_thread():
    # On 405 marks `plumb next` took 14 s of CPU on two cores instead of 5.6.
    code = (
        "import os; from plumb.cli.main import main; main(['effects']); "
        "import sys; print(os.environ['OPENBLAS_NUM_THREADS'], file=sys.stderr)"
    )
    environment = {name: value for name, value in os.environ.items() if "_NUM_THREADS" not in name}
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert run.stderr.split() == ["1"]
