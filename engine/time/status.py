"""How a run can end: codes inside the kernels, words outside.

A step returns a code, it never raises; the run ends with the first code that smaller steps do not cure.
"""

(
    OK, NEWTON_FAILED, STEP_UNDERFLOW, TURN_UNRESOLVED, STRAIN_BELOW_MINUS_ONE, NOT_FINITE, STATICS_FAILED, STEP_LIMIT,
    TENSION_FLAT, SHAPE_LOST, IN_THE_AIR,
) = range(11)  # fmt: skip
WORDS = dict(
    enumerate(
        "ok newton-failed step-underflow turn-unresolved strain-below-minus-one not-finite statics-failed step-limit "
        "tension-flat shape-lost statics-failed".split()
    )
)

WAVES_ON_ELEMENT = (  # of a run that is ok
    "elements of {length:.2g} m are longer than the waves reach down ({depth:.2g} m): tensions hold to {force} N; "
    "add nodes, or refine the grid upwards (tether.grid_stretching)"
)
ADVICE = {  # of the conservation form; `paper_box.driver` has its own
    OK: "",
    NEWTON_FAILED: "Newton's method did not converge at t = {t:.6g} s, at the smallest step tried ({dt:.2g} s): "
    "lower {steps}, or add nodes",
    STEP_UNDERFLOW: "the error control asks for steps below solver.min_step_s at t = {t:.6g} s (last step {dt:.2g} s): "
    "raise solver.rtol, lower solver.min_step_s, or look for a load or mass that no line of this size could bear",
    TURN_UNRESOLVED: "the tether turns by {turn:.3g} rad within one element at t = {t:.6g} s ({releases} loop releases "
    "so far): add nodes, raise solver.max_loop_releases, or study the scene in three dimensions",
    STRAIN_BELOW_MINUS_ONE: "an element is compressed to nothing (strain <= -1) at t = {t:.6g} s: the tension law has "
    "too little stiffness in compression, or bending is left out in slack",
    NOT_FINITE: "a value that is not a finite number appeared at t = {t:.6g} s; waves extrapolated far above still "
    'water grow without bound: compare waves.above_still_water = "zero"',
    STATICS_FAILED: "no static equilibrium was found from which to start: ",  # goes on: engine.time.statics.why_no_rest
    IN_THE_AIR: "at rest the whole sphere would stand in the air, loaded as in water: raise water.depth_m, shorten "
    "the line, or let it float, buoy.submergence = 'spherical-cap'",
    STEP_LIMIT: "the run stands still at t = {t:.6g} s: 20 000 steps of {dt:.2g} s were tried within the "
    "time of one usual step, or Newton's method failed at a sixth of all that were tried; raise solver.rtol, or look "
    "for what the grid cannot resolve (compression without bending, for one)",
}
