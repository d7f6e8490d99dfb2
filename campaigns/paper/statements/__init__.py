"""Every quantitative or qualitative statement of sections 3 to 5 and of the abstract, as claims.

Claims are in our own words. What depends on the water depth, which the paper does not give, is judged at every depth of
the dependence study.
"""

from campaigns.breaking_line import statements as line
from campaigns.breaking_line.statements import again
from campaigns.paper.statements import large_waves, small_waves
from campaigns.paper.statements.accuracy import DOUBLED_BUOY
from campaigns.paper.statements.plane import CLAIMS as PLANE
from campaigns.statements import Claim

EARLIER = "as under 4.2.1"
CLAIMS: tuple[Claim, ...] = (
    line.DOUBLING,
    DOUBLED_BUOY,
    *line.CLAIMS,
    *small_waves.CLAIMS,
    *large_waves.CLAIMS,
    *PLANE,
    again(DOUBLED_BUOY, "5", "as under 3"),
    again(line.UNIFORM_TENSION, "5", "as under 4.1.3"),
    again(line.SAME_SPEED, "5", line.EXACT),
    line.DISSIPATES,
    again(small_waves.ALWAYS_TAUT, "5", EARLIER),
    again(small_waves.REGULAR, "5", EARLIER),
    again(small_waves.TWO_MODES, "5", EARLIER),
    again(large_waves.THRESHOLD, "5", large_waves.SWEEP),
    again(large_waves.SNAPPING, "5", "as under 4.2.2"),
    again(large_waves.CHAOTIC, "5", "as under 4.2.2"),
)
