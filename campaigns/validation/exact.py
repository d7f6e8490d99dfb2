r"""The elastic catenary between two held ends, dry, and its small free motions in its plane.

Weight w per unstretched length s, T = EA eps, force (H, V + w s) at s (Irvine, Cable Structures, 1981, section 1.3):

    x(s) = H s/EA + (H/w) [asinh((V + w s)/H) - asinh(V/H)]
    z(s) = (V s + w s^2/2)/EA + [T(s) - T(0)]/w

H and V put the upper end where it is held. Small motions d about it obey m d_tt = (K d_s)_s, d = 0 at both ends, with

    K = EA t t' + T/(1 + eps) (1 - t t'),   t the tangent,

without any assumption on the sag. Chebyshev collocation gives the frequencies to rounding (Trefethen, Spectral Methods
in MATLAB, 2000, chapter 6).
"""

from dataclasses import dataclass

import numpy as np

POINTS = 60  # of the collocation; 40 give the same ten digits


@dataclass(frozen=True)
class Catenary:
    """H, V: force (N) at the lower end; w: weight (N/m); EA: stiffness (N); m: mass (kg/m); length: unstretched (m)."""

    H: float
    V: float
    w: float
    EA: float
    m: float
    length: float

    def tension(self, s: np.ndarray) -> np.ndarray:
        """T (n,), N, at s (n,), m."""
        return np.hypot(self.H, self.V + self.w * s)

    def place(self, s: np.ndarray) -> np.ndarray:
        """x and z (2, n), m, from the lower end, at s (n,), m."""
        H, V, w, EA = self.H, self.V, self.w, self.EA
        x = H * s / EA + H / w * (np.arcsinh((V + w * s) / H) - np.arcsinh(V / H))
        return np.array([x, (V * s + 0.5 * w * s * s) / EA + (self.tension(s) - np.hypot(H, V)) / w])


def catenary(scene) -> Catenary:
    """That of a scene with a held end to the right of its anchor, dry, and a linear law."""
    from scipy.optimize import fsolve

    tether, end = scene.tether, np.array(scene.end.position_m)[[0, 2]]
    m = tether.density_kgpm3 * tether.area_m2
    fixed = m * scene.gravity_mps2, tether.tension.stiffness_N, m, tether.length_m
    weight = fixed[0] * tether.length_m

    def difference(force):
        return Catenary(np.exp(force[0]), force[1], *fixed).place(np.array([tether.length_m]))[:, 0] - end

    solution, _, ok, message = fsolve(difference, [np.log(weight), -0.5 * weight], xtol=1e-13, full_output=True)
    if ok != 1 and np.abs(difference(solution)).max() > 1e-9 * tether.length_m:
        raise ValueError(f"no catenary found: {message}")
    return Catenary(float(np.exp(solution[0])), float(solution[1]), *fixed)


def frequencies(line: Catenary, count: int) -> np.ndarray:
    """The `count` lowest frequencies (Hz) of motions in the plane of the catenary, rising."""
    D, at = differences(POINTS)
    s, D = 0.5 * line.length * (1.0 - at), -2.0 / line.length * D
    T, n = line.tension(s), len(s)
    t = np.array([np.full(n, line.H), line.V + line.w * s]) / T
    across = T / (1.0 + T / line.EA)
    blocks = [[None, None], [None, None]]
    for i in range(2):
        for j in range(2):
            K = (line.EA - across) * t[i] * t[j] + (i == j) * across
            blocks[i][j] = (D @ np.diag(K) @ D)[1:-1, 1:-1]
    A = np.block(blocks)
    square = np.sort(-np.linalg.eigvals(A / line.m).real)
    return np.sqrt(square[:count]) / (2.0 * np.pi)


def differences(n: int) -> tuple[np.ndarray, np.ndarray]:
    """(matrix of first derivatives (n + 1, n + 1), places (n + 1,) from 1 to -1) of Chebyshev's points."""
    at = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.where(np.arange(n + 1) % n == 0, 2.0, 1.0) * (-1.0) ** np.arange(n + 1)
    D = np.outer(c, 1.0 / c) / (at[:, None] - at[None, :] + np.eye(n + 1))
    return D - np.diag(D.sum(axis=1)), at
