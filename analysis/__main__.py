"""`python -m analysis FILE.csv --column NAME`."""

import sys

from analysis.any_series.command import main

if __name__ == "__main__":
    sys.exit(main())
