"""No timing: the picture of docs/out_of_the_water.md, from four sweeps. About five minutes on two cores.

    .venv/bin/python -m benchmarks.out_of_the_water FOLDER      # writes docs/out_of_the_water.png

Strobed radius over wave steepness at two depths, the whole sphere of eq. (30) beside the wetted cap. FOLDER/H-KIND are
the campaign's own folders: what is there already is not run again, and `python -m reports` makes a report of each.
"""

import sys
from pathlib import Path

import numpy as np

from campaigns.buoy_sweep import main as sweep
from reports.buoy_sweep.runs import read_sweep
from reports.parts.style import BLUE, VERMILION, sheet

FIGURE = Path(__file__).parents[1] / "docs" / "out_of_the_water.png"
DEPTHS_M = (21.0, 22.5)
KINDS = {"full": ("whole sphere (eq. (30))", BLUE), "spherical-cap": ("wetted cap", VERMILION)}
STEEPNESS, LENGTH = ["0.016", "0.16", "28"], ["--periods", "300", "--transient", "100"]


def swept(folder, depth_m, kind):
    """The runs of one sweep (`reports.buoy_sweep.runs`), made where they are not there yet."""
    out = folder / f"{depth_m}-{kind}"
    change = ["--set", f"water.depth_m={depth_m}", f"buoy.submergence={kind}"]
    # no tighter and finer companions: the picture does not show them
    code = sweep(["--steepness-range", *STEEPNESS, *LENGTH, *change, "--no-accuracy", "--no-report", "--out", str(out)])
    if code:
        sys.exit(code)
    return read_sweep(out).runs


def draw(runs_of):
    """runs_of: (depth, kind) -> runs. Writes the picture."""
    with sheet(5.0) as figure:
        panels = figure.subplots(len(DEPTHS_M), len(KINDS), sharex=True, sharey="row")
        for row, depth_m in zip(panels, DEPTHS_M, strict=True):
            row[0].set_ylabel("strobed radius r in m")
            for axis, (kind, (name, colour)) in zip(row, KINDS.items(), strict=True):
                axis.set_title(f"H = {depth_m} m, {name}")
                for run in runs_of[depth_m, kind]:
                    r = run.section[:, 0]
                    axis.plot(np.full(len(r), run.steepness), r, ".", markersize=1.6, markeredgewidth=0, color=colour)
        for axis in panels[-1]:
            axis.set_xlabel("wave steepness kA")
        figure.savefig(FIGURE, dpi=160, metadata={"Software": None})


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python -m benchmarks.out_of_the_water FOLDER")
    folder = Path(sys.argv[1])
    draw({(depth_m, kind): swept(folder, depth_m, kind) for depth_m in DEPTHS_M for kind in KINDS})
    print(f"{FIGURE}: {FIGURE.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
