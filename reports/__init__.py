"""Reports of finished campaigns: one list of contents, rendered as a self-contained HTML page and as a PDF.

from reports import build
html, pdf = build("results/buoy_sweep")      # reads that folder, writes report.html and report.pdf into it
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

# Campaigns as named in provenance.json, and what `python -m analysis` calls itself there; the folder of that name has a
# module `report`, whose `report(directory)` gives the content. Where it has a `beside(directory)` too, that gives
# drawings to keep as files: path -> bytes.
CONTENTS = (
    "accuracy", "breaking_line", "buoy_sweep", "oscillator", "out_of_plane", "paper", "stability", "sweep",
    "time_series",
)  # fmt: skip

__all__ = ["CONTENTS", "build"]


def build(directory: str | Path) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a campaign's folder, and the drawings that belong beside their data.

    All are made in memory first, from the folder alone; the same folder gives the same bytes.
    Returns the two paths.
    Raises FolderError (nothing written) when the folder is not a finished campaign, naming all that is missing;
    OSError when a file cannot be written, which leaves the earlier file of that name whole.
    """
    from engine.atomic import write_atomic

    from .parts.folder import FolderError, campaign_of
    from .parts.html import render_html
    from .parts.pdf import render_pdf

    directory = Path(directory)
    campaign = campaign_of(directory)
    if campaign not in CONTENTS and campaign is not None:
        known = ", ".join(CONTENTS)
        raise FolderError(directory, [f"provenance.json names the campaign {campaign!r}; reports exist for {known}"])
    # Without a readable provenance the folder is no campaign: the reader of any content lists all that is wrong.
    contents = import_module(f"reports.{campaign or 'buoy_sweep'}.report")
    report = contents.report(directory)
    html, pdf = directory / "report.html", directory / "report.pdf"
    pages = {html: render_html(report), pdf: render_pdf(report)}
    if hasattr(contents, "beside"):
        pages |= contents.beside(directory)
    for path, content in pages.items():
        write_atomic(path, content)
    return html, pdf
