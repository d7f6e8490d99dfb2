"""The works of the accuracy campaign: what is simulated, what its error is, and what it is held against.

Errors, over the even samples of a run:

    radius   rms of r(t) - r(t) of the reference, mm
    place    rms of the distance between the upper end's places, mm
    strain   mean over line and time of |strain - exact strain|, per cent of the static strain

The buoy is that of Table 1. The pendulum is a rope of its diameter, softer and shorter, with 2 kg at its lower end, in
air, pushed along and across: smooth, in three dimensions, and what every peer of rods can do. The breaking line is that
of section 4.1 without gravity on an even grid: it stays straight, so that the exact solution in one dimension
(`campaigns.breaking_line.theory`) is the reference.
"""

from dataclasses import dataclass

BUOY, LINE = "tethered_buoy", "breaking_line"
RADIUS, PLACE, STRAIN = "radius", "place", "strain"
UNITS = {RADIUS: "mm", PLACE: "mm", STRAIN: "%"}
PERIOD_S, SAMPLE_S = 5.0, 0.05


@dataclass(frozen=True)
class Work:
    """One work.

    rough: why methods do not show their orders on it, "" where it is smooth. reference, checks: (nodes, rtol) of the
    reference and of runs that show how far it is converged; no reference: the exact solution. The wave period, or
    1 s where there is none, is what steps per period are counted in. timed: False for a work that shows orders only.
    """

    name: str
    title: str
    scene: str
    changes: dict
    duration_s: float
    measure: str
    rough: str = ""
    reference: tuple[int, float] | None = None
    checks: tuple[tuple[int, float], ...] = ()
    period_s: float = PERIOD_S
    timed: bool = True

    def made(self, changes: dict):
        """The scene with further changes. Raises SceneError."""
        from engine import load_scene

        return load_scene(self.scene, {**self.changes, **changes})


def _buoy(steepness: float, depth_m: float) -> dict:
    return {"waves.steepness": steepness, "water.depth_m": depth_m, "output.step_s": SAMPLE_S}


def _line(force_N: float, decay_s: float) -> dict:
    return {
        "gravity_mps2": 0.0,
        "tether.grid_stretching": 0.0,
        "tether.grid_refined": "both",
        "end.force_N": [force_N, 0.0, 0.0],
        "end.force_decay_s": decay_s,
        "output.step_s": 5e-4,
        "output.profiles": True,
        "output.profiles_step_s": 5e-3,
        "output.energy": False,
    }


PENDULUM = {
    "water": None,
    "waves": None,
    "motion.dimensions": 3,
    "tether.length_m": 5.0,
    "tether.tension": {"law": "linear", "stiffness_N": 5e3},
    "tether.bending_stiffness_Nm2": 0.03,  # of the modulus that the stiffness and the section give
    "tether.torsion_stiffness_Nm2": 0.01,
    "buoy.mass_kg": 2.0,
    "buoy.added_mass_kg": 0.0,
    "start.buoy_velocity_mps": [1.5, 0.8, 0.0],
    "output.step_s": SAMPLE_S,
}
# Drag is |v| v, whose second derivative jumps where v changes its sign: no method of order 4 survives that. In a
# current that keeps the sign, and with waves that begin smoothly, the same motion has none of it.
NO_KINKS = {"waves.ramp_s": PERIOD_S, "current": {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.8]}}
SNAP = "the rope goes slack and snaps taut: its tension jumps within milliseconds"
KINK = "the edges of the break are nearly kinks, and no grid here resolves them"
FINE = (641, 1e-5)

WORKS = (
    Work("regular", "Regular buoy, kA = 0.016, H = 22.5 m, ten periods", BUOY, _buoy(0.016, 22.5), 50.0, RADIUS,
         "", FINE, ((161, 1e-5), (321, 1e-5), (641, 1e-4))),
    Work("regular-smooth", "Regular buoy without kinks in its drag, four periods", BUOY,
         {**_buoy(0.016, 22.5), **NO_KINKS}, 20.0, RADIUS, timed=False),
    Work("snap", "Snapping buoy, kA = 0.13, H = 22.5 m, ten periods", BUOY, _buoy(0.13, 22.5), 50.0, RADIUS,
         SNAP, FINE, ((161, 1e-5), (321, 1e-5), (641, 1e-4))),
    Work("violent", "Violent snapping, kA = 0.13, H = 21.6 m, ten periods", BUOY, _buoy(0.13, 21.6), 50.0, RADIUS,
         SNAP, FINE, ((161, 1e-5), (321, 1e-5), (641, 1e-4))),
    Work("break-1", "Breaking line, 45 kN, broken in 5 ms (case 1)", LINE, _line(45e3, 0.005), 0.06, STRAIN,
         KINK, period_s=1.0),
    Work("break-1-slow", "Breaking line, 45 kN, broken in 50 ms (case 1')", LINE, _line(45e3, 0.05), 0.08, STRAIN,
         period_s=1.0),
    Work("break-4", "Breaking line, 450 kN, broken in 5 ms (case 4)", LINE, _line(450e3, 0.005), 0.05, STRAIN,
         "a shock runs along the line: strain jumps", period_s=1.0),
    Work("pendulum", "Pendulum in three dimensions, 10 s", BUOY, PENDULUM, 10.0, PLACE, "", (161, 1e-6),
         ((81, 1e-6), (161, 1e-5), (321, 1e-6)), period_s=1.0),
)  # fmt: skip
BY_NAME = {work.name: work for work in WORKS}
