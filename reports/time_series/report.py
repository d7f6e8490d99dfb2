"""The report on any column of a file: the verdict first, the curves behind it, every test. From the folder alone."""

from functools import partial
from pathlib import Path

import numpy as np

from tables import printed

from ..figures.curves import Curve, Panel, curves
from ..parts import (
    Figure,
    FolderError,
    Heading,
    Items,
    Listing,
    Picture,
    Report,
    Table,
    Text,
    flat,
    heads,
    picture_first,
    read_files,
)
from ..parts.style import INK, kind_for

_LONGEST_NAME = 24  # letters of a column's name beside its axis
SHOWN = 4000  # samples of the record that are drawn: the last
CURVES = ("series", "spectrum", "section", "divergence", "dimension")
PASSED = {True: "yes", False: "no", None: "not asked"}


def read_judged(directory: Path) -> dict[str, object]:
    """{file: content} of the folder: text, JSON, and curves in which a cell without a value is NaN.

    Raises FolderError naming every file that is missing or cannot be read.
    """
    import pandas

    names = ("answer.json", "provenance.json", "answer.txt", *(f"{name}.csv" for name in CURVES))
    curves = {".csv": partial(pandas.read_csv, dtype=float)}
    files = read_files(directory, dict.fromkeys(names, "python -m analysis writes it"), curves)
    if "measures" not in files["answer.json"]:
        raise FolderError(directory, "answer.json is of an older version: run the command again")
    return files


def report(directory: Path) -> Report:
    """The content of the report on a folder of `python -m analysis`. Raises FolderError for any other."""
    judged = read_judged(directory)
    answer, source = judged["answer.json"], judged["provenance.json"]
    figures = _figures(judged, answer["unit_of_time"], source["column"])
    record, *further = picture_first(figures)
    items = [_verdict(answer), record, _measures(answer), *further, _evidence(answer)]
    items.append(_origin(source, judged["answer.txt"]))
    title, under = f"Regular or chaotic: {source['column']}", f"column {source['column']} of {source['file']}"
    return Report(title, under, flat(items))


def _verdict(answer: dict) -> Items:
    return [
        Text(f"The motion is {answer['regime']}: {answer['reason']}."),
        Text(f"{answer['record']}. The section has {answer['section']['how']}."),
    ]


def _measures(answer: dict) -> Table:
    rows = [list(map(printed, row)) for row in answer["measures"]]
    caption = "Measures with one standard error; none: no value, for the reason beside it."
    return Table(heads("measure", ("value", ""), "unit", "from"), rows, caption, small=False)


def _figures(judged: dict, unit: str, column: str) -> Items:
    curves_of_files = {name: judged[f"{name}.csv"].to_numpy().T for name in CURVES}
    time, values = curves_of_files["series"]
    return [
        Heading("What was seen"),
        Figure(
            record_and_spectrum(time, values, *curves_of_files["spectrum"], (unit, column)),
            f"The record and its amplitude spectrum. Above: the last {min(SHOWN, len(time))} samples (`series.csv`). "
            "Below: amplitude of eq. (31) over the later half (`spectrum.csv`): lines alone for a regular motion, a "
            "continuous floor for chaos and for noise.",
            "Two panels: the record over time, and its amplitude spectrum on a logarithmic scale.",
        ),
        Figure(
            _return_map(curves_of_files["section"][1]),
            "The section at the first of its phases (`section.csv`). Left: each point against the one before it; N "
            "spots for period N, a closed curve for a torus, a folded curve for chaos, a cloud for noise. Right: in "
            "the order of time.",
            "Two panels: the return map of the section, and its points in order.",
        ),
        Figure(
            _growth_and_dimension(judged["divergence.csv"], judged["dimension.csv"], unit),
            "Growth of small distances, and the dimension. Left: mean logarithm of the distance of nearest neighbours "
            "by Rosenstein's method (`divergence.csv`); its straight part is the exponent. Right: slope of the "
            "correlation sum (`dimension.csv`); where it runs level, it is the dimension.",
            "Two panels: growth of the distance between neighbours, and local slopes of the correlation sum.",
        ),
    ]


