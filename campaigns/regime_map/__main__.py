"""`python -m campaigns.regime_map`."""

from campaigns.regime_map import main

raise SystemExit(main())
