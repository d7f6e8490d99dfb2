"""What may be asked of the campaign of the whole paper."""

from dataclasses import dataclass

from campaigns.machinery import cli

PARTS = ("breaking_line", "buoy", "sweep", "dependence", "out_of_plane", "oscillator")


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked."""

    parts: tuple[str, ...]
    quick: bool
    how: cli.Running
