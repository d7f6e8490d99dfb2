"""The breaking synthetic line, section 4.1 of the paper: eight cases, their companions, figures 2-7, a report.

    python -m campaigns.breaking_line                    cases 1-4 (fracture in 5 ms) and 1'-4' (in 50 ms)
    python -m campaigns.breaking_line --cases 4 4p       the two at 450 kN alone
    python -m campaigns.breaking_line --cases 1 --no-companions --set tether.nodes=401      in a second or two

Protocol: static start under the end force and gravity, both ends at one level; the force falls as
F cos^2(pi t/(2 t_br)) and is zero after; runs end when the paper's figures do. Companions: every case on a grid of
twice the elements, case 4 there with two other bending stiffnesses as well; and breaks without gravity on even grids,
up to the arrival of the front, to be held against the exact solution: one fine run of every case where theory has a
shock, and a series of grids for case 4 and for case 3', which stays smooth. Nothing is random.
"""

from collections.abc import Sequence
from functools import partial

from campaigns.machinery import cli
from campaigns.machinery.plan import Job
from campaigns.machinery.runner import run
from campaigns.study import Measures, Order, Study

CAMPAIGN = "breaking_line"
SCENE = "breaking_line"
FORCES_N = {"1": 45e3, "2": 180e3, "3": 315e3, "4": 450e3}
LENGTHS_S = {"1": 0.20, "2": 0.14, "3": 0.13, "4": 0.12}
FAST_S, SLOW_S = 0.005, 0.050
CASES = (*FORCES_N, *(f"{number}p" for number in FORCES_N))
STIFFNESS_CASE, STIFFNESSES_NM2 = "4", (10.0, 24.0, 100.0)
STRAIGHT_NODES = 3201
SERIES_CASES, SERIES_NODES = ("4", "3p"), (201, 401, 801, 1601)
STRAIGHT_STEP_S, BIRTH_STEPS = 0.0005, 0.05  # of their profiles; at most as a share of the time to the shock's birth
DOUBLED_STEP_S = 0.002  # of the profiles on doubled grids
COMPILE_RUN_S = 0.001
LONGEST_S = 0.2


def options(group) -> None:
    """Add the options that other studies do not have."""
    cases = f"cases of the paper (default: {' '.join(CASES)}; p: fracture in 50 ms)"
    cli.add(group, "--cases", "A B ...", cases, cli.one_of(CASES), CASES, many=True)
    leave_out = "leave out the doubled grids, the other bending stiffnesses and the breaks without gravity"
    group.add_argument("--no-companions", action="store_true", help=leave_out)


def planned(name: str, changes: dict, cases: Sequence[str], companions: bool, faults: list[str]) -> tuple[Job, ...]:
    """The runs in the order of the table.

    kind: "case"; "doubled" (twice the elements); "stiffness" (case 4, doubled, with another EI); without gravity on an
    even grid up to the arrival of the front, "straight" (fine) and "series" (grid by grid).
    """
    from campaigns.machinery.plausible import doubts
    from engine import SceneError

    runs: list[Job] = []
    try:
        plain = {case: _scene(name, changes, case, {}) for case in cases}
        odd = [line for case, scene in plain.items() for line in doubts(scene, LENGTHS_S[case[0]])]
        faults.extend(dict.fromkeys(odd))
        if faults:  # theory takes seconds, and of an odd line long, for an order that is refused
            return ()
        runs += [_run(case, "case", scene, LENGTHS_S[case[0]]) for case, scene in plain.items()]
        if not companions:
            return tuple(runs)
        doubled = {case: _finer(scene) for case, scene in plain.items()}
        for EI in STIFFNESSES_NM2 if STIFFNESS_CASE in cases else ():
            if EI != plain[STIFFNESS_CASE].tether.bending_stiffness_Nm2:
                further = {**doubled[STIFFNESS_CASE], "tether.bending_stiffness_Nm2": EI}
                scene = _scene(name, changes, STIFFNESS_CASE, further)
                runs.append(_run(STIFFNESS_CASE, "stiffness", scene, LENGTHS_S[STIFFNESS_CASE]))
        for case in cases:
            runs += _straight(name, changes, case, plain[case])
        for case in cases:
            runs.append(_run(case, "doubled", _scene(name, changes, case, doubled[case]), LENGTHS_S[case[0]]))
    except SceneError as error:
        faults.extend(fault for fault in error.faults if fault not in faults)
    return tuple(runs)


def _run(case: str, kind: str, scene, duration_s: float) -> Job:
    return Job({"case": case, "kind": kind}, scene, duration_s=duration_s)


def _finer(scene) -> dict[str, object]:
    changes: dict[str, object] = {"tether.nodes": 2 * scene.tether.nodes - 1}
    return {**changes, "output.profiles_step_s": DOUBLED_STEP_S} if scene.output.profiles else changes


def _scene(name: str, changes: dict, case: str, further: dict):
    from engine import load_scene

    decay = {"end.force_decay_s": SLOW_S if case.endswith("p") else FAST_S}
    force_N = FORCES_N[case[0]]
    settings = {**changes, **further, **decay}
    scene = load_scene(name, {**settings, "end.force_N": [force_N, 0.0, 0.0]})
    tether = scene.tether
    weight_N = tether.density_kgpm3 * tether.area_m2 * scene.gravity_mps2 * tether.length_m
    return load_scene(name, {**settings, "end.force_N": [force_N, 0.0, 0.5 * weight_N]})


def _straight(name: str, changes: dict, case: str, plain) -> list[Job]:
    """The breaks without gravity."""
    from campaigns.breaking_line.theory import theory_of

    theory = theory_of(plain, LONGEST_S)
    if theory is None:
        return []
    step_s = min(STRAIGHT_STEP_S, BIRTH_STEPS * theory.start.time_s) if theory.shocked else STRAIGHT_STEP_S
    kinds = [("straight", STRAIGHT_NODES)] if theory.shocked else []
    kinds += [("series", nodes) for nodes in SERIES_NODES if case in SERIES_CASES]
    straight = {
        "gravity_mps2": 0.0,
        "tether.grid_stretching": 0.0,
        "tether.grid_refined": "both",
        "output.step_s": step_s,
        "output.profiles": True,
        "output.profiles_step_s": step_s,
    }
    return [
        _run(case, kind, _scene(name, changes, case, {**straight, "tether.nodes": nodes}), theory.arrival_s)
        for kind, nodes in kinds
    ]


def measures(order: Order) -> Measures:
    """`rows.breaking_row` of every run."""
    from campaigns.breaking_line.rows import COLUMNS, breaking_row

    own = (f"campaigns/breaking_line/{name}" for name in ("rows.py", "motion_measures.py", "theory"))
    return Measures(COLUMNS, breaking_row, ("analysis", "engine", *own))


def write_results(plan, summary) -> float:
    """statements.csv and exact.nc of the folder; returns 0, no seconds of the workers' analysis."""
    from campaigns.breaking_line import results

    results.write_results(plan.how.out)
    return 0.0


STUDY = Study(
    name=CAMPAIGN,
    protocol=__doc__,
    scene=SCENE,
    taken=dict.fromkeys(("end", "end.force_N", "end.force_decay_s", "end.kind"), "use --cases"),
    options=options,
    cases=lambda order: planned(order.name, order.changes, order.own.cases, not order.own.no_companions, order.faults),
    measures=measures,
    parameters=lambda order: {"cases": list(order.own.cases), "companions": not order.own.no_companions},
    runs=lambda order: partial(run, compile_run_s=COMPILE_RUN_S),
    beside=lambda order: (write_results,),
    together=False,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
