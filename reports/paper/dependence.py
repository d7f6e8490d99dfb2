"""What the paper leaves out: the list of it, and how much of the answer of section 4.2 hangs on each choice."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..buoy_sweep.motion import STROBE_TOLERANCE
from ..figures.depth_exponents import Curve, depth_exponents, kind_of
from ..out_of_plane.comparison import comparison_items, read_pairs
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.folder import FolderError
from ..parts.wording import EMPTY, count, decimals, listed, number, percent
from .results import LARGE, SMALL, TREATED, Results

if TYPE_CHECKING:
    from engine import Scene

TREATMENTS = {
    "extrapolate": "linear waves continued above still water",
    "zero": "no water above still water",
    "wheeler": "stretched to the surface after Wheeler",
    "full": "buoyancy and wave load of the whole sphere always",
    "spherical-cap": "of the wetted part",
}
_EXPONENT, _ERROR = "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"


def dependence_items(results: Results, scene: Scene) -> list[Item]:
    """The section; scene: that of section 4.2 as shipped."""
    items: list[Item] = [
        Heading("What the paper leaves out"),
        Text(
            "To run section 4 one has to choose what the paper does not say. The first table lists the choices of the "
            "shipped scenes; the rest of this section shows what becomes of the answer with others."
        ),
        _gaps(results, scene),
    ]
    if not results.dependence:
        return [*items, Text("The part `dependence` is not there, so nothing is shown of what follows from them.")]
    items += [Heading("Depth, waves above still water, buoyancy out of the water", 2), _depth_text(results)]
    items.append(_depth_figure(results))
    items += [_regimes(results, steepness) for steepness in (SMALL, LARGE)]
    items += [Heading("Bending stiffness", 2), *_stiffness(results)]
    return [*items, *_plane(results)]


def _gaps(results: Results, scene: Scene) -> Table:
    heads = tuple(Column(title, align="left") for title in ("not in the paper", "taken here", "why"))
    depth, density = f"{number(scene.water.depth_m)} m", f"{number(scene.water.density_kgpm3)} kg/m³"
    EI, GI = scene.tether.bending_stiffness_Nm2, scene.tether.torsion_stiffness_Nm2
    breaking = [line.trajectory.scene.tether for line in results.lines if line.trajectory is not None]
    of_line = f"{number(breaking[0].bending_stiffness_Nm2)} N m²" if breaking else EMPTY
    why = "where the two waves come out as the paper says; varied below"
    if results.calm is not None:
        # with the whole sphere's buoyancy, as taken here
        out_m = results.calm.rest_m + 0.5 * scene.buoy.diameter_m - scene.water.depth_m
        where = f"{number(out_m, 2)} m above" if out_m > 0.0 else f"{number(-out_m, 2)} m below"
        why += f"; the top of the buoy at rest is then {where} still water" if math.isfinite(out_m) else ""
    rows = (
        ("water depth H", depth, why),
        ("density of the water", density, "then the added mass is half the displaced mass"),
        (
            "EI, GI of the tether",
            f"{number(EI)} and {number(GI)} N m²",
            "a published example of the same buoy and rope; EI varied below",
        ),
        ("waves above still water", TREATMENTS[scene.waves.above_still_water], "the plainest reading; varied below"),
        ("a buoy that leaves the water", TREATMENTS[scene.buoy.submergence], "eq. (30) as printed; varied below"),
        ("start of the waves, their phase", "all of it from t = 0, crest at the anchor", "“impulsively from rest”"),
        ("EI of the breaking line", of_line, "a solid rod; varied in the part `breaking_line`"),
        ("drag on the breaking line", "none, in air", "not mentioned"),
        ("grids, time steps, tolerances", "see each scene", "each part repeats runs tighter and finer"),
        ("where the buoy's motion is called periodic", f"to {percent(STROBE_TOLERANCE)} of its range", "not mentioned"),
    )
    return Table(heads, rows, "What had to be chosen to run section 4, and why it was chosen so.")


def _depth_text(results: Results) -> Text:
    row = results.dependence[0]
    above, drowned = (_all(results, key) for key in TREATED)
    return Text(
        f"Both waves at {count(len({row['depth_m'] for row in results.dependence}), 'depth')}, with "
        f"{listed(f'`{word}` ({TREATMENTS.get(word, word)})' for word in above)} above still water, and with buoyancy "
        f"{listed(f'`{word}` ({TREATMENTS.get(word, word)})' for word in drowned)}; everything else as shipped (EI = "
        f"{number(row['bending_stiffness_Nm2'])} N m²)."
    )


def _all(results: Results, key: str) -> list[str]:
    return list(dict.fromkeys(row[key] for row in results.dependence))


def curve(name: str, rows: list[dict], over: str) -> Curve:
    """Exponent over a column of the table, of the runs that ended as asked."""
    good = [row for row in rows if row["status"] == "ok"]
    columns = zip(*((row[over], row[_EXPONENT], row[_ERROR], row["regime"]) for row in good), strict=True)
    return Curve(name, *columns) if good else Curve(name, (), (), (), ())


def _depth_figure(results: Results) -> Figure:
    above, drowned = (_all(results, key) for key in TREATED)

    def curves(kA: float, under: str) -> list[Curve]:
        rows = {word: results.over_depth(kA, above_still_water=word, submergence=under) for word in above}
        return [curve(f"waves: {word}", found, "depth_m") for word, found in rows.items()]

    panels = [
        [(f"kA = {number(kA)}, buoyancy {under}", curves(kA, under)) for under in drowned] for kA in (SMALL, LARGE)
    ]
    seen = " ".join(_depth_words(results))
    caption = (
        "Largest Lyapunov exponent (tangent dynamics, one standard error) over the water depth, which the paper does "
        "not give (depths evenly spaced), for the treatments of waves above still water (colours) and of buoyancy "
        f"(columns); marks tell the regime. What to see: {seen} From `dependence/table.csv`."
    )
    alt = f"Exponent over water depth in {len(panels)} rows of panels: {seen}"
    return Figure(depth_exponents(panels, r"$H$ (m)"), caption, alt)


def _depth_words(results: Results) -> tuple[str, ...]:
    lines = []
    for kA in (SMALL, LARGE):
        rows = [
            row
            for row in results.dependence
            if row["steepness"] == kA and row["status"] == "ok" and _usual_stiffness(results, row)
        ]
        positive: dict[tuple[str, str], list[float]] = {}
        for row in sorted(rows, key=lambda row: row["depth_m"]):
            if row[_EXPONENT] - 2.0 * row[_ERROR] > 0.0:
                positive.setdefault((row["above_still_water"], row["submergence"]), []).append(row["depth_m"])
        kinds: dict[str, int] = {}
        for row in rows:
            kind = kind_of(row["regime"]) or "no verdict"
            kinds[kind] = kinds.get(kind, 0) + 1
        said = listed(f"{words} {kind}" for kind, words in sorted(kinds.items()))
        line = f"at kA = {number(kA)} {said} of {count(len(rows), 'run')}"
        where = "; ".join(
            f"{word}, {under}: H = {listed(map(number, depths))} m" for (word, under), depths in positive.items()
        )
        line += f". Exponents two errors above zero: {where}." if positive else ". No exponent two errors above zero."
        lines.append(line[0].upper() + line[1:])
    return tuple(lines)


def _usual_stiffness(results: Results, row: dict) -> bool:
    return row["bending_stiffness_Nm2"] == results.usual()["bending_stiffness_Nm2"]


def _regimes(results: Results, steepness: float) -> Table:
    above, drowned = (_all(results, key) for key in TREATED)
    pairs = [(word, under) for under in drowned for word in above]
    depths = sorted({row["depth_m"] for row in results.over_depth(steepness)})
    heads = (Column("H", "m"), *(Column(f"{word}, {under}", align="left") for word, under in pairs))
    by_place = [
        {row["depth_m"]: row for row in results.over_depth(steepness, above_still_water=word, submergence=under)}
        for word, under in pairs
    ]
    rows = tuple((number(depth), *(_cell(rows.get(depth)) for rows in by_place)) for depth in depths)
    caption = (
        f"Regime and largest exponent, bits per wave period, at kA = {number(steepness)}, by depth, treatment of the "
        "waves above still water and of buoyancy. From `dependence/table.csv`."
    )
    return Table(heads, rows, caption, small=True)


def _cell(row: dict | None) -> str:
    if row is None:
        return EMPTY
    if row["status"] != "ok":
        return row["status"]
    said = f"{row['regime'] or 'no verdict'}"
    if math.isfinite(row[_EXPONENT]):
        said += f", {decimals(row[_EXPONENT], 3)}\u00a0±\u00a0{decimals(row[_ERROR], 3)}"
    return said


def _stiffness(results: Results) -> list[Item]:
    usual = results.usual()
    rows = [row for row in results.dependence if all(row[key] == usual[key] for key in TREATED)]
    varied = {(row["steepness"], row["depth_m"]) for row in rows if not _usual_stiffness(results, row)}
    if not varied:
        return [Text("The stiffness was not varied.")]

    def at(steepness: float, depth: float) -> list[dict]:
        found = [row for row in rows if (row["steepness"], row["depth_m"]) == (steepness, depth)]
        return sorted(found, key=lambda row: row["bending_stiffness_Nm2"])

    panel = [
        [
            (
                f"kA = {number(kA)}",
                [curve(f"H = {number(H)} m", at(kA, H), "bending_stiffness_Nm2") for k, H in sorted(varied) if k == kA],
            )
            for kA in sorted({k for k, _ in varied})
        ]
    ]
    spread = []
    for kA, H in sorted(varied):
        good = [row for row in at(kA, H) if row["status"] == "ok"]
        ends = [(min(row[c] for row in good), max(row[c] for row in good)) for c in ("radius_min_m", "radius_max_m")]
        off = max(high - low for low, high in ends)
        kinds = listed(dict.fromkeys(kind_of(row["regime"]) or "no verdict" for row in good))
        at_ends = f"ends of the range of r within {number(off, 2)} m"
        spread.append(f"kA = {number(kA)}, H = {number(H)} m: {at_ends}; {kinds}")
    caption = (
        "Largest exponent over the bending stiffness of the tether, which the paper does not give. What to see: "
        f"{'; '.join(spread)}. A positive exponent of a run whose buoy repeats its motion belongs to the folds of the "
        "slack rope. From `dependence/table.csv`."
    )
    picture = depth_exponents(panel, r"$EI$ (N m$^2$)", log=True)
    return [Figure(picture, caption, f"Exponent over bending stiffness: {'; '.join(spread)}.")]


def _plane(results: Results) -> list[Item]:
    heading = Heading("Two dimensions or three", 2)
    if results.plane is None:
        return [heading, Text("The part `out_of_plane` is not there.")]
    try:
        pairs = read_pairs(results.plane)
    except FolderError:
        pairs = []
    return [heading, *comparison_items(results.plane, pairs)[1:]]
