"""Planar runs with loop release against runs in three dimensions: when is the planar run good enough?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..buoy_sweep.runs import strobed
from ..figures.section_pairs import section_pairs
from ..parts.content import Bullets, Column, Figure, Heading, Item, Table, Text
from ..parts.symbols import T_I
from ..parts.wording import EMPTY, count, decimals, listed, number, percent
from .runs import Run, Study

APART_M = 0.01  # distance of the two radii from which the runs count as parted
MOST_OFF = 0.01  # of the range of r: what the ends of the ranges may differ by
MOST_ACROSS = 1.5  # times the distance of the halves of one record


@dataclass(frozen=True, eq=False)
class Pair:
    """A planar run and the run in three dimensions of the same scene, with what only both together show.

    sections: r, r' of each after the transient; across, within: `analysis.section_distance`; parted: t/T_i at which the
    radii first differ by APART_M, NaN where they never do; before_m: their largest difference up to one period before
    the rope's first burst.
    """

    planar: Run
    spatial: Run
    sections: tuple[np.ndarray, np.ndarray]
    across: float
    within: float
    parted: float
    before_m: float

    @property
    def depth(self) -> str:
        return number(self.planar["depth_m"])

    @property
    def range_off(self) -> float:
        """Largest difference of the ends of the two ranges of r, by the planar range."""
        low, high = (abs(self.planar[key] - self.spatial[key]) for key in ("radius_min_m", "radius_max_m"))
        return max(low, high) / (self.planar["radius_max_m"] - self.planar["radius_min_m"])

    @property
    def exponents_agree(self) -> bool | None:
        """Wolf's exponents of r within two errors of their difference; None where one of them is missing."""
        column, error = "lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"
        if not (self.planar.known(column) and self.spatial.known(column)):
            return None
        off = abs(self.planar[column] - self.spatial[column])
        return bool(off <= 2.0 * math.hypot(self.planar[error], self.spatial[error]))

    @property
    def same_regime(self) -> bool | None:
        """The same word for both; None where one has none."""
        words = self.planar["regime"], self.spatial["regime"]
        return words[0] == words[1] if all(words) else None

    @property
    def tests(self) -> dict[str, bool | None]:
        """What the two runs are compared in: whether they agree, None where the records are too short to say."""
        return {
            "range of r": self.range_off <= MOST_OFF,
            "section": None if math.isnan(self.across) else self.across <= MOST_ACROSS * self.within,
            "exponent": self.exponents_agree,
            "regime": self.same_regime,
        }

    @property
    def lacking(self) -> list[str]:
        """In what the planar run is not the run in three dimensions."""
        return [name for name, passed in self.tests.items() if passed is False]

    @property
    def untold(self) -> list[str]:
        """In what the two could not be compared."""
        return [name for name, passed in self.tests.items() if passed is None]


def read_pairs(study: Study) -> list[Pair]:
    """Every planar run that ended as asked with loops released and has a counterpart, by depth."""
    pairs = []
    for planar in study.planar(depth_m=None):
        spatial = study.one(depth_m=planar["depth_m"])
        looped = planar.ok and planar["loop_releases"] > 0 and planar.known("radius_min_m")
        if not looped or spatial is None:
            continue
        flat, space = study.trajectory(planar), study.trajectory(spatial)
        if flat is not None and space is not None:
            pairs.append(_pair(planar, spatial, flat, space, study.transient))
    return pairs


def _pair(planar: Run, spatial: Run, flat, space, transient: int) -> Pair:
    from analysis import section_distance

    sections = strobed(flat, transient), strobed(space, transient)
    distance = section_distance(*sections)
    step_s, period_s = flat.scene.sample_step_s(), flat.scene.waves.period_s
    samples = min(len(run.columns["radius_m"]) for run in (flat, space))
    off = np.abs(flat.columns["radius_m"][:samples] - space.columns["radius_m"][:samples])
    first = spatial["rope_first_burst_period"]
    end = samples if math.isnan(first) else max(int((first - 1.0) * period_s / step_s), 1)
    apart = np.flatnonzero(off > APART_M)
    parted = float(apart[0]) * step_s / period_s if len(apart) else math.nan
    return Pair(planar, spatial, sections, distance.across, distance.within, parted, float(off[:end].max()))


def comparison_words(pairs: list[Pair]) -> str:
    """The answer in a sentence, "" without pairs."""
    if not pairs:
        return ""
    good = [pair for pair in pairs if not pair.lacking]
    releases = listed(number(pair.planar["loop_releases"]) for pair in pairs)
    what = (
        f"Planar runs with {releases} loop releases at H = {listed(pair.depth for pair in pairs)} m against runs in "
        "three dimensions"
    )
    untold = list(dict.fromkeys(name for pair in pairs for name in pair.untold))
    off = max(pair.range_off for pair in pairs)
    if len(good) == len(pairs) and untold:
        return (
            f"{what}: the ends of the ranges of r agree to {percent(off)} of the range. The records are too short to "
            f"compare {listed(untold)}, so whether the planar run is good enough for the buoy is not told."
        )
    if len(good) == len(pairs):
        return (
            f"{what}: for the buoy the planar run is good enough there. Range of r (to {percent(off)} of itself), "
            "section, exponent and regime agree within what one record leaves open; the planar run is no substitute "
            "for the rope's own shape in the loops, nor, once the runs have parted, for the buoy's path in time."
        )
    lines = [f"H = {pair.depth} m differs in {listed(pair.lacking)}" for pair in pairs if pair.lacking]
    return f"{what}: {'; '.join(lines)}; the planar run is good enough for the buoy in {len(good)} of {len(pairs)}."


