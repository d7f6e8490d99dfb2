"""`python -m campaigns.accuracy`."""

import sys

from campaigns.accuracy import main, one_thread

if __name__ == "__main__":
    one_thread()
    sys.exit(main())
