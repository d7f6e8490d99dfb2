"""Columns of the planar work arrays; row k belongs to node k. A name is an index: `Y[k, col.PHI]`.

Y, D    strain, shear force (N), velocity (m/s), angle from the x axis (rad), curvature (rad/m); D is Newton's update
C, C~   conserved variables: q = (1 + eps) t and the velocity; K holds their rates. The velocity is where Y has it
X       place (m)
F       velocity (m/s) and acceleration (m/s2) of the water
Q       what the box equations need of a node (`engine.planar.node`)
E       the elimination (`engine.planar.elimination`): in row k P, p of the box below node k, and R, r of the node
"""

from ..record import STRETCH

EPS, SHEAR, VX, VZ, PHI, KAPPA = range(6)  # Y, D
CX, CZ = 0, 1  # C, C~, K: q; the velocity follows in VX, VZ
UX, UZ, AX, AZ = range(4)  # F

COS, SIN, SLOPE = 0, 1, 2  # Q: of phi; dT/deps; `vector(Q[k], COS)` reads all three
NX, NZ = 3, 4  # force N = T t + S n
QX, QZ = STRETCH, STRETCH + 1  # q
QX_T, QZ_T = 7, 8  # dq/dt
GX, GZ = 9, 10  # load G per length
GX_EPS, GZ_EPS = 11, 12  # dG/deps
GX_PHI, GZ_PHI = 13, 14  # dG/dphi
GXX, GXZ, GZX, GZZ = 15, 16, 17, 18  # dG/dV
M, M_EPS, M_SHEAR = 19, 20, 21  # M = (1 + eps)^3 S and its derivatives
TURN = 22  # held of a released loop in the box below (`engine.time.time_loop.hold_turn`)
SHOCK_B, SHOCK_L = 23, 24  # shock viscosity: the last two columns, as in space
NODE_WIDTH = 25

P, P_KNOWN = 0, 9  # E, row k: y of node k - 1 = P y of node k + p; 3 x 3 row by row, and 3
R, R_KNOWN = 12, 21  # v = R y + r, both of node k
BOX_WIDTH = 24
INVERSE = 24  # of the box, 9 numbers, for other right-hand sides of the same matrix
WITH_INVERSE = 33
TOP = 0  # in the row of the anchor, which has no box below: the inverse at the upper end, 9 numbers
TOP_DXX, TOP_DXZ, TOP_DZX, TOP_DZZ = 24, 25, 26, 27  # and D there, where the inverses are kept
