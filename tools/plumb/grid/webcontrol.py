"""The settings of WebControl as the sections, keys and values of a groundcontrol.ini."""

from __future__ import annotations

import configparser
import json


def is_webcontrol(text: str) -> bool:
    """Whether this may be a webcontrol.json."""
    return text.lstrip().startswith("{")


def as_ini(text: str) -> configparser.RawConfigParser:
    """The values of a webcontrol.json; a ValueError if it is none."""
    parser = configparser.RawConfigParser(strict=False)
    document = json.loads(text)
    for section, options in document.items():
        if not isinstance(options, list):
            raise ValueError("a section of WebControl is a list")
        said = {str(each["key"]): str(each["value"]) for each in options if "value" in each}
        parser.read_dict({section: said})
    return parser
