"""What the starts of one scene showed: its motions, which is dangerous, and how little leads to it."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from campaigns.answers import CHAOS_OF_ONE_GRID, greatest, in_newtons
from campaigns.basins.grid import COLUMNS, PHASE
from campaigns.explore.load import use_of
from campaigns.explore.motions import from_rest
from tables import CHAOTIC, PEAK, UNSETTLED, Row, Rows, listed, number_of, ranges

NONE_FOUND = "No start has settled, so there is no motion to name."
CREST = "crest"  # entry of a row: time from its start to the next crest over the anchor, as a share of the wave period
STRAIGHT = 3.0  # degrees from an axis that are told as along it


def sentences(rows: Rows, across: Sequence[str], scene, parts: Mapping[str, Rows]) -> Iterator[str]:
    """At most eight, of the rows of table.csv and those of the tables in its folders motions, shock and edge (parts).

    across: as `Grid.across`; scene: from rest.
    """
    motions = [row for row in parts["motions"] if row.get("motion")]
    worst = greatest(motions, PEAK)
    if worst is None:
        yield NONE_FOUND
        return
    count = "One motion"
    if len(motions) > 1:
        count = f"{len(motions)} motions"
    at = f"kA = {motions[0]['steepness']:.4g} and H = {scene.water.depth_m:g} m"
    yield f"{count} at {at}: {listed(map(_of_motion, motions))}."
    yield _shares(rows, motions)
    if worst is motions[0] and len(motions) > 1:
        yield f"Motion {worst['motion']} pulls hardest: no start of the grid leads to more."
    elif parts["shock"]:
        times = worst[PEAK] / motions[0][PEAK]
        yield f"Motion {worst['motion']} is the dangerous one: it pulls {times:.2g} times as hard as A."
    used = use_of(worst, scene, searched=any(row["motion"] for row in rows))
    yield f"On the tension of {worst['motion']}: {used[:1].lower()}{used[1:]}"
    if parts["shock"]:
        yield _shock(_with_crests(parts["shock"], scene), across, math.cos(scene.waves.direction_rad))
    if PHASE in across and parts["shock"]:
        yield _when(_with_crests(rows, scene), across, str(parts["shock"][0]["motion"]))
    if parts["edge"]:
        yield from _edge(parts["edge"][0])
    unsure = []
    for row in motions:
        if "NOT" in str(row["confirmed"]) or "not settled" in str(row["confirmed"]):
            unsure.append(f"{row['motion']} is found {row['confirmed']}")
    if unsure:
        yield f"It depends on how it is computed: {'; '.join(unsure)}."
    else:
        yield "Each motion stays at a tenth of the tolerance and on a finer grid of the line."
    if any(row["regime"] == CHAOTIC for row in motions):
        yield CHAOS_OF_ONE_GRID


def _of_motion(row: Row) -> str:
    """ "A from rest (period-1, 9.45 kN)"."""
    name = row["motion"]
    if from_rest(row):
        name = f"{name} from rest"
    return f"{name} ({row.get('regime') or row['status']}, {in_newtons(row[PEAK])})"


def _shares(rows: Rows, motions: Rows) -> str:
    counts, unsettled, failed = Counter(), 0, 0
    for row in rows:
        counts[row["motion"]] += 1
        unsettled += row.get("outcome") == UNSETTLED
        failed += row["status"] != "ok"
    ends = listed(f"{counts[motion['motion']]} end in {motion['motion']}" for motion in motions)
    sentence = f"Of {len(rows)} starts {ends}"
    if unsettled or failed:
        sentence += f"; {unsettled} had not settled, and {failed} failed"
    return f"{sentence}."


def _way(shock: Row, across: Sequence[str], along: float) -> str:
    """The direction of a smallest start in words: "along the waves, 23 degrees downwards".

    along: cosine of the direction of the waves; if it is negative, they run along -x.
    """
    first = number_of(shock, COLUMNS[across[0]])
    ahead = ("along the waves", "against the waves")[first * along < 0.0]
    if PHASE in across:
        if across[0] == "vz":
            ahead = ("upwards", "downwards")[first < 0.0]
        return f"{ahead}, {shock[CREST]:.2f} T before a crest"
    second = number_of(shock, COLUMNS[across[1]])
    upright = ("downwards", "upwards")[second > 0.0]
    angle = math.degrees(math.atan2(abs(second), abs(first)))
    if angle <= STRAIGHT:
        return ahead
    if angle >= 90.0 - STRAIGHT:
        return upright
    return f"{ahead}, {angle:.0f} degrees {upright}"


def _shock(rows: Rows, across: Sequence[str], along: float) -> str:
    unit = ("m/s", "m")["x" in across]
    good = [row for row in rows if row["status"] == "ok"]
    if not good:
        return f"No smallest start was found: {rows[0]['message']}."
    first, *finer = good
    if first["size"] == 0.0:
        return f"No gust is needed: waves that begin {first[CREST]:.2f} T before a crest lead to {first['motion']}."
    words = (
        f"The smallest start that leads to {first['motion']} is {first['size']:.2g} {unit} {_way(first, across, along)}"
    )
    for row in finer:
        words += f"; on {row['nodes']:.0f} nodes {row['size']:.2g} {unit} {_way(row, across, along)}"
    if not finer:
        words += f"; on a finer grid of the line {rows[-1]['message']}"
    return f"{words}."


def _with_crests(rows: Rows, scene) -> Rows:
    """The rows with the time from the start to a crest over the anchor, as a share of the wave period."""
    from engine.physics.sea import crest_share

    return [{**row, CREST: crest_share(scene, number_of(row, COLUMNS[PHASE]))} for row in rows]


def _when(rows: Rows, across: Sequence[str], letter: str) -> str:
    """How long before a crest nothing, little or much leads to a motion."""
    least = dict.fromkeys(sorted(row[CREST] for row in rows), math.inf)  # by phase
    for row in rows:
        if row["motion"] == letter:
            least[row[CREST]] = min(abs(number_of(row, COLUMNS[across[0]])), least[row[CREST]])
    sizes, phases = list(least.values()), [round(phase, 3) for phase in least]
    low, high = min(sizes), max(filter(math.isfinite, sizes), default=math.inf)
    enough = f"{low:.2g} m/s are enough"
    if low == 0.0:
        enough = "none is needed"
    words = {enough: low}
    if low < high:
        words[f"it takes {high:.2g} m/s, the most"] = high
    words["no gust of the grid does"] = math.inf
    parts = []
    for text, limit in words.items():
        if limit in sizes:
            parts.append(f"at {ranges(phases, [size == limit for size in sizes], 2)} T {text}")
    return f"How a gust leads to {letter}, by the time from it to a crest: {'; '.join(parts)}."


def _edge(edge: Row) -> Iterator[str]:
    if edge["status"] != "ok":
        yield f"No edge state between {edge['motion']} and {edge['other']} could be followed: the border was lost."
        return
    period = edge["strobed_period"]
    kind = "a motion without a period up to 16"
    if math.isfinite(period):
        kind = f"a motion of period {period:.0f}"
    pull, growth = in_newtons(edge[PEAK]), edge["growth_bits_per_period"]
    yield (
        f"Between {edge['motion']} and {edge['other']} lies {kind} that no start keeps ({pull}): runs leave it by "
        f"{growth:.2g} bits a period."
    )
