"""The arrays that kernels hand to each other, as named tuples. n nodes; unknowns 6 or 13, conserved variables 4 or 6.

Columns are named in `engine.planar.columns`, `engine.spatial.columns` and, for what both have, `engine.record`.
"""

from collections import namedtuple

# Which equations Newton's method solves: those of a stage of a time step, or of statics. t (s): when the water is
# taken; in_motion: 1.0, or 0.0 in statics (a float: Numba would compile True and False apart); cq, cv (1/s): rates are
# q_t = cq (q - q~) and V_t = cv (V - V~), with C~ = (q~, V~) in Work
Stage = namedtuple("Stage", "t in_motion cq cv")
# Arrays of one Newton solve, n rows each. X: places (m); F: velocity and acceleration of the water; Q: nodal
# quantities; E: eliminated boxes; D: Newton's update of the unknowns; C_tilde: known part of the conserved variables;
# sea (n + 1, WIDTH): the sums of a sea of several waves (`engine.physics.sea_series`); in the last row of which time,
# and 1.0 where there is anything
Work = namedtuple("Work", "X F Q E D C_tilde sea")
# An accepted state: unknowns Y (n, unknowns), those of the step before, conserved C (n, conserved), their rates K
Motion = namedtuple("Motion", "Y Y_before C K")
# A step to try: from t (s) by dt (s), dt_before (s) after the state before (0: there is none); small: whether it is one
# of backward Euler in the place of a Runge-Kutta method
Step = namedtuple("Step", "t dt dt_before small")
# What a trial step finds: Y (s, n, unknowns) and K (s, n, conserved) of its s stages (two in a one-stage method, which
# fills the last), of which the last is the new state; C (n, conserved): conserved variables of that state
Trial = namedtuple("Trial", "Y K C")
# What a run keeps: samples (m, 13), profiles (m', n, 6), energies (m'', 12) and their running sums (7,)
Output = namedtuple("Output", "samples profiles energies sums")
# Accepted steps, for perturbations: T (l, 3), begin, length and kind; Y and K (l, s, n, .): stages and rates
Trail = namedtuple("Trail", "T Y K")
