"""The cases of `campaigns.validation`, read from cases.toml, the runs that they need, and the columns of the tables."""

import itertools
import math
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from campaigns.machinery import Job
from tables import MESSAGE, RUN_KEY, STATISTICS, STATUS, Column, of_words

HOLDS, MISSES, NOT_RUN, TOLD = "holds", "misses", "not run", "told"
DATA = Path(__file__).with_name("data")
RUN = of_words("run", "scene, and what sets the run apart from it")
COLUMNS = (RUN, STATUS, *STATISTICS, RUN_KEY, MESSAGE)
JUDGED = (
    of_words("case", "name of the case"),
    of_words("title", "the case in words"),
    of_words("quantity", "what is compared"),
    of_words("ours", "our number"),
    of_words("theirs", "that of the source"),
    Column("error", "", "error", "difference of the two, along the curves where rms is said, in the unit", 4),
    Column("bar", "", "bar", "most that the error may be, set before the run", 4),
    of_words("unit", "unit of error and bar"),
    of_words("verdict", "holds, misses, not run; told: a number that is not judged"),
    of_words("note", "what was fitted and is not judged, or why there is no number"),
    of_words("source", "whose numbers theirs are"),
    of_words("assumed", "what no source says"),
    of_words("x_label", "axis of the curves", "x"),
    of_words("y_label", "axis of the curves", "y"),
    of_words("run_keys", "content keys of the runs", "keys"),
)


@dataclass(frozen=True)
class Case:
    """One case.

    family: a function of `campaigns.validation.families`. changes: keys of the scene; vary: keys with a list each, of
    which every combination is a run. duration_s, or rounds: of the periods of waves or of a moved end. bars: quantity
    -> (most that its error may be, unit). quick: whether it is also part of `--quick`. not_run: why it cannot be.
    """

    name: str
    title: str
    family: str
    source: str
    assumed: str = ""
    scene: str = ""
    changes: dict = field(default_factory=dict)
    vary: dict = field(default_factory=dict)
    duration_s: float = 0.0
    rounds: int = 0
    bars: dict = field(default_factory=dict)
    x_label: str = ""
    y_label: str = ""
    options: dict = field(default_factory=dict)
    quick: bool = False
    not_run: str = ""

    def jobs(self) -> list[Job]:
        """Its runs, in the order in which its family takes them."""
        if missing(self):
            return []
        if self.family == "peer":
            return list(peer_jobs(self))
        return list(own_jobs(self))


def all_cases() -> Iterator[Case]:
    """Every case, in the order of the report; a case takes from its group what it does not say itself."""
    data = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    for group in data["groups"].values():
        for name, row in group.pop("cases").items():
            changes = group.get("changes", {}) | row.get("changes", {})
            yield Case(name, **(group | row | {"changes": changes}))


CASES = {case.name: case for case in all_cases()}
QUICK = tuple(case.name for case in CASES.values() if case.quick)


def own_jobs(case: Case) -> Iterator[Job]:
    """Runs of the engine."""
    from engine import load_scene

    for values in itertools.product(*case.vary.values()):
        changes = case.changes | dict(zip(case.vary, values, strict=True))
        words = [case.scene]
        for key, value in changes.items():
            words.append(f"{key.rpartition('.')[2]} {shown(value)}")
            if value == "none":
                changes[key] = None
        scene = load_scene(case.scene, changes)
        length_s = case.duration_s or case.rounds * period_of(scene)
        yield Job({"run": ", ".join(words)}, scene, duration_s=length_s)


def peer_jobs(case: Case) -> Iterator[Job]:
    """A run of ours and one of another code, on a work of `campaigns.accuracy`."""
    from campaigns.accuracy.jobs import other_code, scene_of, sources_of, version
    from campaigns.accuracy.plan import BY_NAME

    peer, work, setting = peer_of(case), BY_NAME[case.options["work"]], tuple(case.options["setting"])
    yield Job({"run": f"{work.name}, ours"}, work.made({**peer.ours, **case.changes}), duration_s=case.duration_s)
    simulate = partial(other_code, peer=peer, settings=setting)
    maker = f"{peer.name} {version(peer)} {setting} {sources_of(peer)}"
    scene = scene_of(peer, work.name, setting[0])
    yield Job({"run": f"{work.name}, {peer.name}"}, scene, duration_s=case.duration_s, simulate=simulate, made=maker)


def missing(case: Case) -> str:
    """Why a case is not run, "" where it is."""
    if case.family == "peer":
        from campaigns.accuracy.jobs import version

        peer = peer_of(case)
        if not version(peer):
            return f"not installed: pip install {peer.package}, or the extra bench of this project"
        return ""
    return case.not_run


def peer_of(case: Case):
    """The other code of a case (`campaigns.accuracy.plan.Peer`)."""
    from campaigns.accuracy.plan import PEERS

    return next(peer for peer in PEERS if peer.name == case.options["peer"])


def period_of(scene) -> float:
    """Period (s) of its waves, or of the motion of its end."""
    return (scene.waves or scene.end.motion).period_s


def shown(value: object) -> str:
    """A value of a scene in few letters."""
    if isinstance(value, dict):
        words = []
        for key, entry in value.items():
            if not isinstance(entry, list):
                words.append(f"{key} {shown(entry)}")
        return " ".join(words)
    if isinstance(value, float) and math.isfinite(value):
        return f"{value:g}"
    return str(value)


def jobs(cases: Iterable[Case]) -> list[Job]:
    """The runs of all cases, each once: several cases may look at the same one. The longest come first."""
    by_key = {}
    for case in cases:
        for job in case.jobs():
            by_key[job.key] = job
    return sorted(by_key.values(), key=lambda job: -size_of(job))


def size_of(job: Job) -> float:
    """About how long a run takes: its length times its nodes, and by these again where they shorten the steps."""
    return job.duration_s * job.scene.tether.nodes ** (2 if job.scene.solver.courant else 1)
