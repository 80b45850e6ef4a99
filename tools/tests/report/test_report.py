"""`plumb report`: the page says what the commands say; it loads nothing and runs nothing."""

import json
import re

import numpy as np
import plumb
import pytest
from example_machine import checked
from plumb.cli.main import main
from plumb.diagnosis.answer import odds_words
from plumb.diagnosis.expected_error import expected_error
from plumb.model.plain import plain_size
from plumb.report import maps
from plumb.report.findings import find
from plumb.settings.toml import write_machine_toml
from reports import EXAMPLE, Page, asked, board, nine, reported, spans, strange
from synthetic import BELIEVED, TRUE, grid, marks_on

INI, MARKS = EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml"
LABELS = {
    "cannot_tell": "Cannot tell yet",
    "one_suspect": "One explanation",
    "nothing_provable": "No cause shown",
    "not_in_library": "Not in the library",
    "slip": "A reading to look at",
}


def heavy():
    """Nine marks with the usual sled, and again with half as much more."""
    return [
        mark.__class__(mark.name, mark.target, mark.measured, sled_weight=weight)
        for weight in (97.9, 147.0)
        for mark in nine(sled_weight=weight)
    ]


def slipped(folder):
    """The example with a reading that is wrong by 40 mm."""
    path = folder / "slipped.toml"
    path.write_text(MARKS.read_text().replace("measured = [98, 106]", "measured = [138, 106]"))
    return INI, path


HOSTILE = (
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "$\\frac{$",
    "-->&amp;<b>",
)


def hostile(folder):
    """Nine marks, with names that would be tags or formulas."""
    marks = [
        mark.__class__(HOSTILE[i] if i < len(HOSTILE) else mark.name, mark.target, mark.measured)
        for i, mark in enumerate(nine())
    ]
    return board(folder, marks, name="<img src=x onerror=alert(2)>.toml")


BOARDS = {
    "cannot_tell": lambda folder: (INI, MARKS),
    "one_suspect": lambda folder: (INI, MARKS, *checked()),
    "nothing_provable": lambda folder: (INI, MARKS, "--sigma", "5"),
    "not_in_library": lambda folder: board(folder, strange(), tape_sigma_mm=0.3),
    "slip": slipped,
    "spans": spans,
    "heavy": lambda folder: board(folder, heavy()),
    "nine": lambda folder: board(folder, nine()),
    "hostile": hostile,
}
# Each page costs seconds. The fast run makes those of the most parts.
RARE = {"one_suspect", "nothing_provable", "not_in_library", "nine"}


