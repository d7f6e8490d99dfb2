"""Every motion that a wave allows: many starts of a scene, the motions they end in, and these over a grid of places.

grid         keys of a scene with their values, and the run from rest of every combination
starts       where a run begins, and how it goes on until it has settled or has reached a known motion
proposals    starts from the motions of a massless tether
motions      what is known of each place: its motions, their judged runs, their rows
stages       from rest, proposals, carried, kicks, judged, named: how the motions are found
ends         where the range of a motion ends, and whether a motion is of the numerical grid
sweep        all this over one key
"""