def comparison_items(study: Study, pairs: list[Pair]) -> list[Item]:
    """The section: table, sections over each other, what follows."""
    heading = Heading("Planar with loop release, or three dimensions?")
    if not pairs:
        return [heading, Text("No planar run released loops and ended as asked, as its counterpart did.")]
    periods = number(pairs[0].planar["periods"] - study.transient)
    return [
        heading,
        Text(
            "In a plane a loop that is pulled tight cannot open, and the planar engine turns everything above it by 2π "
            "(a loop release); in three dimensions the loop leaves the plane by itself. The same scenes in both, "
            f"judged by the {periods} wave periods after the first {study.transient}, and both by their samples alone "
            "(`regime` without the tangent exponent, which runs in three dimensions do not have):"
        ),
        _table(pairs),
        _figure(pairs, study.transient),
        Bullets(tuple(_pair_words(pair) for pair in pairs)),
        Text(comparison_words(pairs)),
    ]


def _table(pairs: list[Pair]) -> Table:
    heads = (
        Column("H", "m"),
        Column("run", align="left"),
        Column("loops"),
        Column("turn", "rad"),
        Column("r min", "m"),
        Column("r max", "m"),
        Column("T max", "N"),
        Column("slack", "–"),
        Column("σ, Wolf", f"bits/{T_I}"),
        Column("σ, tangent", f"bits/{T_I}"),
        Column("regime", align="left"),
        Column("section: across"),
        Column("within"),
        Column("wall", "s"),
    )
    rows = []
    for pair in pairs:
        for name, run in (("planar", pair.planar), ("3-D", pair.spatial)):
            rows.append(
                (
                    pair.depth,
                    name,
                    number(run["loop_releases"]),
                    decimals(run["max_turn_rad"], 2),
                    decimals(run["radius_min_m"], 3),
                    decimals(run["radius_max_m"], 3),
                    decimals(run["tension_top_max_N"], 0),
                    decimals(run["slack_fraction"], 3),
                    _with_error(run, "wolf"),
                    _with_error(run, "tangent"),
                    run["regime"] or EMPTY,
                    decimals(pair.across, 3) if name == "planar" else "",
                    decimals(pair.within, 3) if name == "planar" else "",
                    decimals(run["wall_s"], 1),
                )
            )
    caption = (
        "Planar runs and their counterparts. loops: loop releases; turn: largest turn in one element; T: tension at "
        "the top; σ: largest exponent. Section: energy distance of the strobed r, r' of the two runs (0 equal, 1 "
        "apart), and, within, of the halves of each. From `table.csv` and the trajectories."
    )
    return Table(heads, tuple(rows), caption, small=True)


def _with_error(run: Run, name: str) -> str:
    found = run[f"lyapunov_{name}_bits_per_period"]
    if math.isnan(found):
        return EMPTY
    return f"{decimals(found, 3)}\u00a0±\u00a0{decimals(run[f'lyapunov_{name}_error'], 3)}"


def _figure(pairs: list[Pair], transient: int) -> Figure:
    picture = section_pairs([(f"H = {pair.depth} m", *pair.sections) for pair in pairs], ("planar", "three dimensions"))
    seen = "; ".join(
        f"{count(len(pair.sections[0]), 'point')} and {len(pair.sections[1])} at H = {pair.depth} m, "
        + (
            "too few for a distance"
            if math.isnan(pair.across)
            else f"distance {decimals(pair.across, 3)} (halves of one: {decimals(pair.within, 3)})"
        )
        for pair in pairs
    )
    caption = (
        f"Poincaré sections of planar runs with loop release and of runs in three dimensions, after {transient} wave "
        f"periods: {seen}. From `radius_m` and `radius_rate_mps`."
    )
    return Figure(picture, caption, f"Sections of planar and three-dimensional runs over each other: {seen}.")


def _pair_words(pair: Pair) -> str:
    parted = (
        "the radii never differ by a centimetre"
        if math.isnan(pair.parted)
        else f"the radii first differ by a centimetre at t = {number(pair.parted, 3)} wave periods"
    )
    first = pair.spatial["rope_first_burst_period"]
    before = "" if math.isnan(first) else f" (before the first loop, by {number(1e3 * pair.before_m, 2)} mm at most)"
    off = f"the ends of the ranges of r differ by {percent(pair.range_off)} of the range"
    verdict = (
        "no difference that one record would not show by itself"
        if not pair.lacking
        else (f"different in {listed(pair.lacking)}")
    )
    if pair.untold and not pair.lacking:
        verdict = f"too short to compare {listed(pair.untold)}"
    return f"H = {pair.depth} m: {parted}{before}; {off}; {verdict}."
