"""`python -m campaigns.sweep`."""

from campaigns.sweep import main

raise SystemExit(main())
