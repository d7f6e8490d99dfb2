"""A number that a campaign declares reaches its report, whatever its name; so does any key that a campaign varies."""

import shutil

import pytest

from campaigns.basins.exploration import COLUMNS as of_basins
from campaigns.columns import Column
from campaigns.explore.rows import COLUMNS as of_sweeps
from campaigns.out_of_plane.rows import COLUMNS as of_space
from campaigns.regime_map.tables import motion_columns
from engine import list_scenes, load_scene
from reports import content_of
from reports.basins.report import _motions
from reports.out_of_plane.report import _PLACED
from reports.parts.content import Table
from reports.parts.folder import Folder, read_columns, read_folder
from reports.parts.provenance import scene_table
from reports.regime_map.maps import read_atlas
from reports.regime_map.sheets import cell_sheets
from reports.sweep.quantities import further
from tests.reports.conftest import rows_in, write
from tests.reports.test_regime_map import columns_of, folder_of

__all__ = ["folder_of"]  # a fixture
NEW = Column("snaps_per_period", "1/T", "snaps", "snaps in a wave period", 2)
ERROR = Column("snaps_per_period_error", "1/T", "± snaps", "standard error of the snaps", 2)
CAMPAIGNS = {
    "buoy_sweep": (of_sweeps, ()),
    "out_of_plane": (of_space, _PLACED),
    "regime_map": (motion_columns(()), ()),
    "basins": (tuple(column for column in of_basins if not column.name.startswith(("kick", "displ", "phase"))), ()),
}


def dictionary(columns):
    return {column.name: column for column in columns}


def shown(items) -> list[str]:
    """The entries below the head of the new column, in the tables of a report."""
    found = []
    for table in (item for item in items if isinstance(item, Table)):
        places = [place for place, head in enumerate(table.columns) if head.title == NEW.symbol]
        found += [row[place] for place in places for row in table.rows]
    return found


@pytest.mark.parametrize("campaign", CAMPAIGNS)
def test_every_column_has_a_place_and_a_new_one_gets_its_own_with_its_error(campaign):
    columns, placed = CAMPAIGNS[campaign]
    assert further(dictionary(columns), placed) == ()
    assert further(dictionary((*columns, NEW, ERROR)), placed) == ((NEW.name, ERROR.name),)
    assert further(dictionary((NEW, *columns)), placed) == ((NEW.name, ""),)


def test_a_new_column_is_in_the_table_of_runs_of_a_buoy_sweep(folder, tmp_path):
    place = tmp_path / "with_column"
    shutil.copytree(folder, place)
    rows = rows_in(place)
    for number, row in enumerate(rows):
        row[NEW.name] = 0.25 + number
    write(place, rows, (*of_sweeps, NEW))
    assert shown(content_of(place)[0].items) == [f"{0.25 + number:.2f}" for number in range(len(rows))]


def test_a_new_column_is_in_the_sheets_of_a_map(folder_of):
    place = folder_of()
    rows = [{**row, NEW.name: 0.75} for row in rows_in(place)]
    write(place, rows, columns_of(rows))
    folder = read_folder(place)
    sheets = cell_sheets(folder, read_atlas(folder))
    assert [head for head, _ in sheets.heads].count(NEW.name.replace("_", " ")) == 1


def test_a_new_column_is_in_the_table_of_motions_of_basins(tmp_path):
    row = {column.name: "" if column.digits is None else 1.0 for column in of_sweeps} | {NEW.name: 0.75, "motion": "A"}
    write(tmp_path, [row], (*of_sweeps, NEW))
    part = Folder(tmp_path, {}, (row,), load_scene("tethered_buoy"), read_columns(tmp_path))
    assert shown(_motions(part, [row], None)) == ["0.75"]


def leaves(section, prefix=""):
    """(dotted key, entry) of a scene's dictionary."""
    for key, entry in section.items():
        yield from leaves(entry, f"{prefix}{key}.") if isinstance(entry, dict) else [(prefix + key, entry)]


@pytest.mark.parametrize("scene", list_scenes())
def test_whatever_is_varied_is_in_the_table_of_the_scene(scene):
    """Every key of every scene, an element of each list, and a word of a campaign that is no key."""
    loaded = load_scene(scene)
    for key, entry in leaves(loaded.as_dict()):
        name = f"{key}[0]" if isinstance(entry, list) else key
        if key in ("name", "title"):
            continue
        rows = {row[0]: row for row in scene_table(loaded, scene, {name: "0 and 4"}, "").rows}
        assert rows[f"`{name}`"][2] == "0 and 4" and rows[f"`{name}`"][4] == "varied by this campaign"
        assert rows[f"`{key}`"][4] == "varied by this campaign"
    assert scene_table(loaded, scene, {"kick": "two"}, "").rows == scene_table(loaded, scene, {}, "").rows


def test_an_element_of_a_table_in_a_list_is_a_key_too():
    sea = [{"period_s": 6.0, "amplitude_m": 0.3}, {"period_s": 5.0, "amplitude_m": 0.2}]
    scene = load_scene("tethered_buoy", {"waves.components": sea})
    name = "waves.components[0].amplitude_m"
    rows = {row[0]: row for row in scene_table(scene, "tethered_buoy", {name: "0 and 4"}, "").rows}
    assert rows[f"`{name}`"][2:4] == ("0 and 4", "m") and rows["`waves.components`"][2] == "2 entries"
