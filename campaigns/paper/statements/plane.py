"""Measures of section 4.2.2: eq. (33) with figure 19b, and the motion across the plane of the waves with figure 20."""

import math

from campaigns.machinery.folder import Row
from campaigns.paper.measured import STRANGE, Results
from campaigns.paper.measures import LARGE
from campaigns.paper.statements.judging import NOT_IN_DOUBT, at, each, passed
from campaigns.statements import Measured, shown

BODIES = ("buoy", "rope")


def strange(results: Results) -> Measured:
    """Largest exponent and Kaplan-Yorke dimension of the attractor of eq. (33)."""
    growth, growth_error, dimension, error = (results.number(name) for name in STRANGE)
    if not all(map(math.isfinite, (growth, growth_error, dimension, error))):
        return Measured()
    whole = min(abs(dimension - n) for n in (1, 2))
    checks = passed(
        ("exponent positive", growth > NOT_IN_DOUBT * growth_error),
        ("dimension not whole", whole > NOT_IN_DOUBT * error),
    )
    words = f"λ1 = {shown(growth, '.4f')} ± {shown(growth_error, '.4f')} bits a period; "
    return Measured(checks, f"{words}dimension {shown(dimension, '.3f')} ± {shown(error, '.3f')}")


def pushed(results: Results) -> list[Row]:
    """Runs of the large wave in three dimensions that were pushed out of the plane and ended as asked."""
    rows = _spatial(results, results.plane_large)
    return [row for row in rows if row["seed_direction"] != "along" and not row["profiles"]]


def calm(results: Results) -> list[Row]:
    """Runs of the small wave in three dimensions that ended as asked."""
    small = min((row["steepness"] for row in results.plane), default=LARGE)
    return [] if small == results.plane_large else _spatial(results, small)


def _spatial(results: Results, steepness: float) -> list[Row]:
    wanted = {"status": "ok", "steepness": steepness, "dimensions": 3}
    return [row for row in results.plane if wanted.items() <= row.items()]


def grows(row: Row) -> bool:
    """Whether the motion of buoy or rope across the plane grows exponentially."""
    return any(row[f"{body}_motion"] == "growth" for body in BODIES)


def planar(results: Results) -> Measured:
    """Largest lateral distance of any node of runs that were pushed along the waves."""
    rows = [row for row in results.plane if row["status"] == "ok" and row["seed_direction"] == "along"]
    most = [row["rope_lateral_max_m"] for row in rows if math.isfinite(row["rope_lateral_max_m"])]
    return Measured([("push along the waves", max(most))], f"{shown(max(most), '.3g')} m") if most else Measured()


def small_decays(results: Results) -> Measured:
    """How many runs of the small wave grow."""
    rows = calm(results)
    growing, decaying = sum(map(grows, rows)), sum(row["buoy_motion"] == row["rope_motion"] == "decay" for row in rows)
    words = f"{growing} of {len(rows)} runs grow, {decaying} decay exponentially" if rows else ""
    return Measured([("all pushes, depths, stiffnesses, grids", growing)] if rows else [], words)


def large_grows(results: Results) -> Measured:
    """At which depths a run of the large wave grows."""
    rows = pushed(results)
    depths = {at(row): row["depth_m"] for row in sorted(rows, key=lambda row: row["depth_m"])}
    checks = [(where, any(grows(row) for row in rows if row["depth_m"] == H)) for where, H in depths.items()]
    bursts = sum(row["rope_motion"] == "bursts" for row in rows)
    words = f"{sum(map(grows, rows))} of {len(rows)} runs grow exponentially; in {bursts} the rope bursts"
    return Measured(passed(*checks), words if rows else "")


def comparable(results: Results) -> Measured:
    """Largest lateral distance of buoy and rope over half the range of the buoy in the plane."""
    most = {}
    for body in BODIES:
        known = [row for row in pushed(results) if math.isfinite(row[f"{body}_share_of_inplane"])]
        if not known:
            return Measured()
        most[body] = max(known, key=lambda row: row[f"{body}_share_of_inplane"])
    words = ", ".join(
        f"{body} {shown(row[f'{body}_share_of_inplane'], '.3%')} ({shown(row[f'{body}_lateral_max_m'], '.2g')} m)"
        for body, row in most.items()
    )
    return Measured([("buoy", most["buoy"]["buoy_share_of_inplane"])], words)


def spatial(results: Results) -> Measured:
    """Largest lateral distance of the rope, m, at every depth."""
    most: dict[str, float] = {}
    for row in sorted(pushed(results), key=lambda row: row["depth_m"]):
        if math.isfinite(row["rope_lateral_max_m"]):
            most[at(row)] = max(most.get(at(row), 0.0), row["rope_lateral_max_m"])
    return each(most.items(), ".2g")
