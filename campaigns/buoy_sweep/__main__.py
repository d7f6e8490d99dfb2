"""`python -m campaigns.buoy_sweep`."""

import sys

from campaigns.buoy_sweep import main

if __name__ == "__main__":
    sys.exit(main())
