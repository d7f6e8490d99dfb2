"""The line of section 4.1 and its cases: static tension [N], breaking time [s]."""

from itertools import product

LENGTH = 60.0
MASS = 1140.0 * 1.964e-3
FAST, SLOW = 5e-3, 50e-3
TENSIONS = (45e3, 180e3, 315e3, 450e3)
CASES = {f"{i + 1}{mark}": (TENSIONS[i], t) for i, (mark, t) in product(range(4), (("", FAST), ("p", SLOW)))}
