"""Columns of the work arrays in space; row k belongs to node k. A vector begins at its name: `vector(Q[k], col.N)`.

Y       strain, shear forces (N), velocity (m/s), Euler parameters, twist and curvatures (rad/m): O1, O2, O3
D       Newton's update, in which a rotation vector theta (rad) takes the place of the Euler parameters
C, C~   conserved variables: q = (1 + eps) t and the velocity V; K holds their rates
X       place (m)
F       velocity (m/s) and acceleration (m/s2) of the water
Q       what the box equations need of a node (`engine.spatial.node`)
E       the elimination: in row k P, p, p' of the box below node k (y of node k - 1 from y of node k), and R, r, r' of
        node k; rows of five, one for each of y = (eps, Sn, Sb, theta2, theta3)
"""

from ..record import STRETCH

EPS, SHEAR_N, SHEAR_B, V, BETA, O1, O2, O3 = 0, 1, 2, 3, 6, 10, 11, 12  # Y; V also in C
THETA1, THETA2, THETA3, D_O1, D_O2, D_O3 = range(6, 12)  # D, after EPS ... V
ACCELERATION = 3  # F: of the water, after its velocity

N, SLOPE, STRETCHED = 0, 3, 4  # Q: N; dT/deps; 1 + eps
Q, Q_T = STRETCH, 8  # q, dq/dt
T_VECTOR, N_VECTOR, B_VECTOR = 11, 14, 17  # t, n, b; `rows_of(Q[k], T_VECTOR)` reads all three
G, G_EPS, G_THETA2, G_THETA3 = 20, 23, 26, 29  # load G per length and its derivatives
G_V = 32  # dG/dV, row by row
M2, M3, CUBE, TENSION = 41, 42, 43, 44  # moments; (1 + eps)^3; T
SHOCK_B, SHOCK_L = 45, 46  # shock viscosity
NODE_WIDTH = 47
N_TURN2, N_TURN3 = 47, 48  # of EXTRA records alone (`engine.spatial.extras`): dN/dtheta2, dN/dtheta3 along t
EXTRA_WIDTH = 49

P, P_KNOWN, P_TORQUE = 0, 25, 30  # E: y_a = P y_b + p + p' dO1; P row by row
R, R_KNOWN, R_TORQUE = 35, 65, 71  # v = R y + r + r' dO1, rows of v: V, O2, O3, theta1
BOX_WIDTH = 77
TOP, TOP_TORQUE = 0, 5  # in the row of the anchor, which has no box below: y of the upper end, and dO1
ROLL = 25  # of R: where its last row, theta1, begins (R + ROLL)
