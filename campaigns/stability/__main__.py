"""`python -m campaigns.stability`."""

import sys

from campaigns.stability import main

if __name__ == "__main__":
    sys.exit(main())
