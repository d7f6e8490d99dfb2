"""The buoy sweep with a fake engine, as a process of its own: python -m tests.campaigns.fake_sweep OPTIONS-OF-THE-SWEEP

The environment variable FAKE holds the fields of the FakeEngine as JSON.
"""

import json
import os
import sys

from campaigns import buoy_sweep
from tests.campaigns.fake_engine import FakeEngine

if __name__ == "__main__":
    fields = json.loads(os.environ.get("FAKE", "{}"))
    fake = FakeEngine(**{name: tuple(entry) if isinstance(entry, list) else entry for name, entry in fields.items()})
    sys.exit(buoy_sweep.main(simulate=fake))
