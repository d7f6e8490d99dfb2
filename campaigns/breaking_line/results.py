"""What the campaign writes beside its table: statements.csv, and exact.nc, what exact theory says to the figures.

exact.nc (netCDF, opens in xarray) holds, padded with nan along `point`:

    time_s, place_m (curve, point)      exact characteristics that leave the broken end when its force is `share` of the
                                        static one, and the shock (share nan), of case `curve_case`
    contour_strain, contour_speed_mps, contour_wave_mps (contour)     measured speeds of contours of tension towards the
                                        fixed end, and √(T′/m) at their strain, of case `contour_case`
    wave_strain, wave_mps (strain)      √(T′/m)
"""

from collections.abc import Sequence
from itertools import zip_longest

import numpy as np

from campaigns.breaking_line.judging import Results, claims
from campaigns.breaking_line.lines import ended, motion_of, read_lines
from campaigns.breaking_line.motion_measures import contour_speed
from campaigns.breaking_line.theory import Theory, theory_of
from campaigns.figure_data import attribute_of, store
from campaigns.machinery import Plan, Summary, made_by
from campaigns.statements import write_statements

EXACT = "exact.nc"
SHARES = (0.99, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01)  # of the static tension: contours and characteristics that are shown
WAVES = 200  # strains of the curve of wave speed


def write_results(plan: Plan, summary: Summary) -> float:
    """statements.csv, and exact.nc where the law has a theory. Raises OSError. Returns 0, no seconds of analysis."""
    folder = plan.how.out
    results = Results(read_lines(folder))
    write_statements(folder, claims().values(), results)
    cases, path = ended(results.lines), folder / EXACT
    runs_of_cases = [line["run_key"] for line in cases.values()]
    key = made_by("analysis", "engine", "campaigns/breaking_line", runs=runs_of_cases)
    if attribute_of(path) == key:
        return 0.0
    runs = {}
    for case, line in cases.items():
        run = motion_of(folder, line)
        if run is not None and run.profiles is not None:
            runs[case] = run
    content = exact(runs)
    if content is None:
        path.unlink(missing_ok=True)
    else:
        store(path, content.assign_attrs(made_by=key))
    return 0.0


def exact(runs: dict):
    """The content of exact.nc, an xarray.Dataset, of trajectories with profiles by case; None where none has theory."""
    import xarray

    curves, contours, wave_speed = [], [], None
    for case, run in runs.items():
        theory = theory_of(run.scene, float(run.columns["time_s"][-1]))
        if theory is None:
            continue
        wave_speed = theory.wave_speed
        for share in (*SHARES, 0.0):
            curves.append((case, share, *theory.falling(share)))
        path = theory.motion.shock
        if theory.shocked and len(path.time_s):
            curves.append((case, np.nan, path.time_s, path.place_m))
        for contour in measured_contours(run.profiles, theory):
            contours.append((case, *contour))
    if wave_speed is None or not contours:
        return None
    cases, shares, times_s, places_m = zip(*curves, strict=True)
    variables = {"time_s": (("curve", "point"), padded(times_s)), "place_m": (("curve", "point"), padded(places_m))}
    variables |= {"curve_case": ("curve", list(cases)), "share": ("curve", list(shares))}
    names = ("contour_case", "contour_strain", "contour_speed_mps", "contour_wave_mps")
    variables |= {name: ("contour", list(row)) for name, row in zip(names, zip(*contours, strict=True), strict=True)}
    _, largest_strain, _, _ = max(contours, key=lambda contour: contour[1])
    strain = np.linspace(0.0, 1.08 * largest_strain, WAVES)
    variables |= {"wave_strain": ("strain", strain), "wave_mps": ("strain", wave_speed(strain))}
    return xarray.Dataset(variables)


def padded(curves: Sequence[np.ndarray]) -> np.ndarray:
    """Curves of different lengths as one array (curve, point), nan behind the end of the shorter ones."""
    points = list(zip_longest(*curves, fillvalue=np.nan))
    return np.array(points).T


def measured_contours(profiles: object, theory: Theory) -> list[tuple]:
    """(strain, speed, wave speed) of each contour of SHARES that can be followed; none that a shock eats."""
    contours = []
    for share in SHARES:
        if theory.swallowed(share):
            continue
        speed = contour_speed(profiles, profiles.tension_N, share * theory.force_N, theory)
        if np.isfinite(speed):
            strain = theory.strain_at(share)
            contours.append((strain, speed, float(theory.wave_speed(strain))))
    return contours
