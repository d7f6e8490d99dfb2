"""Same folder, same bytes: whenever, wherever and by whomever the report is built."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import matplotlib
import pytest

from reports import build

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
def test_a_copy_elsewhere_in_another_process_gives_the_same_bytes(folder, built, tmp_path):
    copy = shutil.copytree(folder, tmp_path / "elsewhere", ignore=shutil.ignore_patterns("report.*"))
    environment = {**os.environ, "PYTHONHASHSEED": "77", "TZ": "Asia/Tokyo", "SOURCE_DATE_EPOCH": "1"}
    subprocess.run([sys.executable, "-m", "reports", str(copy)], cwd=ROOT, env=environment, check=True)
    for path in built:
        assert (copy / path.name).read_bytes() == path.read_bytes()


@pytest.mark.slow
def test_the_reader_s_own_figure_settings_do_not_count_and_stay(folder, built):
    before = [path.read_bytes() for path in built]
    with matplotlib.rc_context({"lines.linewidth": 7.0, "svg.fonttype": "none", "font.size": 20.0}):
        build(folder)
        assert matplotlib.rcParams["lines.linewidth"] == 7.0
    assert [path.read_bytes() for path in built] == before
