"""The law of docs/howto_tension_law.md, saved as its one file in a copy of the engine, is a law like the others."""

import os
import shutil
import subprocess
import sys

from tests.pages import ROOT, blocks

CHECK = """
import numpy as np
from engine import load_scene
from engine.parameters import record_of
from engine.physics.tension.kernels import stored, tension
from engine.scales import strain_at, tension_at
from engine.scene.reference import keys

law = {"law": "stiffening", "stiffness_N": 2e4, "cubic_N": 3e5}
scene = load_scene("tethered_buoy", {"tether.tension": law})
tables = []
p, flat = record_of(scene, tables)[0], np.concatenate(tables)
for eps in (-0.1, 0.0, 0.02, 0.3):
    ahead, behind = (tension(eps + h, p, flat)[0] for h in (1e-6, -1e-6))
    assert abs((ahead - behind) / 2e-6 - tension(eps, p, flat)[1]) < 1e-4 * 2e4
    ahead, behind = (stored(eps + h, p, flat) for h in (1e-6, -1e-6))
    assert abs((ahead - behind) / 2e-6 - tension(eps, p, flat)[0]) < 1e-4 * 2e4
    assert abs(tension_at(eps, scene.tether.tension) - (2e4 * eps + 3e5 * eps**3)) < 1e-9
assert abs(tension_at(strain_at(5000.0, scene.tether.tension), scene.tether.tension) - 5000.0) < 1e-6
assert "tether.tension.cubic_N" in keys()
"""


def test_the_file_of_the_page_is_all_that_a_law_takes(tmp_path):
    (text,) = (text for kind, text in blocks("howto_tension_law") if text.startswith("# engine/physics/tension/"))
    for package in ("engine", "machine_code"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / text[2:].partition(":")[0]).write_text(text)
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "TETHER_CACHE_DIR": str(tmp_path / "kernels")}
    done = subprocess.run([sys.executable, "-c", CHECK], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
