"""The report of `campaigns.stability`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

from engine.excursions import own_words

from ..figures.stability import scene_shares, step_maps, stiffness
from ..parts.columns import Quantity, table_of, value
from ..parts.content import Bullets, Figure, Heading, Item, Notice, Report, Table, Text, heads
from ..parts.folder import FolderError, read_files
from ..parts.provenance import appendix, provenance_items, timing_items
from ..parts.sections import section_items
from ..parts.wording import EMPTY, count, decimals, listed, number

VERDICTS = ("ok", "refused", "known limit", "unexplained")


def report(directory: str | Path) -> Report:
    """The content of the report on a stability folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items: list[Item] = [
        *section_items("stability", "Question"),
        Heading("The answer in numbers"),
        Bullets(tuple(_answers(study))),
        *unexplained_items(study),
        *stiffness_items(study),
        *case_items(study),
        *limit_items(study),
        *random_items(study),
        *map_items(study),
        *share_items(study),
        *appendix(*timing_items(study), *provenance_items(study)),
    ]
    kind = "quick selection" if study.provenance.get("quick") else "all cases"
    return Report("Stiff and extreme scenes", f"{count(len(study.cases), 'case')} ({kind})", tuple(items))


def _answers(study: Study) -> Iterator[str]:
    counts = Counter(row["verdict"] for row in study.cases)
    counts_text = listed(f"{counts[word]} {word}" for word in VERDICTS if counts[word])
    yield f"{count(len(study.cases), 'case')}: {counts_text}."
    if study.random:
        valid, unsound = sum(row["kind"] == "valid" for row in study.random), len(study.unsound())
        slowest = max(value(row, "wall_s") for row in study.random)
        yield (
            f"Random scenes: {valid} valid and {len(study.random) - valid} invalid; {unsound} of them did anything "
            f"else than {', '.join(SOUND)}. The slowest took {number(slowest, 3)} s."
        )
    for row in study.cases:
        if row["group"] == "drift" and math.isfinite(value(row, "measured")):
            yield (
                f"Over {row['case']} ({number(value(row, 'wall_s'), 3)} s of computing) the strobed distance of the "
                f"buoy moves by {number(value(row, 'measured'), 2)} of its range."
            )
    maps = [entry for line in study.maps.values() for entry in line["methods"].values()]
    if distances := [entry["distance"] for entry in maps if "distance" in entry]:
        yield (
            "The engine's one-step map has every eigenvalue that the closed form gives for straight lines, within "
            f"{max(distances):.0e}, for every method."
        )
    times = [scene["us_per_newton"] for scene in study.shares["scenes"].values()]
    yield (
        f"A Newton iteration takes {number(min(times), 3)} to {number(max(times), 3)} µs, depending on what the scene "
        "has: parts that are absent are not computed."
    )


FILES = {
    "table.csv": "one row a case",
    "columns.csv": "what its columns are",
    "fuzz.csv": "one row a random scene",
    "step_maps.json": "eigenvalues of one-step maps",
    "scene_shares.json": "what each part of a scene costs",
    "provenance.json": "what ran, where and for how long",
}
SOUND = ("ok", "ended", "refused")  # outcomes of random scenes; any other is a fault of the program
HOW = (
    "Checks. Closed form: the largest distance from it. Refinement, or a run on other nodes: rms difference of r "
    "from a run with twice the elements and a tenth of the tolerance (or the nodes named), over its range. "
    "Energy: largest change of the total over the largest kinetic energy, without water. Static equilibrium stays, "
    "symmetry, r stays: the largest movement over the length. Tension: how far the largest one at the top is off. "
    "Finite and complete: every sample is there and is a number; this is asked of every run. A case is ok where its "
    "numbers are below their bars, or the run itself says that its tensions hold no better (ringing)."
)
SHOWN = (
    "case", "dimensions", "verdict", "run_status", "how", "measured", "bar", "measured_tension", "bar_tension",
    "unresolved_ringing_N", "length_s", "case_wall_s",
)  # fmt: skip
DEFAULT = "EA", "EA = 50000 N, regular wave"  # whose cost is the unit


@dataclass(frozen=True, eq=False)
class Study:
    """What the campaign left: `cases` and `random`, rows of text by column; `maps`, `shares` as their files have it."""

    provenance: dict
    columns: dict[str, Quantity]
    cases: list[dict[str, str]]
    random: list[dict[str, str]]
    maps: dict
    shares: dict

    def judged(self, verdict: str) -> list[dict[str, str]]:
        """The cases with that verdict."""
        return [row for row in self.cases if row["verdict"] == verdict]

    def unsound(self) -> list[dict[str, str]]:
        """The random scenes in which the program is at fault."""
        return [row for row in self.random if row["outcome"] not in SOUND]


