"""The letter of a motion that a sweep has not found is refused with the letters that it has found."""

import pytest

from campaigns.machinery.folder import BadInput
from campaigns.orbits import _check_letter
from tables import Column, of_words, write_table

COLUMNS = (Column("steepness", "", "kA", "wave steepness", 3), of_words("motion", "letter of the motion"))
ROWS = [{"steepness": 0.1, "motion": "A"}, {"steepness": 0.1, "motion": "C"}, {"steepness": 0.2, "motion": "A"}]


def test_a_letter_is_one_of_the_table(tmp_path):
    write_table(tmp_path / "table.csv", COLUMNS, ROWS)
    _check_letter("C", tmp_path)
    with pytest.raises(BadInput, match=r"'B'; allowed: a motion of .*table.csv: A, C") as refusal:
        _check_letter("B", tmp_path)
    assert refusal.value.code == 2


def test_without_motions_no_letter_is_allowed(tmp_path):
    with pytest.raises(BadInput, match="there is none"):
        _check_letter("A", tmp_path)
