"""A drawn figure as the bytes of a picture."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from plumb.text.ours import picture_metadata

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def saved(figure: Figure, form: str) -> bytes:
    """The figure as png, svg or pdf; the same data give the same bytes."""
    import matplotlib as mpl

    read_as_written(figure)
    file = io.BytesIO()
    # Names inside an SVG are drawn by chance unless they get a salt.
    with mpl.rc_context({"svg.hashsalt": "plumb"}):
        figure.savefig(
            file, format=form, dpi=130, facecolor="white", metadata=picture_metadata(form)
        )
    return file.getvalue()


def pages_saved(pages: list[Figure]) -> bytes:
    """Figures as the pages of a pdf."""
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    with PdfPages(file, metadata=picture_metadata("pdf")) as pdf:
        for page in pages:
            read_as_written(page)
            pdf.savefig(page, facecolor="white")
    return file.getvalue()


def read_as_written(figure: Figure) -> None:
    """Let no word be a formula: a name from a file may hold a `$`."""
    from matplotlib.text import Text

    for text in figure.findobj(Text):
        text.set_parse_math(False)
