"""A first scene of an engineer's own mooring: a sphere on one rope, from a few lengths and a table of ropes.

ropes     properties of a rope by material and diameter (ropes.toml names the source of every number)
scene     what follows from the lengths: floating or submerged, added mass, drag, bed, ramp; the commented text
command   `python -m engine --new FILE`: options, questions, refusals
"""
