"""What every command promises, for the campaigns on the method itself and for that out of the plane."""

import importlib
import subprocess
import sys

import pytest

from tests.campaigns.conftest import ROOT

FAULTS = {
    "accuracy": "--works regular stormy --rounds 9 --jobs 0 --bogus",
    "stability": "--fuzz -1 --seed x --drift-periods 10 --bogus",
    "out_of_plane": "--periods 0 --set waves.steepness=0.1 motion.dimensions=2 tether.mass=1 --bogus",
    "oscillator": "--set mass=3 damping=-1 --effort 0 --force-range 2 1 5 --bogus",
}


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_is_named_at_once_and_nothing_is_written(name, tmp_path, capsys):
    words = FAULTS[name].split()
    assert importlib.import_module(f"campaigns.{name}").main([*words, "--out", str(tmp_path / "new")]) == 2
    said = capsys.readouterr().err
    assert [word for word in words if ("--" in word or "=" in word) and word.partition("=")[0] not in said] == []
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("name", FAULTS)
def test_help_loads_nothing_heavy(name):
    code = f"import sys, campaigns.{name} as one; one.parser().format_help(); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numpy", "numba", "pandas", "scipy", "matplotlib", "pydantic", "hypothesis"} & set(loaded.split())
