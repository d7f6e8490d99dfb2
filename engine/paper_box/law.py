"""T = f(eps) and f'(eps), eqs. (20) and (29), on arrays of real or complex strains, for the complex step."""

from ..physics.tension import LAWS


def tension_law(p, tables, eps):
    """Tension (N) and its slope (N) at strains eps of any shape. p, tables: as in `engine.parameters`."""
    return LAWS[int(p["law"])].of_array(eps, p, tables)
