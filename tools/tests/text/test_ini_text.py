"""Ini files as lines."""

import configparser

import pytest
from plumb.text.errors import InputError
from plumb.text.files import parse_ini, with_values

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


def test_entries_are_those_that_configparser_finds():
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(TEXT)
    expected = [(s, k, v) for s in parser.sections() for k, v in parser[s].items()]
    entries = [(e.section, e.key.lower(), e.value) for e in parse_ini(TEXT, source="x").entries]
    assert entries == expected


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


def test_a_value_on_several_lines_is_not_replaced():
    ini = parse_ini(TEXT, source="x")
    with pytest.raises(InputError, match="several lines"):
        with_values(ini, {("Maslow Settings", "macro1"): "G1"})
