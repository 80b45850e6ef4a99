"""The page and pictures of all effects: complete, and repeatable."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from effects_page import PAGE, pages, picture_name
from fields import LONGEST, SCALE, Picture, drawing, factor_for
from plumb.model.catalogue import every_effect

TEXTS = pages()
EFFECTS = {element["name"]: element for element in every_effect()}
SVG = "{http://www.w3.org/2000/svg}"


def section_of(name: str) -> str:
    return re.search(rf"^## {name}\n(.*?)(?=^## |\Z)", TEXTS[PAGE], re.DOTALL | re.MULTILINE)[1]


@pytest.mark.parametrize("name", EFFECTS)
def test_every_effect_has_a_section_a_picture_and_a_remedy(name):
    effect, text = EFFECTS[name], section_of(name)
    for word in ("summary", "pattern", "remedy"):
        assert effect[word] in text
    assert f"(pictures/effects/{name}.svg)" in text and picture_name(name) in TEXTS
    for parameter in effect["parameters"]:
        assert f"`{parameter['name']}`" in text
        assert parameter["setting"] is None or f"${parameter['setting']}" in text
    assert ("no firmware can cure this" in text) == (effect["where"] == "lab")
    assert len(re.findall(r"`\w+` -?\d\.\d\d", text)) == 3 or "it has no shape" in text


@pytest.mark.parametrize("name", EFFECTS)
def test_every_picture_is_an_svg_that_states_its_scale(name):
    root = ElementTree.fromstring(TEXTS[picture_name(name)])
    assert root.tag == f"{SVG}svg" and name in root.find(f"{SVG}title").text
    said = [element.text for element in root.iter(f"{SVG}text")]
    sheets = len(list(root.iter(f"{SVG}rect"))) - 1
    scales = [line for line in said if re.search(r"mm; arrows \d+ times life size", line)]
    assert sheets == 2 * sum("as it is" in line for line in said)
    assert len(scales) + sum("no shape" in line for line in said) == sheets
    # Positions to a tenth of a pixel, so that the last bits of a sum never show.
    assert not re.search(r"\d\.\d\d", "".join(element.get("d", "") for element in root.iter()))


def test_arrows_point_where_the_marks_went():
    sent = np.zeros((1, 1, 2))
    for error, sign in (((0.0, 1.0), -1), ((0.0, -1.0), 1)):
        errors = np.array(error).reshape(1, 1, 2)
        text = drawing("t", [("one", [Picture("h", sent, errors)])], sheet=(2438.4, 1219.2))
        start, end = re.search(r'd="M\S+ (\S+?)L\S+ (\S+?)" fill="none" stroke="#c0', text).groups()
        # Paper counts downwards: up is less.
        assert np.sign(float(end) - float(start)) == sign
        assert SCALE * factor_for(errors) <= LONGEST
