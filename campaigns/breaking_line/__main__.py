from campaigns.breaking_line import main

raise SystemExit(main())
