"""Periodic orbits of a map, stable and unstable: found, followed along a parameter, with what happens to them there.

    from analysis.orbits import OrbitMap, find_orbit, follow_branch
    branch = follow_branch(system, find_orbit(system, start, parameter=1.0), 0.5, 2.0)

The map is two functions, its image and the product of its derivative with vectors; no matrix is ever formed, so that
maps with hundreds of coordinates serve as well as those with two. `maps` states what a map is, `spaces` has its
derivative on few directions, `finding` Newton's method, `branches` follows an orbit, `events` locates folds, flips and
torus points and begins the orbit of twice the period, `curves` follows events over two parameters. Names
are imported on first use.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "branches": ["Branch", "follow_branch"],
        "curves": ["Curve", "CurvePoint", "follow_curve"],
        "events": ["Event", "doubled_orbit"],
        "finding": ["Orbit", "Scatter", "find_orbit", "middle_of", "scatter_of"],
        "maps": ["NoImage", "OrbitMap"],
    },
)
