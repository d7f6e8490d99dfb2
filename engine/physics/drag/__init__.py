"""Drag laws of the line, eq. (24), one file a law: a new file in this folder is a new value of tether.drag.law.

Drag per metre of unstretched line is F = C |v| v, along the line and across it, v the velocity of the line against the
water: C = 1/2 rho_w pi d sqrt(1 + eps) C_dt along it, 1/2 rho_w d sqrt(1 + eps) C_dp across it. The keys
tether.drag_tangential and tether.drag_normal are the largest coefficients that a line ever has: bounds and time scales
of a scene take these. A law says which share of them is left at a speed. It may depend on the Reynolds number
speed d/nu, d the unstretched diameter.

A law's file has

    Model                       the scene's table, a Section whose key `law` is Literal["name of the law"]
    faults(sound)               rules between the values of that table, as fault lines
    numbers(law)                {field of engine.record.RECORD: number} and the law's table, a list of numbers
    along(speed, p, tables)     at |v_t| (m/s) the share s of C_dt, 0 <= s <= 1, and ds/d ln(speed), 0 at rest; p:
                                parameter record (p.diameter: d), tables: array of all tables
    across(speed, p, tables)    the same of C_dp at |v_p|
    IN_LANES                    False where `along` or `across` branches on the speed: then its runs do not share a
                                batch (`engine.simd`)

`along` and `across` are compiled (`engine.physics.drag.kernels`): numbers, `math`, no calls of other functions.
Fields of the record for a law's numbers: drag1 ... drag4, drag_n; its table begins at drag_at.
"""

from ..laws import laws_in

LAWS, NAMES, DragLaw = laws_in(__name__, __path__)
