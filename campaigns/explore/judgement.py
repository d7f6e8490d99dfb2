"""What the row of a run rests on beside the run itself: its verdict, and the periodic orbit under it.

A row only reads numbers (`campaigns.explore.rows.buoy_row`). Whatever takes long is computed here: the tests of a
record, and orbits, whose computations are kept under keys of their own (`campaigns.explore.multipliers`).
"""

from dataclasses import dataclass, replace

from analysis import Exponent, Verdict, next_look
from analysis.approaches import NEARER
from analysis.looks import FORGOTTEN, NO_GROWTH, OUTLASTS, SHEAR
from campaigns.explore.multipliers import OrbitUnder, orbit_ahead, orbit_of_twice, orbit_under
from campaigns.explore.rows import sound_part
from campaigns.judge import LEAST_JUDGED, motion_of, periods_of, record_regime, tangent_of
from campaigns.machinery import Store
from engine.trajectory import Trajectory
from engine.views import carried, carries_tangents, in_regular_waves
from tables import OPEN


@dataclass(frozen=True)
class Judgement:
    """How a run is judged.

    transient    wave periods at its start that are left out of extremes
    verdict      None where the run has none: it ended early, or is too short
    record       the verdict on its samples alone, as on a record of unknown origin, where that was asked for
    wolf         its exponent by Wolf's method, likewise
    tangent      its exponent from tangent dynamics
    orbit        the periodic orbit under it
    limit        whether the run only comes nearer to its orbit: extremes and slack are then those of the orbit
    note         in words: the multipliers of the orbit under a run that repeats, or why there are none
    """

    transient: int
    verdict: Verdict | None = None
    record: Verdict | None = None
    wolf: Exponent | None = None
    tangent: Exponent | None = None
    orbit: OrbitUnder | None = None
    limit: bool = False
    note: str = ""

    @property
    def tighter(self) -> str | None:
        """The regime of a motion that went on at a tighter tolerance; None where it did not."""
        if any(test.name == "tighter tolerance" and test.passed is not None for test in self.verdict.evidence):
            return self.verdict.regime
        return None


def judgement_of(
    trajectory: Trajectory, checks: dict | None, orbits: Store, transient_periods: int | None, full: int | None = None
) -> Judgement | None:
    """How a run of a buoy in regular waves is judged (`campaigns.judge`); None of any other line.

    It gets a verdict if it reached its end and lasts for two looks. In three dimensions, where no perturbations are
    carried and no orbit is looked for, it is judged as a record of unknown origin: 40 periods after the transient.
    transient_periods: wave periods left out. None: those that the verdict has found, in three dimensions a third; a
    periodic motion then has its orbit, and one that only comes nearer to its orbit is judged by that.
    checks: how it went on at a tighter tolerance, for a run that is chaotic.
    full: wave periods after which a run ends undecided, where Wolf's exponent and the tests for records of unknown
    origin are asked for too; the verdict does not rest on them. None: they are not made.
    """
    transient, scene, verdict, wolf = transient_periods or 0, trajectory.scene, None, None
    if not in_regular_waves(scene):
        return None
    periods = periods_of(scene, sound_part(trajectory.columns))
    if trajectory.status != "ok":
        return Judgement(transient)
    if carries_tangents(scene):
        if transient_periods is None or (carried(trajectory) and periods >= next_look(next_look())):
            verdict = motion_of(trajectory, checks)
    elif scene.motion.dimensions == 3:
        if transient_periods is None:
            transient = int(periods) // 3
        if periods - transient >= LEAST_JUDGED:
            verdict, wolf = record_regime(trajectory, transient)
    judgement = Judgement(transient, verdict, wolf=wolf)
    if verdict is None:
        return judgement
    if transient_periods is None and carries_tangents(scene):
        judgement = _with_orbit(trajectory, judgement, orbits)
        transient = judgement.verdict.transient
    judgement = replace(judgement, transient=transient, tangent=tangent_of(trajectory, transient))
    regime = judgement.verdict.regime
    goes_on = regime in OPEN or (regime == "chaotic" and judgement.tighter is None)
    if full is None or wolf is not None or (goes_on and periods <= full - 0.5):
        return judgement
    record, wolf = record_regime(trajectory, transient, judgement.tangent)
    return replace(judgement, record=record, wolf=wolf)


def _with_orbit(trajectory: Trajectory, judgement: Judgement, orbits: Store) -> Judgement:
    """The judgement with the orbit under the run, and with what that orbit says of the verdict."""
    verdict, orbit = judgement.verdict, None
    if verdict.regime in (*OPEN, "quasi-periodic"):
        verdict, orbit = judged_by_orbit(trajectory, verdict, orbits)
    if orbit is not None:
        limit = verdict.evidence[-1].name == NEARER
        return replace(judgement, verdict=verdict, orbit=orbit, limit=limit, note=orbit.words())
    if not verdict.period or trajectory.final_state is None:
        return replace(judgement, verdict=verdict)
    try:
        orbit = orbit_under(trajectory, verdict.period, orbits)
        if orbit.period != verdict.period:
            raise ArithmeticError(f"the orbit under it has period {orbit.period}")
        if orbit.is_unstable():
            orbit = orbit_of_twice(trajectory, orbit, orbits) or orbit
        note = orbit.words()
    except (ArithmeticError, ValueError) as why:
        orbit, note = None, f"no multipliers: {why}"
    if orbit is None and not _confirmed(verdict):
        reason = f"{verdict.reason}; neither perturbations nor multipliers confirm it"
        verdict = replace(verdict, regime="undecided", reason=reason)
    elif orbit is not None and orbit.is_unstable():
        reason = verdict.reason
        if orbit.growth_bits(verdict.points) > FORGOTTEN:
            reason = f"{reason}; {OUTLASTS}"
        verdict = replace(verdict, regime="undecided", reason=reason)
    elif orbit is not None and orbit.period != verdict.period:
        verdict = replace(verdict, regime=f"period-{orbit.period}", period=orbit.period)
    return replace(judgement, verdict=verdict, orbit=orbit, note=note)


def _confirmed(verdict: Verdict) -> bool:
    """Whether perturbations confirm a period that no orbit does: those of a slow torus do not grow either."""
    bits = [verdict.points * test.value for test in verdict.evidence if test.name == NO_GROWTH]
    return any(value < -SHEAR for value in bits)


def judged_by_orbit(trajectory: Trajectory, verdict: Verdict, orbits: Store) -> tuple[Verdict, OrbitUnder | None]:
    """The Verdict on a run that has not settled, with what the orbit near it says; the orbit where the run comes to it.

    Its transient ends where the last third of the judged periods begins.
    """
    near = orbit_ahead(trajectory, orbits)
    if near is None:
        return verdict, None
    orbit, approach = near
    evidence = *verdict.evidence, approach
    if not approach.passed:
        return replace(verdict, reason=f"{verdict.reason}; {approach.sentence}", evidence=evidence), None
    points = verdict.points // 3
    reason = f"repeats after {orbit.period} wave period(s): {approach.sentence}"
    if approach.name == NEARER:
        reason = (
            f"repeats after {orbit.period} wave period(s) in the limit: {approach.sentence}; extremes are the orbit's"
        )
    transient = verdict.transient + verdict.points - points
    return Verdict(f"period-{orbit.period}", reason, evidence, orbit.period, points, verdict.seed, transient), orbit
