"""Laws: a row tells what a run said and what it went on from; a small number in print is not zero."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tables import Column, counted, read_rows, read_table, write_table


def test_a_row_tells_what_a_run_said_and_what_it_went_on_from():
    run = SimpleNamespace(status="ok", message="a doubt", began="went on at t = 20 s", statistics={})
    assert all(words in counted(run)["message"] for words in (run.message, run.began))


@pytest.mark.parametrize(("value", "printed"), [(0.004, "0.004"), (0.006, "0.01"), (-0.0012, "−0.0012"), (0.0, "0.00")])
def test_a_small_number_in_print_is_not_zero(value, printed):
    assert Column("a", digits=2).cell({"a": value}) == printed


def test_a_row_whose_message_names_a_file_that_is_no_text_is_written_with_the_others(tmp_path):
    rows = [{"a": 1}, {"a": "no file by\udcffte"}]
    write_table(tmp_path / "table.csv", (Column("a"),), rows)
    assert [row["a"] for row in read_rows(tmp_path / "table.csv")] == ["1", r"no file by\udcffte"]


@pytest.mark.parametrize("unknown", [None, float("nan"), np.float64("nan"), ""])
def test_an_unknown_number_is_an_empty_entry_that_is_read_as_nan(unknown, tmp_path):
    path = tmp_path / "table.csv"
    write_table(path, (Column("a", digits=1), Column("b", digits=1)), [{"a": unknown, "b": np.int64(3)}])
    assert read_rows(path) == [{"a": "", "b": "3"}]
    (row,) = read_table(path)
    assert math.isnan(row["a"]) and row["b"] == 3
