"""Campaigns: many runs from one command, one row a run, safe to interrupt and to start again.

Each campaign is a module to run with `python -m`; it reads like a lab protocol and leaves the machinery to the other
files here: `cli` (options and their faults), `session` (compile, run, report, what is said), `folder` (what is on disk,
and how it stays readable), `pools` (where runs execute), `runner` (what happens to each run), `rows` (a run as one line
of numbers), `provenance` (who, where, with what).
"""
