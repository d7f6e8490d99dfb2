"""Why a folder cannot be reported on."""

from __future__ import annotations

from pathlib import Path


class FolderError(ValueError):
    """The folder cannot be reported on; `faults` lists every reason, str() shows them all."""

    def __init__(self, directory: Path, faults: list[str]):
        self.faults = tuple(faults)
        super().__init__("\n".join([f"no report can be made of {directory}:", *(f"  - {fault}" for fault in faults)]))
