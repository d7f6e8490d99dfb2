"""No timing: the picture of docs/results.md#out-of-the-water, from four sweeps. About five minutes on two cores.

    .venv/bin/python -m benchmarks.out_of_the_water FOLDER      # writes docs/out_of_the_water.png

Strobed radius over wave steepness at two depths, the whole sphere of eq. (30) beside the wetted cap. FOLDER/H-KIND are
the campaign's own folders: what is there already is not run again, and `python -m reports` makes a report of each.
"""

import sys
from pathlib import Path

import numpy as np

from benchmarks.shared import DOCS, command_line
from campaigns.buoy_sweep import main as sweep
from reports.buoy_sweep.runs import read_sweep
from reports.figures.curves import Curve, Panel, curves
from reports.parts.style import BLUE, VERMILION

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


def panel(folder, depth_m, kind):
    """Strobed radius over steepness."""
    name, colour = KINDS[kind]
    dots = [(run.value, r) for run in swept(folder, depth_m, kind) for r in run.section[:, 0]]
    curve = Curve(*np.array(dots).T, line="", mark="o", colour=colour, size=0.8)
    return Panel([curve], "wave steepness kA", "strobed radius r in m", f"H = {depth_m} m, {name}")


def main():
    parser = command_line(__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the four sweeps")
    folder = parser.parse_args().folder
    rows = [[panel(folder, depth_m, kind) for kind in KINDS] for depth_m in DEPTHS_M]
    (DOCS / "out_of_the_water.png").write_bytes(curves(rows, 5.0, share="xy", kind="png").data)


if __name__ == "__main__":
    main()
