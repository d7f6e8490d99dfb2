"""What the campaigns that explore have in common: how a row is made, and how long a run may take."""

from functools import partial

from campaigns.study import Measures, Order
from tables import Column, names

ROW_SOURCES = ("analysis", "engine", "campaigns/explore", "campaigns/judge.py")
BUDGET = 1500  # wave periods after which a run ends undecided


def measures_of(order: Order, columns: tuple[Column, ...], full: bool = False) -> Measures:
    """The rows of a buoy in regular waves. full: as of `judgement_of`, after all wave periods of the order."""
    from campaigns.explore.judgement import judgement_of
    from campaigns.explore.rows import buoy_row

    settings = {"transient_periods": order.transient, "full": None}
    if full:
        settings["full"] = order.periods
    return Measures(columns, buoy_row, ROW_SOURCES, settings, judge=partial(judgement_of, **settings))


def columns_of(keys: tuple[Column, ...]) -> tuple[Column, ...]:
    """Those of the places of a grid, then those of the rows of a buoy in a plane."""
    from campaigns.explore.rows import COLUMNS, STEEPNESS

    of_places = names((STEEPNESS, *keys))
    measured = [column for column in COLUMNS if column.name not in of_places and not column.name.startswith("planar_")]
    return *keys, *measured
