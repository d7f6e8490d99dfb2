"""`python -m campaigns.time_series FILE.csv --column NAME`, the same as `python -m analysis`."""

from campaigns.time_series import main

raise SystemExit(main())
