"""One column of a text file, read, judged and told: what `python -m analysis` is made of.

`columns` reads and checks, `sections` decides how the motion is seen, `study` measures and judges, `words` and `files`
tell it, `command` is the command line.
"""
