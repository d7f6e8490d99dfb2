"""`python -m campaigns.stability`."""

from campaigns.stability import main

raise SystemExit(main())
