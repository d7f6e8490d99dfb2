"""What the answer of section 4.2 depends on: both waves with other answers to what the paper leaves out.

The depth, at every treatment of the waves above still water and of a buoy that leaves it; the bending stiffness, at the
depths where the large wave leads to different motions. Runs carry a perturbation, so each has an exponent and a regime
(`campaigns.explore.rows`); they go side by side in the lanes.
"""

from itertools import product
from pathlib import Path
from typing import get_args

from campaigns.explore.grid import STEEPNESS
from campaigns.explore.rows import COLUMNS as OF_A_RUN
from campaigns.explore.sweep import measures_of
from campaigns.machinery import Summary, claimed, filled
from campaigns.machinery.cli import Running
from campaigns.study import Measures, Order, Study
from tables import DEPTH, STIFFNESS, of_words
from tables import PAPER_STEEPNESS as STEEPNESSES

SCENE = "tethered_buoy"
DEPTHS_M = (20.8, 21.0, 21.3, 21.6, 22.0, 22.5, 23.0, 25.0)
STIFFNESSES_NM2 = (0.04, 0.1, 0.4, 1.0, 4.0)
STIFFNESS_DEPTHS_M = (21.0, 21.6, 22.5)
PERIODS, TRANSIENT = 400, 100
QUICK_DEPTHS_M, QUICK_PERIODS, QUICK_TRANSIENT = (21.0, 22.5), 45, 5

ABOVE = of_words("above_still_water", "treatment of the waves above still water", "above water")
DROWNED = of_words("submergence", "treatment of a buoy that leaves the water")
VARIED = {  # column that names a run -> key of the scene
    STEEPNESS: "waves.steepness",
    DEPTH: "water.depth_m",
    ABOVE: "waves.above_still_water",
    DROWNED: "buoy.submergence",
    STIFFNESS: "tether.bending_stiffness_Nm2",
}
CARRIED = {"output.tangent_vectors": 1, "output.lateral_growth": True}
COLUMNS = (*VARIED, *(column for column in OF_A_RUN if column not in VARIED))


def treatments() -> tuple[tuple, tuple]:
    """All that a scene allows: of waves above still water, and of a buoy that leaves the water."""
    from engine.scene.sections import Buoy, Waves

    waves, buoy = Waves.model_fields["above_still_water"], Buoy.model_fields["submergence"]
    return get_args(waves.annotation), get_args(buoy.annotation)


def variants(quick: bool) -> list[tuple]:
    """Every run, each once, as the values of VARIED; the scene as shipped leads."""
    from engine import load_scene

    scene = load_scene(SCENE)
    EI, depth_m = scene.tether.bending_stiffness_Nm2, scene.water.depth_m
    usual = scene.waves.above_still_water, scene.buoy.submergence
    depths = QUICK_DEPTHS_M if quick else DEPTHS_M
    places = [(kA, depth_m, *usual, EI) for kA in reversed(STEEPNESSES)]
    places += product(STEEPNESSES, depths, *treatments(), [EI])
    if not quick:
        # In small waves the line never goes slack, and EI changes nothing: one depth shows it.
        small, large = STEEPNESSES
        waves_and_depths = [(small, depth_m), *product([large], STIFFNESS_DEPTHS_M)]
        for (kA, H), EI in product(waves_and_depths, STIFFNESSES_NM2):
            places.append((kA, H, *usual, EI))
    return list(dict.fromkeys(places))


def changes(values: tuple) -> dict:
    """The changes of the scene that make it a variant."""
    return dict(zip(VARIED.values(), values, strict=True)) | CARRIED


def parameters(quick: bool) -> dict:
    """What the provenance says of this part."""
    above, submergence = treatments()
    settings = {
        "steepness": list(STEEPNESSES),
        "depths_m": list(DEPTHS_M),
        "above_still_water": list(above),
        "submergence": list(submergence),
        "stiffnesses_Nm2": list(STIFFNESSES_NM2),
        "stiffness_depths_m": list(STIFFNESS_DEPTHS_M),
        "periods": PERIODS,
        "transient": TRANSIENT,
    }
    if quick:
        settings |= {"depths_m": list(QUICK_DEPTHS_M), "stiffnesses_Nm2": [], "stiffness_depths_m": []}
        settings |= {"periods": QUICK_PERIODS, "transient": QUICK_TRANSIENT}
    return settings


def measures(order: Order) -> Measures:
    """The row of the buoy sweep, after the columns that name a run."""
    return measures_of(order, COLUMNS)


def run(out: Path, jobs: int, quick: bool) -> Summary:
    """Do the runs that are not there yet; table.csv and trajectories in `out`. Raises as `Study.work`."""
    settings = parameters(quick)
    running = Running(out, jobs, "loky", None, report=False)
    order = Order(running, name=SCENE, periods=settings["periods"], transient=settings["transient"])
    for values in variants(quick):
        order.cases.append(order.case(filled(VARIED, values), changes(values)))
    with claimed(out):
        study = Study("dependence", __doc__, scene=SCENE, cases=lambda order: order.cases, measures=measures)
        return study.work(order)
