"""Planar runs are as good as the report says."""

import pytest

from campaigns import out_of_plane
from campaigns.out_of_plane.pairs import APART_M
from reports.buoy_sweep.tables import COMPARED
from tables import read_table
from tests.campaigns.conftest import order_of


@pytest.mark.slow
def test_the_planar_run_is_good_enough_for_the_buoy_but_not_for_its_path(tmp_path):
    """kA = 0.13 at three depths, 200 periods after a transient of 50, planar and in three dimensions."""
    words = ["--jobs", "2", "--no-report", "--out", str(tmp_path / "out")]
    order = order_of(out_of_plane, *words)
    assert order.periods - order.transient == 200
    base, (_, depths_m) = out_of_plane.base_of(order), out_of_plane.depths_of(order)
    variants = [out_of_plane.variant(case.labels) for case in order.cases]
    pairs = zip(order.cases, variants, strict=True)
    order.cases = [case for case, variant in pairs if out_of_plane.compared(variant, base, depths_m)]
    assert out_of_plane.STUDY.conduct(order, words) == 0
    rows = {row["run_key"]: row for row in read_table(tmp_path / "out" / "table.csv")}
    pairs = read_table(tmp_path / "out" / "pairs.csv")
    assert [pair["depth_m"] for pair in pairs] == [21.0, 21.6, 22.0]
    assert all(depth in COMPARED for depth in ("21.0", "21.6", "22.0")) and "200 wave periods" in COMPARED
    for pair in pairs:
        planar, spatial = rows[pair["planar_key"]], rows[pair["spatial_key"]]
        assert all(pair[f"same_{name}"] == 1 for name in ("range", "section", "exponent", "regime"))
        assert planar["loop_releases"] > 20 and spatial["loop_releases"] == 0
        assert pair["before_m"] < 0.1 * APART_M and pair["apart_period"] > spatial["rope_first_burst_period"]
        assert spatial["rope_lateral_max_m"] > 0.2
