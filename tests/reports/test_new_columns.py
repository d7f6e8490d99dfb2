"""A number that a campaign declares reaches its report, whatever its name; so does any key that a campaign varies."""

import shutil

import pytest

from campaigns.explore.rows import COLUMNS
from campaigns.out_of_plane.rows import COLUMNS as IN_SPACE
from engine import list_scenes, load_scene
from reports import content_of
from reports.basins.report import _motions
from reports.out_of_plane.report import _runs_tables
from reports.out_of_plane.runs import VARIED, Study
from reports.parts.content import Sheet, Table, flat
from reports.parts.folder import Folder, read_folder
from reports.parts.provenance import _flat, scene_table
from reports.regime_map.maps import read_atlas
from reports.regime_map.sheets import cell_sheets
from tables import PLANE, RUNS, SHEET, Column
from tests.campaigns.conftest import rows_of
from tests.reports.conftest import columns_of, of_kind, write
from tests.reports.test_regime_map import SYMBOLS, WORDS, folder_of

__all__ = ["folder_of"]  # a fixture
NEW = Column("snaps_per_period", "1/T", "snaps", "snaps in a wave period", 2)
ERROR = Column("snaps_per_period_error", "1/T", "± snaps", "standard error of the snaps", 2)


def shown(items) -> list[str]:
    """The entries below the head of the new column, in the tables of a report."""
    cells = []
    for table in of_kind(flat(items), Table):
        places = [place for place, head in enumerate(table.columns) if head.title == NEW.symbol]
        cells += [row[place] for place in places for row in table.rows]
    return cells


def one_row(columns) -> dict[str, object]:
    """A row with a number, or a word, in every column."""
    return {column.name: "word" if column.digits is None else 1.0 for column in columns}


def test_a_new_column_is_in_the_sheets_of_a_map(folder_of):
    place = folder_of()
    rows = [{**row, NEW.name: 0.75} for row in rows_of(place)]
    write(place, rows, columns_of(rows, WORDS, SYMBOLS))
    folder = read_folder(place)
    sheets = cell_sheets(folder, read_atlas(folder))
    assert [head for head, _ in sheets.heads].count(NEW.name.replace("_", " ")) == 1


def test_a_new_column_is_in_the_motions_of_basins_with_its_error(tmp_path):
    columns = {column.name: column for column in (*COLUMNS, NEW, ERROR)}
    row = one_row(COLUMNS) | {NEW.name: 0.75, ERROR.name: 0.25, "motion": "A"}
    part = Folder(tmp_path, {}, (row,), load_scene("tethered_buoy"), columns)
    assert shown(_motions(part, [row], part._replace(table=()))) == ["0.75\u00a0±\u00a00.25"]


def test_a_new_column_is_in_the_table_of_runs_out_of_the_plane():
    columns = {column.name: column for column in (*IN_SPACE, NEW)}
    row = one_row(IN_SPACE) | {NEW.name: 0.75}
    folder = Folder(None, {}, (row,), load_scene("tethered_buoy"), columns)
    assert shown(_runs_tables(Study(folder, (row,), dict.fromkeys(VARIED), 0))) == ["0.75"]


def test_a_column_is_printed_where_its_declaration_says(folder, tmp_path):
    """On the page RUNS in the table of runs, PLANE in that of loops and of space, and always on the sheet of a run."""
    place = tmp_path / "with_column"
    shutil.copytree(folder, place)
    for page, runs in ((RUNS, 8), (PLANE, 2), (SHEET, 0)):  # of the eight runs two release loops
        rows = [{**row, NEW.name: 0.25} for row in rows_of(place)]
        write(place, rows, (*COLUMNS, Column(NEW.name, NEW.unit, NEW.symbol, NEW.meaning, 2, page)))
        items = content_of(place)[0].items
        assert len(shown(items)) == runs
        assert all((NEW.symbol, "0.25 1/T") in sheet.facts for sheet in of_kind(items, Sheet))


@pytest.mark.parametrize("scene", list_scenes())
def test_whatever_is_varied_is_in_the_table_of_the_scene(scene):
    """Every key of every scene, an element of each list, and a word of a campaign that is no key."""
    loaded = load_scene(scene)
    for key, entry in _flat(loaded.as_dict()):
        if key in ("name", "title"):
            continue
        name = f"{key}[0]" if isinstance(entry, list) else key
        rows = {row[0]: row for row in scene_table(loaded, scene, {name: "0 and 4"}, "").rows}
        assert rows[f"`{name}`"][2] == "0 and 4"
        assert rows[f"`{name}`"][4] == rows[f"`{key}`"][4] == "varied by this campaign"
    assert scene_table(loaded, scene, {"kick": "two"}, "").rows == scene_table(loaded, scene, {}, "").rows


def test_an_element_of_a_table_in_a_list_is_a_key_too():
    sea = [{"period_s": 6.0, "amplitude_m": 0.3}, {"period_s": 5.0, "amplitude_m": 0.2}]
    scene = load_scene("tethered_buoy", {"waves.components": sea})
    name = "waves.components[0].amplitude_m"
    rows = {row[0]: row for row in scene_table(scene, "tethered_buoy", {name: "0 and 4"}, "").rows}
    assert rows[f"`{name}`"][2:4] == ("0 and 4", "m") and rows["`waves.components`"][2] == "2 entries"
