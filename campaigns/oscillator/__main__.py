"""`python -m campaigns.oscillator`."""

import sys

from campaigns.oscillator import main

if __name__ == "__main__":
    sys.exit(main())
