"""The share of the breaking load that the largest tension is: of the tension along the line, or of that at the top."""

import pytest

from campaigns.explore.rows import utilisation
from engine import load_scene


@pytest.mark.parametrize(
    ("breaking_N", "row", "share"),
    [
        (1e4, {"tension_top_max_N": 5e3}, 0.5),
        (1e4, {"tension_top_max_N": 5e3, "tension_line_max_N": 6e3}, 0.6),
        (1e4, {}, None),
        (None, {"tension_top_max_N": 5e3}, None),
    ],
)
def test_a_share_is_told_where_both_are_known(breaking_N, row, share):
    assert utilisation(load_scene("tethered_buoy", {"tether.breaking_load_N": breaking_N}), row) == share
