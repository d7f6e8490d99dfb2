"""`python -m campaigns.basins`."""

from campaigns.basins import main

raise SystemExit(main())
