"""How fast both exponents of eq. (33) come, event-exact and by a fixed-step toolbox; an orbit diagram of 800 values.

    python -m benchmarks.oscillator_speed [--rounds N] [--core N]

Rates   forcing periods a second with both exponents, at the paper's parameters. Ours: `growth_over_values`, one start.
        pynamicalsys (PyPI; the extra `bench`): `ContinuousDynamicalSystem.lyapunov`, RK4 with T/64 steps, its own QR,
        compiled; equation and Jacobian as it wants them, compiled too. One thread each, compilation left out.
Error   of the state after ten periods from (0.68, 0), against 20 digits of an independent computation.
Diagram 800 values of F in [0.1, 2], four starts, 500 + 1000 periods each, exponents at every value.
"""

from dataclasses import astuple
from functools import partial

import numpy as np

from analysis.oscillator import SnapOscillator, snap_diagram, strobed_states
from analysis.oscillator.strobing import growth_over_values
from benchmarks.shared import in_turns, on_one_core, parser, print_load, seconds, show

START = (0.68, 0.0)
AFTER_TEN = np.array([-20.3682913974351795585, -2.33939200511708733634])
OURS_PERIODS, THEIRS_PERIODS, STEPS = 1_000_000, 20_000, 64


def ours(oscillator: SnapOscillator, periods: int) -> np.ndarray:
    """Both exponents over `periods` periods."""
    parameters, starts = np.array([astuple(oscillator)]), np.array([START])
    sums = growth_over_values(parameters, starts, 100, 10, periods // 10, 0)[0]
    return sums.sum(axis=(0, 1, 2)) / (periods * oscillator.period)


def rate(call, periods: int) -> float:
    """Forcing periods a second of call(periods)."""
    return periods / seconds(partial(call, periods))


def toolbox(oscillator: SnapOscillator):
    """pynamicalsys with eq. (33) in it, or None where it is not installed."""
    try:
        from pynamicalsys import ContinuousDynamicalSystem
    except ImportError:
        return None
    import numba

    @numba.njit
    def rates(time, u, p):
        restoring = u[0] if u[0] >= 0.0 else 0.0
        return np.array([u[1], p[2] * np.sin(p[1] * time) + p[3] - p[0] * u[1] - restoring])

    @numba.njit
    def jacobian(time, u, p):
        return np.array([[0.0, 1.0], [-1.0 if u[0] >= 0.0 else 0.0, -p[0]]])

    system = ContinuousDynamicalSystem(
        equations_of_motion=rates, jacobian=jacobian, system_dimension=2, number_of_parameters=4
    )
    system.integrator("rk4", time_step=oscillator.period / STEPS)
    system.set_parameters(list(astuple(oscillator)[:4]))
    return system


def main() -> None:
    arguments = parser(__doc__, 5, on_one_core=True).parse_args()
    on_one_core(arguments.core)
    print_load()
    oscillator = SnapOscillator()
    end, system = 10 * oscillator.period, toolbox(oscillator)
    calls = {"ours": (partial(ours, oscillator), OURS_PERIODS, strobed_states(oscillator, START, 11)[10])}
    if system is not None:
        theirs = lambda periods: system.lyapunov(START, periods * oscillator.period)  # noqa: E731
        calls["pynamicalsys"] = theirs, THEIRS_PERIODS, system.trajectory(START, end)[-1, 1:]
    for name, (call, periods, last) in calls.items():
        call(100)
        print(f"{name}: exponents {call(periods)}, error after ten periods {np.abs(last - AFTER_TEN).max():.2g}")
    timed = {name: partial(rate, call, periods) for name, (call, periods, _) in calls.items()}
    rates = in_turns(timed, arguments.rounds)
    for name, values in rates.items():
        show(name, values, "forcing periods a second")
    if system is None:
        print("pynamicalsys is not installed (pip install -e .[bench]): no comparison")
    diagram = partial(snap_diagram, oscillator, "force")
    diagram([1.0], transient_periods=1, periods=10, points=1)
    walls = [seconds(partial(diagram, np.linspace(0.1, 2.0, 800))) for _ in range(min(3, arguments.rounds))]
    show("orbit diagram of 800 values with exponents, 6000 periods each", walls, "s")


if __name__ == "__main__":
    main()
