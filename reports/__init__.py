"""Reports of finished campaigns: one list of contents, rendered as a self-contained HTML page and as a PDF.

from reports import build
html, pdf = build("results/buoy_sweep")      # reads that folder, writes report.html and report.pdf into it
"""

from importlib import import_module
from pathlib import Path

# Campaigns as named in provenance.json, and what `python -m analysis` calls itself there; the folder of that name has a
# module `report`, whose `report(directory)` gives the content. Where it has a `beside(directory)` too, that gives
# drawings to keep as files: path -> bytes. A campaign of another name whose provenance names what it varied ("vary")
# gets the report of a sweep.
CONTENTS = (
    "accuracy", "basins", "breaking_line", "buoy_sweep", "orbits", "oscillator", "out_of_plane", "paper", "regime_map",
    "sea", "stability", "sweep", "time_series", "validation",
)  # fmt: skip

__all__ = ["CONTENTS", "build"]


def build(directory: str | Path, again: bool = False) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a campaign's folder, and the drawings that belong beside their data.

    All are made in memory first, from the folder alone; the same folder gives the same bytes. Where all are there and
    nothing changed that they were drawn from, nothing is drawn (`parts.unchanged`), unless `again` asks for it.
    Returns the two paths.
    Raises FolderError (nothing written) when the folder is not a finished campaign, naming all that is missing;
    OSError when a file cannot be written, which leaves the earlier file of that name whole.
    """
    from .parts.unchanged import FILE, is_unchanged, record

    directory = Path(directory)
    html, pdf = directory / "report.html", directory / "report.pdf"
    if not again and is_unchanged(directory):
        return html, pdf
    from engine.atomic import write_atomic

    from .parts.html import render_html
    from .parts.pdf import render_pdf

    report, beside = content_of(directory)
    pages = {html: render_html(report), pdf: render_pdf(report)} | beside
    for path, content in pages.items():
        write_atomic(path, content)
    write_atomic(directory / FILE, record(directory, pages))
    return html, pdf


def content_of(directory: str | Path):
    """(what the report says, drawings to keep as files: path -> bytes). Raises FolderError like `build`."""
    from .parts.first_page import opened
    from .parts.folder import FolderError, provenance_of

    directory = Path(directory)
    provenance = provenance_of(directory)
    # without a campaign the reader of any content lists all that is wrong
    campaign = provenance.get("campaign", "buoy_sweep")
    name = campaign
    if campaign not in CONTENTS and provenance.get("vary"):
        name = "sweep"
    if name not in CONTENTS:
        known = ", ".join(CONTENTS)
        fault = f"provenance.json names the campaign {campaign!r} and nothing that it varied; reports exist for {known}"
        raise FolderError(directory, fault)
    contents = import_module(f"reports.{name}.report")
    beside = {}
    if hasattr(contents, "beside"):
        beside = contents.beside(directory)
    return opened(contents.report(directory), directory, provenance), beside
