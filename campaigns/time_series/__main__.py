"""`python -m campaigns.time_series FILE.csv --column NAME`, the same as `python -m analysis`."""

import sys

from campaigns.time_series import main

if __name__ == "__main__":
    sys.exit(main())
