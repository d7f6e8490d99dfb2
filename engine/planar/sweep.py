"""One Newton update of the planar box equations by condensed elimination, at a cost linear in the nodes.

Box between nodes a (lower) and b (upper), half element length e, c0 = cq; residuals that Newton drives to zero:

    V_b - V_a - e (q_t,a + q_t,b) = 0            compatibility          o b   y_b, v_b
    phi_b - phi_a - e (kappa_a + kappa_b) = 0    curvature              |
    N_b - N_a - e (G_a + G_b) = 0                momentum               |  h = 2 e
    EI (kappa_b - kappa_a) + e (M_a + M_b) = 0   moment                 o a   y_a, v_a

Split the unknowns into y = (eps, S, phi) and v = (U, W, kappa). Below node a everything is one affine relation
v_a = R_a y_a + r_a (at the anchor v = 0: R = 0). Compatibility and curvature give v_b from (v_a, y_a, y_b); momentum
and moment then give y_a = P y_b + p through one 3 x 3 inverse, and R_b, r_b follow. The inverse is an adjugate over a
determinant, one division and no pivot search: row scaling does not change it, and Newton failures were as rare as with
pivoting.

With a and b exchanged and -e in the place of e the equations are the same. So the upper half is eliminated by the same
code from the upper end down, where e_N dN + D dV = -e_0 (`engine.ends`) and dkappa = -kappa are such a relation too if
D is regular: dV = -D^-1 (e_0 + e_N dN/dy dy). The halves meet at node m = n // 2, where v = R y + r = R' y + r' is one
3 x 3 solve; then back substitution to both ends. A run alone goes through both halves at once, in two lanes of a vector
(`engine.planar.places`), a batch through one after the other; the arithmetic is the same. Where D is singular - a free
end, statics - the sweep is one-sided: m = n - 1, and the condition of the end takes the place of R', r'.

Without bending S and kappa are zero, y = (eps, phi), v = (U, W), and the same steps need a 2 x 2 inverse.

E (n, 24), row k: P (9) and p (3) to node k from its neighbour towards m, R (9) and r (3) at node k; row-major; in
the row of m, instead of P, the inverse of its 3 x 3 system. 2 x 2 in other places without bending. For other
right-hand sides of the same matrix (`resolve_bent`, after a one-sided sweep) an E (n, 33) also takes in E[k, 24:33] the
inverse of the box next to k, and in E[n - 1, 24:27] Dxx, Dxz, Dzz.
"""

from ..choose import smaller
from ..compiled import by_kind, kernel
from ..ends import BUOY, HELD, planar_end, released
from .elimination import WIDTH, back_substitute, eliminate, update_node
from .places import both, lane, put


@kernel
def _meet(E, m, relation, A, g, D):
    """Solve A y = g (9 and 3 numbers, row-major) at node m: inverse, relation and update into rows m of E and D.

    Returns y and the determinant.
    """
    A00, A01, A02, A10, A11, A12, A20, A21, A22 = A
    i00, i01, i02 = A11 * A22 - A12 * A21, A02 * A21 - A01 * A22, A01 * A12 - A02 * A11
    i10, i11, i12 = A12 * A20 - A10 * A22, A00 * A22 - A02 * A20, A02 * A10 - A00 * A12
    i20, i21, i22 = A10 * A21 - A11 * A20, A01 * A20 - A00 * A21, A00 * A11 - A01 * A10
    det = A00 * i00 + A01 * i10 + A02 * i20
    f = 1.0 / det
    i00, i01, i02, i10, i11, i12 = f * i00, f * i01, f * i02, f * i10, f * i11, f * i12
    i20, i21, i22 = f * i20, f * i21, f * i22
    put(E, m, 0, (i00, i01, i02, i10, i11, i12, i20, i21, i22))
    put(E, m, 12, relation)
    y = (
        i00 * g[0] + i01 * g[1] + i02 * g[2],
        i10 * g[0] + i11 * g[1] + i12 * g[2],
        i20 * g[0] + i21 * g[1] + i22 * g[2],
    )
    update_node(E, m, y, D)
    return y, det


@kernel
def _anchor(Y):
    """Relation at the lower end: v = 0."""
    zero = 0.0 * Y[0, 2]
    return zero, zero, zero, zero, zero, zero, zero, zero, zero, -Y[0, 2], -Y[0, 3], -Y[0, 5]


@kernel
def sweep_from_below(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D):
    """One-sided: fill D (n, 6) with the Newton update; returns False where a pivot block is singular."""
    b = Y.shape[0] - 1
    relation, least = _up(p, tables, cq, 0, b, _anchor(Y), Y, Q, E)
    R00, R01, R02, R10, R11, R12, R20, R21, R22, r0, r1, r2 = relation
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(
        p, tables, t, cv, in_motion, Q[b, 3], Q[b, 4], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b]
    )
    c, s, slope = Q[b, 0], Q[b, 1], Q[b, 2]
    A = (
        eN * slope * c + Dxx * R00 + Dxz * R10, -eN * s + Dxx * R01 + Dxz * R11,
        -eN * Q[b, 4] + Dxx * R02 + Dxz * R12,
        eN * slope * s + Dxz * R00 + Dzz * R10, eN * c + Dxz * R01 + Dzz * R11,
        eN * Q[b, 3] + Dxz * R02 + Dzz * R12,
        R20, R21, R22,
    )  # fmt: skip
    g = -ex - Dxx * r0 - Dxz * r1, -ez - Dxz * r0 - Dzz * r1, -Y[b, 5] - r2
    y, det = _meet(E, b, relation, A, g, D)
    if E.shape[1] > WIDTH:
        E[b, 24], E[b, 25], E[b, 26] = Dxx, Dxz, Dzz
    _down(p, E, b, b, y, D)
    return smaller(least, abs(det)) != 0.0


