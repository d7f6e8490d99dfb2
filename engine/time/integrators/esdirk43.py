"""ESDIRK4(3): the implicit part of ARK4(3)6L[2]SA, Kennedy & Carpenter, Appl. Numer. Math. 44 (2003) 139-181.

Six stages, the first explicit, gamma = 1/4, L-stable, stiffly accurate: order 4 with an embedded order 3.
"""

import numpy as np

ORDER, EMBEDDED_ORDER, ADAPTIVE = 4, 3, True
PHASE = 0.8  # rad of an oscillation a step: 100 cycles keep 99.6 % of it

A = np.zeros((6, 6))
A[1, :2] = 1 / 4, 1 / 4
A[2, :3] = 8611 / 62500, -1743 / 31250, 1 / 4
A[3, :4] = 5012029 / 34652500, -654441 / 2922500, 174375 / 388108, 1 / 4
A[4, :5] = 15267082809 / 155376265600, -71443401 / 120774400, 730878875 / 902184768, 2285395 / 8070912, 1 / 4
A[5, :] = 82889 / 524892, 0, 15625 / 83664, 69875 / 102672, -2260 / 8211, 1 / 4
B_EMBEDDED = np.array(
    [4586570599 / 29645900160, 0, 178811875 / 945068544, 814220225 / 1159782912, -3700637 / 11593932, 61727 / 225920]
)
