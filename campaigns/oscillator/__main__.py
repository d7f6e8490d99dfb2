"""`python -m campaigns.oscillator`."""

from campaigns.oscillator import main

raise SystemExit(main())
