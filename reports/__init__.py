"""Reports of finished campaigns: one list of contents, rendered as a self-contained HTML page and as a PDF.

from reports import build
html, pdf = build("results/buoy_sweep")      # reads that folder, writes report.html and report.pdf into it
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

# Campaign as named in provenance.json: the module whose `report(directory)` gives the content.
CONTENTS = {
    "accuracy": "reports.accuracy_content",
    "buoy_sweep": "reports.buoy_sweep",
    "oscillator": "reports.oscillator_content",
    "breaking_line": "reports.breaking_line",
    "out_of_plane": "reports.offplane_content",
    "stability": "reports.stability_content",
}

__all__ = ["CONTENTS", "build"]


def build(directory: str | Path) -> tuple[Path, Path]:
    """Write report.html and report.pdf of a campaign's folder.

    Both are made in memory first, from the folder alone; the same folder gives the same bytes.
    Returns the two paths.
    Raises FolderError (nothing written) when the folder is not a finished campaign, naming all that is missing;
    OSError when a file cannot be written, which leaves the earlier file of that name whole.
    """
    from engine.atomic import write_atomic

    from .folder import FolderError, campaign_of
    from .html import render_html
    from .pdf import render_pdf

    directory = Path(directory)
    campaign = campaign_of(directory)
    if campaign not in CONTENTS and campaign is not None:
        known = ", ".join(sorted(CONTENTS))
        raise FolderError(directory, [f"provenance.json names the campaign {campaign!r}; reports exist for {known}"])
    # Without a readable provenance the folder is no campaign: the reader of any content lists all that is wrong.
    report = import_module(CONTENTS[campaign or "buoy_sweep"]).report(directory)
    pages = {directory / "report.html": render_html(report), directory / "report.pdf": render_pdf(report)}
    for path, content in pages.items():
        write_atomic(path, content)
    html, pdf = pages
    return html, pdf
