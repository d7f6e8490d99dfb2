"""`python -m campaigns.out_of_plane`."""

import sys

from campaigns.out_of_plane import main

if __name__ == "__main__":
    sys.exit(main())
