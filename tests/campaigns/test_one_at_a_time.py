"""Two campaigns never write into one folder at the same time, and a dead one does not keep the folder."""

from campaigns.machinery.folder import claimed
from tests.campaigns.conftest import finished, start_sweep, until


def test_second_campaign_in_the_folder_is_turned_away(tmp_path):
    out = tmp_path / "out"
    first = start_sweep(out, "--steepness", "0.01", "0.02", "0.03", "0.04", sleep_s=1.0)
    until(lambda: (out / "table.csv").exists(), first)
    before = (out / "provenance.json").read_bytes()
    second = start_sweep(out, "--steepness", "0.05")
    _, error = second.communicate(timeout=60)
    assert second.returncode == 1
    assert f"in use by process {first.pid}" in error
    assert (out / "provenance.json").read_bytes() == before
    output = first.communicate(timeout=60)
    assert first.returncode == 0, output
    assert len(finished(out)) == 4


def test_lock_dies_with_its_holder(tmp_path):
    first = start_sweep(tmp_path, "--steepness", "0.01", "0.02", "0.03", sleep_s=1.0)
    until(lambda: (tmp_path / "table.csv").exists(), first)
    first.kill()
    first.communicate()
    with claimed(tmp_path):
        pass
