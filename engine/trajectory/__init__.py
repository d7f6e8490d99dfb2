"""The record of one run: even samples of the buoy and the tension, how the run ended, what it cost, optional profiles.

On disk a netCDF-3 file (it opens in xarray and in any netCDF tool); scene, status, message and statistics are
attributes, and a digest of the whole content lets `load` tell a damaged file from a sound one.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from engine import views
from engine.atomic import write_atomic
from engine.scene.load import Scene, SceneError, scene_from_toml
from engine.trajectory import netcdf
from engine.trajectory.excursions import message_of, own_words
from engine.trajectory.final_state import FinalState, state_of_file
from engine.trajectory.parts import EnergyBudget, Profiles, TangentGrowth, along_waves, heading_of

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

    from analysis import Exponent, PoincareSection, Spectrum, Verdict

COLUMNS = {  # name -> (unit, long name), in the order of the table
    "time_s": ("s", "time"),
    "x_m": ("m", "position of the upper end along x (the waves), from the anchor"),
    "y_m": ("m", "position of the upper end along y (across the waves), from the anchor"),
    "z_m": ("m", "height of the upper end above the anchor"),
    "radius_m": ("m", "distance of the upper end from the anchor"),
    "radius_rate_mps": ("m s-1", "rate of the distance of the upper end from the anchor"),
    "angle_rad": ("rad", "angle of the upper end from the vertical in the plane of the waves, atan2(x, z), unwrapped"),
    "angle_rate_radps": ("rad s-1", "rate of the angle of the upper end from the vertical"),
    "offplane_m": ("m", "largest distance of any node from the plane of the waves"),
    "tension_top_N": ("N", "tension at the upper end"),
    "tension_min_N": ("N", "least tension along the tether"),
    "tension_top_low_N": ("N", "least tension at the upper end over all steps since the previous sample"),
    "tension_top_high_N": ("N", "largest tension at the upper end over all steps since the previous sample"),
    "loop_releases": ("1", "loops of slack tether released since t = 0"),
    "line_lowest_m": ("m", "height of the lowest node of the tether above the anchor"),
    "unresolved_N": ("N", "axial ringing that steps and grid did not resolve since the previous sample"),
}
TEXTS = ("title", "scene", "status", "message", "statistics")  # attributes of a file that are part of the run
BEGAN = "began"  # one that only some files have


class TrajectoryError(ValueError):
    """A trajectory file that cannot be read: not there, truncated, damaged, or not one of ours."""


@dataclass(frozen=True)
class Trajectory:
    """One run of one scene.

    status: "ok", or the word for how the run ended early; then the samples up to its end are kept (possibly none).
    message: what its user has to know of it, in words; often empty. columns: every name of COLUMNS -> (n,) array,
    evenly sampled.
    statistics: counts and times of the work done. profiles, tangent, energy: where the scene asks for them.
    final_state: what `simulate(..., start=)` goes on from; None where the run ended early, or keeps energies.
    began: what was changed where it went on from another run, as "went on at t = 300 s; changed:
    waves.steepness 0.12 -> 0.13"; empty where nothing was, and for a run from rest.
    """

    scene: Scene
    status: str
    message: str
    columns: dict[str, np.ndarray]
    statistics: dict[str, int | float]
    profiles: Profiles | None = None
    tangent: TangentGrowth | None = None
    energy: EnergyBudget | None = None
    final_state: FinalState | None = None
    began: str = ""

    def followed_by(self, later: "Trajectory") -> "Trajectory":
        """This run and the one that went on from its final state as one record: scene and end of the later one.

        Perturbations that only the later one carried have growth nan before. Raises ValueError where `later` does not
        begin where this run ends, or one of them has profiles and the other not.
        """
        if not len(later.columns["time_s"]) or later.columns["time_s"][0] != self.columns["time_s"][-1]:
            raise ValueError("later: a run that begins with the last sample of this one is needed")
        if (self.profiles is None) != (later.profiles is None):
            raise ValueError("later: profiles are needed of both runs, or of none")
        columns = {name: np.concatenate([self.columns[name], later.columns[name][1:]]) for name in COLUMNS}
        x, y, z = (columns[name] for name in ("x_m", "y_m", "z_m"))
        columns["angle_rad"] = np.unwrap(np.arctan2(along_waves(heading_of(later.scene), x, y), z))
        statistics = dict(later.statistics)
        many = dict.fromkeys(("max_turn_rad", "end_time_s", "unresolved_ringing_N"), max) | {"min_strain": min}
        for name in self.statistics.keys() & later.statistics.keys():
            statistics[name] = many.get(name, lambda a, b: a + b)(self.statistics[name], later.statistics[name])
        profiles = later.profiles
        if self.profiles is not None and profiles is not None:
            new = profiles.time_s > self.profiles.time_s[-1]
            old, more = vars(self.profiles), vars(profiles)
            both = {name: np.concatenate([old[name], more[name][new]]) for name in more if name != "s_m"}
            profiles = replace(profiles, **both)
        tangent = _joined(self.tangent, later.tangent, float(later.columns["time_s"][0]))
        began = "; ".join(filter(None, (self.began, later.began)))
        own = own_words(later.message) or self.message
        message = message_of(own, later.scene, columns, later.status)
        more = {"tangent": tangent, "began": began, "message": message}
        return replace(later, columns=columns, statistics=statistics, profiles=profiles, **more)

    def table(self) -> "pandas.DataFrame":
        """The samples as a pandas table, one row a sample, columns in the order of COLUMNS."""
        import pandas

        return pandas.DataFrame({name: self.columns[name] for name in COLUMNS})

    def plot(self, path: "str | Path | None" = None) -> "dict[str, Axes]":
        """A figure: tension and radius over the whole run and its end; section and spectrum, or the path without waves.

        path: a .png, .svg or .pdf file to write; without one the figure belongs to `matplotlib.pyplot`: a notebook
        shows it, a script with `pyplot.show()`. Returns matplotlib's Axes by the name of the panel.
        """
        return views.plot(self, path)

    def spectrum(self, column: str = "radius_m", transient_periods: int | None = None) -> "Spectrum":
        """Eq. (31) of a column of the table after the transient, the first third of the run (`analysis.spectrum`).

        The window is the last multiple of 12 forcing periods, so that motions of period 2, 3, 4 or 6 do not leak.
        Raises ValueError where neither regular waves nor a shaken end drive the run, as do the three below.
        """
        return views.spectrum(self, column, transient_periods)

    def section(
        self,
        columns: str | Sequence[str] = ("radius_m", "radius_rate_mps"),
        transient_periods: int | None = None,
        phase: float = 0.0,
    ) -> "PoincareSection":
        """Columns of the table once per period after the transient, its first third (`analysis.poincare_section`)."""
        return views.section(self, columns, transient_periods, phase)

    def exponent(self, transient_periods: int | None = None) -> "Exponent":
        """The largest Lyapunov exponent after the transient, that of `verdict` or the first third, in bits per forcing
        period.

        From the tangent dynamics where the run carried them (`output.tangent_vectors`), else by Wolf's method from r,
        which is far less certain and takes seconds; its `method` says which.
        """
        return views.exponent(self, transient_periods)

    def verdict(self) -> "Verdict":
        """The regime of a buoy in regular waves with the evidence for it (`analysis.motion_regime`), as campaigns judge
        it. Chaos and tori need a run with `output.tangent_vectors` = 1, and any word 135 periods or more.
        """
        return views.verdict(self)

    def to_xarray(self) -> "xarray.Dataset":
        """Everything that `save` writes but the final state, as an xarray Dataset with units and long names."""
        return views.dataset(self)

    def __repr__(self) -> str:
        return f"Trajectory({self.scene.name!r}, {self.status!r}, {len(self.columns['time_s'])} samples)"

    def _repr_html_(self) -> str:
        return views.html(self)

    def save(self, path: str | Path, attributes: dict[str, str] | None = None) -> None:
        """Write the record as one netCDF-3 file, whole or not at all.

        attributes: further global attributes (provenance). The folder must exist.
        Raises OSError (nothing is left behind), ValueError for an attribute name that the record or the format uses
        itself.
        """
        write_atomic(path, self.to_bytes(attributes))

    def to_bytes(self, attributes: dict[str, str] | None = None) -> bytes:
        """The content of the file that `save` writes, for whoever has to send it first. Raises ValueError as `save`."""
        texts = {
            "title": self.scene.title or self.scene.name,
            "scene": self.scene.to_toml(),
            "status": self.status,
            "message": self.message,
            "statistics": json.dumps(self.statistics, default=lambda number: number.item()),  # of NumPy
        } | ({BEGAN: self.began} if self.began else {})
        return netcdf.to_bytes(_variables(self), texts, attributes or {})

    @staticmethod
    def load(path: str | Path, attributes: dict[str, str] | None = None) -> "Trajectory":
        """The record saved under path, equal to the one saved. attributes: of `save`, which the file must have.

        Raises TrajectoryError with the reason when there is no such file or it is truncated, damaged, not a
        trajectory, or has other attributes.
        """
        try:
            content = Path(path).read_bytes()
        except OSError as error:
            raise TrajectoryError(f"{path}: cannot be read: {error.strerror or error}") from None
        return Trajectory.from_bytes(content, str(path), attributes)

    @staticmethod
    def from_bytes(content: bytes, name: str = "the record", attributes: dict[str, str] | None = None) -> "Trajectory":
        """The record of a file's content, as `load`, for whoever was sent it; TrajectoryError calls it by name."""
        try:
            return _restored(*netcdf.from_bytes(content, TEXTS, (BEGAN,), attributes))
        except (TrajectoryError, netcdf.DamagedError) as error:
            raise TrajectoryError(f"{name}: {error}") from None
        except Exception as error:  # a damaged header can make the reader fail in any way at all
            raise TrajectoryError(f"{name}: truncated, damaged, or not a netCDF-3 file ({error})") from None


