"""Every motion that a wave allows: many starts of a scene, the motions they end in, and these along a parameter.

starts       where a run begins, and how it goes on until it has settled or has reached a known motion
proposals    starts from the motions of a massless tether
along        the motions of every value of a sweep: carried to the neighbours, named, judged
ends         where the range of a motion ends, and whether a motion is of the grid
"""
