"""The report of `campaigns.regime_map`, and its first map alone while it fills."""

from pathlib import Path

__all__ = ["draw"]


def draw(folder: str | Path, path: str | Path) -> None:
    """Write the map of regimes as a PNG, from what is there of `cells/table.csv`; takes about a second.

    folder: of a campaign that may still run. path: of the PNG, replaced at once when it is whole.
    Where no cell can be read yet, nothing is written; OSError where the file cannot be.
    """
    from engine.atomic import write_atomic

    from ..figures.regime_map import regime_maps
    from ..parts.folder import Folder
    from .maps import legend, read_atlas, regimes

    atlas = read_atlas(Folder(Path(folder), {}, (), None, {}))
    if atlas is None:
        return
    maps = [regimes(page) for page in atlas.pages]
    across = min(2, len(maps))
    picture, _ = regime_maps(maps, atlas.labels, legend(atlas), atlas.marks, across, kind="png")
    write_atomic(Path(path), picture.data)
