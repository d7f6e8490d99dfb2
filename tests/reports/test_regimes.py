"""A sweep of records long enough has exponents and regimes; planar runs are as good as the report says."""

import pytest

from analysis import read_evidence
from campaigns import buoy_sweep, out_of_plane
from campaigns.out_of_plane.pairs import APART_M
from reports.buoy_sweep.report import report
from reports.buoy_sweep.tables import COMPARED
from reports.parts.content import Sheet
from tables import read_table
from tests.campaigns import conftest

pytestmark = pytest.mark.slow
LONG, SHORT = (["--periods", "200", "--transient", "50"], ["--periods", "60", "--transient", "21"])
SWEPT = ["--steepness", "0.016", "0.13", "--jobs", "1", "--backend", "threading"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("regimes") / "sweep"
    assert buoy_sweep.main([*SWEPT, *LONG, "--out", str(out)]) == 0
    return out


def rows_of(folder):
    return {float(row["steepness"]): row for row in conftest.rows_of(folder)}


def test_the_table_holds_exponents_with_errors_and_a_regime(folder):
    rows = rows_of(folder)
    calm = rows[0.016]
    value, error = (float(calm[f"lyapunov_tangent_{end}"]) for end in ("bits_per_period", "error"))
    assert value < -2 * error < 0, "small waves: perturbations die out"
    for row in rows.values():
        assert row["regime"] in {"transient", "undecided", "quasi-periodic", "chaotic"} or "period-" in row["regime"]
        assert row["lyapunov_wolf_error"] == "", "nobody asked for Wolf's method"


def test_the_table_tells_growth_across_the_plane_where_no_loop_is_released(folder):
    rows = rows_of(folder)
    growth, error = (rows[0.016][f"offplane_growth_{end}"] for end in ("bits_per_period", "error"))
    assert float(growth) < -5 * float(error) < 0, "pushed out of its plane the calm motion returns"
    assert int(rows[0.13]["loop_releases"]) > 0
    assert rows[0.13]["offplane_growth_bits_per_period"] == rows[0.13]["offplane_growth_error"] == ""


def test_the_report_gives_the_evidence_for_the_papers_two_cases(folder):
    """The table of tests in a run's sheet has one row for each test in the table's row; both sheets are printed."""
    items = report(folder).items
    for row in rows_of(folder).values():
        names = [name for name, *_ in read_evidence(row["evidence"])]
        sheets = [item for item in items if isinstance(item, Sheet)]
        found = [one for one in sheets if one.table and [cells[0] for cells in one.table.rows] == names]
        assert names and found and all(one.chosen for one in sheets)


@pytest.mark.parametrize("without", [[*LONG, "--set", "output.tangent_vectors=0"], SHORT])
def test_a_sweep_without_exponents_leaves_the_columns_empty(tmp_path, without):
    """Not asked for, or too short for a verdict: then nothing is paid for it."""
    assert buoy_sweep.main([*SWEPT, *without, "--no-report", "--out", str(tmp_path / "sweep")]) == 0
    for row in rows_of(tmp_path / "sweep").values():
        assert row["regime"] == row["lyapunov_tangent_bits_per_period"] == row["lyapunov_wolf_error"] == ""
        assert row["offplane_growth_bits_per_period"] == row["offplane_growth_error"] == ""


def test_the_planar_run_is_good_enough_for_the_buoy_but_not_for_its_path(tmp_path):
    """kA = 0.13 at three depths, 200 periods after a transient of 50, planar and in three dimensions."""
    words = ["--jobs", "2", "--no-report", "--out", str(tmp_path / "out")]
    order = out_of_plane.read_order(words, faults := [])
    assert not faults and order.periods - order.transient == 200
    base = out_of_plane.base_of(order)
    order.cases = [case for case in order.cases if out_of_plane.compared(out_of_plane.variant(case.labels), base)]
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
