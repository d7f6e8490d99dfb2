"""What the sweep's report says of planar runs with loop releases is what the out-of-plane campaign finds."""

import pytest

from campaigns import out_of_plane
from reports.buoy_sweep.tables import COMPARED
from reports.out_of_plane.comparison import APART_M, read_pairs
from reports.out_of_plane.runs import read_study
from reports.parts.folder import read_folder


@pytest.mark.slow
def test_the_planar_run_is_good_enough_for_the_buoy_but_not_for_its_path(tmp_path):
    """kA = 0.13 at three depths, 200 periods after a transient of 50, planar and in three dimensions."""
    words = ["--jobs", "2", "--no-report", "--out", str(tmp_path / "out")]
    order = out_of_plane.read_order(words, faults := [])
    assert not faults and order.periods - order.transient == 200
    base = out_of_plane.base_of(order)
    order.cases = [case for case in order.cases if out_of_plane.compared(out_of_plane.variant(case), base)]
    assert out_of_plane.STUDY.conduct(order, words) == 0
    pairs = read_pairs(read_study(read_folder(tmp_path / "out")))
    assert [pair.depth for pair in pairs] == ["21", "21.6", "22"]
    assert all(depth in COMPARED for depth in ("21.0", "21.6", "22.0")) and "200 wave periods" in COMPARED
    for pair in pairs:
        assert pair.lacking == [] and pair.exponents_agree and pair.same_regime
        assert pair.planar["loop_releases"] > 20 and pair.spatial["loop_releases"] == 0
        assert pair.before_m < 0.1 * APART_M and pair.parted > pair.spatial["rope_first_burst_period"]
        assert pair.spatial["rope_lateral_max_m"] > 0.2
