"""Eq. (33), the snap oscillator, integrated exactly: section, exponents, diagrams, basins, periodic orbits, grazing.

    from analysis.oscillator import SnapOscillator, snap_exponents
    print(snap_exponents(SnapOscillator()).first)

`equation` states it, `pieces` holds the closed forms, `crossings` finds the switching times and says why none is
missed, `strobing` carries state and tangent over a forcing period; the rest asks questions. Everything is
dimensionless, as in the paper. Names are imported on first use.
"""

from analysis.on_first_use import on_first_use

_HOME = {
    "SnapOscillator": "equation",
    "SnapMotion": "motions",
    "snap_motion": "motions",
    "strobed_states": "motions",
    "strobed_states_within": "motions",
    "SnapExponents": "growth",
    "snap_exponents": "growth",
    "section_dimension": "growth",
    "SnapDiagram": "diagrams",
    "snap_diagram": "diagrams",
    "SnapBasins": "basin_grids",
    "snap_basins": "basin_grids",
    "start_grid": "basin_grids",
    "PeriodicOrbit": "newton_orbits",
    "periodic_orbit": "newton_orbits",
    "search_periodic_orbits": "newton_orbits",
    "Grazing": "grazing",
    "grazing_force": "grazing",
    "clearance": "grazing",
}

__all__ = [*_HOME]
__getattr__, __dir__ = on_first_use(__name__, _HOME)
