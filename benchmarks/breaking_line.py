"""Shock capturing of the breaking line: figures and tables of docs/results.md#the-breaking-line. About three minutes.

    .venv/bin/python -m benchmarks.breaking_line        # writes docs/breaking_line_*.png

1. The eight cases of the paper as the campaign runs them, on two processes: wall time; figures of the report.
2. Case 4 without gravity on even grids: error, ripples and place of the shock over viscosity, step and damping.
"""

import math
import tempfile

import numpy as np

from benchmarks.shared import DOCS, command_line, shrink
from campaigns import breaking_line
from campaigns.breaking_line import motion_measures as measures
from campaigns.breaking_line.theory import theory_of
from engine import load_scene, simulate
from reports.breaking_line.figures import folds_figure, plane_figure
from reports.breaking_line.runs import read_exact, read_lines
from reports.parts.folder import read_folder

GRIDS = (401, 801)
CHOICES = {  # beside what is shipped: c_q = 1, c_l = 0.2, Courant number 1, rho_inf = 0.5
    "solver.shock_viscosity.linear": (0.2, 0.1, 0.3, 0.5),
    "solver.shock_viscosity.quadratic": (0.5, 2.0),
    "solver.courant": (0.5, 0.25, 2.0),
    "solver.spectral_radius": (0.8, 0.2, 0.0),
}


def straight(nodes, **changes):
    """Case 4 without gravity on an even grid."""
    even = {"tether.nodes": nodes, "tether.grid_stretching": 0.0, "tether.grid_refined": "both"}
    plain = {"gravity_mps2": 0.0, "end.force_N": [450e3, 0.0, 0.0], **even}
    return load_scene("breaking_line", {**plain, **changes})


def captured(nodes, theory, changes):
    """One row: mean error of strain, overshoot, rise, shock off by elements; nan where the run fails."""
    run = simulate(straight(nodes, **changes), duration_s=theory.arrival_s)
    if run.status != "ok":
        return [math.nan] * 4
    above, rise = measures.strain_overshoot(run.profiles, 0.98 * theory.arrival_s)
    _, places, exact = measures.shock_track(run.profiles, theory)
    off = np.median(np.abs(places - exact)) * (nodes - 1) / theory.length_m
    return [1e6 * measures.strain_error(run.profiles, theory), 100 * above, 100 * rise, off]


def table():
    theory = theory_of(straight(GRIDS[0]), 0.2)
    print("| | error at 401, 801 nodes, 1e-6 | order | overshoot, % | rise, % | shock off, elements |")
    print("|---|---|---|---|---|---|")
    for key, value in [(key, value) for key, values in CHOICES.items() for value in values]:
        coarse, fine = (captured(nodes, theory, {key: value}) for nodes in GRIDS)
        order = math.log2(coarse[0] / fine[0])
        cells = [f"{a:.3g}, {b:.3g}" for a, b in zip(coarse, fine, strict=True)]
        print(f"| {key} = {value:g} | {cells[0]} | {order:.2f} | {cells[1]} | {cells[2]} | {cells[3]} |")


def eight():
    with tempfile.TemporaryDirectory() as place:
        breaking_line.main(["--no-companions", "--no-report", "--jobs", "2", "--out", place])
        folder = read_folder(place)
        lines = read_lines(folder)
        for name, figure in (("fronts", plane_figure(lines, read_exact(folder))), ("folds", folds_figure(lines))):
            path = DOCS / f"breaking_line_{name}.{figure.picture.kind}"
            path.write_bytes(figure.picture.data)
            if path.suffix == ".png":
                shrink(path, 256)
        print(f"eight cases, two processes: {folder.provenance['timing']['run_s']:.1f} s")


if __name__ == "__main__":
    command_line(__doc__).parse_args()
    eight()
    table()
