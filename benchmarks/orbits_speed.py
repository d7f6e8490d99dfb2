"""What orbits cost in maps, passes of their derivative and seconds: an orbit, its errors over meshes, its branch.

    python -m benchmarks.orbits_speed [--rounds 3] [--cable]

Eq. (33): an orbit of period 1 and its branch over the force. --cable: the same of the scene `tethered_buoy` at
H = 25 m, kA = 0.13, 41 nodes, rtol 1e-4, over kA; the run that it begins with is not counted. "Worth": the time in
maps of that system, what an orbit costs beside one period of a run.
"""

from collections import Counter
from dataclasses import replace

from analysis.orbits import OrbitMap, find_orbit, follow_branch, scatter_of
from analysis.oscillator import SnapOscillator, snap_map
from benchmarks.shared import on_one_core, parser, print_load, seconds
from campaigns.explore.multipliers import cable_map
from engine import load_scene, simulate

KEYS = {"water.depth_m": 25.0, "tether.nodes": 41, "solver.rtol": 1e-4}


class Counted:
    """An OrbitMap that counts its maps, its meshes and the passes of their derivatives."""

    def __init__(self, system: OrbitMap):
        self.inner, self.counts = system, Counter()
        frozen = system.frozen and self.frozen
        self.system = replace(system, step=self.counting(system.step), frozen=frozen)

    def counting(self, step):
        def counted(z, parameter):
            self.counts["maps"] += 1
            image, linearised = step(z, parameter)
            return image, lambda V: self.counts.update(passes=1, vectors=V.shape[1]) or linearised(V)

        return counted

    def frozen(self, points, parameter, mesh):
        self.counts["meshes"] += len(points)
        return [self.counting(step) for step in self.inner.frozen(points, parameter, mesh)]

    def show(self, title, call, a_map):
        """What a call returns; prints what it needed."""
        self.counts.clear()
        results = []
        took = seconds(lambda: results.append(call()))
        counts = ", ".join(f"{number} {name}" for name, number in self.counts.items())
        print(f"{took:9.4f} s  {title}: {counts}; worth {took / a_map:.0f} maps", flush=True)
        return results[0]


def measure(name, system, start, low, value, high, orbits):
    """An orbit from a start, and a branch of it, twice: the first compiles."""
    counted = Counted(system)
    orbit = find_orbit(counted.system, start, value)
    a_map = min(seconds(lambda: system.step(orbit.points[0], value)) for _ in range(5))
    print(f"{name}: a map takes {1e3 * a_map:.3g} ms")
    counted.show("orbit of period 1", lambda: find_orbit(counted.system, start, value), a_map)
    if system.meshes > 1:
        counted.show("its errors over meshes", lambda: scatter_of(counted.system, orbit), a_map)
    step = 0.8 * (high - low) / system.parameter_size / orbits
    limits = {"step": step, "longest": step, "accuracy": 1e-2 if system.frozen else 1e-9}
    branch = counted.show("branch", lambda: follow_branch(counted.system, orbit, low, high, **limits), a_map)
    print(f"           {len(branch.orbits)} orbits, {len(branch.events)} events; {'; '.join(branch.ends)}")


def main():
    options = parser(__doc__, 1, on_one_core=True)
    options.add_argument("--cable", action="store_true", help="the cable too: some minutes")
    arguments = options.parse_args()
    on_one_core(arguments.core)
    print_load()
    for _ in range(arguments.rounds):
        measure("eq. (33)", snap_map(SnapOscillator()), [0.68, 0.0], 0.2, 0.5, 2.0, 60)
    if arguments.cable:

        def scene_of(value):
            return load_scene("tethered_buoy", {**KEYS, "waves.steepness": value})

        state = simulate(scene_of(0.13), periods=60).final_state
        cable, system = cable_map(scene_of, state, 0.13, 0.1)
        for _ in range(arguments.rounds):
            measure("cable", system, cable.first, 0.08, 0.13, 0.15, 60)


if __name__ == "__main__":
    main()
