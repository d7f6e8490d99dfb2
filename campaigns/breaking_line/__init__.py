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

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import isfinite

from campaigns.machinery import Job, cli
from campaigns.study import Measures, Order, Study
from tables import Rows, listed, number_of

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
LONGEST_S = 0.2


@dataclass
class Options(cli.Options):
    """The options of this campaign."""

    cases: list[str] = cli.option(
        "A B ...",
        f"cases of the paper (default: {' '.join(CASES)}; p: fracture in 50 ms)",
        cli.one_of(CASES),
        CASES,
        many=True,
    )
    no_companions: bool = cli.flag(
        "leave out the doubled grids, the other bending stiffnesses and the breaks without gravity"
    )


def cases(order: Order) -> Iterator[Job]:
    """The runs in the order of the table.

    kind: "case"; "doubled" (twice the elements); "stiffness" (case 4, doubled, with another EI); without gravity on an
    even grid up to the arrival of the front, "straight" (fine) and "series" (grid by grid).
    """
    order.tell(*_own_break(order))
    plain = {}
    for case in order.options.cases:
        scene = order.scene(_changes(order, case, {}), LENGTHS_S[case[0]])
        if scene is None:
            return
        plain[case] = scene
    if order.faults:  # theory takes seconds, and of an odd line long, for an order that is refused
        return
    for case, scene in plain.items():
        yield Job({"case": case, "kind": "case"}, scene, duration_s=LENGTHS_S[case[0]])
    if order.options.no_companions:
        return
    finer = {}
    for case, scene in plain.items():
        finer[case] = {"tether.nodes": 2 * scene.tether.nodes - 1}
        if scene.output.profiles:
            finer[case]["output.profiles_step_s"] = DOUBLED_STEP_S
    if STIFFNESS_CASE in plain:
        for EI in STIFFNESSES_NM2:
            if EI != plain[STIFFNESS_CASE].tether.bending_stiffness_Nm2:
                changes = finer[STIFFNESS_CASE] | {"tether.bending_stiffness_Nm2": EI}
                yield _run(order, STIFFNESS_CASE, "stiffness", changes)
    for case, scene in plain.items():
        yield from _straight(order, case, scene)
    for case in plain:
        yield _run(order, case, "doubled", finer[case])


def _own_break(order: Order) -> Iterator[str]:
    """Faults of a scene with a break of its own, which the cases would replace."""
    scene = order.base()
    if scene is None:
        return
    force_N, decay_s = scene.end.force_N, scene.end.force_decay_s
    if force_N is not None and force_N[0] not in FORCES_N.values():
        allowed = ", ".join(f"{force:g}" for force in FORCES_N.values())
        yield f"end.force_N: given {force_N[0]:g} N along x; allowed: that of a case, {allowed}; use --cases"
    if decay_s not in (None, FAST_S, SLOW_S):
        yield f"end.force_decay_s: given {decay_s:g}; allowed: that of a case, {FAST_S:g} or {SLOW_S:g}; use --cases"


def _run(order: Order, case: str, kind: str, changes: dict, duration_s: float = 0.0) -> Job:
    scene = order.base(_changes(order, case, changes), tell=True)
    return Job({"case": case, "kind": kind}, scene, duration_s=duration_s or LENGTHS_S[case[0]])


def _changes(order: Order, case: str, further: dict) -> dict:
    """The changes of a case: its break, with both ends at one level."""
    force_N = [FORCES_N[case[0]], 0.0, 0.0]
    changes = {**further, "end.force_decay_s": SLOW_S if case.endswith("p") else FAST_S, "end.force_N": force_N}
    scene = order.base(changes)
    if scene is not None:
        tether = scene.tether
        force_N[2] = 0.5 * (tether.density_kgpm3 * tether.area_m2 * scene.gravity_mps2 * tether.length_m)
    return changes


def _straight(order: Order, case: str, plain) -> Iterator[Job]:
    """The breaks without gravity."""
    from campaigns.breaking_line.theory import theory_of

    theory = theory_of(plain, LONGEST_S)
    if theory is None:
        return
    step_s, kinds = STRAIGHT_STEP_S, []
    if theory.shocked:
        step_s = min(STRAIGHT_STEP_S, BIRTH_STEPS * theory.start.time_s)
        kinds.append(("straight", STRAIGHT_NODES))
    if case in SERIES_CASES:
        kinds += [("series", nodes) for nodes in SERIES_NODES]
    straight = {
        "gravity_mps2": 0.0,
        "tether.grid_stretching": 0.0,
        "tether.grid_refined": "both",
        "output.step_s": step_s,
        "output.profiles": True,
        "output.profiles_step_s": step_s,
    }
    for kind, nodes in kinds:
        yield _run(order, case, kind, {**straight, "tether.nodes": nodes}, theory.arrival_s)


def measures(order: Order) -> Measures:
    """`rows.breaking_row` of every run."""
    from campaigns.breaking_line.rows import COLUMNS, breaking_row

    sources = (f"campaigns/breaking_line/{name}" for name in ("rows.py", "motion_measures.py", "theory"))
    return Measures(COLUMNS, breaking_row, ("analysis", "engine", *sources))


def beside(order: Order) -> Iterator[Callable]:
    """What follows the runs: statements.csv and exact.nc of the folder."""
    from campaigns.breaking_line.results import write_results

    yield write_results


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """Speeds of the broken ends, how far they are off theory, and the paper's statements that do not hold."""
    from campaigns.answers import verdicts

    speeds, errors = [], []
    for row in rows:
        if row["kind"] != "case" or row["status"] != "ok":
            continue
        speeds.append(f"{number_of(row, 'end_speed_mps'):.0f} m/s (case {row['case']})")
        error = number_of(row, "end_speed_error")
        if isfinite(error):
            errors.append(abs(error))
    if speeds:
        yield f"The broken ends come back at {listed(speeds)}."
    if errors:
        yield f"Exact theory gives {len(errors)} of these speeds, within {100.0 * max(errors):.2g} %."
    yield from verdicts(order.how.out, quoted=4)


STUDY = Study(
    name=CAMPAIGN,
    protocol=__doc__,
    scene=SCENE,
    taken=dict.fromkeys(("end", "end.force_N", "end.force_decay_s", "end.kind"), "use --cases"),
    options=Options,
    cases=cases,
    measures=measures,
    parameters=lambda order: {"cases": list(order.options.cases), "companions": not order.options.no_companions},
    beside=beside,
    answer=answer,
    together=False,
)
main, read_order = STUDY.main, STUDY.read_order
