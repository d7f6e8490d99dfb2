"""`python -m campaigns.breaking_line`."""

import sys

from campaigns.breaking_line import main

if __name__ == "__main__":
    sys.exit(main())
