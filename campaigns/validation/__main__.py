"""`python -m campaigns.validation`."""

from campaigns.validation import main

raise SystemExit(main())
