"""`python -m campaigns.accuracy`."""

import os

from campaigns.accuracy import main

# Linear algebra on one thread, as every other solver that is timed, before NumPy is imported: the matrices of scipy's
# solvers are small, and on a busy machine two threads were seen to take a hundred times longer.
for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")
raise SystemExit(main())
