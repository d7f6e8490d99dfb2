"""Eq. (33), the snap oscillator, integrated exactly: section, exponents, diagrams, periodic orbits, grazing.

    from analysis.oscillator import SnapOscillator, snap_exponents
    print(snap_exponents(SnapOscillator()).first)

`equation` states it, `pieces` holds the closed forms, `crossings` finds the switching times and says why none is
missed, `strobing` carries state and tangent over a forcing period; the rest asks questions. Everything is
dimensionless, as in the paper. Names are imported on first use.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "attractors": [
            "grazing_force", "search_periodic_orbits", "settled_periods", "snap_map",
            "start_grid",
        ],
        "equation": ["SnapOscillator"],
        "growth": ["SnapDiagram", "SnapExponents", "section_dimension", "snap_diagram", "snap_exponents"],
        "motions": ["SnapMotion", "snap_motion", "strobed_states", "strobed_states_within"],
    },
)  # fmt: skip
