"""A drawn figure as the bytes of a picture."""

from __future__ import annotations

import io

import matplotlib as mpl
from matplotlib.figure import Figure

from plumb.text.ours import picture_metadata


def saved(figure: Figure, form: str) -> bytes:
    """The figure as png, svg or pdf; the same data give the same bytes."""
    file = io.BytesIO()
    # Names inside an SVG are drawn by chance unless they get a salt.
    with mpl.rc_context({"svg.hashsalt": "plumb"}):
        figure.savefig(
            file, format=form, dpi=130, facecolor="white", metadata=picture_metadata(form)
        )
    return file.getvalue()
