"""Where machine code is kept: a folder for each state of the sources, and not too many of them."""

import os

from machine_code.store import folder_for, hash_of


def test_every_source_counts_by_name_and_content(tmp_path):
    found = {hash_of(tmp_path, ".py", ".toml")}
    for name, content in (("a.py", "x"), ("a.py", "y"), ("b.py", "y"), ("inner/c.toml", "")):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(content)
        found.add(hash_of(tmp_path, ".py", ".toml"))
    assert len(found) == 5
    (tmp_path / "notes.md").write_text("nothing of this compiles")
    assert hash_of(tmp_path, ".py", ".toml") in found


def test_the_latest_folders_of_a_name_stay(tmp_path, monkeypatch):
    monkeypatch.setenv("TETHER_CACHE_DIR", str(tmp_path))
    other = folder_for("other", "0", 2)
    for number in range(5):
        folder = folder_for("mine", str(number), 2)
        (folder / "inner").mkdir()
        (folder / "inner" / "code").touch()
        os.utime(folder, (number, number))
    assert {path.name for path in tmp_path.iterdir()} == {"mine-4", "mine-3", "mine-2", other.name}


def test_where_nothing_can_be_written_the_temporary_folder_is_taken(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("TETHER_CACHE_DIR", str(tmp_path / "file" / "below"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    assert folder_for("mine", "0", 1).is_relative_to(tmp_path / "temporary")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "file"))
    assert folder_for("mine", "0", 1) is None
