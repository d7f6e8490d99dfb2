"""The campaigns on the method itself: what every command promises, for the three that are no sweeps of a scene."""

import importlib
import subprocess
import sys

import pytest

from tests.campaigns.conftest import ROOT

FAULTS = {
    "accuracy": "--works regular stormy --rounds 9 --jobs 0 --bogus",
    "stability": "--fuzz -1 --seed x --drift-periods 10 --bogus",
    "oscillator": "--set mass=3 damping=-1 --effort 0 --force-range 2 1 5 --bogus",
}


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_is_named_at_once_and_nothing_is_written(name, tmp_path, capsys):
    words = FAULTS[name].split()
    assert importlib.import_module(f"campaigns.{name}").main([*words, "--out", str(tmp_path / "new")]) == 2
    said = capsys.readouterr().err
    assert [option for option in words if option.startswith("--") and option not in said] == []
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("name", FAULTS)
def test_help_loads_nothing_heavy(name):
    code = f"import sys, campaigns.{name} as one; one.parser().format_help(); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numpy", "numba", "pandas", "scipy", "matplotlib", "pydantic", "hypothesis"} & set(loaded.split())
