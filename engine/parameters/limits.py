"""How much a run may ask for: samples live in memory until the run ends, and a short output step can ask for any number
of them; a long run in short steps would not end.
"""

from operator import itemgetter

from .. import parameters
from ..record import PROFILE_WIDTH
from ..time.integrators import METHODS
from .scales import longest_steps

MOST_SAMPLES = 20_000_000  # 2 GB of samples; 1e5 wave periods at a hundred samples each is half of it
MOST_PROFILE_VALUES = 400_000_000  # 3 GB of profiles
MOST_STEPS = 1e9  # a day or more of computing on one core


def longest_step(scene):
    """(key, s) of the longest time step that a run of the scene can take."""
    solver = scene.solver
    if solver.step_s:
        return "solver.step_s", solver.step_s
    if solver.scheme != "paper-box" and METHODS[solver.integrator].ADAPTIVE:
        return min(longest_steps(scene).items(), key=itemgetter(1))
    key = "solver.step_s" if solver.courant is None else "solver.courant"
    return key, float(parameters.record_of(scene, [])[0]["fixed_step"])  # its default goes by the period of the waves


def check_room(scene, duration_s):
    """Raises ValueError with the key to change where a run would never end, or keep more than memory usually holds."""
    output, sample_s = scene.output, scene.sample_step_s()
    values = scene.tether.nodes * PROFILE_WIDTH if output.profiles else 0
    profile_s = output.profiles_step_s or sample_s
    longest_key, longest_s = longest_step(scene)
    for key, step_s, width, limit, noun in (
        (longest_key, longest_s, 1, MOST_STEPS, "steps"),
        ("output.step_s", sample_s, 1, MOST_SAMPLES, "samples"),
        ("output.profiles_step_s", profile_s, values, MOST_PROFILE_VALUES, "values of profiles"),
    ):
        count = duration_s / step_s * width
        if count > limit:
            cure = "a longer step" if noun == "steps" else f"a step of {duration_s * width / limit:.3g} s or more,"
            raise ValueError(
                f"{key}: {step_s:g} s makes {count:.3g} {noun} or more in a run of {duration_s:g} s; allowed: at most "
                f"{limit:.3g}, {cure} or a shorter run"
            )
        passed = longest_s / step_s * width  # the last step goes past the end
        if passed > limit:
            raise ValueError(
                f"{longest_key}: a step of {longest_s:g} s may pass {passed:.3g} {noun}; allowed: at most "
                f"{limit:.3g}, a shorter step"
            )
