"""The page of all effects is complete."""

import re

import pytest
from effects_page import PAGE, pages
from plumb.model.catalogue import every_effect

TEXTS = pages()
EFFECTS = {element["name"]: element for element in every_effect()}


def section_of(name: str) -> str:
    return re.search(rf"^## {name}\n(.*?)(?=^## |\Z)", TEXTS[PAGE], re.DOTALL | re.MULTILINE)[1]


@pytest.mark.parametrize("name", EFFECTS)
def test_every_effect_has_a_section_a_picture_and_a_remedy(name):
    effect, text = EFFECTS[name], section_of(name)
    for word in ("summary", "pattern", "remedy"):
        assert effect[word] in text
    assert f"(pictures/effects/{name}.png)" in text
    for parameter in effect["parameters"]:
        assert f"`{parameter['name']}`" in text
        assert parameter["setting"] is None or f"${parameter['setting']}" in text
    assert ("no firmware can cure this" in text) == (effect["where"] == "lab")
    assert len(re.findall(r"`\w+` -?\d\.\d\d", text)) == 3 or "it has no shape" in text
