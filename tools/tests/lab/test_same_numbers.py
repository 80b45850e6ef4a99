"""Terminal, report and page state the same numbers of the same marks, to the digits shown."""

import io
import json
import re
import shutil
from contextlib import redirect_stdout

import pytest
from folder import EXAMPLE, asked, choose, finished
from plumb.cli.main import main
from plumb.model.plain import noun_of, plain_size
from plumb.settings.toml import write_machine_toml
from plumb.text.values import MM
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

LENGTH = r"([\d.]+) mm"


def example(folder):
    """The example's files."""
    for name in ("groundcontrol.ini", "marks.toml"):
        shutil.copy(EXAMPLE / name, folder)
    return "groundcontrol.ini", "marks.toml"


def hidden(folder):
    """Effects that the settings miss, with marks and distances, and no word of the noise."""
    write_machine_toml(folder / "machine.toml", BELIEVED)
    marks = marks_on(TRUE, BELIEVED, grid(3, 3), noise=0.3)
    lines = ['frame = "machine"']
    for mark in marks:
        lines += ["[[mark]]", f'name = "{mark.name}"', f"target = {[*map(float, mark.target)]}"]
        lines.append(f"measured = {[round(float(x), 3) for x in mark.measured]}")
    for each in distances_between(marks).distances[:12]:
        lines += ["[[distance]]", f"between = {json.dumps(each.between)}"]
        lines.append(f"mm = {each.length + 0.4:.2f}")
    (folder / "marks.toml").write_text("\n".join(lines) + "\n")
    return "machine.toml", "marks.toml"


class Said:
    """The numbers of terminal, report and page for a board."""

    def __init__(self, folder, files):
        words = [str(folder / name) for name in files]
        self.compare, self.compared = terminal("compare", *words, "--details")
        self.diagnose, self.diagnosed = terminal("diagnose", *words, "--details")
        self.add, self.added = terminal("add", *words, "--effect", "auto", "--details")
        terminal("report", *words, "-o", str(folder / "r.html"), "--force")
        saved = re.search(r'id="answers">(.*?)</script>', (folder / "r.html").read_text("utf-8"))
        self.saved = json.loads(saved[1])
        client = asked(folder)
        choose(client, settings=files[0], marks=[files[1]])
        self.verdict, self.correction = (
            finished(client, name)[name] for name in ("verdict", "correction")
        )
        choice = {"effects": self.added["effects_added"]}
        self.bench = client.post("/api/bench/fit", json=choice).json()
        self.stairs = client.post("/api/bench/stairs", json=choice).json()["stairs"]


def terminal(*words):
    """The text of a command, its lines joined, and its JSON."""
    said = []
    for more in ([], ["--json"]):
        out = io.StringIO()
        with redirect_stdout(out):
            main([*words, *more])
        said.append(out.getvalue())
    return " ".join(said[0].split()), json.loads(said[1])


