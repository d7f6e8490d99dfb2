"""The report on any column of a file: the verdict first, the curves behind it, every test. From the folder alone."""

from functools import partial
from pathlib import Path

from tables import printed

from ..figures.series_panels import SHOWN, growth_and_dimension, record_and_spectrum, return_map
from ..parts import Figure, FolderError, Heading, Items, Listing, Report, Table, Text, heads, picture_first, read_files

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
    items = [*_verdict(answer), *picture_first(figures), *_evidence(answer), *_origin(source, judged["answer.txt"])]
    title, under = f"Regular or chaotic: {source['column']}", f"column {source['column']} of {source['file']}"
    return Report(title, under, items)


def _verdict(answer: dict) -> Items:
    rows = [list(map(printed, row)) for row in answer["measures"]]
    caption = "Measures with one standard error; none: no value, for the reason beside it."
    return [
        Text(f"The motion is {answer['regime']}: {answer['reason']}."),
        Text(f"{answer['record']}. The section has {answer['section']['how']}."),
        Table(heads("measure", ("value", ""), "unit", "from"), rows, caption, small=False),
    ]


def _figures(judged: dict, unit: str, column: str) -> Items:
    curves = {name: judged[f"{name}.csv"].to_numpy().T for name in CURVES}
    time, values = curves["series"]
    # By name: a folder of an older version has another column, Kantz's curve, and more than one number of delays.
    growth = (curves["divergence"][0], judged["divergence.csv"]["rosenstein_nats"].to_numpy())
    dimension = judged["dimension.csv"]
    dimension = dimension[dimension["delays"] == dimension["delays"].min()]
    slopes = (dimension["delays"].min(), dimension["radius"].to_numpy(), dimension["slope"].to_numpy())
    return [
        Heading("What was seen"),
        Figure(
            record_and_spectrum(time, values, *curves["spectrum"], (unit, column)),
            f"The record and its amplitude spectrum. Above: the last {min(SHOWN, len(time))} samples (`series.csv`). "
            "Below: amplitude of eq. (31) over the later half (`spectrum.csv`): lines alone for a regular motion, a "
            "continuous floor for chaos and for noise.",
            "Two panels: the record over time, and its amplitude spectrum on a logarithmic scale.",
        ),
        Figure(
            return_map(curves["section"][1]),
            "The section at the first of its phases (`section.csv`). Left: each point against the one before it; N "
            "spots for period N, a closed curve for a torus, a folded curve for chaos, a cloud for noise. Right: in "
            "the order of time.",
            "Two panels: the return map of the section, and its points in order.",
        ),
        Figure(
            growth_and_dimension(growth, slopes, unit),
            "Growth of small distances, and the dimension. Left: mean logarithm of the distance of nearest neighbours "
            "by Rosenstein's method (`divergence.csv`); its straight part is the exponent. Right: slope of the "
            "correlation sum (`dimension.csv`); where it runs level, it is the dimension.",
            "Two panels: growth of the distance between neighbours, and local slopes of the correlation sum.",
        ),
    ]


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