def _joined(earlier: TangentGrowth | None, later: TangentGrowth | None, time_s: float) -> TangentGrowth | None:
    """Growth in the periods of two runs, the later of which begins at that time."""
    if later is None:
        return None
    before = int(time_s / later.period_s + 1e-9)

    def both(name: str) -> np.ndarray:
        new = getattr(later, name)
        old = None if earlier is None else getattr(earlier, name)
        if old is None or old.shape[1:] != new.shape[1:]:
            old = np.full((before, *new.shape[1:]), 0.0 if name == "released" else np.nan)
        return np.concatenate([old, new])

    lateral = None if later.lateral_nats is None else both("lateral_nats")
    return TangentGrowth(later.period_s, both("growth_nats"), both("released"), lateral)


def _abouts(record: type, prefix: str) -> dict[str, tuple[str, str, str]]:
    """Of each field of a record the name, unit and long name in a file, where s_m has no prefix."""
    about = {name: kind.__metadata__[0] for name, kind in record.__annotations__.items()}
    return {name: (name if name == "s_m" else prefix + name, *words) for name, words in about.items()}


def _variables(run: Trajectory) -> list[netcdf.Variable]:
    """Everything that is stored of a run; a dimension is named after its coordinate."""
    found = [(name, ("time_s",), run.columns[name], *about) for name, about in COLUMNS.items()]
    for record, prefix in ((run.profiles, "profile_"), (run.energy, "energy_")):
        for field, (name, *about) in (_abouts(type(record), prefix) if record is not None else {}).items():
            values = getattr(record, field)
            dimensions = ("s_m",) if name == "s_m" else (f"{prefix}time_s", "s_m")[: values.ndim]
            if values.size:  # the format has no second dimension of length zero
                found.append((name, dimensions, values, *about))
    if run.tangent is not None and len(run.tangent.released):
        grown = run.tangent
        about = (f"period ({grown.period_s!r} s)", "number of the period, the first is 0")
        found.append(("period", ("period",), np.arange(len(grown.released)), *about))
        found.append(("released", ("period",), grown.released, "1", "1 where a loop was released in the period"))
        if count := grown.growth_nats.shape[1]:
            found.append(("vector", ("vector",), np.arange(count), "1", "number of the perturbation, fastest first"))
            found.append(("growth_nats", ("period", "vector"), grown.growth_nats, "1", "growth of perturbations, nats"))
        if grown.lateral_nats is not None:
            about = ("1", "growth of a perturbation across the plane of the waves, nats")
            found.append(("lateral_nats", ("period",), grown.lateral_nats, *about))
    return found if run.final_state is None else found + run.final_state.variables()


