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

from dataclasses import dataclass
from functools import partial

from campaigns.machinery import cli

CAMPAIGN = "breaking_line"
MODULE = "campaigns.breaking_line"
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


@dataclass(frozen=True)
class Run:
    """One run to do: the paper's case, the kind of run (see `planned`), its scene and length."""

    case: str
    kind: str
    scene: object
    duration_s: float


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked."""

    runs: tuple[Run, ...]
    how: cli.Running
    source: dict


def main(argv: list[str] | None = None, simulate=None) -> int:
    """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2 or 130)."""
    return cli.command(MODULE, argv, read_order, partial(break_lines, simulate=simulate))


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is run")
    cli.add(what, "--cases", "A B ...", f"cases of the paper (default: {' '.join(CASES)}; p: fracture in 50 ms)")
    cli.add(what, "--scene", "FILE_OR_NAME", f"scene to start from (default: {SCENE})")
    cli.add(what, "--set", "KEY=VALUE ...", "change values of the scene, as tether.nodes=401")
    leave_out = "leave out the doubled grids, the other bending stiffnesses and the breaks without gravity"
    what.add_argument("--no-companions", action="store_true", help=leave_out)
    cli.add_running(parser.add_argument_group("how and where"), f"results/{CAMPAIGN}")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault, of options and scenes, is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    cases = _cases(options.cases, faults)
    how = cli.running(options, CAMPAIGN, faults)
    name = cli.scene_name(options, SCENE, faults)
    taken = dict.fromkeys(("end", "end.force_N", "end.force_decay_s", "end.kind"), "use --cases")
    changes = cli.assignments(options.set, taken, faults)
    runs = planned(name, changes, cases, not options.no_companions, faults)
    source = {"scene": name, "set": changes, "cases": cases, "companions": not options.no_companions}
    return Order(runs, how, source)


def _cases(words: list[str] | None, faults: list[str]) -> list[str]:
    allowed = "one of " + " ".join(CASES)
    if words == []:
        faults.append(f"--cases: given nothing; allowed: one or more, each {allowed}")
    found = cli.values(words or list(CASES), "--cases", list(CASES), cli.one_of(CASES), allowed, faults)
    return list(dict.fromkeys(found))


def planned(name: str, changes: dict, cases: list[str], companions: bool, faults: list[str]) -> tuple[Run, ...]:
    """The runs in the order of the table.

    kind: "case"; "doubled" (twice the elements); "stiffness" (case 4, doubled, with another EI); without gravity on an
    even grid up to the arrival of the front, "straight" (fine) and "series" (grid by grid).
    """
    from campaigns.machinery.plausible import doubts, endless
    from engine import SceneError

    runs: list[Run] = []
    try:
        plain = {case: _scene(name, changes, case, {}) for case in cases}
        odd = [line for case, scene in plain.items() for line in (*doubts(scene), *endless(scene, LENGTHS_S[case[0]]))]
        faults.extend(dict.fromkeys(odd))
        if faults:  # theory takes seconds, and of an odd line long, for an order that is refused
            return ()
        runs += [Run(case, "case", scene, LENGTHS_S[case[0]]) for case, scene in plain.items()]
        if not companions:
            return tuple(runs)
        doubled = {case: _finer(scene) for case, scene in plain.items()}
        for EI in STIFFNESSES_NM2 if STIFFNESS_CASE in cases else ():
            if EI != plain[STIFFNESS_CASE].tether.bending_stiffness_Nm2:
                further = {**doubled[STIFFNESS_CASE], "tether.bending_stiffness_Nm2": EI}
                scene = _scene(name, changes, STIFFNESS_CASE, further)
                runs.append(Run(STIFFNESS_CASE, "stiffness", scene, LENGTHS_S[STIFFNESS_CASE]))
        for case in cases:
            runs += _straight(name, changes, case, plain[case])
        for case in cases:
            runs.append(Run(case, "doubled", _scene(name, changes, case, doubled[case]), LENGTHS_S[case[0]]))
    except SceneError as error:
        faults.extend(fault for fault in error.faults if fault not in faults)
    return tuple(runs)


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


def _straight(name: str, changes: dict, case: str, plain) -> list[Run]:
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
        Run(case, kind, _scene(name, changes, case, {**straight, "tether.nodes": nodes}), theory.arrival_s)
        for kind, nodes in kinds
    ]


def break_lines(order: Order, argv: list[str], simulate) -> int:
    """Run it: compile, run, table, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.breaking_line.rows import COLUMNS, breaking_row
    from campaigns.machinery import session
    from campaigns.machinery.row_store import made_by
    from campaigns.machinery.runner import make_job, plan_of

    if simulate is None:
        from engine import simulate
    sources = ("analysis", "engine", "campaigns/breaking_line/rows.py")
    plan = plan_of(order.how, simulate, breaking_row, COLUMNS, made_by({}, *sources))
    jobs = [
        make_job(run.scene, duration_s=run.duration_s, labels={"case": run.case, "kind": run.kind})
        for run in order.runs
    ]
    compiled = partial(session.run, compile_run_s=COMPILE_RUN_S)
    how = {"report": order.how.report, "runs": compiled}
    return session.conduct(CAMPAIGN, MODULE, argv, plan, jobs, order.source, **how)