@kernel
def sweep_both_ways(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D):
    """Two-sided, for ends with a regular D: arguments and result as of `sweep_from_below`."""
    b = Y.shape[0] - 1
    ex, ez, eN, Dxx, Dxz, Dzz = planar_end(
        p, tables, t, cv, in_motion, Q[b, 3], Q[b, 4], Y[b, 2], Y[b, 3], C_tilde[b, 2], C_tilde[b, 3], F[b]
    )
    regular = Dxx * Dzz - Dxz * Dxz
    f = -1.0 / regular
    ixx, ixz, izz = f * Dzz, -f * Dxz, f * Dxx
    c, s, slope, nx, nz = eN * Q[b, 0], eN * Q[b, 1], Q[b, 2], eN * Q[b, 3], eN * Q[b, 4]
    zero = 0.0 * Y[b, 5]
    end = (
        slope * (ixx * c + ixz * s), ixz * c - ixx * s, ixz * nx - ixx * nz,
        slope * (ixz * c + izz * s), izz * c - ixz * s, izz * nx - ixz * nz,
        zero, zero, zero, ixx * ex + ixz * ez, ixz * ex + izz * ez, -Y[b, 5],
    )  # fmt: skip
    below, above, least = _halves(p, tables, cq, _anchor(Y), end, Y, Q, E)
    A = (
        below[0] - above[0], below[1] - above[1], below[2] - above[2],
        below[3] - above[3], below[4] - above[4], below[5] - above[5],
        below[6] - above[6], below[7] - above[7], below[8] - above[8],
    )  # fmt: skip
    g = above[9] - below[9], above[10] - below[10], above[11] - below[11]
    y, det = _meet(E, Y.shape[0] // 2, below, A, g, D)
    _back_to_ends(p, E, y, D)
    return smaller(smaller(least, abs(det)), abs(regular)) != 0.0


@kernel
def _up_in_pairs(p, tables, cq, k, count, relation, Y, Q, E):
    """The same in both lanes."""
    result, least = eliminate(p, tables, cq, (k, k), (1, 1), count, both(relation, relation), Y, Q, E)
    return lane(result, 0), lane((least,), 0)[0]


@kernel
def _up_alone(p, tables, cq, k, count, relation, Y, Q, E):
    return eliminate(p, tables, cq, k, 1, count, relation, Y, Q, E)


@kernel
def _down_in_pairs(p, E, k, count, y, D):
    return lane(back_substitute(E, (k, k), (-1, -1), count, both(y, y), D), 0)


@kernel
def _down_alone(p, E, k, count, y, D):
    return back_substitute(E, k, -1, count, y, D)


@kernel
def _at_once(p, tables, cq, anchor, end, Y, Q, E):
    """Both halves as the two lanes of a vector; of an even number of nodes the lower half has one box more."""
    n = Y.shape[0]
    count = (n - 1) // 2
    relations, leasts = eliminate(p, tables, cq, (0, n - 1), (1, -1), count, both(anchor, end), Y, Q, E)
    below, above = lane(relations, 0), lane(relations, 1)
    least = smaller(lane((leasts,), 0)[0], lane((leasts,), 1)[0])
    below, of_rest = _up_in_pairs(p, tables, cq, count, n // 2 - count, below, Y, Q, E)
    return below, above, smaller(least, of_rest)


@kernel
def _in_turn(p, tables, cq, anchor, end, Y, Q, E):
    """One half after the other."""
    n = Y.shape[0]
    below, least = eliminate(p, tables, cq, 0, 1, n // 2, anchor, Y, Q, E)
    above, least_above = eliminate(p, tables, cq, n - 1, -1, (n - 1) // 2, end, Y, Q, E)
    return below, above, smaller(least, least_above)


@kernel
def _back_at_once(p, E, y, D):
    n = D.shape[0]
    count = (n - 1) // 2
    lower = _down_in_pairs(p, E, n // 2, n // 2 - count, y, D)
    back_substitute(E, (count, n // 2), (-1, 1), count, both(lower, y), D)


@kernel
def _back_in_turn(p, E, y, D):
    n = D.shape[0]
    back_substitute(E, n // 2, -1, n // 2, y, D)
    back_substitute(E, n // 2, 1, (n - 1) // 2, y, D)


_up = by_kind(_up_in_pairs, _up_in_pairs, _up_alone)
_down = by_kind(_down_in_pairs, _down_in_pairs, _down_alone)
_halves = by_kind(_at_once, _at_once, _in_turn)
_back_to_ends = by_kind(_back_at_once, _back_at_once, _back_in_turn)


@kernel
def _either(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D):
    """Two-sided where D of the upper end is regular: a held end, a buoy in motion (in statics it has no inertia)."""
    buoy, held = p.end == BUOY and in_motion > 0.0, p.end == HELD and (in_motion == 0.0 or not released(p, t))
    if buoy or held:
        return sweep_both_ways(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D)
    return sweep_from_below(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D)


_sweep = by_kind(_either, _either, sweep_both_ways)


@kernel
def sweep_bent(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D):
    """Fill D (n, 6) with the Newton update; returns False where a pivot block is singular."""
    return _sweep(p, tables, t, cq, cv, in_motion, Y, C_tilde, F, Q, E, D)
