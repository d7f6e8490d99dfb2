"""`python -m campaigns.out_of_plane`."""

from campaigns.out_of_plane import main

raise SystemExit(main())
