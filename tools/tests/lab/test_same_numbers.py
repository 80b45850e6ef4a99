"""Terminal, report and page state the same numbers of the same marks, to the digits shown."""

import io
import json
import re
from contextlib import redirect_stdout

from folder import asked, choose, finished
from plumb.cli.main import main
from plumb.marks.form import marks_toml
from plumb.marks.read import Measurements
from plumb.model.plain import plain_size
from plumb.settings.toml import write_machine_toml
from plumb.text.values import MM
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

LENGTH = r"([\d.]+) mm"


def hidden(folder):
    """Effects that the settings miss, with marks and distances, and no word of the noise."""
    write_machine_toml(folder / "machine.toml", BELIEVED)
    marks = marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3)
    spans = distances_between(marks).distances[:12]
    (folder / "marks.toml").write_text(marks_toml(Measurements(marks, spans)))
    return "machine.toml", "marks.toml"


def terminal(*words):
    """The text of a command, its lines joined, and its JSON."""
    said = []
    for more in ([], ["--json"]):
        out = io.StringIO()
        with redirect_stdout(out):
            main([*words, *more])
        said.append(out.getvalue())
    return " ".join(said[0].split()), json.loads(said[1])


def match_in(pattern, words):
    match = re.search(pattern, words)
    assert match, (pattern, words)
    return match[1]


def row(title, words):
    """The numbers of a row of `plumb add`'s table of errors."""
    return re.findall(r"\d+\.\d+", match_in(rf"{re.escape(title)}((?: +(?:[\d.]+|-))+)", words))


def test_terminal_report_and_page_state_the_same_numbers(tmp_path):
    files = hidden(tmp_path)
    words = [str(tmp_path / name) for name in files]
    compare, compared = terminal("compare", *words, "--details")
    _, diagnosed = terminal("diagnose", *words)
    add, added = terminal("add", *words, "--effect", "auto", "--details")
    terminal("report", *words, "-o", str(tmp_path / "r.html"), "--force")
    saved = re.search(r'id="answers">(.*?)</script>', (tmp_path / "r.html").read_text("utf-8"))[1]
    client = asked(tmp_path)
    choose(client, settings=files[0], marks=[files[1]])
    verdict, correction = (finished(client, name)[name] for name in ("verdict", "correction"))
    choice = {"effects": added["effects_added"]}
    bench = client.post("/api/bench/fit", json=choice).json()
    climbed = client.post("/api/bench/stairs", json=choice).json()
    stairs = [climbed["before"], *climbed["by_effect"]]
    as_set = client.get("/api/bench").json()["as_set"]
    fallen = [as_set["fit_rms"], *(step["fit_rms_mm"] for step in stairs)]

    report = json.loads(saved)
    assert (report["verdict"]["verdict"], report["correction"]) == (verdict, correction)

    first, raw = diagnosed["explanations"][0], row("raw: the settings as they are", add)
    assert {*first["effects"]} == {*added["effects_added"]}
    card, after = verdict["cards"][0]["account"], added["after"]
    headline = re.findall(r"[\d.]+\d", correction["said"])[-3:]
    states = verdict["states"]
    page = [[states[i]["fit_rms"], fallen[i]] for i in (0, 1, -1)]
    noise = states[-1]["noise_rms"], stairs[-1]["noise_rms_mm"], bench["noise_rms"]
    fitted = correction["whole"]["fit_rms"], bench["fit_rms"]
    for lengths in (
        [match_in(rf"The marks lie {LENGTH} RMS", compare), compared["rms_mm"], *page[0], raw[0]],
        [added["raw"]["rms_mm"], correction["as_set"]["fit_rms"], headline[0], raw[0]],
        [match_in(rf"The worst is mark \S+ {LENGTH}", compare), compared["worst_mm"], raw[1]],
        [match_in(rf"whole sheet would leave {LENGTH}", compare), compared["shape_rms_mm"], raw[2]],
        [match_in(rf"The distances are {LENGTH} RMS", compare), compared["distance_rms_mm"]],
        [diagnosed["rms_mm"], added["before"]["fit_rms_mm"], *page[1]],
        [row("fitted: the frame", add)[0], *page[1]],
        [first["noise_rms_mm"], card["noise_rms_mm"], after["noise_rms_mm"], *noise],
        [first["rms_after_mm"], card["rms_after_mm"], *fitted, *page[2]],
        [after["fit_rms_mm"], headline[1], *page[2]],
        [after["left_out_rms_mm"], bench["left_out_rms"], headline[2]],
        [diagnosed["sigma_mm"], added["sigma_mm"], match_in(LENGTH, correction["intervals"])],
    ):
        shown = [each if isinstance(each, str) else f"{each:.2f}" for each in lengths]
        assert len({*shown}) == 1, shown
    assert correction["said"] in add and correction["intervals"] in add
    numbers = {each["name"]: each["after"] for each in correction["numbers"]}
    for each in added["parameters"]:
        size = plain_size(each["name"], each["value"], each["low"], each["high"], unit=MM)
        # In the terminal's table a long line goes on below.
        assert all(number in add for number in re.findall(r"[\d.]+\d", size))
        assert numbers.get(each["name"], "").lstrip("-") in size
        assert bench["sizes"].get(each["name"], {"said": size})["said"] == size
