"""Which scenes may share a batch."""


def goes_in_lanes(scene):
    """May this scene share a batch? Planar, adaptive, a buoy at the end, no tables but a uniform current's, no profiles."""
    return (
        scene.solver.scheme != "paper-box"
        and scene.motion.dimensions == 2
        and scene.solver.integrator in ("esdirk43", "trbdf2")
        and scene.solver.shock_viscosity is None
        and scene.end.kind == "buoy"
        and scene.tether.tension.law != "tabulated"
        and (scene.current is None or scene.current.law == "uniform")
        and scene.output.profiles is False
    )
