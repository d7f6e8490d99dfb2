"""Planar runs with loop release against runs in three dimensions: when is the planar run good enough?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..buoy_sweep.runs import strobed
from ..figures.motion import section_pairs
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.symbols import T_I
from ..parts.wording import decimals, listed, number, percent
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


def comparison_items(study: Study, pairs: list[Pair]) -> list[Item]:
    """The section: runs, what they are compared in, sections over each other."""
    heading = Heading("Planar with loop release, or three dimensions?")
    if not pairs:
        return [heading, Text("No planar run released loops and ended as asked, as its counterpart did.")]
    periods = number(pairs[0].planar["periods"] - study.transient)
    runs = [run for pair in pairs for run in (pair.planar, pair.spatial)]
    names = [
        "depth_m", "dimensions", "loop_releases", "max_turn_rad", "radius_min_m", "radius_max_m", "tension_top_max_N",
        "slack_fraction", ("lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"),
        ("lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"), "regime", "wall_s",
    ]  # fmt: skip
    return [
        heading,
        Text(
            "In a plane a loop that is pulled tight cannot open, and the planar engine turns everything above it by 2π "
            "(a loop release); in three dimensions the loop leaves the plane by itself. The same scenes in both, "
            f"judged by the {periods} wave periods after the first {study.transient}, and both by their samples alone "
            "(`regime` without the tangent exponent, which runs in three dimensions do not have):"
        ),
        study.table(names, runs, "Planar runs (D = 2) and their counterparts (D = 3)."),
        _compared(pairs),
        _figure(pairs, study.transient),
    ]


def _compared(pairs: list[Pair]) -> Table:
    """What the runs of each pair differ in, by the tests of `Pair`."""
    words = {True: "same", False: "different", None: "too short"}
    heads = (
        Column("H", "m"), Column("apart at", T_I), Column("before", "mm"), Column("ends of r"), Column("across"),
        Column("within"), *(Column(name, align="left") for name in pairs[0].tests),
    )  # fmt: skip
    rows = tuple(
        (
            pair.depth, number(pair.parted, 3), number(1e3 * pair.before_m, 2), percent(pair.range_off),
            decimals(pair.across, 3), decimals(pair.within, 3), *(words[passed] for passed in pair.tests.values()),
        )
        for pair in pairs
    )  # fmt: skip
    caption = (
        "What the runs of a pair differ in. apart at: when the radii first differ by a centimetre; before: their "
        "largest difference before the first loop; ends of r: difference of the ends of the ranges by the range; "
        "across, within: energy distance of the strobed r, r' of the two runs (0 equal, 1 apart), and of the halves "
        f"of each. Same is a range within {percent(MOST_OFF)}, a section within {number(MOST_ACROSS)} times the "
        "halves, an exponent within two errors."
    )
    return Table(heads, rows, caption, small=True)


def _figure(pairs: list[Pair], transient: int) -> Figure:
    picture = section_pairs([(f"H = {pair.depth} m", *pair.sections) for pair in pairs], ("planar", "three dimensions"))
    seen = listed(f"{len(pair.sections[0])} and {len(pair.sections[1])} points at H = {pair.depth} m" for pair in pairs)
    caption = (
        f"Poincaré sections of planar runs with loop release and of runs in three dimensions, after {transient} wave "
        f"periods: {seen}. From `radius_m` and `radius_rate_mps`."
    )
    return Figure(picture, caption, f"Sections of planar and three-dimensional runs over each other: {seen}.")
