"""The machine as a table of times has to name it: processor, cores."""

import os
import platform
from pathlib import Path


def machine() -> dict[str, object]:
    """{"processor", "cores"}: model name, cores that this process may use."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {"processor": _model() or platform.processor() or platform.machine(), "cores": cores}


def _model() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return ""
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), "")
