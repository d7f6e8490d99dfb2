"""TR-BDF2: Bank et al. 1985 as an ESDIRK3 pair, Hosea & Shampine, Appl. Numer. Math. 20 (1996) 21-37.

gamma = 1 - 1/sqrt 2 on the diagonal, L-stable, stiffly accurate: order 2 with an embedded order 3.
"""

import numpy as np

ORDER, EMBEDDED_ORDER, ADAPTIVE = 2, 3, True
PHASE = 0.25  # rad of an oscillation a step: 100 cycles keep 96 % of it

_G = 1 - 1 / np.sqrt(2)
_W = np.sqrt(2) / 4
A = np.array([[0, 0, 0], [_G, _G, 0], [_W, _W, _G]])
B_EMBEDDED = np.array([(1 - _W) / 3, (3 * _W + 1) / 3, _G / 3])
