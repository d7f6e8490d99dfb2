"""Campaigns: many runs from one command, one row a run, safe to interrupt and to start again.

Each folder with a `__main__` is a campaign to run with `python -m campaigns.NAME`; its `__init__` reads like a lab
protocol, and the files beside it hold what only this campaign has, such as a run as one line of numbers (`rows`).
`study` is what a campaign of simulations is, `columns` what a column of a table is, `judge` the verdict on the motion
of a buoy, `answers` what campaigns say at their end. In `machinery`, each module imports only those before it:

    cli, folder, plan     options and their faults; what is on disk and stays readable; the runs to do
    progress              the line that says how far a command is
    session               a command from its words to its exit code, its provenance, its report
    pools, runner         where runs execute, and what becomes of each; all runs of a campaign, and its table
"""

import engine  # noqa: F401  first of all, because it refuses an older Python in words
