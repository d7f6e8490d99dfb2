"""A run written is the run read; a file is there whole or not at all; a damaged file is refused."""

import errno
import json
import math
import os
from dataclasses import replace

import numpy as np
import pytest
import xarray

from engine import Trajectory
from engine.trajectory import COLUMNS, Profiles, TangentGrowth, TrajectoryError
from tests.engine.lines import assert_same, line


def run_of(samples: int, profiles: int | None = None, status: str = "ok", message: str = "") -> Trajectory:
    random = np.random.default_rng(samples)
    columns = {name: random.normal(size=samples) for name in COLUMNS}
    lines = None
    if profiles is not None:
        lines = Profiles(np.arange(profiles) * 0.5, np.linspace(0, 20, 5), *random.normal(size=(6, profiles, 5)))
    statistics = {"steps": 123456789012, "newton_iterations": np.int64(7), "min_strain": np.float64(-0.25)}
    return Trajectory(line({"title": "Bøje ✓"}), status, message, columns, statistics, lines)


@pytest.mark.parametrize("profiles", [None, 0, 1, 40])
@pytest.mark.parametrize("samples", [0, 1, 500])
def test_a_run_written_is_the_run_read_bit_for_bit(samples, profiles, tmp_path):
    """Also one that failed, with its reason."""
    failed = {"status": "turn-unresolved", "message": "a turn of 4.2 rad in one element — at t = 3 s"}
    run = run_of(samples, profiles, **(failed if samples == 1 else {}))
    if samples > 1:
        run.columns["tension_top_N"][3:6] = np.nan, np.inf, -0.0
    run.save(tmp_path / "run.nc")
    again = Trajectory.load(tmp_path / "run.nc")
    assert_same(run, again)
    assert type(again.statistics["steps"]) is int and type(again.statistics["min_strain"]) is float
    again.save(tmp_path / "again.nc")
    assert (tmp_path / "again.nc").read_bytes() == (tmp_path / "run.nc").read_bytes()
    for name in COLUMNS:
        assert again.columns[name].dtype == np.dtype("float64")


def test_the_table_has_the_agreed_columns():
    table = run_of(3).table()
    agreed = (
        "time_s x_m y_m z_m radius_m radius_rate_mps angle_rad angle_rate_radps offplane_m tension_top_N tension_min_N "
        "tension_top_low_N tension_top_high_N loop_releases line_lowest_m unresolved_N "
        "tension_anchor_N tension_max_N tension_max_s_m tension_anchor_high_N"
    )
    assert list(table.columns) == agreed.split()
    assert len(table) == 3 and len(run_of(0).table()) == 0


@pytest.mark.parametrize(("vectors", "across"), [(2, False), (0, True), (2, True)])
@pytest.mark.parametrize("periods", [0, 6])
def test_perturbations_are_read_as_they_were_written(periods, vectors, across, tmp_path):
    """Also without a complete period, and with one of many digits."""
    period_s, random = 5.0 + 1e-13 * math.pi, np.random.default_rng(periods)
    lateral = random.normal(size=periods) if across else None
    tangent = TangentGrowth(period_s, random.normal(size=(periods, vectors)), np.zeros(periods), lateral)
    requested = {"output.tangent_vectors": vectors, "output.lateral_growth": across, "waves.period_s": period_s}
    run = replace(run_of(5), scene=line(requested), tangent=tangent)
    run.save(tmp_path / "run.nc")
    assert_same(Trajectory.load(tmp_path / "run.nc"), run)
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy") as data:
        for name in {"growth_nats", "released", "lateral_nats"} & set(data):
            assert data[name].dims[0] == "period" and data[name].attrs["long_name"]


UNITS = {"m": "m", "s": "s", "N": "N", "rad": "rad", "mps": "m s-1", "radps": "rad s-1", "strain": "1"}


