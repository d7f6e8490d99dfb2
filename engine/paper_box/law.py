"""T = f(eps) and f'(eps), eqs. (20) and (29), on arrays of real or complex strains, for the complex step."""

import numpy as np

from ..physics.tension import LAWS


def tension_law(p: np.void, tables: np.ndarray, eps: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tension (N) and its slope (N) at strains eps of any shape. p, tables: as in `engine.parameters`."""
    return LAWS[int(p["law"])].of_array(eps, p, tables)
