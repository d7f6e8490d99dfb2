"""Elementary functions that the kernels call at every node, in forms that LLVM can inline.

libm's sin and cos cost more than the rest of a node together; the pair below shares one range reduction.
"""

import math

import numpy as np

from ..compiled import kernel
from .select import every, some, where

# pi/2 in three parts (Cody & Waite 1980): k * PIO2_A and k * PIO2_B are exact for |k| < 2**20.
PIO2_A = float.fromhex("0x1.921fb544p+0")
PIO2_B = float.fromhex("0x1.0b4611a6p-34")
PIO2_C = math.pi / 2 - PIO2_A - PIO2_B + 6.123233995736766e-17
TWO_OVER_PI = 2.0 / math.pi


@kernel
def sincos(x):
    """Sine and cosine of one angle, to 1 unit in the last place for |x| < 1e6 rad.

    Taylor polynomials on [-pi/4, pi/4] after reduction by multiples of pi/2: terms up to x^17 and x^18,
    remainders 1e-19 and below.
    """
    k = np.rint(x * TWO_OVER_PI)
    r = ((x - k * PIO2_A) - k * PIO2_B) - k * PIO2_C
    z = r * r
    tail = -1.0 / 39916800 + z * (1.0 / 6227020800 + z * (-1.0 / 1307674368000 + z / 355687428096000))
    s = r + r * z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 + z * tail))))
    tail = 1.0 / 40320 + z * (-1.0 / 3628800 + z * (1.0 / 479001600 + z * (-1.0 / 87178291200 + z / 20922789888000)))
    c = 1.0 + z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * tail)))
    quadrant = k - 4.0 * np.floor(0.25 * k)
    second = quadrant == 1.0
    last = quadrant == 3.0
    crossed = second | last
    sine, cosine = where(crossed, c, s), where(crossed, s, c)
    return where(quadrant >= 2.0, -sine, sine), where(second | (quadrant == 2.0), -cosine, cosine)


@kernel
def small_exponentials(a):
    """exp(a) and exp(-a) for |a| <= 0.25 (one even and one odd Taylor polynomial, remainder below 2e-16)."""
    z = a * a
    even = 1.0 + z * (0.5 + z * (1.0 / 24 + z * (1.0 / 720 + z * (1.0 / 40320 + z / 3628800))))
    odd = a * (1.0 + z * (1.0 / 6 + z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880 + z / 39916800)))))
    return even + odd, even - odd


@kernel
def small_sincos(a):
    """sin(a) and cos(a) for |a| <= 0.25 (Taylor polynomials, remainder below 2e-16)."""
    z = a * a
    s = a * (1.0 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 - z / 39916800)))))
    c = 1.0 + z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 - z / 3628800))))
    return s, c


@kernel
def copy_into(target, source):
    """target[:] = source for arrays (n, m): the slice assignment itself takes Numba half a second to compile."""
    for k in range(target.shape[0]):
        for i in range(target.shape[1]):
            target[k, i] = source[k, i]


@kernel
def keep(mask, source, target):
    """target = source in the lanes of the mask, for arrays (n, m)."""
    if not some(mask):
        return
    for k in range(target.shape[0]):
        for i in range(target.shape[1]):
            target[k, i] = where(mask, source[k, i], target[k, i])


@kernel
def within(weights, C0, C1, K0, K1, k, i):
    """C[k, i] at one instant of a step, from both ends of it (`engine.time.time_loop.weights_within`)."""
    w0, w1, g0, g1, _ = weights
    return w0 * C0[k, i] + w1 * C1[k, i] + g0 * K0[k, i] + g1 * K1[k, i]


@kernel
def strain_within(weights, C0, C1, K0, K1):
    """Strain of a node at one instant of a step, from its rows of C and K at both ends, which begin with q.

    Between the lengths |q|, not the length of the q between: that is too short by a^4/384 where q turns by a. Of a
    stiff unknown the rates K hold to a^2/4 in a step: from a = 0.2 on the strain is linear, below the order is kept. A
    node that turned by 0.5 rad in 0.1 s was given -0.6 kN (Table 1); all stages were within 12 N of zero.
    """
    w0, w1, g0, g1, theta = weights
    square0 = square1 = rate0 = rate1 = product = 0.0
    for i in range(C0.shape[0] // 2):
        square0 += C0[i] * C0[i]
        square1 += C1[i] * C1[i]
        product += C0[i] * C1[i]
        rate0 += C0[i] * K0[i]
        rate1 += C1[i] * K1[i]
    length0, length1 = math.sqrt(square0), math.sqrt(square1)
    linear = (1.0 - theta) * length0 + theta * length1
    smooth = max(0.0, 1.0 - 50.0 * (1.0 - product / (length0 * length1)))  # 1 - (a/0.2)^2
    cubic = w0 * length0 + w1 * length1 + g0 * rate0 / length0 + g1 * rate1 / length1
    return linear + smooth * (cubic - linear) - 1.0


@kernel
def bracket(tables, at, n, value):
    """Where a value lies on an axis of n increasing numbers, tables[at : at + n].

    Returns the lower index, the weight of the upper neighbour, and 1/spacing (0 beyond the ends).
    """
    if n == 1 or value <= tables[at]:
        return 0, 0.0, 0.0
    if value >= tables[at + n - 1]:
        return n - 2, 1.0, 0.0
    low, high = 0, n - 1
    while high - low > 1:
        mid = (low + high) // 2
        if tables[at + mid] <= value:
            low = mid
        else:
            high = mid
    inverse = 1.0 / (tables[at + low + 1] - tables[at + low])
    return low, (value - tables[at + low]) * inverse, inverse


@kernel
def smooth_start(t, ramp):
    """sin^2(pi t/(2 ramp)) and its rate (1/s) up to t = ramp (s), then 1 and 0; ramp = 0: 1 and 0 from the start."""
    full = t >= ramp
    gain, rate = where(full, 1.0, 0.0), where(full, 0.0, 0.0)
    if not every(full):
        a = 0.5 * math.pi / ramp
        s = math.sin(a * t)
        gain, rate = where(full, gain, s * s), where(full, rate, a * math.sin(2.0 * a * t))
    return gain, rate
