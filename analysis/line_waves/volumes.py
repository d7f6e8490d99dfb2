"""The breaking line by finite volumes (MUSCL-Hancock): conservative, through any shock and echo (kernel of `captured`).

    eps_t = u_s,   m u_t = T_s        cell j: means of eps and u over [j h, (j + 1) h], h = L/cells

        |---- j-1 ----|---- j ----|---- j+1 ----|        face j lies left of cell j; faces 0 and n are the ends
                     face j     face j+1

1. In each cell the differences to both neighbours are split into the two waves, du + c d eps (towards the fixed end)
   and du - c d eps, each limited by van Leer's harmonic mean: zero at an extremum, smooth elsewhere.
2. Both face values of a cell move half a step by the equations (Hancock).
3. At a face Roe's average for this system is exact, sigma^2 = (T_r - T_l)/(m (eps_r - eps_l)), and with Z = m sigma

       T* = (T_l + T_r)/2 + Z (u_r - u_l)/2,   u* = (u_l + u_r)/2 + (T_r - T_l)/(2 Z)

   Both waves keep their direction in the unstretched coordinate, so that Roe's flux needs no entropy repair, also where
   the law has an inflection. Ends: u* = 0 with T* = T_r + Z u_r; T* = F(t) with u* = u_l + (F - T_l)/Z.

Below lambda = 1 + eps = 1/2 the tension may gain - P_b (1/(2 lambda) - 1)^2, which keeps eps > -1. T is smooth there.
Sources: van Leer, J. Comput. Phys. 32, 101 (1979); Toro, Riemann Solvers (2009), chapter 14; Roe, J. Comput. Phys. 43,
357 (1981).
"""

import numpy as np

from analysis.compiled import kernel
from analysis.line_waves import law as unguarded
from analysis.line_waves.simple_wave import end_force

HALF = 0.5  # lambda below which the barrier acts
OK, COLLAPSED = 0, 1


@kernel
def tension(law, barrier, eps):
    """T [N] with the barrier P_b [N]."""
    pull = unguarded.tension(law, eps)
    if eps + 1.0 < HALF and barrier > 0.0:
        pull -= barrier * (HALF / (1.0 + eps) - 1.0) ** 2
    return pull


@kernel
def wave_speed(law, barrier, eps):
    """c [m/s] with the barrier."""
    stiff = unguarded.slope(law, eps)
    if eps + 1.0 < HALF and barrier > 0.0:
        stiff += 2.0 * barrier * (HALF / (1.0 + eps) - 1.0) * HALF / (1.0 + eps) ** 2
    return np.sqrt(stiff / law[5])


@kernel
def barrier_energy(barrier, eps):
    """What the barrier stores [J/m]: the integral of its tension from lambda = 1/2."""
    x = 1.0 + eps
    return barrier * (HALF * HALF / x + 2.0 * HALF * np.log(x / HALF) - x) if x < HALF and barrier > 0.0 else 0.0


@kernel
def limited(a, b):
    """Van Leer's harmonic mean of two differences; 0 when their signs differ."""
    return 2.0 * a * b / (a + b) if a * b > 0.0 else 0.0


@kernel
def roe_speed(law, barrier, left, right, T_left, T_right):
    """sigma [m/s] between two strains; c in the middle where they are too close to divide by."""
    jump = right - left
    if abs(jump) < 1e-5:
        return wave_speed(law, barrier, 0.5 * (left + right))
    return np.sqrt((T_right - T_left) / (law[5] * jump))


@kernel
def fastest(law, barrier, eps, c):
    """Fill c (n,) [m/s] of eps (n,); return the largest of them and of the chords between them."""
    low, high, most = eps[0], eps[0], 0.0
    for j in range(len(eps)):
        c[j] = wave_speed(law, barrier, eps[j])
        low, high, most = min(low, eps[j]), max(high, eps[j]), max(most, c[j])
    bend = -law[2] / law[1]
    return max(most, wave_speed(law, barrier, bend)) if low < bend < high else most


@kernel
def face_values(eps, u, c, ratio, faces):
    """Fill faces (n, 4): eps, u at the left and eps, u at the right face of each cell, half a step ahead.

    ratio    dt/h [s/m]. Beyond the fixed end the line is mirrored, beyond the broken end its last difference goes on.
    """
    n = len(eps)
    for j in range(n):
        if j > 0:
            e_left, u_left = eps[j] - eps[j - 1], u[j] - u[j - 1]
        else:
            e_left, u_left = 0.0, 2.0 * u[0]
        if j < n - 1:
            e_right, u_right = eps[j + 1] - eps[j], u[j + 1] - u[j]
        else:
            e_right, u_right = e_left, u_left
        down = limited(u_left + c[j] * e_left, u_right + c[j] * e_right)
        up = limited(u_left - c[j] * e_left, u_right - c[j] * e_right)
        de, du = 0.5 * (down - up) / c[j], 0.5 * (down + up)
        e_half, u_half = eps[j] + 0.5 * ratio * du, u[j] + 0.5 * ratio * c[j] * c[j] * de
        faces[j, 0], faces[j, 1] = e_half - 0.5 * de, u_half - 0.5 * du
        faces[j, 2], faces[j, 3] = e_half + 0.5 * de, u_half + 0.5 * du


@kernel
def advance(law, barrier, force, decay, length, courant, t, until, eps, u, c, faces, totals):
    """Carry cell means eps, u (n,) from t to `until` [s], in place.

    totals    (4,) running sums: displacement of the broken end [m], impulse of both ends [N s], work of the broken
              end [J], steps
    c (n,), faces (n, 4)    room to work in.  Returns OK or COLLAPSED (a strain that is no number, or below -1 with a
    barrier; u and eps are then of no use).
    """
    n = len(eps)
    h, m = length / n, law[5]
    while t < until:
        dt = courant * h / fastest(law, barrier, eps, c)
        left = until - t
        dt = left if dt >= left else (0.5 * left if 2.0 * dt > left else dt)
        ratio = dt / h
        face_values(eps, u, c, ratio, faces)
        u_star, wall = 0.0, tension(law, barrier, faces[0, 0]) + m * wave_speed(law, barrier, faces[0, 0]) * faces[0, 1]
        T_star = wall
        T_right = tension(law, barrier, faces[0, 2])
        for j in range(n):
            if j < n - 1:
                T_left, e_l, u_l = T_right, faces[j, 2], faces[j, 3]
                e_r, u_r = faces[j + 1, 0], faces[j + 1, 1]
                T_next = tension(law, barrier, e_r)
                Z = m * roe_speed(law, barrier, e_l, e_r, T_left, T_next)
                T_new = 0.5 * (T_left + T_next) + 0.5 * Z * (u_r - u_l)
                u_new = 0.5 * (u_l + u_r) + 0.5 * (T_next - T_left) / Z
                T_right = tension(law, barrier, faces[j + 1, 2])
            else:
                T_new = end_force(force, decay, t + 0.5 * dt)
                u_new = faces[j, 3] + (T_new - T_right) / (m * wave_speed(law, barrier, faces[j, 2]))
            eps[j] += ratio * (u_new - u_star)
            u[j] += ratio * (T_new - T_star) / m
            if not eps[j] < np.inf or (barrier > 0.0 and eps[j] <= -1.0):
                return COLLAPSED
            u_star, T_star = u_new, T_new
        totals[0] += dt * u_star
        totals[1] += dt * (T_star - wall)
        totals[2] += dt * T_star * u_star
        totals[3] += 1.0
        t = until if dt == left else t + dt
    return OK
