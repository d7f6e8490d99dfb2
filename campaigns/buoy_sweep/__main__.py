"""`python -m campaigns.buoy_sweep`."""

from campaigns.buoy_sweep import main

raise SystemExit(main())
