"""Figures 2-7 and 9-20 of the paper drawn from their data files alone, and the drawings kept beside the data.

    figures_of(DIR)        the figures as records of a report, by their number in the paper
    left_out(DIR)          why each of the others is not there
    pictures(DIR)          fig_NN.svg and fig_NN.png of every figure, as path -> bytes

The files are written by `campaigns.paper.figures`. The same file gives the same bytes, drawn whenever and wherever.
"""

import json
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from ...parts import Figure, read_arrays
from .breaking import breaking
from .buoy import history, spectra
from .chaos import offplane_histories, running_exponents, sections

DRAWN_BY = {
    **dict.fromkeys((2, 3, 4, 5, 6, 7), breaking),
    **dict.fromkeys((9, 10, 11, 13, 15, 16), history),
    **dict.fromkeys((12, 17, 18), spectra),
    14: running_exponents,
    19: sections,
    20: offplane_histories,
}
NUMBERS = tuple(sorted(DRAWN_BY))  # 1 and 8 are sketches
PREFACE = (
    "The figures show our runs in the layout of the paper's figures 2-7 and 9-20 (1 and 8 are sketches), as far as "
    "its text and captions tell it: the copy that this work had holds no pictures. Where they do not name a unit, "
    "the static state of section 4.2 serves: tension over the static tension, radius over the static radius, the "
    "angle in rad, both sections in the units of eq. (33); the second axis of each history is in ordinary units."
)


def figures_of(root: Path, kind: str = "svg") -> dict[int, Figure]:
    """The figures that can be drawn from the files in a campaign's folder, by their number in the paper."""
    figures = {}
    for number in NUMBERS:
        try:
            figures[number] = draw(number, _place(root, number, "nc").read_bytes(), kind)
        except (OSError, ValueError, AttributeError, KeyError):  # no file, or not the data of this figure
            continue
    return figures


def left_out(root: Path) -> dict[int, str]:
    """Why there is no figure, by its number in the paper, for each that cannot be drawn."""
    try:
        reasons = json.loads((root / "figures" / "left_out.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        reasons = {}
    drawn = figures_of(root)
    missing = {}
    for number in NUMBERS:
        if number not in drawn:
            missing[number] = str(reasons.get(str(number), "its data file is missing or damaged"))
    return missing


def pictures(root: Path) -> dict[Path, bytes]:
    """The drawings to keep beside the data."""
    files = {}
    for kind in ("svg", "png"):
        for number, figure in figures_of(root, kind).items():
            files[_place(root, number, kind)] = figure.picture.data
    return files


def _place(root: Path, number: int, kind: str) -> Path:
    return root / "figures" / f"fig_{number:02d}.{kind}"


@lru_cache(maxsize=2 * len(NUMBERS))
def draw(number: int, content: bytes, kind: str) -> Figure:
    """A figure of the paper from the bytes of its data file; kind: "svg" or "png".

    Raises ValueError, AttributeError or KeyError for bytes that are no data of that figure.
    """
    figure = DRAWN_BY[number](read_arrays(content), kind)
    return replace(figure, caption=f"Fig. {number} of the paper, {figure.caption}")
