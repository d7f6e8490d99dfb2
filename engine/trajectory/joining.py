"""Two trajectories, of which the later one went on from the final state of the earlier one, as one."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .columns import COLUMNS, EXTREMES, along_waves, heading_of
from .excursions import with_excursions
from .parts import Profiles, TangentGrowth

if TYPE_CHECKING:
    from . import Trajectory


def joined(earlier: "Trajectory", later: "Trajectory") -> "Trajectory":
    """The one trajectory; see `Trajectory.followed_by`."""
    if not len(later.columns["time_s"]) or later.columns["time_s"][0] != earlier.columns["time_s"][-1]:
        raise ValueError("later: a run that begins with the last sample of this one is needed")
    if (earlier.profiles is None) != (later.profiles is None):
        raise ValueError("later: profiles are needed of both runs, or of none")
    columns = {name: np.concatenate([earlier.columns[name], later.columns[name][1:]]) for name in COLUMNS}
    place = along_waves(heading_of(later.scene), columns["x_m"], columns["y_m"])
    columns["angle_rad"] = np.unwrap(np.arctan2(place, columns["z_m"]))
    statistics = dict(later.statistics)
    for name in earlier.statistics.keys() & later.statistics.keys():
        pair = earlier.statistics[name], later.statistics[name]
        statistics[name] = EXTREMES[name](pair) if name in EXTREMES else sum(pair)
    own_message = later.own_message or earlier.own_message
    message, excursions = with_excursions(own_message, later.scene, columns, later.status)
    return replace(
        later,
        message=message,
        excursions=excursions,
        columns=columns,
        statistics=statistics,
        profiles=_joined_profiles(earlier.profiles, later.profiles),
        tangent=_joined_growth(earlier.tangent, later.tangent, float(later.columns["time_s"][0])),
        began="; ".join(filter(None, (earlier.began, later.began))),
    )


def _joined_profiles(earlier: Profiles | None, later: Profiles | None) -> Profiles | None:
    if earlier is None or later is None:
        return None
    new = later.time_s > earlier.time_s[-1]
    arrays = {
        name: np.concatenate([values, getattr(later, name)[new]]) for name, values in vars(earlier).items()
        if name != "s_m"
    }  # fmt: skip
    return replace(later, **arrays)


def _joined_growth(earlier: TangentGrowth | None, later: TangentGrowth | None, time_s: float) -> TangentGrowth | None:
    """Growth in the periods of two runs, the later of which begins at that time."""
    if later is None:
        return None
    periods_before = int(time_s / later.period_s + 1e-9)

    def both(name: str) -> np.ndarray:
        new = getattr(later, name)
        old = None if earlier is None else getattr(earlier, name)
        if old is None or old.shape[1:] != new.shape[1:]:
            old = np.full((periods_before, *new.shape[1:]), 0.0 if name == "released" else np.nan)
        return np.concatenate([old, new])

    lateral = None if later.lateral_nats is None else both("lateral_nats")
    return TangentGrowth(later.period_s, both("growth_nats"), both("released"), lateral)
