"""Fills the templates of the pages, which lie beside this file."""

from __future__ import annotations

from pathlib import Path

import jinja2

_ENVIRONMENT = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


def filled(name: str, **words: object) -> str:
    """Return the text of a template, `NAME.jinja`, with these words in it."""
    return _ENVIRONMENT.get_template(f"{name}.jinja").render(words)