def record_and_spectrum(
    time: np.ndarray, values: np.ndarray, frequency: np.ndarray, amplitude: np.ndarray, names: tuple[str, str]
) -> Picture:
    """The end of the record (n,) over time, and |X| (m,) of eq. (31) over the angular frequency, logarithmic.

    names: the unit of time; the column, as its file calls it.
    """
    unit, column = names
    shown = column if len(column) <= _LONGEST_NAME else column[: _LONGEST_NAME - 1] + "…"
    label = shown.replace("$", r"\$")  # a name is no mathematics
    record = Curve(time[-SHOWN:], values[-SHOWN:], colour=INK, width=0.6)
    moving = amplitude[1:]
    spectrum = Curve(frequency[1:], np.maximum(moving, 1e-6 * moving.max(initial=1e-300)), width=0.7)
    upper = Panel([record], f"time ({unit})", label)
    lower = Panel([spectrum], f"angular frequency (rad/{unit})", "$|X|$, eq. (31), as above", log="y")
    return curves([[upper], [lower]], 3.8, kind=kind_for(len(frequency) + SHOWN))


def _return_map(values: np.ndarray) -> Picture:
    """Each point of the section (m,) against the one before it, and against its number."""
    look = {"line": "", "mark": "o", "size": 2.5 if len(values) < 600 else 1.5, "alpha": 0.6}
    values_panel = Panel([Curve(values[:-1], values[1:], **look)], "point $k$", "point $k + 1$")
    right = Panel([Curve(np.arange(len(values)), values, **look)], "$k$", "point $k$")
    return curves([[values_panel, right]], 3.0, kind=kind_for(2 * len(values)))


def _growth_and_dimension(divergence, dimension, unit: str) -> Picture:
    """Growth of the distance of neighbours and slopes of the correlation sum; a panel is empty where there is no curve.

    By names of columns: a folder of an older version has another column, Kantz's curve, and more than one number of
    delays. unit: of the time.
    """
    left, right = [], []
    growth_nats = divergence["rosenstein_nats"].to_numpy()
    if np.isfinite(growth_nats).any():
        left.append(Curve(divergence.iloc[:, 0].to_numpy(), growth_nats))
    delays = dimension["delays"].min()
    dimension = dimension[dimension["delays"] == delays]
    if len(dimension):
        radius, slope = dimension["radius"].to_numpy(), dimension["slope"].to_numpy()
        right.append(Curve(radius, slope, f"{delays:.0f} delays", colour=INK))
    panels = (
        Panel(left, f"time ({unit})", "mean ln(distance) (nats)"),
        Panel(right, "radius (standard deviations)", "slope of the correlation sum", log="x"),
    )
    return curves([panels], 3.0, "best")


def _evidence(answer: dict) -> Items:
    rows = []
    for test in answer["evidence"]:
        value, threshold = _number(test["value"]), _number(test["threshold"])
        rows.append((test["name"], PASSED[test["passed"]], value, threshold, printed(test["sentence"])))
    columns = heads("test", "passed", ("value", ""), ("compared with", ""), "meaning")
    caption = "Every test behind the word, in the order in which it was made (`analysis/verdicts.py`)."
    return [Heading("Evidence"), Table(columns, rows, caption)]


def _number(value: float | None) -> str:
    if value is None:
        return "none"
    return f"{value:.4g}"


def _origin(source: dict, page: str) -> Items:
    lines = [f"{key}: {value}" for key, value in source.items() if key not in ("campaign", "versions")]
    lines += [f"{name} {version}" for name, version in source["versions"].items()]
    items = [Heading("The answer as printed"), Listing(page)]
    return [Heading("Where it comes from"), Listing("\n".join(lines)), *items]
