"""What a map is, and what one shot from every point of an orbit tells: gaps, and the derivative without a matrix.

An orbit of period N is N points z_0 ... z_{N-1} with P(z_i, lambda) = z_{i+1} and z_N = z_0. All N points are unknowns
(multiple shooting, one segment a period), so that errors of an unstable orbit grow over one period and not over N:

    d_{i+1} = J_i d_i + b_i delta + r_i,    r_i = P(z_i) - z_{i+1},   J_i = dP/dz,   b_i = dP/dlambda     (a)

Newton's update must close: d_N = d_0. Because (a) is affine in d_0 and delta, only they are left as unknowns,

    (I - M) d_0 - B delta = R,    M = J_{N-1} ... J_0,    R, B: d_N from the r_i, from the b_i, alone     (b)

and the other d_i follow by (a). M has the multipliers of the orbit as eigenvalues.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

DIFFERENCE = 1e-5  # of parameter_size, where a map does not tell its derivative by the parameter


class NoImage(Exception):
    """Raised by a map at a state that has no image; its message says why, as the end of a sentence."""


@dataclass(frozen=True, eq=False)
class OrbitMap:
    """A map P(z, parameter) of states z (n,), in coordinates of which |z| is a measure of distance.

    A branch is followed in steps of |z_0|. What follows from other coordinates, as rates do, or changes with the steps
    by which a system is computed, must be small in z: otherwise steps of the branch drown in it. Orbits and multipliers
    do not depend on the scale.

    step             (z, parameter) -> (image (n,), linearised); linearised(V (n, k)) -> (n, k) is dP/dz V at z. It may
                     raise NoImage
    along            (z, parameter) -> dP/dparameter (n,); None: by central differences of `step`
    frozen           (points (N, n), parameter) -> N maps, one for each point, that are smooth near these points: for a
                     map that is computed in steps, with the steps of that orbit; None: the map is smooth as it is
    parameter_size   the change of the parameter that counts as 1
    """

    step: Callable[[np.ndarray, float], tuple[np.ndarray, Callable[[np.ndarray], np.ndarray]]]
    along: Callable[[np.ndarray, float], np.ndarray] | None = None
    frozen: Callable[[np.ndarray, float], Sequence["OrbitMap"]] | None = None
    parameter_size: float = 1.0

    def near(self, points: np.ndarray, parameter: float) -> Sequence["OrbitMap"]:
        """The maps to be used near an orbit, one for each of its points."""
        return [self] * len(points) if self.frozen is None else self.frozen(points, parameter)

    def slope(self, z: np.ndarray, parameter: float) -> np.ndarray:
        """Derivative (n,) of the image by the parameter in units of `parameter_size`."""
        if self.along is not None:
            return self.along(z, parameter) * self.parameter_size
        h = DIFFERENCE * self.parameter_size
        ahead, behind = (self.step(z, parameter + change)[0] for change in (h, -h))
        return (ahead - behind) / (2.0 * DIFFERENCE)


@dataclass(frozen=True, eq=False)
class Shots:
    """One shot from every point: gaps r (N, n), slopes b (N, n) and the products with J_i (head of this file)."""

    gaps: np.ndarray
    slopes: np.ndarray
    linearised: tuple[Callable[[np.ndarray], np.ndarray], ...]

    @property
    def residual(self) -> float:
        """Largest gap; NaN where an image is not finite."""
        return float(np.abs(self.gaps).max())

    def carried(self, vectors: np.ndarray) -> np.ndarray:
        """M V for vectors V (n, k)."""
        for linear in self.linearised:
            vectors = linear(vectors)
        return vectors

    def chain(self, first: np.ndarray, known: np.ndarray) -> np.ndarray:
        """d_0 ... d_N (N + 1, n) of equation (a) from d_0 = first (n,), with known parts (N, n)."""
        found = [first]
        for linear, part in zip(self.linearised, known, strict=True):
            found.append(linear(found[-1][:, None])[:, 0] + part)
        return np.array(found)


def shoot(maps: Sequence[OrbitMap], points: np.ndarray, parameter: float, with_slopes: bool) -> Shots:
    """One shot from every point (N, n). Raises NoImage, also where an image is not finite."""
    images, linearised = zip(*(m.step(z, parameter) for m, z in zip(maps, points, strict=True)), strict=True)
    gaps, slopes = np.array(images) - np.roll(points, -1, axis=0), np.zeros_like(points)
    if with_slopes:
        slopes = np.array([m.slope(z, parameter) for m, z in zip(maps, points, strict=True)])
    if not (np.isfinite(gaps).all() and np.isfinite(slopes).all()):
        raise NoImage("an image is not finite")
    return Shots(gaps, slopes, linearised)
