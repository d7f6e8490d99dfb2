"""Machine code of kernels on disk, for the engine and the analysis alike: by which sources, where, and who may write.

Neither package knows the other; this one knows neither (`machine_code.store`). Both import it first, so that it also
turns away a Python that is too old, and a switch of Numba that leaves nothing to run.
"""

import os
import sys

if sys.version_info < (3, 11):  # noqa: UP036
    running = ".".join(map(str, sys.version_info[:3]))
    raise ImportError(
        f"the tether workbench needs Python 3.11 or newer, and this is {running} ({sys.executable}); "
        "make its environment with a newer one, for instance python3.12 -m venv .venv"
    )

if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
    print("NUMBA_DISABLE_JIT is ignored, because the kernels exist as machine code only", file=sys.stderr)
    os.environ["NUMBA_DISABLE_JIT"] = "0"  # for the workers too
    if "numba" in sys.modules:
        sys.modules["numba"].config.DISABLE_JIT = 0
