"""The data behind figures 2-7 and 9-20 of the paper, from the folders of the campaign's parts: one file a figure.

    write_figure_data(DIR)      DIR/breaking_line, buoy, oscillator, out_of_plane -> DIR/figures/fig_NN.nc

A figure whose part is missing or failed has no file; `left_out.json` says why. Figures are drawn from their files alone
(`reports.paper.figures`). A file whose sources and makers are unchanged stays as it is; the same sources give the same
bytes.
"""

from functools import partial
from pathlib import Path

from campaigns import figure_data
from campaigns.breaking_line.lines import FAST, SLOW
from campaigns.machinery import made_by, read_json, write_json
from campaigns.paper.figures.chaos import running_exponents, sections
from campaigns.paper.figures.motions import SHOWN, breaking, history, offplane_histories, spectra
from campaigns.paper.measured import LeftOut, Parts
from tables import LARGE, SMALL

LEFT_OUT = "left_out.json"
MAKERS = ("figures", "measures.py", "measured.py")
SHARED = ("analysis", "engine", "campaigns/figure_data.py", "campaigns/explore/rows.py")
SOURCES = (*SHARED, *(f"campaigns/paper/{name}" for name in MAKERS))
FIGURES = {  # of the paper -> what plans its data from the `Parts`; 1 and 8 are sketches
    **{number: partial(breaking, cases=FAST, quantity=quantity) for number, quantity in enumerate(SHOWN, 2)},
    **{number: partial(breaking, cases=SLOW, quantity=quantity) for number, quantity in enumerate(SHOWN, 5)},
    9: partial(history, steepness=SMALL, side="tension"),
    10: partial(history, steepness=SMALL, side="radial"),
    11: partial(history, steepness=SMALL, side="angular"),
    12: partial(spectra, steepness=SMALL, sides=("radial", "angular")),
    13: partial(history, steepness=LARGE, side="tension"),
    14: running_exponents,
    15: partial(history, steepness=LARGE, side="radial"),
    16: partial(history, steepness=LARGE, side="angular"),
    17: partial(spectra, steepness=LARGE, sides=("radial",)),
    18: partial(spectra, steepness=LARGE, sides=("angular",)),
    19: sections,
    20: offplane_histories,
}


def place_of(root: Path) -> Path:
    """The folder of data and drawings within the campaign's folder."""
    return root / "figures"


def files_of(root: Path, number: int) -> tuple[Path, Path, Path]:
    """Data, SVG and PNG of a figure of the paper; the drawings are the report's."""
    stem = place_of(root) / f"fig_{number:02d}"
    return stem.with_suffix(".nc"), stem.with_suffix(".svg"), stem.with_suffix(".png")


def write_figure_data(folder: str | Path) -> dict[int, str]:
    """Write the data of every figure that can be drawn; returns why each of the others cannot, by figure.

    A figure that can no longer be drawn loses its files. Raises OSError, which leaves every file whole.
    """
    root = Path(folder)
    place_of(root).mkdir(parents=True, exist_ok=True)
    parts, left_out, code = Parts(root), {}, made_by(*SOURCES)
    for number, planned in FIGURES.items():
        data, *pictures = files_of(root, number)
        try:
            plan = planned(parts)
            digests = [(source["label"], source["file"], source["sha256"]) for source in plan.sources]
            key = made_by(figure=number, title=plan.title, sources=digests, code=code)
            if figure_data.attribute_of(data) != key:
                figure_data.store(data, figure_data.dataset(plan.title, plan.arrays(), plan.sources, key))
        except LeftOut as reason:
            left_out[number] = str(reason)
            for path in (data, *pictures):
                path.unlink(missing_ok=True)
    content, reasons = {str(number): reason for number, reason in left_out.items()}, place_of(root) / LEFT_OUT
    if read_json(reasons) != content:
        write_json(reasons, content)
    return left_out
