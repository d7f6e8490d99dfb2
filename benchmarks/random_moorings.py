"""No timing: whether moorings drawn at random rest and run, and how far the largest tensions of their sweeps hold.

    .venv/bin/python -m benchmarks.random_moorings --seed 1 --count 150       # a mooring takes about a second
    .venv/bin/python -m benchmarks.random_moorings --seed 1 --count 20 --rows     # half a minute with its rows

A mooring is what somebody may answer to `python -m engine --new`: a floating, slack or submerged buoy on one of five
ropes, 5 to 600 m of water, waves, and in every third of them a current. Mooring N of a seed is always the same.

ended       status of a run of 15 wave periods
mirrored    moorings in a current whose rest is not the mirror image of that in the opposite current: another status, or
            another tension at the top by a thousandth
rows        of `campaigns.sweep` from rest at three amplitudes. The reference goes on from the end of a row for 120 wave
            periods with four times the elements at a sixteenth of the tolerance; its first third is left out. A row is
            off where the largest tension differs by more than the stated error and a thousandth of itself
"""

import math
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.random_scenes import Draw
from benchmarks.shared import command_line
from campaigns.sweep import sweep
from engine import Scene, SceneError, Trajectory, simulate
from engine.own_mooring.ropes import materials, rope_of
from engine.own_mooring.scene import Mooring, scene_text
from engine.run.rest import rest_of
from engine.scene import scene_from_toml
from engine.scene.finer import finer

KINDS = {"floating": (0.95, 1.0), "slack": (1.005, 1.6), "submerged": (0.4, 0.95)}  # lengths over the depth
PERIODS, REFERENCE = 15, 120  # wave periods
SHARES = 0.6, 0.8, 1.0  # of the amplitude, in a sweep
ELEMENTS, STEPS = 4, 16  # times as many, and as tight
CLOSE = 1e-3  # of a tension


def short(value: float) -> float:
    """With three digits, as somebody would answer."""
    return float(f"{value:.3g}")


def drawn(seed: int, number: int) -> Mooring:
    """A mooring."""
    draw = Draw(seed, number)
    material, kind = draw.choice((*materials(),)), draw.choice((*KINDS,))
    depth_m, diameter_m = short(draw.scale(5.0, 600.0)), short(draw.scale(0.4, 6.0))
    period_s = short(draw.between(3.0, 12.0))
    thickest_mm = 14.0 if material == "wire" else 30.0
    rope = rope_of(material, 1e-3 * short(draw.scale(6.0, max(thickest_mm * diameter_m**0.7, 7.0))))
    height_m = short(min(1.56 * period_s**2 * draw.between(0.02, 0.1), 0.5 * depth_m))
    current_mps = short(draw.between(-1.0, 1.0)) if draw.chance(1 / 3) else 0.0
    length_m = short(depth_m * draw.between(*KINDS[kind]))
    return Mooring(diameter_m, depth_m, rope, length_m, height_m, period_s, current_mps)


def scene_of(mooring: Mooring) -> Scene | None:
    """Its scene; None where `--new` or the scene refuses it."""
    if mooring.faults():
        return None
    try:
        return scene_from_toml(scene_text(mooring, "mine"))
    except SceneError:
        return None


def is_mirrored(scene: Scene) -> bool:
    """Whether the rest in the opposite current is the mirror image."""
    x_mps, *across = scene.current.velocity_mps
    there, here = rest_of(scene.with_values("current", velocity_mps=(-x_mps, *across))), rest_of(scene)
    return there.status == here.status and math.isclose(there.top_N, here.top_N, rel_tol=CLOSE, abs_tol=CLOSE)


def errors_of_rows(scene: Scene) -> Iterator[tuple[float, float]]:
    """Difference and stated error of the largest tension of each row, over that tension; rows without one are left."""
    amplitudes_m = [share * scene.waves.amplitude_m for share in SHARES]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "rows")
        try:
            table = sweep(scene, "waves.amplitude_m", amplitudes_m, starts="rest", jobs=1, out=out, report=False)
        except ValueError:  # waves that are not linear there
            return
        for row in table.to_dict("records"):
            if not math.isfinite(row["tension_top_max_error_N"]):
                continue
            run = Trajectory.load(out / "trajectories" / f"{row['run_key']}.nc")
            changes = {"output.tangent_vectors": 0, "waves.ramp_s": 0.0}
            reference = finer(run.scene, elements=ELEMENTS, steps=STEPS, changes=changes)
            later = simulate(reference, periods=REFERENCE, start=run.final_state.at_zero())
            if later.status == "ok":
                high_N, largest_N = later.columns["tension_top_high_N"], row["tension_top_max_N"]
                difference = abs(float(high_N[len(high_N) // 3 :].max()) - largest_N)
                yield difference / largest_N, row["tension_top_max_error_N"] / largest_N


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--rows", action="store_true", help="sweeps of those that end as asked, with references")
    options = parser.parse_args()
    ended, mirrored, rows = Counter(), Counter(), []
    for number in range(options.count):
        mooring = drawn(options.seed, number)
        scene = scene_of(mooring)
        if scene is None:
            ended["refused"] += 1
            continue
        run = simulate(scene, periods=PERIODS)
        ended[run.status] += 1
        if run.status != "ok":
            print(f"mooring {number}: {scene.title}: {run.message}")
        if scene.current is not None:
            mirrored[is_mirrored(scene)] += 1
        if options.rows and run.status == "ok":
            for difference, stated in errors_of_rows(scene):
                rows.append((difference, stated))
                if difference > max(stated, CLOSE):
                    print(f"mooring {number}: {scene.title}: off by {difference:.2%}, stated {stated:.2%}")
    print(f"ended: {dict(ended)}")
    print(f"in a current: {mirrored[True]} mirrored, {mirrored[False]} not")
    if rows:
        difference, stated = np.array(rows).T
        off = int((difference > np.maximum(stated, CLOSE)).sum())
        medians = f"{np.median(difference):.2%}, stated {np.median(stated):.2%}"
        print(f"rows: {len(rows)}, off {off}; median difference {medians}")


if __name__ == "__main__":
    main()
