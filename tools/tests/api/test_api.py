"""The lab in Python: the notebook runs, and says what the commands say."""

import json
import subprocess
import sys
from pathlib import Path

import plumb
import pytest
from asked_again import tried_less  # noqa: F401
from example_machine import checked
from plumb.settings import read_settings

TOOLS = Path(__file__).resolve().parents[2]
DOCS = TOOLS.parent / "docs"
INI, MARKS = DOCS / "example/groundcontrol.ini", DOCS / "example/marks.toml"


def cells():
    """The code of the notebook, cell by cell."""
    notebook = json.loads((DOCS / "lab.ipynb").read_text(encoding="utf-8"))
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]


def test_the_notebook_runs_and_its_answers_are_those_of_the_commands(monkeypatch, ask):
    monkeypatch.chdir(DOCS)
    names, answers = {}, []
    for code in cells():
        *statements, last = code.split("\n")
        exec("\n".join(statements), names)
        answers.append(eval(last, names))
    readings, compared, verdict, proposal, settled, fall = answers
    assert readings == 23
    code, said = ask("compare", INI, MARKS)
    assert compared == (round(said["rms_mm"], 2), round(said["worst_mm"], 2))
    _, said = ask("diagnose", INI, MARKS)
    assert verdict == (said["verdict"], tuple(said["suspects"]))
    assert proposal == (said["next"][0]["title"], said["next"][0]["minutes"])
    _, said = ask("diagnose", INI, MARKS, *checked())
    assert settled == (said["verdict"], tuple(said["suspects"])) and "chain_pitch" in settled[1]
    _, said = ask("add", INI, MARKS, "--effect", *settled[1], *checked("motor_gap", "motor_height"))
    after = said["after"]
    left = after["fit_rms_mm"], after["left_out_rms_mm"]
    assert fall == tuple(round(each, 2) for each in (said["raw"]["rms_mm"], *left))


def test_the_written_machine_is_the_fitted_one(tmp_path):
    addition = plumb.add(plumb.read(INI, MARKS), ["chain_pitch"])
    machine = read_settings(plumb.write(addition, tmp_path / "machine.toml"))
    assert machine.effects["chain_pitch"] == pytest.approx(addition.settings.effects["chain_pitch"])


def test_options_are_those_of_the_commands():
    inputs = plumb.read(INI, MARKS, cut_with=INI, sigma=0.4, priors={"motor_gap": 0.0})
    assert inputs.sigma == 0.4 and inputs.priors["motor_gap"] == 0.0
    assert inputs.cut_with is not None
    assert plumb.decide(inputs).diagnosis.noise.sigma == pytest.approx(0.4)
    with pytest.raises(plumb.InputError, match="there is no such file"):
        plumb.read("none.ini", MARKS)


def test_the_package_loads_its_functions_when_they_are_used():
    program = (
        "import sys, plumb\n"
        "before = 'numpy' in sys.modules\n"
        "plumb.read\n"
        "print(before, 'numpy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout == "False True\n", done.stderr


@pytest.mark.slow
def test_a_type_checker_knows_the_functions(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import plumb\n"
        'inputs = plumb.read("groundcontrol.ini", "marks.toml")\n'
        "rms: float = plumb.compare(inputs).rms\n"
        "verdict: str = plumb.diagnose(inputs).verdict\n"
        "best = plumb.next(inputs).proposals[0].option.title.upper()\n"
        'plumb.add(inputs, ["chain_pitch"]).settings\n'
        "wrong: int = plumb.compare(inputs).rms\n"
        "plumb.raed\n"
    )
    options = ["--cache-dir", DOCS.parent / ".build/mypy", "--no-pretty"]
    options += ["--config-file", DOCS.parent / "pyproject.toml"]
    command = [sys.executable, "-m", "mypy", *options, "--no-pretty", program]
    done = subprocess.run(command, cwd=TOOLS, capture_output=True, text=True)
    errors = [line.split(":")[1] for line in done.stdout.splitlines() if ": error: " in line]
    assert errors == ["7", "8"], done.stdout + done.stderr
