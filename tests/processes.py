"""A Python of its own, for what a process does from its start."""

import os
import subprocess
import sys

from tests.pages import ROOT

OTHERWISE = {"PYTHONHASHSEED": "77", "TZ": "Asia/Tokyo", "SOURCE_DATE_EPOCH": "1"}  # what no file may depend on


def python(*words, cwd=ROOT, **environment):
    """The finished process of `python WORDS`, whatever its exit code, with further variables of the environment."""
    variables = os.environ | {"PYTHONPATH": str(ROOT)} | environment
    return subprocess.run([sys.executable, *map(str, words)], cwd=cwd, env=variables, capture_output=True, text=True)
