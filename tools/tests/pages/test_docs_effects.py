"""The page of all effects is complete, and its numbers are those published elsewhere."""

import re

import pytest
import write
from effects_page import PAGE, Showing, cosine, pages
from plumb.fit.observations import rms
from plumb.model.catalogue import every_effect

BOTH = {"chain_pitch.left": 0.001, "chain_pitch.right": 0.001}
SAG = {"chain_sag.weight_ratio_squared": 8.2e-12}
STRETCH = {"chain_stretch.compliance": 5.2e-6}
TAPE = {"tape_scale.strain": 0.001}


def test_every_effect_has_a_section_a_picture_and_a_remedy():
    page = pages()[PAGE]
    for effect in every_effect():
        name = effect["name"]
        text = re.search(rf"^## {name}\n(.*?)(?=^## |\Z)", page, re.DOTALL | re.MULTILINE)[1]
        said = [effect[word] for word in ("summary", "pattern", "remedy")]
        for parameter in effect["parameters"]:
            number = parameter["setting"]
            said += [f"`{parameter['name']}`", *([] if number is None else [f"${number}"])]
        missing = [each for each in [*said, f"(pictures/effects/{name}.png)"] if each not in text]
        assert missing == [] and all(said), name
        assert ("no firmware can cure this" in text) == (effect["where"] == "lab"), name
        assert len(re.findall(r"`\w+` -?\d\.\d\d", text)) == 3 or "it has no shape" in text, name


def shape_cosine(cause: dict, other: dict) -> float:
    return cosine(*(Showing("", parameters).field.shape for parameters in (cause, other)))


# Published cosines of shapes, 13 x 7 marks on the same machine, computed independently.
@pytest.mark.parametrize(
    ("cause", "other", "published"),
    [
        ({"motor_gap": 1.0}, {"rotation_radius": 1.0}, -0.99),
        ({"motor_gap": 1.0}, STRETCH, -0.88),
        ({"rotation_radius": 1.0}, STRETCH, 0.91),
        ({"frame_flex.inward": 0.007}, STRETCH, 0.97),
        ({"frame_flex.downward": 0.02}, BOTH, -0.91),
        ({"frame_flex.downward": 0.02}, TAPE, -0.74),
        (BOTH, TAPE, 0.73),
        (BOTH, SAG, -0.60),
        (SAG, TAPE, -0.67),
        (SAG, STRETCH, 0.0),
        ({"chain_pitch.left": 0.001}, {"chain_pitch.right": 0.001}, 0.60),
    ],
)
def test_cosines_are_those_published(cause, other, published):
    assert shape_cosine(cause, other) == pytest.approx(published, abs=0.05)


def test_sizes_are_those_published():
    gap, radius = (Showing("", {name: 1.0}).field for name in ("motor_gap", "rotation_radius"))
    assert (rms(gap.raw), rms(gap.shape)) == pytest.approx((0.72, 0.39), abs=0.02)
    assert (rms(radius.raw), rms(radius.shape)) == pytest.approx((1.75, 0.61), abs=0.04)


TEXTS, PICTURE = {"docs/a.md": "# A\n"}, "docs/pictures/a/one.png"


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Writes a page and its picture below a folder; gives the exit code."""
    monkeypatch.setattr(write, "PAGES", (lambda: TEXTS,))
    monkeypatch.setattr(write.effects_page, "pictures", lambda: {PICTURE: b"drawn"})
    return lambda *options: write.main([*options, "--folder", str(tmp_path)])


def test_a_changed_or_missing_page_is_reported(written, tmp_path, capsys):
    assert written() == written("--check") == 0
    assert capsys.readouterr().out == "" and (tmp_path / PICTURE).read_bytes() == b"drawn"
    for change in (lambda path: path.write_text("other"), lambda path: path.unlink()):
        change(tmp_path / "docs/a.md")
        assert written("--check") == 1
        assert capsys.readouterr().out.startswith("docs/a.md: stale; run ")
        assert written() == written("--check") == 0


def test_a_folder_that_cannot_be_written_is_refused(written, tmp_path, capsys):
    (tmp_path / "docs").write_text("a file")
    assert written() == 2
    assert capsys.readouterr().err.startswith("write.py: ")
