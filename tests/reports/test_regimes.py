"""A sweep of records long enough has exponents and regimes in its table, and the report says why."""

import csv

import pytest

from analysis import read_evidence
from campaigns import buoy_sweep
from reports.buoy_sweep.report import report
from reports.parts.content import Figure, Sheet, Table

pytestmark = pytest.mark.slow
LONG, SHORT = (["--periods", "200", "--transient", "50"], ["--periods", "60", "--transient", "21"])
SWEPT = ["--steepness", "0.016", "0.13", "--jobs", "1", "--backend", "threading"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("regimes") / "sweep"
    assert buoy_sweep.main([*SWEPT, *LONG, "--out", str(out)]) == 0
    return out


def rows_of(folder):
    with open(folder / "table.csv", newline="", encoding="utf-8") as file:
        return {float(row["steepness"]): row for row in csv.DictReader(file)}


def test_the_table_holds_exponents_with_errors_and_a_regime(folder):
    rows = rows_of(folder)
    calm = rows[0.016]
    value, error = (float(calm[f"lyapunov_tangent_{end}"]) for end in ("bits_per_period", "error"))
    assert value < -2 * error < 0, "small waves: perturbations die out"
    for row in rows.values():
        assert row["regime"] in {"transient", "undecided", "quasi-periodic", "chaotic"} or "period-" in row["regime"]
        assert float(row["lyapunov_wolf_error"]) > 0


def test_the_table_tells_growth_across_the_plane_where_no_loop_is_released(folder):
    rows = rows_of(folder)
    growth, error = (rows[0.016][f"offplane_growth_{end}"] for end in ("bits_per_period", "error"))
    assert float(growth) < -5 * float(error) < 0, "pushed out of its plane the calm motion returns"
    assert int(rows[0.13]["loop_releases"]) > 0
    assert rows[0.13]["offplane_growth_bits_per_period"] == rows[0.13]["offplane_growth_error"] == ""


def test_the_report_gives_the_evidence_for_the_papers_two_cases(folder):
    """The table of a run's tests, in its sheet and in the section, has one row for each test in the table's row."""
    items = report(folder).items
    for row in rows_of(folder).values():
        names = [name for name, *_ in read_evidence(row["evidence"])]
        tables = [item.table for item in items if isinstance(item, Sheet)] + list(items)
        found = [table for table in tables if isinstance(table, Table) and [cells[0] for cells in table.rows] == names]
        assert names and len(found) == 2
    assert any("fig. 14" in item.caption for item in items if isinstance(item, Figure))


@pytest.mark.parametrize("without", [[*LONG, "--set", "output.tangent_vectors=0"], SHORT])
def test_a_sweep_without_exponents_leaves_the_columns_empty(tmp_path, without):
    """Not asked for, or too short for a verdict: then nothing is paid for it."""
    assert buoy_sweep.main([*SWEPT, *without, "--no-report", "--out", str(tmp_path / "sweep")]) == 0
    for row in rows_of(tmp_path / "sweep").values():
        assert row["regime"] == row["lyapunov_tangent_bits_per_period"] == row["lyapunov_wolf_error"] == ""
        assert row["offplane_growth_bits_per_period"] == row["offplane_growth_error"] == ""
