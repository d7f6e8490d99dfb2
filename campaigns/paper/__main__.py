"""`python -m campaigns.paper`."""

from campaigns.paper import main

raise SystemExit(main())
