"""What all campaigns share: whatever turns a list of runs into a folder of results, safe to interrupt and to resume.

These are the names that campaigns use; its own modules import from each other.
"""

# ruff: noqa: F401
from campaigns.machinery.folder import (
    SEAL,
    BadInput,
    CampaignStopped,
    Table,
    claimed,
    made_by,
    of_the_page,
    read_json,
    read_sealed,
    run_of,
    stored_run,
    trajectory_path,
    write_failure,
    write_json,
    write_new,
    write_sealed,
)
from campaigns.machinery.long_runs import EARLY, TANGENTS, once, until_judged, until_settled
from campaigns.machinery.plan import Job, Jobs, Plan, Summary, filled
from campaigns.machinery.progress import in_parts, print_line, stage
from campaigns.machinery.runner import ENGINE, run, shares_worker, spare_groups, write_scene
from campaigns.machinery.session import command_line, ended, machine
from campaigns.machinery.store import Store, key_of, orbits_in
from campaigns.machinery.tasks import Task, results
