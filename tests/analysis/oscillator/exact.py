"""An integration of eq. (33) that shares nothing with the package: Taylor series, 50 digits, bisection."""

from mpmath import mp, mpf

DIGITS = 50
ORDER, STEPS = 40, 48


def taylor(a, t, x, v, o):
    """Taylor coefficients of g at time t on a piece, from the recurrence of the differential equation."""
    mu, omega, force, lift = (mpf(repr(n)) for n in (o.damping, o.frequency, o.force, o.lift))
    phase = mpf(repr(o.phase))
    c = [mpf(x), mpf(v)]
    for n in range(ORDER):
        forcing = force * omega**n * mp.sin(omega * t + phase + n * mp.pi / 2) / mp.factorial(n) + (
            lift if n == 0 else 0
        )
        c.append((forcing - mu * (n + 1) * c[n + 1] - a * c[n]) / ((n + 1) * (n + 2)))
    return c


def value(c, h):
    return mp.polyval(c[::-1], h), mp.polyval([n * c[n] for n in range(len(c) - 1, 0, -1)], h)


def states(o, start, periods):
    """States after 1 ... periods forcing periods, and the switching times. A switch is where g changes sign between the
    ends of a (small) step, so the start must be one that does not graze."""
    with mp.workdps(DIGITS):
        x, v = (mpf(repr(float(entry))) for entry in start)
        period = 2 * mp.pi / mpf(repr(o.frequency))
        found, switches = [], []
        a = 1 if x > 0 or (x == 0 and v > 0) else 0
        for n in range(periods):
            t, end = n * period, (n + 1) * period
            while t < end:
                h = min(period / STEPS, end - t)
                c = taylor(a, t, x, v, o)
                g, u = value(c, h)
                if (g > 0) != (a == 1):
                    low, high = mpf(0), h
                    for _ in range(150):
                        middle = (low + high) / 2
                        low, high = (middle, high) if (value(c, middle)[0] > 0) == (a == 1) else (low, middle)
                    h = high
                    g, u = value(c, h)
                    g, a = mpf(0), 1 - a
                    switches.append(float(t + h))
                x, v, t = g, u, t + h
                if abs(end - t) < mpf(10) ** (-DIGITS + 10):
                    break
            found.append((float(x), float(v)))
        return found, switches
