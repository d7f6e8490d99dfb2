"""A chain of rigid links in a vertical plane, integrated by scipy: an independent model of a folded chain let go."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


def falling_links(count, length, gap, gravity, times):
    """Tip (x, z) at `times` of a chain of `count` uniform links that hung between hooks `gap` apart, let go at time 0.

    Lagrange's equations in the links' angles p, of unit mass in all: with a_ki what link i moves the middle of link k,
    sum_j c_ij [cos(p_i - p_j) p_j'' + sin(p_i - p_j) p_j'^2] = -g w_i cos p_i,   w_i = sum_k a_ki/count.
    """
    i, h = np.arange(count), length / count
    w = h * (count - i - 0.5) / count
    beyond = count - 1 - np.maximum.outer(i, i)
    c = h**2 / count * (beyond + np.where(np.eye(count) > 0, 1 / 4 + 1 / 12, 1 / 2))

    def hanging(pull):
        return np.arctan2(w.mean() - w, pull)

    pull = brentq(lambda pull: h * np.sum(np.cos(hanging(pull))) - gap, 1e-9, 1e3)

    def rates(_, y):
        p, v = y[:count], y[count:]
        turned = p[:, None] - p
        load = -(c * np.sin(turned)) @ v**2 - gravity * w * np.cos(p)
        return np.concatenate([v, np.linalg.solve(c * np.cos(turned), load)])

    start = np.concatenate([hanging(pull), np.zeros(count)])
    run = solve_ivp(rates, (0, times[-1]), start, method="DOP853", rtol=1e-8, atol=1e-8, t_eval=times)
    p = run.y[:count]
    return h * np.cos(p).sum(axis=0), h * np.sin(p).sum(axis=0)
