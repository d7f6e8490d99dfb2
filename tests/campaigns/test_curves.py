"""`campaigns.orbits --curves`: events of Henon's map over its second parameter, kept, drawn; what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from analysis.orbits import NoImage, OrbitMap
from campaigns.orbits import main
from campaigns.orbits.curves import curve, write_curves
from reports.orbits.curves import curve_items
from reports.parts.content import Figure, Table
from reports.parts.folder import Folder
from tables import Column
from tests.campaigns.conftest import rows_of
from tests.campaigns.test_orbit_tree import KEY, HenonLine, grown


def henon(z, p):
    (a, b), (x, y) = p, z
    return np.array([a - x * x + y, b * x]), lambda V: np.array([[-2.0 * x, 1.0], [b, 0.0]]) @ V


class HenonPlane:
    points = sharper_maps = None
    low, high, value = np.array([-0.6, -1.5]), np.array([4.0, 0.9]), 0.3
    key = SimpleNamespace(column=Column("b", "", "b", "the other parameter of Henon's map", 5))
    line = SimpleNamespace(scenes=SimpleNamespace(key=SimpleNamespace(column=KEY)), size=1.0)
    maps = OrbitMap(henon, parameter_size=np.ones(2))

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

        @property
        def maps(self):
            return OrbitMap(self.step, parameter_size=np.ones(2))

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

        @property
        def maps(self):
            return OrbitMap(self.step, parameter_size=np.ones(2))

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


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ("water.depth_m 26 27", "a range with the value of the scene"),
        ("waves.steepness 0.1 0.2", "is the key of --vary"),
        ("nosuch 1 2", "no such key"),
        ("water.depth_m 1", "allowed: KEY2 LO HI"),
        ("tether.nodes 31 51", "holds a whole number"),
    ],
)
def test_a_second_key_that_cannot_be_is_refused(tmp_path, capsys, words, reason):
    out = tmp_path / "refused"
    with pytest.raises(SystemExit) as ending:
        raise SystemExit(main(["--curves", *words.split(), "--out", str(out)]))
    assert ending.value.code == 2 and reason in capsys.readouterr().err and not out.exists()


CABLE = "--vary waves.steepness 0.12 0.13 --values 2 --no-accuracy --no-report --jobs 1".split()


def cable(out, depth, *words):
    """The folder of the orbits of a buoy on a coarse line at a depth."""
    assert main(["--set", f"water.depth_m={depth}", "tether.nodes=21", *words, *CABLE, "--out", str(out)]) == 0
    return out


def fold_of_period_3(folder):
    (row,) = (row for row in rows_of(folder, "events/table.csv") if (row["kind"], row["period"]) == ("fold", "3"))
    return float(row["waves.steepness"]), float(row["error"])


@pytest.mark.slow
def test_folds_of_the_cable_lie_on_their_curve_and_a_tenth_of_the_tolerance_moves_it_less_than_its_error(tmp_path):
    over = "--curves", "water.depth_m", "24.99", "25.2"
    first, second = cable(tmp_path / "25", 25, *over), cable(tmp_path / "25.2", 25.2)

    def curve_in(folder):
        rows = [row for row in rows_of(folder, "curves/table.csv") if row["period"] == "3" and not row["special"]]
        columns = [[float(row[name]) for row in rows] for name in ("water.depth_m", "waves.steepness", "error_1")]
        return np.array(columns)[:, np.argsort(columns[0])]

    depths, steepness, errors = curve_in(first)
    assert depths[-1] == 25.2
    for folder, depth in ((first, 25.0), (second, 25.2)):
        there = np.interp(depth, depths, steepness)
        assert there == pytest.approx(fold_of_period_3(folder)[0], abs=2e-4)
    assert abs(steepness[-1] - fold_of_period_3(second)[0]) <= errors[-1] + fold_of_period_3(second)[1]
    key = next(row["run_key"] for row in rows_of(first, "motions/table.csv") if row["strobed_period"] in ("3", "3.0"))
    start = "--start-from", str(first / "motions" / "trajectories" / f"{key}.nc")
    sharp = curve_in(cable(tmp_path / "sharp", 25, "solver.rtol=1e-4", *start, *over))
    for end in (0, -1):  # both at the same depth
        assert sharp[0][end] == depths[end] and abs(sharp[1][end] - steepness[end]) <= errors[end]
