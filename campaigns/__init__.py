"""Campaigns: many runs from one command, one row a run, safe to interrupt and to start again.

Each folder but `machinery` is a campaign to run with `python -m`. Its `__init__` holds the command line and reads like
a lab protocol; the files beside it hold what only this campaign has, such as a run as one line of numbers (`rows`).
What all share is in `machinery`: `cli` (options and their faults), `session` (compile, run, report, what is said),
`folder` (what is on disk, and how it stays readable), `pools` (where runs execute), `runner` (what happens to each
run), `side_by_side` (runs that share a worker), `row_store` (rows that need not be made again), `provenance` and
`machine` (who, where, with what).
"""
