"""The data behind figures 2-7 and 9-20 of the paper, from the folders of the campaign's parts: one file a figure.

    write_figure_data(DIR)      DIR/breaking_line, buoy, oscillator, out_of_plane -> DIR/figures/fig_NN.nc

A figure whose part is missing or failed has no file; `left_out.json` says why. Figures are drawn from their files alone
(`reports.paper.figures`). A file whose sources and makers are unchanged stays as it is; the same sources give the same
bytes.
"""

import contextlib
from functools import partial
from pathlib import Path

NUMBERS = (2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20)  # 1 and 8 are sketches
LEFT_OUT = "left_out.json"
SOURCES = ("analysis", "engine", "campaigns/figure_data.py", "campaigns/paper/figures", "campaigns/paper/measures.py")


def place_of(root: Path) -> Path:
    """The folder of data and drawings within the campaign's folder."""
    return root / "figures"


def files_of(root: Path, number: int) -> tuple[Path, Path, Path]:
    """Data, SVG and PNG of a figure of the paper; the drawings are the report's."""
    stem = place_of(root) / f"fig_{number:02d}"
    return stem.with_suffix(".nc"), stem.with_suffix(".svg"), stem.with_suffix(".png")


def planners() -> dict[int, object]:
    """Figure of the paper -> what plans its data from the `Parts`."""
    from campaigns.breaking_line.lines import FAST, SLOW
    from campaigns.paper.figures.breaking import breaking
    from campaigns.paper.figures.buoy import history, spectra
    from campaigns.paper.figures.exponents import running_exponents
    from campaigns.paper.figures.offplane import offplane_histories
    from campaigns.paper.figures.sections import sections
    from campaigns.paper.measures import LARGE, SMALL

    def of_line(cases, what):
        return partial(breaking, cases=cases, what=what)

    def of_buoy(steepness, side):
        return partial(history, steepness=steepness, side=side)

    def of_spectrum(steepness, *sides):
        return partial(spectra, steepness=steepness, sides=sides)

    return {
        2: of_line(FAST, "motion"),  # fig. 2: x-z motion, fracture in 5 ms
        3: of_line(FAST, "tension"),  # fig. 3
        4: of_line(FAST, "velocity"),  # fig. 4
        5: of_line(SLOW, "motion"),  # fig. 5: fracture in 50 ms
        6: of_line(SLOW, "tension"),  # fig. 6
        7: of_line(SLOW, "velocity"),  # fig. 7
        9: of_buoy(SMALL, "tension"),  # fig. 9: kA = 0.016
        10: of_buoy(SMALL, "radial"),  # fig. 10
        11: of_buoy(SMALL, "angular"),  # fig. 11
        12: of_spectrum(SMALL, "radial", "angular"),  # fig. 12
        13: of_buoy(LARGE, "tension"),  # fig. 13: kA = 0.13
        14: running_exponents,  # fig. 14: both
        15: of_buoy(LARGE, "radial"),  # fig. 15
        16: of_buoy(LARGE, "angular"),  # fig. 16
        17: of_spectrum(LARGE, "radial"),  # fig. 17
        18: of_spectrum(LARGE, "angular"),  # fig. 18
        19: sections,  # fig. 19: buoy and eq. (33)
        20: offplane_histories,  # fig. 20
    }


def write_figure_data(folder: str | Path) -> dict[int, str]:
    """Write the data of every figure that can be drawn; returns why each of the others cannot, by figure.

    A figure that can no longer be drawn loses its files. Raises OSError, which leaves every file whole.
    """
    from campaigns import figure_data
    from campaigns.machinery.folder import made_by, read_json, write_json
    from campaigns.paper.figures.plans import LeftOut, Parts

    root = Path(folder)
    place = place_of(root)
    place.mkdir(parents=True, exist_ok=True)
    parts, left_out = Parts(root), {}
    code = made_by({}, *SOURCES)
    for number, planned in planners().items():
        data, *pictures = files_of(root, number)
        try:
            plan = planned(parts)
            digests = [(one.label, one.file, one.sha256) for one in plan.sources]
            key = made_by({"figure": number, "title": plan.title, "sources": digests, "code": code})
            if figure_data.made_by_of(data) != key:
                figure_data.store(data, figure_data.dataset(plan.title, plan.arrays(), plan.sources, key))
        except LeftOut as reason:
            left_out[number] = str(reason)
            for path in (data, *pictures):
                with contextlib.suppress(FileNotFoundError):
                    path.unlink()
    content = {str(number): reason for number, reason in left_out.items()}
    if read_json(place / LEFT_OUT) != content:
        write_json(place / LEFT_OUT, content)
    return left_out
