"""`python -m campaigns.breaking_line`."""

from campaigns.breaking_line import main

raise SystemExit(main())
