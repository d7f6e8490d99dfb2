"""Section 4.2.2: eq. (33) with figure 19b, and the motion across the plane of the waves with figure 20."""

from __future__ import annotations

import math

from ...out_of_plane.verdict import COMPARABLE, calm_runs, large_runs
from ...parts.statements import Statement
from ...parts.wording import count, decimals, number, percent
from ..results import Results
from .rows import NOT_IN_DOUBT

SAME_NUMBER = 0.05
VISIBLE_M = 0.1  # lateral distance from which a motion of the rope is three-dimensional


def strange(results: Results) -> Statement:
    study = results.oscillator
    claim = "The section of eq. (33) shows the fractal structure of a strange attractor."
    names = ("lambda_1_bits_per_period", "lambda_1_bits_error", "section_dimension", "section_dimension_error")
    values = [study.number("exponents", name) for name in names] if study is not None else [math.nan]
    if not all(map(math.isfinite, values)):
        return Statement(claim, "No run shows it.", ())
    growth, growth_error, dimension, error = values
    found = (
        f"λ1 = {decimals(growth, 4)} ± {decimals(growth_error, 4)} bits a period; Kaplan-Yorke dimension of the "
        f"section {decimals(dimension, 3)} ± {decimals(error, 3)}."
    )
    whole = min(abs(dimension - n) for n in (1, 2))
    checks = (
        ("exponent positive", growth > NOT_IN_DOUBT * growth_error),
        ("dimension not whole", whole > NOT_IN_DOUBT * error),
    )
    return Statement(claim, found, checks, "two errors above zero, and off 1 and 2")


def normalised(results: Results) -> Statement:
    claim = "In eq. (33) all is normalised by the buoy's mass and diameter and the radial natural frequency."
    own, study = results.scales, results.oscillator
    if own is None or study is None:
        return Statement(claim, "No run shows it.", ())
    pairs = (
        ("ω", own.frequency, study.oscillator["frequency"]),
        ("B − W", own.lift, study.oscillator["lift"]),
        ("F", own.force, study.oscillator["force"]),
    )
    told = ", ".join(f"{name} = {number(a, 3)} ({number(b, 3)})" for name, a, b in pairs)
    found = f"So normalised table 1 and the large wave give, added mass included (printed): {told}."
    checks = tuple((name, abs(a / b - 1.0) < SAME_NUMBER) for name, a, b in pairs)
    return Statement(claim, found, checks, f"each within {percent(SAME_NUMBER)} of the number of fig. 19b")


def planar(results: Results) -> Statement:
    study = results.plane
    claim = "Waves symmetric about the plane of the static system move buoy and line in that plane."
    runs = [run for run in study.runs if run.ok and run["seed_direction"] == "along"] if study is not None else []
    runs = [run for run in runs if run.known("rope_lateral_max_m")]
    if not runs:
        return Statement(claim, "No run shows it.", ())
    most = max(run["rope_lateral_max_m"] for run in runs)
    found = f"Pushed along the waves, in three dimensions: largest lateral distance of any node {number(most)} m."
    return Statement(claim, found, (("push along the waves", most == 0.0),), "exactly none")


def small_decays(results: Results) -> Statement:
    claim = "In small waves a disturbance across the plane does not grow."
    runs = calm_runs(results.plane) if results.plane is not None else []
    growing = [run for run in runs if "growth" in (run["buoy_motion"], run["rope_motion"])]
    decaying = [run for run in runs if run["buoy_motion"] == run["rope_motion"] == "decay"]
    if not runs:
        return Statement(claim, "No run shows it.", ())
    found = f"Of {count(len(runs), 'run')} {len(growing)} grow and {len(decaying)} decay exponentially."
    return Statement(claim, found, (("all pushes, depths, stiffnesses, grids", not growing),), "no run grows")


def _pushed(results: Results) -> list:
    runs = large_runs(results.plane) if results.plane is not None else []
    return [run for run in runs if not run["profiles"]]


def large_grows(results: Results) -> Statement:
    claim, runs = "In large waves a disturbance across the plane grows exponentially.", _pushed(results)
    if not runs:
        return Statement(claim, "No run shows it.", ())
    growing = [run for run in runs if "growth" in (run["buoy_motion"], run["rope_motion"])]
    bursts = [run for run in runs if run["rope_motion"] == "bursts"]
    found = f"Of {count(len(runs), 'run')} {len(growing)} grow exponentially; in {len(bursts)} the rope bursts."
    depths = sorted({run["depth_m"] for run in runs})
    checks = tuple((f"H = {number(H)} m", any(run["depth_m"] == H for run in growing)) for H in depths)
    return Statement(claim, found, checks, "an exponential growth of buoy or rope at that depth")


def _share(runs: list, body: str):
    known = [run for run in runs if run.known(f"{body}_share_of_inplane")]
    return max(known, key=lambda run: run[f"{body}_share_of_inplane"]) if known else None


def comparable(results: Results) -> Statement:
    claim = "In large waves the motion of the buoy across the plane becomes comparable with that in it."
    runs = _pushed(results)
    buoy, rope = (_share(runs, body) for body in ("buoy", "rope"))
    if buoy is None or rope is None:
        return Statement(claim, "No run shows it.", ())
    shares = buoy["buoy_share_of_inplane"], rope["rope_share_of_inplane"]
    found = (
        f"Largest share of the in-plane half range of the buoy: buoy {percent(shares[0])} "
        f"({number(1e3 * buoy['buoy_lateral_max_m'], 2)} mm), rope {percent(shares[1])} "
        f"({number(rope['rope_lateral_max_m'], 2)} m)."
    )
    return Statement(claim, found, (("buoy", shares[0] >= COMPARABLE),), f"{percent(COMPARABLE)} or more")


def spatial(results: Results) -> Statement:
    claim, runs = "In large waves the response as a whole becomes three-dimensional (rope included).", _pushed(results)
    runs = [run for run in runs if run.known("rope_lateral_max_m")]
    if not runs:
        return Statement(claim, "No run shows it.", ())
    depths = sorted({run["depth_m"] for run in runs})
    most = {H: max(run["rope_lateral_max_m"] for run in runs if run["depth_m"] == H) for H in depths}
    words = ", ".join(f"{number(most[H], 2)} m at H = {number(H)} m" for H in depths)
    checks = tuple((f"H = {number(H)} m", most[H] > VISIBLE_M) for H in depths)
    return Statement(claim, f"Largest lateral distance of the rope: {words}.", checks, f"{number(VISIBLE_M)} m or more")


PUSHES = "size and direction of the push, depth, stiffness and grid varied (report out of the plane)"
STATEMENTS = (
    ("4.2.2, eq. (33)", normalised, "closed form: table 1, dispersion relation"),
    ("4.2.2, eq. (33), fig. 19b", strange, "exact motion, closed form in each piece; λ1 + λ2 = −μ (report on eq. 33)"),
    ("4.2, 4.2.2", planar, "exact symmetry of the scheme"),
    ("4.2.2, fig. 20", small_decays, f"exponent of an infinitesimal perturbation of planar runs agrees; {PUSHES}"),
    ("4.2.2, fig. 20", large_grows, PUSHES),
    ("4.2.2, fig. 20", comparable, PUSHES),
    ("4.2.2, fig. 20", spatial, PUSHES),
)
