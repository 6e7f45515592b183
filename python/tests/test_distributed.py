"""A surface in parts, on threads and on a Dask cluster whose worker dies."""

from __future__ import annotations

import os
import signal
from subprocess import run

import numpy as np
import pytest

import holdfast
import holdfast.distributed
from conftest import box
from holdfast._program import program


@pytest.fixture
def cube(tmp_path):
    points, triangles = box()
    path = tmp_path / "cube.off"
    path.write_text("OFF\n8 12 0\n" + "".join("%r %r %r\n" % tuple(map(float, p)) for p in points)
                    + "".join("3 %d %d %d\n" % tuple(t) for t in triangles))
    return path


def test_parts_are_meshed_and_joined(cube, tmp_path):
    seen = []
    division = holdfast.distributed.mesh(cube, tmp_path / "out.vtu", parts=3, size=0.15,
                                         progress=lambda row, done, all: seen.append((done, all)))
    assert seen == [(1, 3), (2, 3), (3, 3)]
    assert holdfast.distributed.check(division.folder)
    mesh = holdfast.read_volume(tmp_path / "out.vtu")
    assert holdfast.check(cube, mesh)
    assert abs(mesh.quality().volume.sum() - 1) < 1e-12


def test_goes_on_where_it_stopped_and_begins_anew_for_another_call(cube, tmp_path):
    division = holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=3, size=0.2)
    first, second = (division.volume(p) for p in division.parts[:2])
    before = second.stat().st_mtime_ns
    bits = first.read_bytes()
    first.unlink()
    holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=3, size=0.2)
    assert first.read_bytes() == bits
    assert second.stat().st_mtime_ns == before
    holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=2, size=0.2)
    assert len(holdfast.distributed.read(tmp_path / "d").parts) == 2
    assert holdfast.distributed.check(tmp_path / "d")


def test_volumes_of_an_earlier_split_are_made_anew(cube, tmp_path):
    """The program's `split` leaves them, unlike that of this module."""
    holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=2, size=0.3)
    run([program(), "split", cube, "--parts", "2", "--size", "0.2", "-o", tmp_path / "d"], check=True, capture_output=True)
    assert not holdfast.distributed.check(tmp_path / "d")
    assert [row["status"] for row in holdfast.distributed.mesh_parts(tmp_path / "d")] == ["done", "done"]
    assert holdfast.distributed.check(tmp_path / "d")
    assert [row["status"] for row in holdfast.distributed.mesh_parts(tmp_path / "d")] == ["skipped", "skipped"]


def test_a_surface_that_is_no_file_is_refused(tmp_path):
    for surface in box(), holdfast.delaunay(box()[0]), 5, None:
        with pytest.raises(TypeError, match="a path is expected"):
            holdfast.distributed.mesh(surface, folder=tmp_path / "d", parts=2)


def test_what_goes_wrong_is_told(cube, tmp_path):
    with pytest.raises(TypeError, match="no option gradation"):
        holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=2, gradation=0.2)
    with pytest.raises(ValueError, match="out.xyz: the format '.xyz' cannot be written"):
        holdfast.distributed.mesh(cube, tmp_path / "out.xyz", folder=tmp_path / "d", parts=2)
    assert not (tmp_path / "d").exists()
    with pytest.raises(holdfast.FileError):
        holdfast.distributed.split(tmp_path / "nothing.off", tmp_path / "d", parts=2)
    cube.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(holdfast.InvalidSurface):
        holdfast.distributed.split(cube, tmp_path / "d", parts=2)
    with pytest.raises(FileNotFoundError):
        holdfast.distributed.read(tmp_path / "e")


@pytest.mark.parametrize("text, message", [
    ("{", "line 1"), ("[]", "is not one of"), ('{"format": "holdfast division"}', '"parts" is missing or damaged'),
    ('{"format": "holdfast division", "parts": [{"surface": "part_1.poly"}]}', '"parts" is missing or damaged')])
def test_a_damaged_manifest_is_told(tmp_path, text, message):
    (tmp_path / "manifest.json").write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        holdfast.distributed.read(tmp_path)
    assert str(tmp_path / "manifest.json") in str(caught.value)
    with pytest.raises(holdfast.FileError):
        holdfast.distributed.check(tmp_path)


def test_a_split_that_fails_leaves_what_is_there(cube, tmp_path):
    division = holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=2, size=0.3)
    with pytest.raises(holdfast.FileError):
        holdfast.distributed.split(tmp_path / "nothing.off", tmp_path / "d", parts=2)
    assert holdfast.distributed.check(division.folder)


def test_workers_in_another_folder(cube, tmp_path, monkeypatch):
    import concurrent.futures

    monkeypatch.chdir(tmp_path)
    with concurrent.futures.ProcessPoolExecutor(2, initializer=os.chdir, initargs=("/",)) as pool:
        holdfast.distributed.mesh("cube.off", "out.vtu", parts=2, size=0.3, client=pool)
    assert holdfast.check(cube, "out.vtu")


def test_the_error_is_told_and_not_what_comes_before(cube, tmp_path):
    with pytest.raises(holdfast.HoldfastError, match="time limit of 1e-06 s"):
        holdfast.distributed.mesh(cube, folder=tmp_path / "d", parts=2, size=0.3, time_limit=1e-6)


def test_regions_in_arrays(cube, tmp_path):
    division = holdfast.distributed.split(cube, tmp_path / "d", parts=1, regions=np.array([[0.25, 0.5, 1e-3, 7.0, 0.3]]))
    assert division.parts[0]["regions"] == [7]


def test_dask_with_a_killed_worker(cube, tmp_path):
    distributed = pytest.importorskip("distributed")
    alone = holdfast.distributed.mesh(cube, folder=tmp_path / "alone", parts=4, size=0.1)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                  local_directory=str(tmp_path)) as cluster, distributed.Client(cluster) as client:
        victims = list(client.run(os.getpid).values())

        def kill_one(row, done, count):
            if done == 1:
                os.kill(victims[0], signal.SIGKILL)

        division = holdfast.distributed.mesh(cube, tmp_path / "out.vtu", folder=tmp_path / "dask", parts=4, size=0.1,
                                             client=client, progress=kill_one)
    assert holdfast.distributed.check(division.folder)
    for ours, theirs in zip(division.parts, alone.parts):
        assert division.volume(ours).read_bytes() == alone.volume(theirs).read_bytes()


def test_a_straggler_is_run_a_second_time(cube, tmp_path, monkeypatch):
    import concurrent.futures
    import threading
    import holdfast.distributed as d

    monkeypatch.setattr(d, "STRAGGLES_AFTER_SECONDS", 0.5)
    monkeypatch.setattr(d, "STRAGGLES_BEYOND", 0.0)
    division = d.split(cube, tmp_path / "d", parts=3, size=0.3)
    slow = str(division.volume(division.parts[1]))
    calls, release = [], threading.Event()
    real = d.run_part

    def sometimes_stuck(task):
        calls.append(task.output)
        if task.output == slow and calls.count(slow) == 1:
            release.wait(60)
        return real(task)

    monkeypatch.setattr(d, "run_part", sometimes_stuck)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        rows = d.mesh_parts(division, client=pool)
        release.set()
    assert [row["status"] for row in rows] == ["done"] * 3
    assert calls.count(slow) == 2
    assert d.check(division.folder)