@pytest.mark.parametrize("samples", [0, 500])
def test_xarray_opens_it_with_units_and_names(samples, tmp_path):
    run = run_of(samples, profiles=4)
    run.save(tmp_path / "run.nc", {"git_commit": "abc"})
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy") as data:
        np.testing.assert_array_equal(data["radius_m"].values, run.columns["radius_m"])
        assert data["radius_m"].dims == ("time_s",)
        assert data["profile_strain"].dims == ("profile_time_s", "s_m")
        assert data["time_s"].dtype == np.dtype("float64")  # a number of seconds, not a date
        for name, variable in data.variables.items():
            assert variable.attrs["units"] and variable.attrs["long_name"], name
            ending = UNITS.get(name.rpartition("_")[2])
            assert ending in (None, variable.attrs["units"]), name
        assert data.attrs["status"] == "ok" and data.attrs["git_commit"] == "abc" and "✓" in data.attrs["title"]
        assert json.loads(data.attrs["statistics"])["steps"] == run.statistics["steps"]
        assert data.attrs["scene"] == run.scene.to_toml()


def test_an_attribute_may_not_replace_one_of_the_record(tmp_path):
    for name in ("status", "scene", "content_sha256", "variables"):
        with pytest.raises(ValueError, match=name):
            run_of(3).save(tmp_path / "run.nc", {name: "x"})
    assert not list(tmp_path.iterdir())


def test_what_is_truncated_or_no_trajectory_is_refused(tmp_path):
    run_of(50, profiles=3).save(tmp_path / "run.nc")
    whole = (tmp_path / "run.nc").read_bytes()
    ends = [*range(0, len(whole), 101), len(whole) - 8, len(whole) - 1]
    others = [b"CDF\x01", b"\x89HDF\r\n\x1a\n" + bytes(100), b"time_s,x_m\n0,0\n"]
    for content in (*(whole[:end] for end in ends), *others):
        (tmp_path / "cut.nc").write_bytes(content)
        with pytest.raises(TrajectoryError, match=r"cut\.nc"):
            Trajectory.load(tmp_path / "cut.nc")
    xarray.Dataset({"a": ("x", [1.0, 2.0])}).to_netcdf(tmp_path / "other.nc", engine="scipy")
    with pytest.raises(TrajectoryError, match="not a trajectory"):
        Trajectory.load(tmp_path / "other.nc")
    for path in (tmp_path / "none.nc", tmp_path):
        with pytest.raises(TrajectoryError, match="cannot be read"):
            Trajectory.load(path)


def test_a_changed_byte_never_gives_different_numbers(tmp_path):
    run = run_of(50, profiles=3)
    run.save(tmp_path / "run.nc")
    content = (tmp_path / "run.nc").read_bytes()
    refused = 0
    for position in range(0, len(content), 37):
        changed = bytearray(content)
        changed[position] ^= 0x55
        (tmp_path / "changed.nc").write_bytes(changed)
        try:
            again = Trajectory.load(tmp_path / "changed.nc")
        except TrajectoryError:
            refused += 1
        else:  # only the wording of a unit or a long name, which load does not read
            assert_same(run, again)
    assert refused > 100


@pytest.mark.parametrize("fault", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt()], ids=["full disk", "Ctrl-C"])
@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_a_failure_at_any_stage_leaves_the_old_file(call, fault, tmp_path, monkeypatch):
    old = run_of(10)
    old.save(tmp_path / "run.nc")

    def failing(*_):
        raise fault

    monkeypatch.setattr(os, call, failing)
    for name in ("run.nc", "new.nc"):
        with pytest.raises(type(fault)):
            run_of(20).save(tmp_path / name)
    monkeypatch.undo()
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]
    assert_same(old, Trajectory.load(tmp_path / "run.nc"))


def test_others_may_read_the_file_as_the_user_allows(tmp_path):
    mask = os.umask(0o022)
    try:
        run_of(3).save(tmp_path / "run.nc")
    finally:
        os.umask(mask)
    assert (tmp_path / "run.nc").stat().st_mode & 0o777 == 0o644
