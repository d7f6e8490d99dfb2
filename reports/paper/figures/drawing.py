"""What every figure of the paper says of its data: single numbers, ranges, and the results that are behind them.

The data are one netCDF-3 file, which its campaign wrote. Arrays carry `units` and `long_name`.
"""

import json
from types import SimpleNamespace

import xarray

from tables import decimals, number

from ...parts import RHO_W

DASHED = (0, (4, 1.5))  # the second of two lines of the paper's keys


def value(data: xarray.Dataset, name: str) -> float:
    """A single number of a data file."""
    return float(data[name])


def spans(data: xarray.Dataset, names: dict[str, str], places: int = 2) -> str:
    """ "x from 0.10 to 0.90; y from ..." of arrays by their name in words."""
    ranges = []
    for name, words in names.items():
        x = data[name].values
        ranges.append(f"{words} from {decimals(x.min(), places)} to {decimals(x.max(), places)}")
    return "; ".join(ranges)


def sources_of(data: xarray.Dataset) -> list[SimpleNamespace]:
    """The results behind the figure, in the order of its key of lines, from the attribute `sources`.

    Each has its label there, its file and sha256, the key of its run, its settings (TOML or JSON), and its run_s.
    """
    return [SimpleNamespace(**source) for source in json.loads(data.attrs["sources"])]


def behind(data: xarray.Dataset) -> str:
    """The scene and the settings behind a figure, and its run time, as the end of its caption."""
    sources = sources_of(data)
    seconds = number(float(data.attrs["run_seconds"]), 3)
    run_time = f"Run time {seconds} s"
    if len(sources) != 1:
        run_time += f" ({len(sources)} runs)"
    settings = dict.fromkeys(_settings(source) for source in sources)
    settings.pop("", None)
    return f"{'; '.join(settings)}. {run_time}."


def _settings(source) -> str:
    from engine.scene import SceneError, scene_from_toml

    try:
        scene = scene_from_toml(source.settings)
    except SceneError:
        return ""  # eq. (33) has no scene; its numbers are in the figure's own arrays
    tether, solver = scene.tether, scene.solver
    words = [f"Scene `{scene.name}`"]
    if scene.water is not None:
        words.append(f"H = {number(scene.water.depth_m)} m, {RHO_W} = {number(scene.water.density_kgpm3)} kg/m³")
    words.append(f"EI = {number(tether.bending_stiffness_Nm2)} N m², {tether.nodes} nodes")
    words.append(f"{solver.integrator}, {_steps(solver)}")
    if scene.buoy is not None:
        words.append({"full": "constant buoyancy"}.get(scene.buoy.submergence, scene.buoy.submergence))
    if scene.waves is not None:
        words.append(f"waves above still water: {scene.waves.above_still_water}")
    space = "in a plane" if scene.motion.dimensions == 2 else "in three dimensions"
    words.append(space)
    return ", ".join(words)


def _steps(solver) -> str:
    """What sets the length of a step."""
    if solver.courant:
        return f"Courant number {number(solver.courant)}"
    if solver.step_s:
        return f"steps of {number(solver.step_s)} s"
    return f"rtol {number(solver.rtol)}"
