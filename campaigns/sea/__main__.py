"""`python -m campaigns.sea`."""

from campaigns.sea import main

raise SystemExit(main())
