"""Commands: each has its file; wrong words, interrupts, closed pipes and full disks."""

import errno
import functools
import inspect
import json
import os
import shlex
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from example_machine import EXAMPLE
from plumb.cli import main
from plumb.cli.main import COMMANDS, GROUPS, build_parser
from plumb.cli.output import INTERRUPTED, ended
from published_marks import MARKS, SETTINGS
from systems import ON_POSIX

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
        (["bench", "--kinds"], "expected at least one argument; see plumb bench --help"),
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
