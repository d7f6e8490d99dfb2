"""Law: the engine's elementary functions are those of the C library, to 2 units in the last place of values up to 1.

Near zeros of sine and cosine the reduction modulo pi/2 leaves an absolute error; 2 ulp of 1 is what the engine needs.
The stated 1 ulp for |x| < 1e6 is tried with long doubles on small arguments.
"""

import numpy as np

from engine.simd.elementary import sincos, small_exponentials, small_sincos

EPS = np.finfo(float).eps


def values(function, arguments):
    return np.array([function(x) for x in arguments]).T


def test_sine_and_cosine_are_numpys():
    """Also where the quadrant changes, from both sides, and with the exact values at 0."""
    rng, multiples = np.random.default_rng(1), np.arange(-4000, 4001) * (np.pi / 4)
    reaches = [np.append(rng.uniform(-reach, reach, 20000), [reach, -reach]) for reach in (0.1, 1.0, 10.0, 1e3, 1e6)]
    x = np.concatenate([*reaches, multiples, np.nextafter(multiples, np.inf), np.nextafter(multiples, -np.inf)])
    s, c = values(sincos, x)
    assert np.max(np.abs(s - np.sin(x))) <= 2 * EPS
    assert np.max(np.abs(c - np.cos(x))) <= 2 * EPS
    assert sincos(0.0) == (0.0, 1.0)


def test_small_arguments_keep_their_relative_accuracy():
    x = np.concatenate([np.random.default_rng(2).uniform(-0.78, 0.78, 20000), 10.0 ** -np.arange(1, 300, 7)])
    s, c = values(sincos, x)
    exact = np.sin(x.astype(np.longdouble))
    assert np.max(np.abs((s - exact) / exact)) <= 2 * EPS
    assert np.max(np.abs(c - np.cos(x.astype(np.longdouble)))) <= 2 * EPS


def test_short_polynomials_for_neighbouring_nodes():
    x = np.linspace(-0.25, 0.25, 4001)
    for function, exact in ((small_exponentials, (np.exp(x), np.exp(-x))), (small_sincos, (np.sin(x), np.cos(x)))):
        for mine, theirs in zip(values(function, x), exact, strict=True):
            assert np.max(np.abs(mine - theirs)) <= 3 * EPS  # remainder 2e-16, and the rounding of both
