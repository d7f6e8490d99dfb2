"""Campaigns: many runs from one command, one row a run, safe to interrupt and to start again.

Each folder but `machinery` is a campaign to run with `python -m`. Its `__init__` holds the command line and reads like
a lab protocol; the files beside it hold what only this campaign has, such as a run as one line of numbers (`rows`).
What all share is in `machinery`: `cli` (options and their faults), `session` (compile, run, report, what is said),
`folder` (what is on disk, and how it stays readable), `pools` (where runs execute), `runner` (what happens to each
run), `side_by_side` (runs that share a worker), `row_store` (rows that need not be made again), `provenance` and
`machine` (who, where, with what).
"""

import sys

# Said here as well: what a command imports first does not even compile on an older one.
if sys.version_info < (3, 11):  # noqa: UP036
    running = ".".join(map(str, sys.version_info[:3]))
    raise ImportError(
        f"the tether workbench needs Python 3.11 or newer, and this is {running} ({sys.executable}); "
        "make its environment with a newer one, for instance python3.12 -m venv .venv"
    )