def read_study(directory: str | Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    files = read_files(directory, FILES)
    table, columns, random, maps, shares, provenance = (files[name] for name in FILES)
    faults = []
    if not table or not {"part", "group", "verdict"} <= set(table[0]):
        faults.append("table.csv cannot be read: it has no rows, or not those of this campaign")
    if not isinstance(shares.get("scenes"), dict):
        faults.append("scene_shares.json cannot be read: it has no scenes")
    if faults:
        raise FolderError(Path(directory), faults)
    return Study(provenance, columns, [row for row in table if row["part"] == "case"], random, maps, shares)


def case_items(study: Study) -> list[Item]:
    """One table of all cases, a row with its title before each group."""
    rows = []
    for about in dict.fromkeys(row["about"] for row in study.cases):
        rows += [{"case": f"— {about} —"}, *(row for row in study.cases if row["about"] == about)]

    def cell(name: str):
        return lambda row: study.columns[name].cell(row[name]) if "group" in row else row.get(name, "")

    caption = "Cases and verdicts, from `table.csv`."
    cells = {name: cell(name) for name in SHOWN}
    return [Heading("Cases and verdicts"), Text(HOW), table_of(study.columns, SHOWN, rows, caption, cells)]


def stiffness_items(study: Study) -> Iterator[Item]:
    """Error of the largest tension, and cost, over stiffness; nothing without the case whose cost is the unit."""
    rows = [row for row in study.judged("ok") if row["measured_tension"] and not own_words(row["message"])]
    rows = [row for row in rows if row["group"] == "EA" or row["how"] == "waves in a bar"]
    costs = {row["run_key"]: value(row, "newton_iterations") / value(row, "length_s") for row in rows}
    unit = [costs[row["run_key"]] for row in rows if (row["group"], row["case"]) == DEFAULT]
    checks: dict[str, list[tuple[float, ...]]] = {}
    for row in rows if unit else ():
        if math.isfinite(value(row, "stiffness_N")):
            point = value(row, "stiffness_N"), value(row, "measured_tension"), costs[row["run_key"]] / unit[0]
            checks.setdefault(row["how"], []).append(point)
    if not checks:
        return
    points = {name: np.array(series).T for name, series in checks.items()}
    worst = max(series[1].max() for series in points.values())
    largest = max(series[2].max() for series in points.values())
    seen = f"errors up to {number(worst, 2)}, {number(largest, 2)} times as many iterations at most"
    yield Heading("Tension and cost over stiffness")
    yield Figure(
        stiffness(points),
        f"Largest tension at the top against what it should be, and its cost: {seen}. A stiff line costs more only "
        "while it rings. From `table.csv`.",
        f"Error of the largest tension and cost over axial stiffness: {seen}.",
    )


def limit_items(study: Study) -> Iterator[Item]:
    """What ended otherwise than "ok", and what the user is told."""
    cells = {"message": lambda row: row["message"].removeprefix("faulty scene: ")}
    sections = (
        (Heading("Known limits"), "known limit", ("limit", "case", "run_status"), "Endings that were expected."),
        (Heading("Refused, and what the user is told", 2), "refused", ("case", "message"), "Scenes not started."),
    )
    for heading, verdict, names, caption in sections:
        rows = sorted(study.judged(verdict), key=lambda row: row["limit"])
        yield heading
        yield table_of(study.columns, names, rows, f"{caption} From `table.csv`.", cells) if rows else Text("None.")


def random_items(study: Study) -> Iterator[Item]:
    """Counts of outcomes and statuses, and the times."""
    yield Heading("Random scenes")
    if not study.random:
        yield Text("None were asked for (`--fuzz 0`).")
        return
    yield Text(
        "Valid scenes are drawn section by section, and drawn again where a rule between their values is broken; in "
        "about half of them up to three numbers are replaced by extreme ones that the engine still accepts. Invalid "
        "scenes are valid ones with up to three faults put in. Each scene runs in a process of its own, for up to 40 "
        "samples, with a limit of 60 s of computing. The same seed gives the same scenes."
    )
    walls: dict[tuple[str, ...], list[float]] = {}
    for row in sorted(study.random, key=lambda row: (row["kind"] != "valid", row["outcome"] != "ok")):
        named = row["kind"], row["outcome"], row["status"] or EMPTY, row["meaning"]
        walls.setdefault(named, []).append(value(row, "wall_s"))
    rows = tuple(
        (*named, str(len(values)), number(median(values), 2), number(max(values), 3)) for named, values in walls.items()
    )
    columns = heads("scenes", "outcome", "ended", "meaning", ("count", ""), ("median", "s"), ("slowest", "s"))
    yield Table(columns, rows, "Outcomes of random scenes. From `fuzz.csv`.", small=True)


def unexplained_items(study: Study) -> list[Item]:
    """A warning with all that nobody expected, or a note that there is nothing of the kind."""
    lines = [
        f"{row['group']}, {row['case']}: {row['run_status']} {row['message']}".strip()
        for row in study.judged("unexplained")
    ]
    lines += [
        f"random {row['kind']} scene {row['number']}: {row['outcome']}, {row['message'][:300]}"
        for row in study.unsound()
    ]
    if lines:
        return [Notice("warning", "Unexplained", tuple(lines))]
    return [Notice("note", "Nothing unexplained", ("Every case ended as expected, or with a reason given below.",))]


def map_items(study: Study) -> Iterator[Item]:
    """A figure for each line and one table of all."""
    yield Heading("Eigenvalues of one step")
    yield Text(
        "The map from one step to the next is differenced about a state of rest, with all its unknowns: the conserved "
        "variables q and V of every node and their rates. A method multiplies a mode of rate λ by its stability "
        "function R(λ Δt). In a taut line the rates are imaginary and no eigenvalue may leave the unit circle, however "
        "long the step. Under compression the rates are real, and the modes that grow must have eigenvalues outside: a "
        "step of many e-folds damps them instead, in every implicit method. Steps that control their own length are "
        "held to two e-folds of the fastest buckle for this reason (`solver.growth_per_step`)."
    )
    rows = []
    for line in study.maps.values():
        values = {name: np.array(entry["re"]) + 1j * np.array(entry["im"]) for name, entry in line["methods"].items()}
        step, largest = number(line["step_s"], 3), max(entry["largest"] for entry in line["methods"].values())
        seen = f"{line['title']}, steps of {step} s; largest modulus {number(largest, 7)}"
        caption = (
            f"A line {seen}. Eigenvalues μ, dots: inside or on the unit circle; crosses: outside, those beyond the "
            "panel on its edge. From `step_maps.json`."
        )
        yield Figure(step_maps(values), caption, f"Eigenvalues in the complex plane beside the unit circle: {seen}.")
        for name, entry in line["methods"].items():
            excess = f"{entry['largest'] - 1:.1e}".replace("-", "−")
            distance = f"{entry['distance']:.1e}" if "distance" in entry else EMPTY
            growing = (str(entry.get(key, EMPTY)) for key in ("growing", "growing_found"))
            rows.append((line["title"], name, step, excess, distance, *growing))
    numbers = ("largest |μ| − 1", "distance from closed form", "should grow", "grow")
    columns = heads("line", "method", ("Δt", "s"), *((name, "") for name in numbers))
    caption = (
        "Eigenvalues by line and method. Distance: the largest of those of the closed form's eigenvalues R(λ Δt) "
        "from the nearest one found. Grow: how many modes should and do lie outside the unit circle. From "
        "`step_maps.json`."
    )
    yield Table(columns, tuple(rows), caption, small=True)


def share_items(study: Study) -> Iterator[Item]:
    """Times of scenes with parts taken away and added."""
    scenes = study.shares["scenes"]
    times = np.array([scene["us_per_newton"] for scene in scenes.values()])
    shares = times / times[0]
    seen = f"{number(shares.min(), 2)} to {number(shares.max(), 2)} times the time of the first scene"
    yield Heading("What a scene does not need")
    yield Figure(
        scene_shares(list(scenes), times),
        f"What each part of a scene costs: a Newton iteration takes {seen}. A scene without a part does not compute "
        "it. From `scene_shares.json`.",
        f"Bars of the time of a Newton iteration for {len(scenes)} scenes: {seen}.",
    )
    columns = heads("scene", ("Newton iteration", "µs"), ("share of the first", ""), ("step", "µs"))
    rows = tuple(
        (name, number(scene["us_per_newton"], 3), decimals(share, 2), number(scene["us_per_step"], 3))
        for (name, scene), share in zip(scenes.items(), shares, strict=True)
    )
    rounds = f"medians of {study.shares['rounds']} rounds in turns on one core"
    yield Table(columns, rows, f"Cost of the parts of a scene: {rounds}. From `scene_shares.json`.", small=True)
