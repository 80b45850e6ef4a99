"""Ini files as lines."""

import configparser

import pytest
from plumb.text.errors import InputError
from plumb.text.ini import parse_ini, with_values

TEXT = """; a comment
[Maslow Settings]
comport = COM3
openfile = C:\\100%\\new=old.nc
macro1 = G0 X0
\tG0 Y0
motorSpacingX: 2978.4

[Advanced Settings]
digits = 4
"""


def test_entries_are_those_configparser_finds():
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(TEXT)
    expected = [(s, k, v) for s in parser.sections() for k, v in parser[s].items()]
    entries = [(e.section, e.key.lower(), e.value) for e in parse_ini(TEXT, source="x").entries]
    assert entries == expected


def test_keys_are_found_whatever_their_case():
    ini = parse_ini(TEXT, source="x")
    assert ini.find("MOTORSPACINGX", section="maslow settings").value == "2978.4"
    assert ini.find("digits", section="Elsewhere").value == "4"
    assert ini.find("nothing", section="Maslow Settings") is None


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("[a]\nb = 1\nB = 2\n", "line 3, .a. B: the same key is already on line 2"),
        ("[a]\nb = 1\n[A]\nb = 2\n", "already on line 2"),
        ("b = 1\n", "before the first .section."),
        ("[a]\nnonsense\n", "line 2: is not key = value"),
        ("[a]\n= 5\n", "line 2: is not key = value"),
    ],
)
def test_broken_lines_are_refused(text, hint):
    with pytest.raises(InputError, match=hint):
        parse_ini(text, source="x.ini")


def test_a_key_in_two_other_sections_is_refused():
    ini = parse_ini("[a]\nk = 1\n[b]\nk = 2\n", source="x.ini")
    with pytest.raises(InputError, match="appears in"):
        ini.find("k", section="c")


@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("start", ["", "\ufeff"])
def test_only_the_value_changes(ending, start):
    text = start + TEXT.replace("\n", ending).replace("digits = 4", "digits\t=  4  ")
    ini = parse_ini(text, source="x")
    changed = with_values(ini, {("Advanced Settings", "digits"): "5"})
    assert changed == text.replace("digits\t=  4  ", "digits\t=  5  ")
    assert with_values(ini, {}) == text


def test_an_empty_value_can_be_filled():
    ini = parse_ini("[a]\nk =\nm = \n", source="x")
    assert with_values(ini, {("a", "k"): "1", ("a", "m"): "2"}) == "[a]\nk =1\nm = 2\n"


def test_new_keys_go_to_the_end_of_their_section():
    ini = parse_ini("[a]\r\nk = 1\r\n\r\n[b]\r\nm = 2", source="x")
    changed = with_values(ini, {("A", "New"): "3", ("b", "more"): "4", ("c", "last"): "5"})
    assert changed == (
        "[a]\r\nk = 1\r\nnew = 3\r\n\r\n[b]\r\nm = 2\r\nmore = 4\r\n\r\n[c]\r\nlast = 5\r\n"
    )
    parse_ini(changed, source="x")


def test_a_value_on_several_lines_is_not_replaced():
    ini = parse_ini(TEXT, source="x")
    with pytest.raises(InputError, match="several lines"):
        with_values(ini, {("Maslow Settings", "macro1"): "G1"})
