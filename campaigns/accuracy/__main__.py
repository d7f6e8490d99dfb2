"""`python -m campaigns.accuracy`."""

from campaigns.accuracy import main, one_thread

one_thread()
raise SystemExit(main())
