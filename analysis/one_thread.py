"""Least squares of a few hundred rows on one thread.

Libraries of linear algebra hand even such products to all cores, which on a busy machine wait for each other: a fit of
50 lines to 300 points was seen to take 20 times longer beside one other process. Columns here are sines of separate
frequencies, nearly orthogonal, so that the normal equations lose nothing that matters.
"""

import numpy as np

from analysis.compiled import kernel


@kernel
def transposed_product(a, b):
    """a^T b of a (k, i) and b (k, j)."""
    out = np.zeros((a.shape[1], b.shape[1]))
    for k in range(a.shape[0]):
        for i in range(a.shape[1]):
            factor = a[k, i]
            for j in range(b.shape[1]):
                out[i, j] += factor * b[k, j]
    return out


@kernel
def product(a, b):
    """a b of a (k, i) and b (i, j)."""
    out = np.zeros((a.shape[0], b.shape[1]))
    for k in range(a.shape[0]):
        for i in range(a.shape[1]):
            factor = a[k, i]
            for j in range(b.shape[1]):
                out[k, j] += factor * b[i, j]
    return out


@kernel
def solve_normal(gram, right):
    """x of gram x = right, gram (i, i) symmetric and not negative, right (i, j), by Cholesky.

    A direction whose pivot is below 1e-12 of its diagonal is not determined: its x is 0.
    """
    n, columns = right.shape
    lower, x = gram.copy(), right.copy()
    for i in range(n):
        whole = lower[i, i]
        for j in range(i + 1):
            total = lower[i, j]
            for k in range(j):
                total -= lower[i, k] * lower[j, k]
            if i > j:
                lower[i, j] = total / lower[j, j]
            else:
                lower[i, i] = np.sqrt(total) if total > 1e-12 * whole and total > 0.0 else np.inf
    for i in range(n):
        for c in range(columns):
            for k in range(i):
                x[i, c] -= lower[i, k] * x[k, c]
            x[i, c] /= lower[i, i]
    for i in range(n - 1, -1, -1):
        for c in range(columns):
            for k in range(i + 1, n):
                x[i, c] -= lower[k, i] * x[k, c]
            x[i, c] /= lower[i, i]
    return x
