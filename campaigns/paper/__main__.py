"""`python -m campaigns.paper`."""

import sys

from campaigns.paper import main

if __name__ == "__main__":
    sys.exit(main())
