"""The map of the cable over one wave period, and its derivative."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from analysis.orbits import OrbitMap, find_orbit
from engine import simulate
from engine.record import SAMPLE_WIDTH, TOP_HIGH, TOP_LOW
from engine.run.period_map import PeriodMap
from engine.scene import build_scene
from tests.engine.lines import line
from tests.engine.time.test_similarity import OTHER, factor, in_other_units

SMALL = {"tether.nodes": 9, "water.depth_m": 25.0, "solver.rtol": 1e-3}
AT = 0.13


def scene_at(value, **changes):
    return line({**SMALL, "waves.steepness": value, **changes})


def of_run(cable, z, periods, rtol):
    """Where a run from z is after so many periods."""
    scene = cable.scene_of(0.136).with_values("solver", rtol=rtol)
    return cable.packed(simulate(scene, periods=periods, start=cable.state_of(z, 0.136)).final_state)


@pytest.fixture(scope="module")
def settled():
    return simulate(scene_at(AT), periods=30.3)


@pytest.fixture(scope="module")
def cable(settled):
    return PeriodMap(scene_at, settled.final_state, AT)


def test_it_repeats_to_the_last_bit_and_its_derivative_is_that_of_differences(cable):
    image, z = cable.frozen([cable.first], AT)[0], cable.first
    there, derivative = image(z, AT)
    assert (image(z, AT)[0] == there).all()
    V = np.random.default_rng(1).normal(size=(len(z), 3))
    V = derivative(V)
    V /= np.linalg.norm(V, axis=0)
    for v, computed in zip(V.T, derivative(V).T, strict=True):
        ahead, behind = (image(z + h * v, AT)[0] for h in (1e-6, -1e-6))
        assert computed == pytest.approx((ahead - behind) / 2e-6, abs=1e-4 * np.abs(computed).max())


def test_it_begins_at_the_strobe_after_a_state_and_goes_where_a_run_does(cable, settled):
    """The state is .3 of a period and part of a step past a strobe."""
    longer = simulate(scene_at(AT), periods=32)
    per_period = cable.samples_of(scene_at(AT))
    computed = cable.history([cable.first], AT)
    assert list(computed) == list(longer.columns) and len(computed["time_s"]) == per_period
    last = {name: column[31 * per_period : 32 * per_period] for name, column in longer.columns.items()}
    assert computed["radius_m"] == pytest.approx(last["radius_m"], abs=2e-3)
    x, z, u, w = cable.seen.T @ cable.first
    omega = 2.0 * math.pi / scene_at(AT).waves.period_s
    assert (math.hypot(x, z), (x * u + z * w) * omega / math.hypot(x, z)) == pytest.approx(
        (computed["radius_m"][0], computed["radius_rate_mps"][0]), abs=1e-9
    )
    assert computed["tension_top_high_N"].max() == pytest.approx(last["tension_top_high_N"].max(), rel=2e-3)
    rare = PeriodMap(lambda value: scene_at(value, **{"output.step_s": 5.0}), settled.final_state, AT)
    for name in (
        "tension_top_low_N",
        "tension_top_high_N",
        "tension_anchor_high_N",
    ):  # one sample has the extremes of all of the period
        extreme = np.min if "low" in name else np.max
        assert extreme(rare.history([rare.first], AT)[name]) == pytest.approx(extreme(computed[name]), rel=0.02)


def test_what_a_branch_is_measured_in_grows_with_the_scene(cable, settled):
    """A model of the mooring in a tank has the orbits of the mooring, followed in steps of its own size."""

    def model_at(value):
        return build_scene(in_other_units(scene_at(value).as_dict(), OTHER))

    start = simulate(model_at(AT), duration_s=factor("s", OTHER) * settled.final_state.state()["t"]).final_state
    model = PeriodMap(model_at, start, AT)
    seen = cable.seen.T @ cable.first
    assert model.seen.T @ model.first == pytest.approx(seen, abs=1e-4 * np.abs(seen).max())


def test_an_orbit_is_what_the_run_settles_on_and_what_a_run_from_its_state_keeps(cable, settled):
    orbit = find_orbit(OrbitMap(cable.step, frozen=cable.frozen), cable.first, AT, count=4, tolerance=1e-9)
    assert orbit.found and orbit.stable and orbit.gap < 1e-8
    per_period = cable.samples_of(scene_at(AT))
    kept = simulate(scene_at(AT), periods=4, start=cable.state_of(orbit.points[0], AT)).columns["radius_m"]
    assert kept[::per_period] == pytest.approx(kept[0], abs=1e-3)  # rtol of its own steps
    assert kept[0] == pytest.approx(cable.history(orbit.points, AT)["radius_m"][0], abs=1e-12)
    # the volume that four perturbations span shrinks by the product of their multipliers, however pairs of them turn
    tight = scene_at(AT, **{"output.tangent_vectors": 4, "solver.rtol": 1e-4})
    shrinks = simulate(tight, periods=60, start=settled.final_state.at_zero()).tangent.growth_nats[30:].sum(axis=1)
    assert shrinks.mean() == pytest.approx(math.log(abs(np.prod(orbit.multipliers[:4]))), rel=0.03)


def test_a_period_that_changes_keeps_the_steps_as_shares_of_it(settled):
    def of_period(value):
        return line({**SMALL, "waves.steepness": AT, "waves.period_s": value})

    period_s = of_period(5.0).waves.period_s
    cable = PeriodMap(of_period, simulate(of_period(period_s), periods=10).final_state, period_s)
    (image,) = cable.frozen([cable.first], period_s)
    near = image(cable.first, period_s * (1 + 1e-6))[0]
    assert 0.0 < np.abs(near - image(cable.first, period_s)[0]).max() < 1e-4


def test_extremes_before_a_strobe_are_those_of_the_first_sample_after_it():
    """An orbit of two periods; before the strobe at the end of each the tension reaches 1 and 2 N."""

    class ByHand:
        """An image whose samples are given."""

        def __init__(self, most_N):
            self.samples = np.zeros((2, SAMPLE_WIDTH))
            self.samples[1, [TOP_LOW, TOP_HIGH]] = -most_N, most_N

        def __call__(self, z, value):
            return z, None

    cable = SimpleNamespace(
        frozen=lambda points, value: [ByHand(1.0), ByHand(2.0)],
        _run=lambda value: SimpleNamespace(scene=scene_at(value)),
        samples_of=lambda scene: 1,
    )
    columns = PeriodMap.history(cable, [None, None], AT)
    assert columns["tension_top_high_N"].tolist() == [2.0, 1.0]
    assert columns["tension_top_low_N"].tolist() == [-2.0, -1.0]


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"motion.dimensions": 3}, "in a plane"),
        ({"solver.integrator": "backward-euler", "solver.step_s": 0.02}, "error control"),
    ],
)
def test_scenes_without_such_a_map_are_refused(settled, changes, word):
    with pytest.raises(ValueError, match=word):
        PeriodMap(lambda value: scene_at(value, **changes), settled.final_state, AT)


def test_a_state_without_image_is_refused_in_words(cable):
    wild = cable.first.copy()
    wild[: 4 * 9].reshape(9, 4)[1:, 2:] *= 400.0
    with pytest.raises(ArithmeticError, match="Newton's method did not converge at t = 0 s"):
        cable.step(wild, AT)


def test_a_map_goes_through_the_release_of_a_loop_and_ends_where_it_comes_and_goes(cable):
    violent = {"water.depth_m": 21.0, "tether.nodes": 21}
    begin = simulate(scene_at(0.136, **violent), periods=3).final_state
    there = PeriodMap(lambda value: scene_at(value, **violent), begin, 0.136)
    z, released, from_run, between_runs, largest = there.first, 0, [], [], []
    with pytest.raises(ArithmeticError, match="a loop is about to be released"):
        for _ in range(100):
            (image,) = there.frozen([z], 0.136)
            after, derivative = image(z, 0.136)
            if there.history([z], 0.136)["loop_releases"][-1] > 0:
                released += 1
                run, finer_run = (of_run(there, z, 2, rtol) for rtol in (1e-3, 3e-4))
                change = there.step(after, 0.136)[0] - run
                from_run.append(np.linalg.norm(change))
                largest.append(np.abs(change).max())
                between_runs.append(np.linalg.norm(finer_run - run))
                v = derivative(np.random.default_rng(released).normal(size=(len(z), 1)))
                v = derivative(v / np.linalg.norm(v))
                v /= np.linalg.norm(v)
                ahead, behind = (image(z + h * v[:, 0], 0.136)[0] for h in (1e-6, -1e-6))
                computed = derivative(v)[:, 0]
                assert computed == pytest.approx((ahead - behind) / 2e-6, abs=1e-3 * np.abs(computed).max())
            z = after
    assert released > 5
    # steps change the moment of a release, so the map lies as near to a run as two runs to each other
    assert max(from_run) < 2.0 * max(between_runs)
    assert np.median(largest) < 2e-2
    with pytest.raises(ValueError, match="one grid"):
        PeriodMap(lambda v: scene_at(v, **{"tether.nodes": 9 if v < 0.14 else 11}), cable.start, AT).step(z, 0.15)
