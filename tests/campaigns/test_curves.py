"""`campaigns.orbits --curves`: events of Henon's map over its second parameter, kept, drawn; what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from analysis.orbits import OrbitMap
from campaigns.orbits import main
from campaigns.orbits.curves import write_curves
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
    computed = tree.computed
    write_curves(tree, HenonPlane())
    assert tree.computed == computed, "a curve is computed once"
    items = list(curve_items(Folder(tmp_path, {}, (), None, {})))
    assert [type(item) for item in items if isinstance(item, Figure | Table)] == [Figure, Table]


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