def _restored(texts: dict[str, str], arrays: dict[str, np.ndarray]) -> Trajectory:
    """The run of which a file holds these texts and arrays."""
    try:
        scene = scene_from_toml(texts["scene"])
    except SceneError as error:
        raise TrajectoryError(f"holds a scene that this version does not accept: {error}") from None
    none = np.empty(0)
    profiles = energy = None
    if "s_m" in arrays:
        blank, stored = np.empty((0, len(arrays["s_m"]))), _abouts(Profiles, "profile_")
        profiles = Profiles(
            **{field: arrays.get(name, none if field == "time_s" else blank) for field, (name, *_) in stored.items()}
        )
    if scene.output.energy:
        energy = EnergyBudget(*(arrays.get(name, none) for name, *_ in _abouts(EnergyBudget, "energy_").values()))
    tangent = _growth(scene, arrays)
    unknown = np.zeros(len(arrays["time_s"]))
    of_older_files = dict.fromkeys(("loop_releases", "line_lowest_m", "unresolved_N"), unknown)
    columns = {name: (of_older_files | arrays)[name] for name in COLUMNS}
    statistics = json.loads(texts["statistics"])
    more = profiles, tangent, energy, state_of_file(scene, arrays), texts.get(BEGAN, "")
    return Trajectory(scene, texts["status"], texts["message"], columns, statistics, *more)


def _growth(scene: Scene, arrays: dict[str, np.ndarray]) -> TangentGrowth | None:
    """What a file holds of perturbations; empty arrays for a run that ended before its first period did."""
    count, sideways = scene.output.tangent_vectors, scene.output.lateral_growth
    if not (count or sideways):
        return None
    period_s = scene.waves.period_s if scene.waves is not None else 1.0
    released = arrays.get("released", np.empty(0))
    growth = arrays.get("growth_nats", np.empty((len(released), count)))
    return TangentGrowth(period_s, growth, released, arrays.get("lateral_nats", np.empty(0)) if sideways else None)
