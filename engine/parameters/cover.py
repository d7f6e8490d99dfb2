"""Which scenes may share a batch, and which have a record type of their own (`engine.record.PLAIN`)."""

from ..physics import drag, tension
from ..scene.models import Scene


def goes_in_lanes(scene: Scene) -> bool:
    """May this scene share a batch: planar, by a Runge-Kutta method, a buoy at the end, nothing looked up in a table?

    Held and free ends, tabulated laws, currents with a profile, damping and profiles of the line are left out because
    few sweeps need them. Each would want its branches written as choices (`engine.simd.select`).
    """
    return (
        scene.solver.scheme != "paper-box"
        and scene.motion.dimensions == 2
        and scene.solver.integrator in ("esdirk43", "trbdf2")
        and scene.solver.shock_viscosity is None
        and _without_tables(scene)
        and scene.output.profiles is False
        and not scene.output.energy
        and not _is_damped(scene)
    )


def has_rare_laws(scene: Scene) -> bool:
    """Has the line a law that few scenes have (`engine.physics.extras`)?"""
    tether = scene.tether
    raised = any(scene.anchor.position_m)
    whole_push = tether.froude_krylov == "whole"
    in_part = tether.submergence != "full"
    return bool(_is_damped(scene) or raised or whole_push or in_part or scene.floor is not None)


def _is_damped(scene):
    return bool(scene.tether.damping_Ns or scene.tether.damping_critical)


def is_plain(scene: Scene) -> bool:
    """Has every term of this planar scene its simplest form: a regular wave if any, and a sphere without a cap?"""
    regular = scene.waves is None or not scene.waves.irregular
    return regular and _without_tables(scene) and scene.buoy.submergence == "full" and not has_rare_laws(scene)


def _without_tables(scene):
    line_drag = scene.tether.drag
    return (
        scene.end.kind == "buoy"
        and tension.LAWS[tension.NAMES.index(scene.tether.tension.law)].IN_LANES
        and (line_drag is None or drag.LAWS[drag.NAMES.index(line_drag.law)].IN_LANES)
        and (scene.current is None or scene.current.law == "uniform")
    )
