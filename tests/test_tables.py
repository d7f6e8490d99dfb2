"""Laws: a table holds what a run said and its numbers to the last bit; a number in print is not taken for nothing."""

from types import SimpleNamespace

import pytest

from tables import Column, counted, read_table, write_table


def test_a_table_is_read_as_it_was_written(tmp_path):
    rows = [{"a": 1.0 / 3.0, "b": 7}, {"a": -2.5e-17, "b": None}]
    write_table(tmp_path / "table.csv", (Column("a", digits=2), Column("b", digits=0)), rows)
    first, second = read_table(tmp_path / "table.csv")
    assert (first, second["a"]) == (rows[0], rows[1]["a"])
    assert second["b"] != second["b"], "unknown, and not 0"


def test_a_row_tells_what_a_run_said_and_what_it_went_on_from():
    run = SimpleNamespace(status="ok", message="a doubt", began="went on at t = 20 s", statistics={})
    assert all(words in counted(run)["message"] for words in (run.message, run.began))


@pytest.mark.parametrize(("value", "printed"), [(0.004, "0.004"), (0.006, "0.01"), (-0.0012, "−0.0012"), (0.0, "0.00")])
def test_a_small_number_in_print_is_not_zero(value, printed):
    assert Column("a", digits=2).cell({"a": value}) == printed