def each_kind(kinds):
    return [pytest.param(kind, marks=pytest.mark.slow if kind in RARE else ()) for kind in kinds]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The words, the answer and the page of a kind of board, made once."""
    known = {}

    def make(kind):
        if kind not in known:
            folder = tmp_path_factory.mktemp(kind)
            words = BOARDS[kind](folder)
            known[kind] = (words, *reported(*words, folder=folder))
        return known[kind]

    return make


@pytest.mark.parametrize("verdict", each_kind(LABELS))
def test_the_verdict_is_that_of_diagnose(made, verdict):
    words, answer, page = made(verdict)
    said = asked("diagnose", *words)
    assert answer["diagnosis"]["verdict"] == said["verdict"] == verdict
    assert answer["diagnosis"] == {key: said[key] for key in said if key != "next"}
    assert answer["next"] == said["next"]
    text = Page(page.part("verdict")).text
    assert LABELS[verdict] in text and said["sentence"] in text


@pytest.mark.parametrize("kind", each_kind(BOARDS))
def test_a_page_loads_nothing_and_runs_nothing(made, kind):
    page = made(kind)[2]
    assert not re.search(r"https?:|@import", page.source)
    assert not page.named("script") and not page.named("link") and not page.named("iframe")
    for tag, attributes in page.tags:
        assert not [name for name in attributes if name.startswith("on")], tag
        for name in ("src", "href"):
            where = attributes.get(name)
            assert where is None or where.startswith(("#", "data:image/png;base64,")), where
    assert set(re.findall(r"url\(([^)]*)\)", page.source)) <= {
        f"#{each['id']}" for _, each in page.tags if "id" in each
    }
    policy = next(each for each in page.named("meta") if "http-equiv" in each)
    assert policy["content"].startswith("default-src 'none'")


@pytest.mark.parametrize("kind", each_kind(BOARDS))
def test_a_page_is_well_formed(made, kind):
    page = made(kind)[2]
    assert page.source.startswith("<!doctype html>")
    assert not page.crossed and not page.open
    ids = [each["id"] for _, each in page.tags if "id" in each]
    assert len(ids) == len(set(ids))
    targets = {each["href"] for _, each in page.tags if each.get("href", "").startswith("#")}
    assert targets <= {f"#{name}" for name in ids}
    assert all(each.get("aria-label") or each.get("aria-hidden") for each in page.named("svg"))
    assert len(page.source.encode()) < 1_000_000


def test_the_fall_is_that_of_add(made):
    _, answer, page = made("one_suspect")
    said, text = (
        asked("add", INI, MARKS, *checked(), "--effect", "auto"),
        Page(page.part("fall")).text,
    )
    assert answer["addition"].items() <= said.items()
    sizes = [said["raw"]["rms_mm"], said["before"]["fit_rms_mm"]]
    sizes += [step["fit_rms_mm"] for step in said["by_effect"]]
    places = [text.index(f"{size:.2f} mm") for size in sizes]
    assert places == sorted(places) and len(places) == 4
    assert f"checked {said['after']['left_out_rms_mm']:.2f} mm" in text


def test_bars_of_the_fall_are_as_high_as_their_errors(made):
    _, answer, page = made("one_suspect")
    heights = [
        float(each["height"])
        for each in Page(page.part("fall")).named("rect")
        if each.get("class") in ("good", "bad")
    ]
    added = answer["addition"]
    sizes = [added["raw"]["rms_mm"], added["before"]["fit_rms_mm"]]
    sizes += [step["fit_rms_mm"] for step in added["by_effect"]]
    assert heights == pytest.approx(100 * np.array(sizes) / max(sizes), abs=0.01)


def test_settings_are_those_of_add(made):
    words, answer, page = made("cannot_tell")
    said = asked("add", *words, "--effect", "auto")
    part = Page(page.part("settings"))
    assert answer["addition"]["parameters"] == said["parameters"]
    for each in said["parameters"]:
        size = plain_size(each["name"], each["value"], each["low"], each["high"])
        assert size in part.text and each["name"] in part.text
        assert f"{each['value']:.6g} {each['unit']} ({each['low']:.6g}" in part.text
    assert "most likely explanation" in part.text


def test_a_slip_changes_no_setting(made):
    _, answer, page = made("slip")
    assert answer["addition"] is None and answer["expected"] is None
    assert "Nothing was fitted" in Page(page.part("settings")).text
    slip = answer["diagnosis"]["slips"][0]
    assert slip["sentence"][1:] in Page(page.part("slips")).text
    assert "suspects" not in [each.get("id") for _, each in page.tags]
    assert "(look again)" in Page(page.part("readings")).text
    fall_text = Page(page.part("fall")).text
    assert f"Frame fitted without {slip['name']}" in fall_text
    assert fall_text.count("not fitted") == 1


def test_a_slip_does_not_count(made):
    _, answer, page = made("slip")
    as_set = re.search(r"As set: ([\d.]+) mm", Page(page.part("maps")).text)
    assert float(as_set[1]) < answer["comparison"]["rms_mm"] - 2


def test_cards_say_what_diagnose_says(made):
    _, answer, page = made("cannot_tell")
    text = Page(page.part("suspects")).text
    ranking = {each["effect"]: each for each in answer["diagnosis"]["ranking"]}
    for name in answer["diagnosis"]["suspects"]:
        card = text[text.index(f" {name} ") :]
        share, after = ranking[name]["hidden_share"], ranking[name]["rms_after_mm"]
        assert f"Taken up by other numbers of the motors {100 * share:.0f} %" in card
        assert f"Alone, the error falls to {after:.2f} mm" in card
    sizes = {}
    for explanation in answer["diagnosis"]["explanations"]:
        for each in explanation["parameters"]:
            sizes.setdefault(f"{each['effect']}.{each['name']}", each)
    for name, each in sizes.items():
        assert plain_size(name, each["value"], each["low"], each["high"]) in text
    table = text[text.index("odds against all others") :]
    for each in answer["diagnosis"]["explanations"]:
        left, noise = (f"{each[key]:.2f} mm" for key in ("rms_after_mm", "noise_rms_mm"))
        assert f"{odds_words(each['share'])} {left} {noise}" in table


def test_what_could_hide_is_in_the_order_of_its_size(made):
    _, answer, page = made("cannot_tell")
    part = Page(page.part("unseen")).text
    suspects = answer["diagnosis"]["suspects"]
    sizes = [
        each["mm"]
        for each in answer["diagnosis"]["could_hide"]
        if each["mm"] and each["effect"] not in suspects
    ]
    shown = [float(size) for size in re.findall(r"(\d+\.\d) mm", part)]
    assert shown == pytest.approx(sorted(sizes, reverse=True)[: len(shown)], abs=0.051)
    assert len(shown) == min(10, len(sizes)) > 5


def test_the_readings_are_those_of_compare(made):
    words, answer, page = made("cannot_tell")
    compared = asked("compare", *words)
    assert answer["comparison"] == compared
    rows = re.findall(r"<tr>(<th scope=\"row\">.*?)</tr>", page.part("readings"))
    assert len(rows) == len(compared["marks"]) == len(answer["left_by_frame"])
    for row, mark, left in zip(rows, compared["marks"], answer["left_by_frame"], strict=True):
        cells = re.findall(r">([^<]+)<", row)
        assert cells[0] == mark["name"] == left["name"]
        error, shown = mark["error"], [float(cell) for cell in cells[1:]]
        # Typed from the top left corner, so y counts down.
        assert shown[4:6] == pytest.approx([error[0], -error[1]], abs=0.0051)
        chains = [np.hypot(*left["error"]), left["left_chain"], left["right_chain"]]
        assert shown[6:9] == pytest.approx(chains, abs=0.0051)


def test_what_is_left_of_the_marks_is_what_the_fit_leaves(made):
    answer = made("cannot_tell")[1]
    for view, rms in (
        (answer["left_by_frame"], answer["diagnosis"]["rms_mm"]),
        (answer["left_by_fit"], answer["diagnosis"]["explanations"][0]["rms_after_mm"]),
    ):
        errors = np.array([each["error"] for each in view])
        assert np.sqrt(np.mean(np.sum(errors**2, axis=1))) == pytest.approx(rms, rel=1e-6)


@pytest.fixture(scope="module")
def drawn(made):
    """A page made once more: the look and the scale of each arrow map, and the page."""
    words, maps_drawn = made("nine")[0], []
    arrow_figure = maps.arrow_figure

    def record(panel, scale, look, **how):
        maps_drawn.append((look, scale))
        return arrow_figure(panel, scale, look, **how)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(maps, "arrow_figure", record)
        _, page = reported(*words, folder=words[0].parent)
    return maps_drawn, page


def test_both_maps_have_a_single_scale(drawn):
    maps_drawn, page = drawn
    first, second = [scale for look, scale in maps_drawn if look is maps.LARGE]
    assert first is second
    said = re.findall(r"arrows ([\d.]+) times life size", page.part("maps"))
    assert said == [f"{first.factor:g}"] * 2
    assert f"{first.factor:g} times life size in both maps" in Page(page.part("maps")).text


def test_the_same_files_give_the_same_bytes(made, drawn):
    assert drawn[1].source == made("nine")[2].source


def test_rivals_make_the_error_to_expect_larger_by_their_shares():
    findings = find(plumb.read(INI, MARKS))
    alone = expected_error(findings.used)
    shares = [together.share for together in findings.diagnosis.explanations]
    rivals = [*zip(findings.diagnosis.fits, shares, strict=True)][1:]
    whole = expected_error(findings.used, rivals)
    assert findings.expected.rms == pytest.approx(whole.rms) and 0 < rivals[0][1] < 0.5
    assert findings.expected.rms > 1.05 * alone.rms


def test_distances_alone_have_no_maps_and_no_chains(made):
    _, answer, page = made("spans")
    parts = [each.get("id") for _, each in page.tags]
    assert "fall" in parts and "settings" in parts
    assert not {"maps", "chains", "covariates"} & {*parts}
    assert answer["left_by_frame"] == [] and answer["covariates"] == []
    text = Page(page.part("readings")).text
    farthest = max(answer["comparison"]["distances"], key=lambda each: abs(each["error"]))
    assert f"{farthest['error']:+.2f}" in text and "6 more readings" in text


def test_a_heavier_sled_pulls_harder_at_the_same_mark(made):
    tension = next(each for each in made("heavy")[1]["covariates"] if each["name"] == "tension")
    light_half, heavy_half = np.array(tension["left"][:9]), np.array(tension["left"][9:])
    assert np.all(heavy_half > 1.3 * light_half)


def test_the_left_chain_is_the_shorter_one_left_of_the_middle(made):
    answer = made("heavy")[1]
    length = next(each for each in answer["covariates"] if each["name"] == "length")
    across = np.array([mark["target"][0] for mark in answer["comparison"]["marks"]])
    longer = np.array(length["left"]) - np.array(length["right"])
    assert np.all(np.sign(longer[across != 0]) == np.sign(across[across != 0]))


def test_names_from_files_are_words_and_no_more(made):
    page = made("hostile")[2]
    assert not page.named("img")
    assert all(set(each) <= {"class"} for each in page.named("b"))
    for name in HOSTILE:
        assert name in page.text
    assert "<img src=x onerror=alert(2)>.toml" in page.text


def test_lengths_are_in_the_unit_that_was_asked_for(made, tmp_path):
    words = made("hostile")[0]
    path = tmp_path / "inch.html"
    assert main(["report", *map(str, words), "--units", "inch", "-o", str(path)]) == 0
    page = Page(path.read_text())
    assert not page.crossed and all(name in page.text for name in HOSTILE)
    rms = asked("compare", *words)["rms_mm"]
    assert f"{rms / 25.4:.3f} inch" in Page(page.part("verdict")).text
    for name in ("fall", "maps", "chains", "covariates", "readings"):
        text = Page(page.part(name)).text
        assert "inch" in text and not re.search(r"\bmm\b", text), name
    assert "--units inch" in page.text


def test_a_covariate_that_says_nothing_is_named_instead(made):
    text = Page(made("cannot_tell")[2].part("covariates")).text
    assert "Not drawn: side of the approach: the same for all marks." in text
    assert "Left chain, tension" in text and "Right chain, order in the file" in text


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ((INI, MARKS, "-o", "report.txt"), "-o report.txt: end the name with .html, .htm"),
        ((INI, "none.toml", "-o", "r.html"), "none.toml: there is no such file"),
        ((INI, INI, "-o", "r.html"), "groundcontrol.ini"),
        ((INI, MARKS, "--without", "99", "-o", "r.html"), "--without"),
        ((INI, MARKS, "-o", "no/such/r.html"), "cannot be written"),
        ((INI, "own.html", "-o", "own.html"), "own.html"),
        ((INI, MARKS, "-o", "own.html"), "own.html: exists, and plumb did not write it"),
        ((INI, MARKS), "-o/--output"),
    ],
)
def test_what_cannot_be_used_is_refused_and_nothing_written(
    tmp_path, monkeypatch, capsys, words, complaint
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.html").write_text("mine")
    assert main(["report", *map(str, words)]) == 2
    said = capsys.readouterr()
    assert complaint in said.err and said.err.count("\n") == 1 and not said.out
    assert [path.name for path in tmp_path.iterdir()] == ["own.html"]
    assert (tmp_path / "own.html").read_text() == "mine"


def test_a_page_that_plumb_wrote_may_be_replaced(made, tmp_path, capsys):
    words, _, page = made("cannot_tell")
    path = tmp_path / "r.html"
    path.write_text(page.source)
    assert main(["report", *map(str, words), "-o", str(path)]) == 0
    # A long name stands on the next line.
    assert f"Written: {path}" in " ".join(capsys.readouterr().out.split())


@pytest.mark.slow
def test_four_hundred_marks_make_a_page_too(tmp_path):
    marks = marks_on(TRUE, BELIEVED, grid(27, 15), noise=0.5)
    answer, page = reported(*board(tmp_path, marks, tape_sigma_mm=0.5), folder=tmp_path)
    assert len(answer["left_by_frame"]) == 405
    assert len(page.source.encode()) < 3_000_000
    assert "345 more readings" in Page(page.part("readings")).text
    assert json.dumps(answer)


def test_settings_that_are_right_need_nothing(tmp_path):
    write_machine_toml(tmp_path / "machine.toml", TRUE)
    marks = board(tmp_path, marks_on(TRUE, TRUE, grid(3, 3), noise=0.3), settings=TRUE)
    answer, page = reported(*marks, folder=tmp_path)
    assert answer["diagnosis"]["verdict"] == "nothing_provable"
    assert "nothing to change: cut your jobs" in Page(page.part("verdict")).text
    assert not page.source.count('class="card"')
