"""A trajectory as the variables and texts of a file (`netcdf`), and back."""

import json
from typing import TYPE_CHECKING

import numpy as np

from ..scene.load import SceneError, scene_from_toml
from ..scene.models import Scene
from . import netcdf
from .columns import COLUMNS
from .excursions import excursions_of
from .final_state import state_of_file
from .netcdf import NamedArrays, TrajectoryError
from .parts import EnergyBudget, Profiles, TangentGrowth

if TYPE_CHECKING:
    from . import Trajectory

TEXTS = ("title", "scene", "status", "message", "statistics")  # attributes of a file that are part of the run
OPTIONAL_TEXTS = ("began", "excursions")  # those that only some files have: fields of a Trajectory, where not empty
NOT_IN_OLDER_FILES = {  # columns that older files lack, and what is known of them
    "loop_releases": 0.0,
    "line_lowest_m": 0.0,
    "unresolved_N": 0.0,
    "tension_anchor_N": np.nan,
    "tension_max_N": np.nan,
    "tension_max_s_m": np.nan,
    "tension_anchor_high_N": np.nan,
}


def texts_of(run: "Trajectory") -> dict[str, str]:
    """The attributes of the file of a run."""
    texts = {
        "title": run.scene.title or run.scene.name,
        "scene": run.scene.to_toml(),
        "status": run.status,
        "message": run.message,
        "statistics": json.dumps(run.statistics, default=lambda number: number.item()),  # of NumPy
    }
    for name in OPTIONAL_TEXTS:
        if text := getattr(run, name):
            texts[name] = text
    return texts


def variables_of(run: "Trajectory") -> list[netcdf.Variable]:
    """Everything that is stored of a run; a dimension is named after its coordinate."""
    variables = [(name, ("time_s",), run.columns[name], *about) for name, about in COLUMNS.items()]
    for part, prefix in ((run.profiles, "profile_"), (run.energy, "energy_")):
        if part is not None:
            variables += _variables_of_part(part, prefix)
    if run.tangent is not None and len(run.tangent.released):
        variables += _variables_of_growth(run.tangent)
    if run.final_state is not None:
        variables += run.final_state.variables()
    return variables


def _variables_of_part(part: Profiles | EnergyBudget, prefix: str) -> list[netcdf.Variable]:
    variables = []
    for field, (name, unit, long_name) in _descriptions(type(part), prefix).items():
        values = getattr(part, field)
        dimensions = ("s_m",) if name == "s_m" else (f"{prefix}time_s", "s_m")[: values.ndim]
        if values.size:  # the format has no second dimension of length zero
            variables.append((name, dimensions, values, unit, long_name))
    return variables


def _variables_of_growth(growth: TangentGrowth) -> list[netcdf.Variable]:
    periods, vectors = growth.growth_nats.shape
    unit = f"period ({growth.period_s!r} s)"
    variables = [
        ("period", ("period",), np.arange(periods), unit, "number of the period, the first is 0"),
        ("released", ("period",), growth.released, "1", "1 where a loop was released in the period"),
    ]
    if vectors:
        number, nats = "number of the perturbation, fastest first", "growth of perturbations, nats"
        variables.append(("vector", ("vector",), np.arange(vectors), "1", number))
        variables.append(("growth_nats", ("period", "vector"), growth.growth_nats, "1", nats))
    if growth.lateral_nats is not None:
        nats = "growth of a perturbation across the plane of the waves, nats"
        variables.append(("lateral_nats", ("period",), growth.lateral_nats, "1", nats))
    return variables


def _descriptions(part: type, prefix: str) -> dict[str, tuple[str, str, str]]:
    """Of each field of Profiles or EnergyBudget the name, unit and long name in a file, where s_m has no prefix."""
    about = {field: kind.__metadata__[0] for field, kind in part.__annotations__.items()}
    return {field: (field if field == "s_m" else prefix + field, *words) for field, words in about.items()}


def fields_of(texts: dict[str, str], arrays: NamedArrays) -> dict[str, object]:
    """The fields of the Trajectory of which a file holds these texts and arrays. Raises TrajectoryError."""
    try:
        scene = scene_from_toml(texts["scene"])
    except SceneError as error:
        raise TrajectoryError(f"holds a scene that this version does not accept: {error}") from None
    samples = len(arrays["time_s"])
    columns = {name: np.full(samples, value) for name, value in NOT_IN_OLDER_FILES.items()} | arrays
    columns = {name: columns[name] for name in COLUMNS}
    excursions = texts.get("excursions", "")
    if texts["message"] and not excursions:  # older files have them in the message alone
        words = "; ".join(excursions_of(scene, columns))
        excursions = words if texts["message"].endswith(words) else ""
    return {
        "scene": scene,
        "status": texts["status"],
        "message": texts["message"],
        "columns": columns,
        "statistics": json.loads(texts["statistics"]),
        "profiles": _part_of(Profiles, "profile_", arrays) if "s_m" in arrays else None,
        "tangent": _growth_of(scene, arrays),
        "energy": _part_of(EnergyBudget, "energy_", arrays) if scene.output.energy else None,
        "final_state": state_of_file(scene, arrays),
        "began": texts.get("began", ""),
        "excursions": excursions,
    }


def _part_of(part: type, prefix: str, arrays: NamedArrays) -> Profiles | EnergyBudget:
    """A part of which a file holds these arrays; what is empty is not there."""
    no_rows = np.empty((0, len(arrays.get("s_m", ()))))
    values = {}
    for field, (name, *_) in _descriptions(part, prefix).items():
        empty = np.empty(0) if field == "time_s" or part is EnergyBudget else no_rows
        values[field] = arrays.get(name, empty)
    return part(**values)


def _growth_of(scene: Scene, arrays: NamedArrays) -> TangentGrowth | None:
    """What a file holds of perturbations; empty arrays for a run that ended before its first period did."""
    count, sideways = scene.output.tangent_vectors, scene.output.lateral_growth
    if not (count or sideways):
        return None
    period_s = scene.waves.period_s if scene.waves is not None else 1.0
    released = arrays.get("released", np.empty(0))
    growth = arrays.get("growth_nats", np.empty((len(released), count)))
    return TangentGrowth(period_s, growth, released, arrays.get("lateral_nats", np.empty(0)) if sideways else None)
