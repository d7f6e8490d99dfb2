"""Time integrators, one method a file. Two families share every kernel.

Diagonally implicit Runge-Kutta: a stage is C_i = C~ + a_ii dt K_i with C~ = C_n + dt sum_{j<i} a_ij K_j, so its rates
are K_i = (C_i - C~)/(a_ii dt). One-stage (generalized-alpha) family: the stage state lies at t_n + alpha_f dt.
`METHODS` maps the name in `solver.integrator` to its coefficients. A Runge-Kutta method lies in `tables` from
p.method_at on: A (s, s), c (s,), b - b embedded (s,). PHASE: what a step may turn of ringing that is to stay.
"""

from . import backward_euler, esdirk43, generalized_alpha, midpoint, trbdf2

METHODS = {
    "esdirk43": esdirk43,
    "trbdf2": trbdf2,
    "midpoint": midpoint,
    "backward-euler": backward_euler,
    "generalized-alpha": generalized_alpha,
}
