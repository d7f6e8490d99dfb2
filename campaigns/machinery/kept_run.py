"""A finished run by its file, for rows that are made from two runs: it can be sent to where the file is not."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class KeptRun:
    """The run in a file. Pickled, it takes the content of the file along and leaves the path behind.

    path: of the file, None where only the content is known; content: b"" where the file is.
    """

    path: Path | None
    content: bytes = b""

    def load(self):
        """The Trajectory. Raises engine.trajectory.TrajectoryError where there is none."""
        from engine import Trajectory

        return Trajectory.load(self.path) if self.path is not None else Trajectory.from_bytes(self.content)

    def stamp(self) -> object:
        """Something that changes with the content; None where there is no such run."""
        if self.path is None:
            return self.content or None
        return self.path.stat().st_mtime_ns if self.path.exists() else None

    def __reduce__(self):
        try:
            content = self.content if self.path is None else self.path.read_bytes()
        except OSError:
            content = b""
        return KeptRun, (None, content)
