"""The report of the snap oscillator: made from its folder alone, the same twice, and open about what is missing."""

import pytest

from campaigns import oscillator
from reports import build
from reports.oscillator.folder import PARTS, read_study
from reports.parts.folder import FolderError
from tests.campaigns.conftest import rows_of


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    out = tmp_path_factory.mktemp("oscillator") / "out"
    assert oscillator.main(["--effort", "0.01", "--out", str(out)]) == 0
    return out


@pytest.mark.slow
def test_same_folder_same_bytes_and_a_lost_part_leaves_the_rest(study):
    first = [path.read_bytes() for path in build(study)]
    assert [path.read_bytes() for path in build(study)] == first
    assert first[0].count(b"<figure") == first[0].count(b"<figcaption") == 7
    key = next(row["run_key"] for row in rows_of(study) if row["part"] == "basins")
    (study / "trajectories" / f"{key}.nc").unlink()
    found = read_study(study)
    assert set(found.faults) == {"basins"} and set(found.arrays) == set(PARTS) - {"basins"}
    assert build(study)[0].read_bytes().count(b"<figure") == 6


def test_a_folder_that_is_no_study_is_refused(tmp_path):
    (tmp_path / "provenance.json").write_text('{"campaign": "oscillator"}')
    with pytest.raises(FolderError, match=r"table\.csv is missing"):
        build(tmp_path)
