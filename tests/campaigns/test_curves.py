"""`campaigns.orbits --curves`: events of Henon's map over its second parameter, kept, drawn; what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from analysis.orbits import NoImage, OrbitMap
from campaigns.explore.grid import varied
from campaigns.orbits import main
from campaigns.orbits.curves import Plane, curve, write_curves
from engine import load_scene, simulate
from reports.orbits.curves import curve_items
from reports.parts.content import Figure, Table
from reports.parts.folder import Folder
from tables import Column
from tests.analysis.systems import henon_plane as henon
from tests.campaigns.conftest import rows_of
from tests.campaigns.test_orbit_tree import KEY, HenonLine, grown


class HenonPlane:
    points = sharper_maps = None
    low, high, value = np.array([-0.6, -1.5]), np.array([4.0, 0.9]), 0.3
    key = SimpleNamespace(column=Column("b", "", "b", "the other parameter of Henon's map", 5))
    line = SimpleNamespace(scenes=SimpleNamespace(key=SimpleNamespace(column=KEY)), size=1.0)
    step = staticmethod(henon)

    @property
    def maps(self):
        return OrbitMap(self.step, parameter_size=np.ones(2))

    def digest(self):
        return "henon over two parameters"


def test_events_of_one_key_lie_on_their_curves_which_are_kept_and_drawn(tmp_path):
    tree = grown(tmp_path, line=HenonLine(high=0.6))
    write_curves(tree, HenonPlane())
    rows = [row for row in rows_of(tmp_path, "curves/table.csv") if row["status"] == "ok"]
    for kind, factor in (("fold", -0.25), ("flip", 0.75)):
        chosen = [row for row in rows if (row["kind"], row["period"]) == (kind, "1")]
        a, b = (np.array([float(row[name]) for row in chosen]) for name in "ab")
        assert abs(a - factor * (1.0 - b) ** 2).max() < 1e-8 and np.ptp(b) > 0.8
    assert "1:2" in {row["special"] for row in rows}
    assert all(row["message"] or (row["error_1"] and row["error_2"]) for row in rows)
    computed = tree.computed
    write_curves(tree, HenonPlane())
    assert tree.computed == computed, "a curve is computed once"
    items = list(curve_items(Folder(tmp_path, {}, (), None, {})))
    assert [type(item) for item in items if isinstance(item, Figure | Table)] == [Figure, Table, Table]


def test_a_curve_that_was_stopped_goes_on_from_its_points_with_the_same_bits(tmp_path):
    class Counted(HenonPlane):
        points, calls, allowed = tmp_path / "points", 0, np.inf

        def step(self, z, p):
            self.calls += 1
            if self.calls > self.allowed:
                raise KeyboardInterrupt
            return henon(z, p)

    flip = "flip", 0.3675, np.array([[0.35, 0.105]]), 60
    whole, _ = curve(HenonPlane(), *flip)
    alone, stopped, again = Counted(), Counted(), Counted()
    alone.points = None
    curve(alone, *flip)
    stopped.allowed = alone.calls // 2
    with pytest.raises(KeyboardInterrupt):
        curve(stopped, *flip)
    result, _ = curve(again, *flip)
    assert result == whole and again.calls < 0.7 * alone.calls


def test_a_special_point_whose_search_fails_is_a_row_a_mark_and_a_line_of_the_report(tmp_path):
    class Holed(HenonPlane):
        """No image near the 1:2 point (3, -1)."""

        def step(self, z, p):
            if abs(p[1] + 1.0) < 0.01:
                raise NoImage("there is a hole")
            return henon(z, p)

    write_curves(grown(tmp_path, line=HenonLine(high=0.6)), Holed())
    (row,) = (row for row in rows_of(tmp_path, "curves/table.csv") if row["special"] == "1:2")
    assert row["status"] == "not-found" and "there is a hole" in row["message"]
    assert abs(float(row["b"]) + 1.0) < float(row["error_2"])
    _, figure, special, _ = curve_items(Folder(tmp_path, {}, (), None, {}))
    assert isinstance(figure, Figure) and isinstance(special, Table)


ISLAND = {"water.depth_m": 25, "tether.nodes": 11, "waves.steepness": 0.123, "start.buoy_velocity_mps": [3.5, 0.0, 4.5]}
WORDS = "--vary waves.steepness 0.113 0.123 --orbits 10 --no-accuracy --no-report --backend threading --jobs 1".split()


@pytest.mark.slow
def test_folds_of_the_cable_at_a_tenth_of_the_tolerance_lie_on_their_curve_within_its_errors(tmp_path):
    """The period 3 that a kick leads to: its curve, and runs over one key on it and at its end."""
    start = tmp_path / "start.nc"
    simulate(load_scene("tethered_buoy", ISLAND), periods=100).save(start)

    def fold(name, *words):
        """Steepness of the fold of a campaign of that name."""
        assert main(["--set", *words, *WORDS, "--start-from", str(start), "--out", str(tmp_path / name)]) == 0
        (event,) = (row for row in rows_of(tmp_path / name, "events/table.csv") if row["kind"] == "fold")
        assert event["period"] == "3"
        return float(event["waves.steepness"])

    on_one_key = fold("curve", "water.depth_m=25", "--curves", "water.depth_m", "24.99", "25.02")
    rows = [row for row in rows_of(tmp_path / "curve", "curves/table.csv") if not row["special"]]
    columns = [[float(row[name]) for row in rows] for name in ("water.depth_m", "waves.steepness", "error_1")]
    depths, steepness, errors = np.array(columns)[:, np.argsort(columns[0])]
    assert (depths[0], depths[-1]) == (24.99, 25.02)
    assert np.interp(25.0, depths, steepness) == pytest.approx(on_one_key, abs=2e-4)
    sharp = fold("sharp", f"water.depth_m={depths[-1]}", "solver.rtol=1e-4")
    assert abs(steepness[-1] - sharp) <= errors[-1]


def test_a_curve_is_kept_for_its_range_of_the_second_key():
    ranges = ("water.depth_m", "22", "25"), ("water.depth_m", "22", "26"), ("waves.period_s", "22", "25")
    digests = {Plane(HenonLine(), varied(words, [], count=2), 23.0).digest() for words in ranges}
    assert len(digests) == 3
