"""How much a run may ask for: samples live in memory until the run ends, and a short output step can ask for any number
of them; a long run in short steps would not end.
"""

from .. import parameters
from ..time.integrators import METHODS

MOST_SAMPLES = 20_000_000  # 2 GB of samples; 1e5 wave periods at a hundred samples each is half of it
MOST_PROFILE_VALUES = 400_000_000  # 3 GB of profiles
PROFILE_QUANTITIES = 6
MOST_STEPS = 1e9  # a day or more of computing on one core


def longest_step(scene):
    """(key, s) of the longest time step that a run of the scene can take."""
    solver = scene.solver
    if solver.step_s:
        return "solver.step_s", solver.step_s
    if solver.courant is not None:
        return "solver.courant", _fixed_step(scene)
    if solver.scheme == "paper-box" or not METHODS[solver.integrator].ADAPTIVE:
        return "solver.step_s", _fixed_step(scene)  # its default goes by the period of the waves
    return "solver.max_step_s", solver.max_step_s


def _fixed_step(scene):
    return float(parameters.record_of(scene, [])[0]["fixed_step"])


def check_room(scene, duration_s):
    """Raises ValueError with the key to change where a run would never end, or keep more than memory usually holds."""
    key, step_s = longest_step(scene)
    if duration_s / step_s > MOST_STEPS:
        raise ValueError(
            f"{key}: {step_s:g} s makes {duration_s / step_s:.3g} steps or more of a run of {duration_s:g} s; allowed: "
            f"at most {MOST_STEPS:.3g}, a longer step or a shorter run"
        )
    step_s = scene.sample_step_s()
    samples = duration_s / step_s
    if samples > MOST_SAMPLES:
        raise ValueError(
            f"output.step_s: {step_s:g} s gives {samples:.3g} samples in {duration_s:g} s; allowed: at most "
            f"{MOST_SAMPLES:.3g}, a step of {duration_s / MOST_SAMPLES:.3g} s or more, or a shorter run"
        )
    if not scene.output.profiles:
        return
    step_s = scene.output.profiles_step_s or step_s
    values = duration_s / step_s * scene.tether.nodes * PROFILE_QUANTITIES
    if values > MOST_PROFILE_VALUES:
        longest = duration_s * scene.tether.nodes * PROFILE_QUANTITIES / MOST_PROFILE_VALUES
        raise ValueError(
            f"output.profiles_step_s: {step_s:g} s gives {values:.3g} values along the line in {duration_s:g} s; "
            f"allowed: at most {MOST_PROFILE_VALUES:.3g}, a step of {longest:.3g} s or more, or a shorter run"
        )
