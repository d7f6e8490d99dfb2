"""What a map is, and what one shot from every point of an orbit tells: its gaps.

An orbit of period N is N points z_0 ... z_{N-1} with P(z_i, lambda) = z_{i+1} and z_N = z_0. All N points are unknowns
(multiple shooting, one segment a period), so that errors of an unstable orbit grow over one period and not over N.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

TOLERANCE = 1e-9  # of the gaps of an orbit, relative to the largest coordinate of the guess or 1
IN_STEPS = 1e-6  # the same for a map that is computed in steps: other steps move its points by 1000 times as much
DIFFERENCE = 1e-5  # of parameter_size, where a map does not tell its derivative by the parameter
Linearised = Callable[[np.ndarray], np.ndarray]
Step = Callable[[np.ndarray, float], tuple[np.ndarray, Linearised]]


class NoImage(ArithmeticError):
    """A state has no image; the message says why, as the end of a sentence. Any ArithmeticError is taken so."""


class NotSolved(NoImage):
    """There may be an image or an orbit, but the computation does not come to it."""


@dataclass(frozen=True, eq=False)
class OrbitMap:
    """A map P(z, parameter) of states z (n,), in coordinates of which |z| is a measure of distance.

    A branch is followed in steps of what is seen of z_0. What changes with the steps by which a system is computed must
    be small in it: otherwise steps of the branch drown in that. Orbits and multipliers do not depend on it.

    step             (z, parameter) -> (image (n,), linearised); linearised(V (n, k)) -> (n, k) is dP/dz V at z. An
                     ArithmeticError says that there is no image, and why: the end of a sentence
    along            (z, parameter) -> dP/dparameter (n,); None: by a difference of `step`
    frozen           (points (N, n), parameter, mesh) -> N functions as `step`, one for each point, that are smooth
                     near these points: for a map that is computed in steps, with the steps of that orbit; mesh 0 ...
                     meshes - 1 chooses among steps of the same accuracy. None: the map is smooth as it is
    parameter_size   the change of the parameter that counts as 1; (m,) where `parameter` is an array (m,) of several,
                     and `along` then gives (n, m)
    meshes           how many there are: the differences between them are the errors of an orbit
    abreast          directions that `linearised` carries at the cost of one
    seen             (n, m): seen.T @ z is what distances along a branch are measured in; None: all of z
    """

    step: Step
    along: Callable[[np.ndarray, float], np.ndarray] | None = None
    frozen: Callable[[np.ndarray, float, int], Sequence[Step]] | None = None
    parameter_size: float = 1.0
    meshes: int = 1
    abreast: int = 1
    seen: np.ndarray | None = None

    @property
    def tolerance(self) -> float:
        """To which the gaps of its orbits are closed."""
        return TOLERANCE if self.frozen is None else IN_STEPS

    def near(self, points: np.ndarray, parameter: float, mesh: int = 0) -> Sequence["OrbitMap"]:
        """The maps to be used near an orbit, one for each of its points."""
        if self.frozen is None:
            return [self] * len(points)
        return [replace(self, step=step, frozen=None) for step in self.frozen(points, parameter, mesh)]

    def row(self, change: np.ndarray, rate: float) -> np.ndarray:
        """(n + 1,) of the inner product with a change (n,) of a point and one of the parameter, in what is seen."""
        if self.seen is not None:
            change = self.seen @ (self.seen.T @ change)
        return np.append(change, rate)

    def length(self, change: np.ndarray, rate: float) -> float:
        """Length of such a change."""
        return float(np.sqrt(self.row(change, rate) @ np.append(change, rate)))

    def slope(self, z: np.ndarray, parameter: float, image: np.ndarray) -> np.ndarray:
        """Derivative (n,) of the image by the parameter in units of `parameter_size`."""
        if self.along is not None:
            return self.along(z, parameter) * self.parameter_size
        if not np.ndim(parameter):
            return (self.step(z, parameter + DIFFERENCE * self.parameter_size)[0] - image) / DIFFERENCE
        slopes = []
        for change in np.diag(DIFFERENCE * np.ones(len(parameter)) * self.parameter_size):
            slopes.append((self.step(z, parameter + change)[0] - image) / DIFFERENCE)
        return np.stack(slopes, axis=1)


@dataclass(frozen=True, eq=False)
class Shots:
    """One shot from every point: images (N, n), gaps P(z_i) - z_{i+1} (N, n), and the products with J_i = dP/dz."""

    images: np.ndarray
    gaps: np.ndarray
    linearised: tuple[Linearised, ...]

    @property
    def residual(self) -> float:
        """Largest gap."""
        return float(np.abs(self.gaps).max())


def finite(values: np.ndarray) -> np.ndarray:
    """The values. Raises NoImage where one is not finite."""
    if not np.isfinite(values).all():
        raise NoImage("an image is not finite")
    return values


def shoot(maps: Sequence[OrbitMap], points: np.ndarray, parameter: float) -> Shots:
    """One shot from every point (N, n)."""
    images, linearised = zip(*(m.step(z, parameter) for m, z in zip(maps, points, strict=True)), strict=True)
    return Shots(np.array(images), finite(np.array(images) - np.roll(points, -1, axis=0)), linearised)


def slopes_of(maps: Sequence[OrbitMap], shots: Shots, points: np.ndarray, parameter: float) -> np.ndarray:
    """dP/dlambda (N, n) at every point, in units of `parameter_size`."""
    shots_of_points = zip(maps, points, shots.images, strict=True)
    return finite(np.array([m.slope(z, parameter, image) for m, z, image in shots_of_points]))
