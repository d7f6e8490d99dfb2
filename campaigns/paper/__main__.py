from campaigns.paper import main

raise SystemExit(main())
