"""`python -m campaigns.orbits`."""

from campaigns.orbits import main

raise SystemExit(main())
