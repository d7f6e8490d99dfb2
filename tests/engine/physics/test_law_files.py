"""Law: one file is all that a law of tension or of drag takes.

The file of a how-to is saved in a copy of the engine, and its law is then one like the others.
Tension: the slope is the derivative, and the tension that of the stored energy, by central differences.
Drag: the pulls at both ends of a straight taut line across a current differ by its drag, below, in and above the
crisis; Newton's updates and perturbations across the plane solve the equations of `box_equations`, which have the law
and are linearised there by complex step.
"""

import os
import shutil

import pytest

from tests.pages import ROOT, blocks
from tests.processes import python

TENSION = """
import numpy as np
from engine.physics.tension.kernels import stored, tension
from engine.physics.strains import strain_at, tension_at
from engine.scene.reference import keys
from tests.engine.kernels import parameters_of
from tests.engine.lines import line

law = {"law": "stiffening", "stiffness_N": 2e4, "cubic_N": 3e5}
scene = line({"water.depth_m": 22.5}, tension=law)
p, tables = parameters_of(scene)
for eps in (-0.1, 0.0, 0.02, 0.3):
    ahead, behind = (tension(eps + h, p, tables)[0] for h in (1e-6, -1e-6))
    assert abs((ahead - behind) / 2e-6 - tension(eps, p, tables)[1]) < 1e-4 * 2e4
    ahead, behind = (stored(eps + h, p, tables) for h in (1e-6, -1e-6))
    assert abs((ahead - behind) / 2e-6 - tension(eps, p, tables)[0]) < 1e-4 * 2e4
    assert abs(tension_at(eps, scene.tether.tension) - (2e4 * eps + 3e5 * eps**3)) < 1e-9
assert abs(tension_at(strain_at(5000.0, scene.tether.tension), scene.tether.tension) - 5000.0) < 1e-6
assert "tether.tension.cubic_N" in keys()
"""
DRAG = """
import numpy as np
from engine import goes_in_lanes
from engine.scene.faults import SceneError
from engine.scene.reference import keys
from tests.engine.box_equations import state_of
from tests.engine.lines import STILL, equilibrium, forces, held, line, linear
from tests.engine.perturbations import test_lateral as lateral
from tests.engine.time import test_newton_jacobian as newton

law = {"law": "crisis", "critical": 1.2e5, "drop": 0.7}
assert keys()["tether.drag.viscosity_m2ps"].unit == "m2/s"
assert goes_in_lanes(line({"tether.drag": law}))
try:
    line({"tether.drag": law, "solver.scheme": "paper-box", "solver.integrator": "generalized-alpha"})
except SceneError as error:
    assert "tether.drag.law: given 'crisis'" in str(error)
else:
    raise AssertionError("the paper's scheme has the quadratic law only")

d, rho, L = 0.05, 1000.0, 20.0
for share_of_critical, x in ((0.5, 1 / 16), (1.0, 1.0), (4.0, 256.0)):
    U = share_of_critical * 1.2e5 * 1.2e-6 / d
    across = {"current": {"law": "uniform", "velocity_mps": [U, 0.0, 0.0]}, "water.density_kgpm3": rho}
    scene = line(
        STILL, held(0.0, 1.01 * L), across, length_m=L, diameter_m=d, drag_normal=1.2, density_kgpm3=rho, nodes=11,
        drag=law, tension=linear(1e8),
    )
    N = forces(equilibrium(scene).Y, 1e8)
    exact = 0.5 * rho * d * L * np.sqrt(1.01) * 1.2 * (1 - 0.7 * x / (1 + x)) * U**2
    assert abs(N[0, 0] - N[-1, 0] - exact) < 1e-4 * exact, (U, N[0, 0] - N[-1, 0], exact)

rng = np.random.default_rng(5)
for dimensions in (2, 3):
    scene = newton.scene_of(dimensions, "linear", "buoy", True, 24.0, **{"tether.drag": law})
    newton.assert_solved(scene, newton.STAGES["motion"], *state_of(rng, scene, newton.directions(rng, 0.3, dimensions)))
scene = lateral.scene_of("buoy", True, drag=law)
state, change = state_of(rng, scene, lateral.angles(rng, 0.5)), rng.normal(size=(lateral.NODES, 2))
exact = lateral.space_response(scene, *state, change, 5.0)[:, [1, 4]]
assert np.abs(lateral.kernel_response(scene, *state, change) - exact).max() < 1e-8 * np.abs(exact).max()
"""


@pytest.mark.parametrize(
    "law, check", [("tension", TENSION), pytest.param("drag", DRAG, marks=pytest.mark.slow)], ids=["tension", "drag"]
)
def test_the_file_of_the_page_is_all_that_a_law_takes(law, check, tmp_path):
    (text,) = (text for _, text in blocks("scenes") if text.startswith(f"# engine/physics/{law}/"))
    for package in ("engine", "machine_code"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / text[2:].partition(":")[0]).write_text(text)
    paths = os.pathsep.join([str(tmp_path), str(ROOT)])  # the tests themselves from here
    done = python("-c", check, cwd=tmp_path, PYTHONPATH=paths, TETHER_CACHE_DIR=str(tmp_path / "kernels"))
    assert done.returncode == 0, done.stderr
