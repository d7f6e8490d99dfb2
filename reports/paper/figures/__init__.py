"""Figures 2-7 and 9-20 of the paper drawn from their data files alone, and the drawings kept beside the data.

    figures_of(DIR)        the figures as records of a report, by their number in the paper
    left_out(DIR)          why each of the others is not there
    pictures(DIR)          fig_NN.svg and fig_NN.png of every figure, as path -> bytes

The files are written by `campaigns.paper.figures`. The same file gives the same bytes, drawn whenever and wherever.
"""

import json
from functools import lru_cache
from pathlib import Path

from ...parts.content import Figure, Picture
from ...parts.figure_data import FigureDataError, parsed
from ...parts.style import prints_of, sheet
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


def files_of(root: str | Path, number: int) -> tuple[Path, Path, Path]:
    """Data, SVG and PNG of a figure of the paper, in the folder of data and drawings within the campaign's folder."""
    stem = Path(root) / "figures" / f"fig_{number:02d}"
    return stem.with_suffix(".nc"), stem.with_suffix(".svg"), stem.with_suffix(".png")


def figures_of(root: str | Path) -> dict[int, Figure]:
    """The figures that can be drawn, by their number in the paper."""
    return {
        number: Figure(svg, f"Fig. {number} of the paper, {caption}", alt)
        for number, (svg, _, caption, alt) in _drawn(root).items()
    }


def left_out(root: str | Path) -> dict[int, str]:
    """Why there is no figure, by its number in the paper, for each that cannot be drawn."""
    try:
        reasons = json.loads((Path(root) / "figures" / "left_out.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        reasons = {}
    drawn = _drawn(root)
    unknown = "its data file is missing or damaged"
    return {number: str(reasons.get(str(number), unknown)) for number in NUMBERS if number not in drawn}


def pictures(root: str | Path) -> dict[Path, bytes]:
    """The drawings to keep beside the data."""
    kept = {}
    for number, (svg, png, _, _) in _drawn(root).items():
        _, as_svg, as_png = files_of(root, number)
        kept |= {as_svg: svg.data, as_png: png.data}
    return kept


def _drawn(root: str | Path) -> dict[int, tuple[Picture, Picture, str, str]]:
    found = {}
    for number in NUMBERS:
        try:
            found[number] = draw(number, files_of(root, number)[0].read_bytes())
        except (OSError, FigureDataError):
            continue
    return found


@lru_cache(maxsize=len(NUMBERS))
def draw(number: int, content: bytes) -> tuple[Picture, Picture, str, str]:
    """A figure of the paper from the bytes of its data file: SVG, PNG, caption, text alternative.

    Raises FigureDataError for bytes that are no data of that figure.
    """
    data = parsed(content)
    try:
        drawing = DRAWN_BY[number](data)
    except (AttributeError, KeyError) as error:
        raise FigureDataError(f"not the data of fig. {number} of the paper ({error})") from None
    with sheet(drawing.height_in) as figure:
        drawing.fill(figure)
        svg, png = prints_of(figure)
    return svg, png, drawing.caption, drawing.alt
