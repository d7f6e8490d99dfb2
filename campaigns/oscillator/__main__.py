from campaigns.oscillator import main

raise SystemExit(main())
