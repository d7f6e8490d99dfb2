"""`python -m campaigns.sweep`."""

import sys

from campaigns.sweep import main

if __name__ == "__main__":
    sys.exit(main())
