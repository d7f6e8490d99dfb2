"""`python -m reports`: quick to say what it does, and quick enough for a large sweep."""

import subprocess
import sys
import time
from pathlib import Path

import pytest

from reports import build
from tests.reports.synthetic import campaign

ROOT = Path(__file__).parents[2]


def test_help_loads_nothing_heavy():
    code = "import sys, runpy; sys.argv = ['reports', '--help']\n"
    code += "try: runpy.run_module('reports', run_name='__main__')\n"
    code += "except SystemExit: print(sorted({'numpy', 'matplotlib', 'pandas', 'numba', 'typst'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert "folder of a finished campaign" in done.stdout and done.stdout.strip().endswith("[]")


@pytest.mark.slow
def test_sixty_long_runs_within_fifteen_seconds_of_processor_and_ten_megabytes(tmp_path):
    steepness = [round(0.01 + 0.0025 * k, 4) for k in range(60)]
    folder = campaign(tmp_path / "out", steepness, periods=300, transient=100)
    start = time.process_time()
    paths = build(folder)
    assert time.process_time() - start < 15.0
    assert all(path.stat().st_size < 10e6 for path in paths)