@pytest.fixture(scope="module", params=[example, hidden], ids=["example", "hidden"])
def said(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("board")
    return Said(folder, request.param(folder))


def assert_same(*lengths):
    """All lengths, as written or as they are [mm], are the same to two decimals."""
    shown = [each if isinstance(each, str) else f"{each:.2f}" for each in lengths]
    assert len({*shown}) == 1, shown


def match_in(pattern, words):
    match = re.search(pattern, words)
    assert match, (pattern, words)
    return match[1]


def row(title, words):
    """The numbers of a row of `plumb add`'s table of errors."""
    return re.findall(r"\d+\.\d+", match_in(rf"{re.escape(title)}((?: +(?:[\d.]+|-))+)", words))


def test_the_error_as_set_is_the_same(said):
    assert_same(
        match_in(rf"The marks lie {LENGTH} RMS", said.compare),
        said.compared["rms_mm"],
        said.added["raw"]["rms_mm"],
        row("raw: the settings as they are", said.add)[0],
        said.verdict["states"][0]["fit_rms"],
        said.correction["as_set"]["fit_rms"],
        said.stairs[0]["fit_rms"],
    )


def test_worst_error_and_shape_are_the_same(said):
    raw = row("raw: the settings as they are", said.add)
    worst, shape = said.compared["worst_mm"], said.compared["shape_rms_mm"]
    assert_same(match_in(rf"The worst is mark \S+ {LENGTH}", said.compare), worst, raw[1])
    assert_same(
        match_in(rf"Moving the whole sheet would leave {LENGTH}", said.compare), shape, raw[2]
    )


def test_distances_have_a_number_by_themselves(said):
    rms = said.compared["distance_rms_mm"]
    if rms is None:
        assert "distances" not in said.compare
    else:
        assert_same(rms, match_in(rf"The distances are {LENGTH} RMS off", said.compare))
        assert rms != pytest.approx(said.compared["rms_mm"], abs=0.1)


def test_error_of_the_fitted_frame_is_the_same(said):
    assert_same(
        said.diagnosed["rms_mm"],
        said.added["before"]["fit_rms_mm"],
        row("fitted: the frame", said.add)[0],
        said.stairs[1]["fit_rms"],
        said.verdict["states"][1]["fit_rms"],
    )


def test_the_report_holds_what_the_page_shows(said):
    assert said.saved["verdict"]["verdict"] == said.verdict
    # Where the terminal names a command, the page names a screen.
    held, shown = ({**each, "reasons": ""} for each in (said.saved["correction"], said.correction))
    assert held == shown


def test_what_noise_alone_leaves_is_the_same(said):
    together, card = chosen(said)
    assert_same(
        together["noise_rms_mm"],
        card["account"]["noise_rms_mm"],
        said.added["after"]["noise_rms_mm"],
        row(f"fitted: + {noun_of(said.added['effects_added'][-1])}", said.add)[1],
        said.verdict["states"][-1]["noise_rms"],
    )
    named = said.added["after"]["noise_rms_mm"]
    assert_same(named, said.bench["noise_rms"], said.stairs[-1]["noise_rms"])
    assert_same(said.diagnosed["noise_rms_mm"], said.added["before"]["noise_rms_mm"])


def chosen(said):
    """The explanation that is added, and its card on the page."""
    added = {*said.added["effects_added"]}
    both = zip(said.diagnosed["explanations"], said.verdict["cards"], strict=True)
    return next(each for each in both if {*each[0]["effects"]} == added)


def test_error_of_what_is_added_is_the_same(said):
    together, card = chosen(said)
    assert_same(
        together["rms_after_mm"],
        card["account"]["rms_after_mm"],
        said.added["after"]["fit_rms_mm"],
        said.verdict["states"][-1]["fit_rms"],
        said.correction["whole"]["fit_rms"],
    )
    named = said.added["after"]["fit_rms_mm"]
    assert_same(named, said.bench["fit_rms"], said.stairs[-1]["fit_rms"])


def test_the_decision_reads_the_same_everywhere(said):
    headline = said.added["auto"]["headline"]
    assert headline in said.add and said.correction["said"] == headline
    numbers = re.findall(r"[\d.]+\d", headline)
    after = said.added["after"]
    assert_same(numbers[-3], said.added["raw"]["rms_mm"])
    assert_same(numbers[-2], after["fit_rms_mm"])
    assert_same(numbers[-1], after["left_out_rms_mm"], said.bench["left_out_rms"])


def test_sizes_and_their_noise_are_those_of_the_fit(said):
    noise = said.correction["intervals"]
    assert noise in said.add
    assert_same(match_in(LENGTH, noise), said.added["sigma_mm"])
    numbers = {each["name"]: each for each in said.correction["numbers"]}
    for each in said.added["parameters"]:
        size = plain_size(each["name"], each["value"], each["low"], each["high"], unit=MM)
        # In the terminal's table a long line goes on below.
        assert all(number in said.add for number in re.findall(r"[\d.]+\d", size))
        if each["name"] in numbers:
            assert numbers[each["name"]]["after"].lstrip("-") in size


def test_sizes_on_the_bench_are_those_of_the_effects_that_are_named(said):
    for each in said.added["parameters"]:
        if each["name"] in said.bench["sizes"]:
            size = plain_size(each["name"], each["value"], each["low"], each["high"], unit=MM)
            assert said.bench["sizes"][each["name"]]["said"] == size


def test_a_diagnosis_and_a_fit_have_the_same_noise_and_say_where_it_is_from(said):
    assert_same(said.diagnosed["sigma_mm"], said.added["sigma_mm"])
    assert said.diagnosed["sigma_from"] == "marks"
    for words in (said.verdict["noise"], said.correction["intervals"]):
        assert "(from the scatter of the marks)" in words
