"""The lab in Python: the notebook runs, and says what the commands say."""

import json
from pathlib import Path

import pytest
from plumb import api
from plumb.settings.files import read_settings
from plumb.text.errors import InputError

DOCS = Path(__file__).resolve().parents[3] / "docs"
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
    readings, compared, verdict, proposal, proved, fall = answers
    assert readings == 23
    code, said = ask("compare", INI, MARKS)
    assert compared == (round(said["rms_mm"], 2), round(said["worst_mm"], 2))
    _, said = ask("diagnose", INI, MARKS)
    assert verdict == (said["verdict"], tuple(said["suspects"]))
    assert proposal == (said["next"][0]["title"], said["next"][0]["minutes"])
    _, said = ask("diagnose", INI, MARKS, "--checked", "tape_scale.strain=0+-0.0001")
    assert proved == (said["verdict"], tuple(said["suspects"])) and "chain_pitch" in proved[1]
    _, said = ask("add", INI, MARKS, "--effect", *proved[1])
    after = said["after"]
    assert fall == (
        round(said["raw"]["rms_mm"], 2),
        round(after["fit_rms_mm"], 2),
        round(after["left_out_rms_mm"], 2),
    )


def test_what_is_written_is_the_machine_that_was_fitted(tmp_path):
    addition = api.add(api.read(INI, MARKS), ["chain_pitch"])
    machine = read_settings(api.write(addition, tmp_path / "machine.toml"))
    assert machine.effects["chain_pitch"] == pytest.approx(addition.settings.effects["chain_pitch"])


def test_options_are_those_of_the_commands():
    inputs = api.read(INI, MARKS, cut_with=INI, sigma=0.4, priors={"motor_gap": 0.0})
    assert inputs.sigma == 0.4 and inputs.priors["motor_gap"] == 0.0
    assert inputs.cut_with is not None
    assert api.auto(inputs).diagnosis.noise.sigma == pytest.approx(0.4)
    with pytest.raises(InputError, match="there is no such file"):
        api.read("none.ini", MARKS)
