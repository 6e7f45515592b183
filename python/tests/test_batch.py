"""batch: the function and the command."""

from __future__ import annotations

import concurrent.futures
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import holdfast
from conftest import box, sphere, write_off
from holdfast import _batch


@pytest.fixture
def parts(tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()
    files = [write_off(folder / f"part{i}.off", *sphere(8 + i)) for i in range(4)]
    points, triangles = box()
    files.append(write_off(folder / "open.off", points, triangles[1:]))
    (folder / "bad.off").write_text("OFF\n1 2\n")
    return [*files, folder / "bad.off"]


def command(*arguments, **options):
    return subprocess.run([sys.executable, "-m", "holdfast", "batch", *map(str, arguments)], capture_output=True, text=True,
                          timeout=120, **options)


def rows_of(path):
    return [json.loads(line) for line in Path(path).read_text().splitlines()]


def test_statuses_and_table(parts, tmp_path):
    out = tmp_path / "out"
    run = command(*parts, tmp_path / "none.off", "-o", out, "--jobs", 2, "--results", tmp_path / "r.jsonl")
    assert run.returncode == 1, run.stderr
    rows = {Path(r["file"]).stem: r for r in rows_of(tmp_path / "r.jsonl")}
    assert {k: r["status"] for k, r in rows.items()} == {
        "part0": "done", "part1": "done", "part2": "done", "part3": "done", "open": "invalid", "bad": "failed", "none": "failed"}
    assert rows["open"]["exit"] == 4 and rows["bad"]["exit"] == 3
    assert rows["part0"]["tetrahedra"] > 0 and rows["part0"]["min_dihedral_deg"] > 0 and rows["part0"]["seconds"] > 0
    assert "line 2" in rows["bad"]["message"]
    assert run.stdout.splitlines()[-1] == "7 parts: 4 done, 1 invalid, 2 failed"
    assert sorted(p.name for p in out.iterdir()) == sorted(f"part{i}{end}.vtu" for i in range(4) for end in ("", "_surface"))
    assert holdfast.check(parts[0], out / "part0.vtu").holds


def test_equal_to_the_program(parts, tmp_path):
    rows = holdfast.batch(parts[:3], tmp_path / "a", jobs=2)
    assert [r["status"] for r in rows] == ["done"] * 3
    for part in parts[:3]:
        alone = tmp_path / (part.stem + ".vtu")
        subprocess.run([_batch.program(), "mesh", part, "-o", alone, "-q"], check=True)
        assert alone.read_bytes() == (tmp_path / "a" / (part.stem + ".vtu")).read_bytes()


def test_resume_does_what_is_missing(parts, tmp_path):
    good = parts[:4]
    out = tmp_path / "out"
    assert command(*good[:2], "-o", out).returncode == 0
    before = {p.name: p.stat().st_mtime_ns for p in out.glob("*.vtu")}
    with open(out / "results.jsonl", "a") as lines:
        lines.write('{"file": "killed while wri')
    run = command(*good, "-o", out, "--resume")
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines()[-1] == "4 parts: 2 done, 2 skipped"
    assert all((out / n).stat().st_mtime_ns == t for n, t in before.items())
    rows = rows_of(out / "results.jsonl")
    assert sorted(Path(r["file"]).stem for r in rows) == [f"part{i}" for i in range(4)]
    assert all(r["status"] == "done" for r in rows), "what an earlier run did stays done"


def test_resume_does_again_what_has_other_options_now(parts, tmp_path):
    out = tmp_path / "out"
    assert command(*parts[:2], "-o", out, "--", "--fill").returncode == 0
    filled = {p.name: p.read_bytes() for p in out.glob("part?.vtu")}
    assert all(r["options"] == ["--fill"] for r in rows_of(out / "results.jsonl"))
    same = command(*parts[:2], "-o", out, "--resume", "--time-limit", 100, "--", "--fill", "--threads", 2, "-q")
    assert same.stdout.splitlines()[-1] == "2 parts: 0 done, 2 skipped"
    other = command(*parts[:2], "-o", out, "--resume", "--", "--size=0.3")
    assert other.stdout.splitlines()[-1] == "2 parts: 2 done"
    assert all((out / name).read_bytes() != bytes_ for name, bytes_ in filled.items())
    assert all(r["options"] == ["--size", "0.3"] for r in rows_of(out / "results.jsonl"))
    assert command(*parts[:2], "-o", out, "--resume", "--", "--size", "0.3").stdout.splitlines()[-1].endswith("2 skipped")


def test_resume_does_again_what_is_of_another_surface(parts, tmp_path):
    out = tmp_path / "out"
    assert command(*parts[:2], "-o", out).returncode == 0
    write_off(parts[0], *box())
    assert command(*parts[:2], "-o", out, "--resume").stdout.splitlines()[-1] == "2 parts: 1 done, 1 skipped"


def test_resume_does_again_what_failed_with_the_options_since(parts, tmp_path):
    """The file there is of the options before."""
    out = tmp_path / "out"
    assert command(parts[0], "-o", out, "--", "--fill").returncode == 0
    assert command(parts[0], "-o", out, "--resume", "--time-limit", "1e-9").returncode == 1
    assert command(parts[0], "-o", out, "--resume").stdout.splitlines()[-1] == "1 part: 1 done"


def test_the_latest_row_counts_whichever_file_it_is_in(parts, tmp_path):
    out = tmp_path / "out"
    for i in range(2):
        assert command(*parts[:4], "-o", out, "--shard", f"{i}/2", "--", "--fill").returncode == 0
    assert command(*parts[:4], "-o", out, "--resume").stdout.splitlines()[-1] == "4 parts: 4 done"
    for i in range(2):
        assert command(*parts[:4], "-o", out, "--resume", "--shard", f"{i}/2").stdout.splitlines()[-1] == "2 parts: 0 done, 2 skipped"
    assert command(*parts[:4], "-o", out, "--resume").stdout.splitlines()[-1] == "4 parts: 0 done, 4 skipped"
    assert all(r["options"] == [] and r["status"] == "done" for r in rows_of(out / "results.jsonl"))


def test_resume_of_results_without_options(parts, tmp_path):
    out = tmp_path / "out"
    assert command(parts[0], "-o", out).returncode == 0
    rows = [{k: v for k, v in r.items() if k not in ("options", "checksum")} for r in rows_of(out / "results.jsonl")]
    (out / "results.jsonl").write_text("".join(json.dumps(r) + "\n" for r in rows))
    assert command(parts[0], "-o", out, "--resume", "--", "--fill").stdout.splitlines()[-1] == "1 part: 1 done"
    assert command(parts[0], "-o", out, "--resume", "--", "--fill").stdout.splitlines()[-1].endswith("1 skipped")


def test_equal_stems(parts, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    twin = write_off(other / "part0.off", *box())
    run = command(parts[0], twin, "-o", tmp_path / "out")
    assert run.returncode == 2 and str(parts[0]) in run.stderr and str(twin) in run.stderr
    assert not (tmp_path / "out").exists()
    with pytest.raises(ValueError, match="part0"):
        holdfast.batch([parts[0], twin], tmp_path / "out")


def test_shards_are_merged(parts, tmp_path):
    good = parts[:4]
    out, results = tmp_path / "out", tmp_path / "r.jsonl"
    for i in range(3):
        assert command(*good, "-o", out, "--results", results, "--shard", f"{i}/3").returncode == 0
    assert len(list(tmp_path.glob("r.*-of-3.jsonl"))) == 3
    assert sorted(Path(r["file"]).stem for r in rows_of(results)) == [f"part{i}" for i in range(4)]
    results.unlink()
    run = command(*good, "-o", out, "--results", results, "--resume")
    assert run.returncode == 0 and "4 skipped" in run.stdout
    assert [r["status"] for r in rows_of(results)] == ["done"] * 4
    assert command(*good, "-o", out, "--shard", "3/3").returncode == 2
    assert command(*good, "-o", out, "--shard", "x").returncode == 2


def test_shards_of_slurm(parts, tmp_path):
    env = {"SLURM_ARRAY_TASK_ID": "12", "SLURM_ARRAY_TASK_MIN": "10", "SLURM_ARRAY_TASK_COUNT": "3"}
    assert _batch.shard_of_slurm(env) == (2, 3)
    assert _batch.shard_of_slurm({"SLURM_ARRAY_TASK_ID": "1", "SLURM_ARRAY_TASK_COUNT": "4"}) == (1, 4)
    assert _batch.shard_of_slurm({}) is None
    done = set()
    for task in (10, 11, 12):
        run = command(*parts[:4], "-o", tmp_path / "out", env={**os.environ, **env, "SLURM_ARRAY_TASK_ID": str(task)})
        assert run.returncode == 0, run.stderr
        done.add(run.stdout.splitlines()[-1])
    assert done == {"2 parts: 2 done", "1 part: 1 done"}
    assert len(rows_of(tmp_path / "out" / "results.jsonl")) == 4


def test_limits_cost_one_part(parts, tmp_path):
    large = write_off(tmp_path / "large.off", *sphere(150))
    run = command(large, parts[0], "-o", tmp_path / "out", "--time-limit", 2, "--", "--size", 0.01)
    rows = {Path(r["file"]).stem: r["status"] for r in rows_of(tmp_path / "out" / "results.jsonl")}
    assert run.returncode == 1 and rows["large"] == "limit"
    assert not (tmp_path / "out" / "large.vtu").exists()


def test_a_killed_part_is_one_line(parts, tmp_path, monkeypatch):
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\nkill -9 $$\n")
    program.chmod(0o755)
    monkeypatch.setenv("HOLDFAST_PROGRAM", str(program))
    (row,) = holdfast.batch(parts[:1], tmp_path / "out")
    assert row["status"] == "failed" and row["exit"] == -9 and "SIGKILL" in row["message"]


def test_options_go_through(parts, tmp_path):
    (row,) = holdfast.batch(parts[:1], tmp_path / "out", fill=True, format=".mesh", seed=3, regions=[(0, 0, 0, 9)])
    assert row["output"].endswith("part0.mesh")
    assert set(holdfast.read_volume(row["output"]).regions) == {9}
    with pytest.raises(TypeError):
        holdfast.batch(parts[:1], tmp_path / "out", nonsense=1)
    with pytest.raises(TypeError):
        holdfast.batch(parts[:1], tmp_path / "out", size=np.ones(3))


def test_options_of_mesh_in_a_batch(parts, tmp_path):
    options = {"max_volume": {None: 0.1, 1: 0.02}, "max_ratio": 2, "layers": 2, "repair": 1e-9, "fill_holes": 4, "union": True, "order": "halving",
               "without": "flips"}
    (row,) = holdfast.batch(parts[:1], tmp_path / "out", **options)
    assert row["status"] == "done", row["message"]
    mesh = holdfast.read_volume(row["output"])
    assert mesh.quality().volume.max() <= 0.02
    same = holdfast.mesh(parts[0], **options)
    assert np.array_equal(mesh.points, same.points) and np.array_equal(mesh.tetrahedra, same.tetrahedra)
    (row,) = holdfast.batch(parts[:1], tmp_path / "out", repair=True, fill_holes=True)
    assert row["status"] == "done", row["message"]


@pytest.mark.parametrize("given", [["--format", "msh"], ["--format=msh"], ["-o", "x.vtu"], ["-ox.vtu"], ["--output=x.vtu"], ["--report", "r.json"],
                                   ["--html", "a.html"], ["--repair", "--repaired", "a.off"], ["--exact=e.jsonl"]])
def test_files_of_one_run_are_refused(parts, tmp_path, given):
    run = command(*parts[:2], "-o", tmp_path / "out", "--", *given)
    assert run.returncode == 2 and "after -- names one file" in run.stderr
    assert not (tmp_path / "out").exists()


def test_node_files_go_together(parts, tmp_path):
    out = tmp_path / "out"
    assert command(parts[0], "-o", out, "--format", "node").returncode == 0
    assert "1 skipped" in command(parts[0], "-o", out, "--format", "node", "--resume").stdout
    (out / "part0.ele").unlink()
    assert "1 done" in command(parts[0], "-o", out, "--format", "node", "--resume").stdout


def test_executor(parts, tmp_path):
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        rows = holdfast.batch(parts, tmp_path / "out", executor=pool)
    assert [r["status"] for r in rows] == ["done"] * 4 + ["invalid", "failed"]


def test_interrupted_batch_leaves_no_children(tmp_path):
    large = [write_off(tmp_path / f"large{i}.off", *sphere(150)) for i in range(2)]
    child = subprocess.Popen([sys.executable, "-m", "holdfast", "batch", *map(str, large), "-o", str(tmp_path / "out"),
                              "--jobs", "2", "--", "--size", "0.005"], stderr=subprocess.PIPE, text=True)
    time.sleep(2)
    child.send_signal(signal.SIGTERM)
    assert child.wait(20) == 5
    time.sleep(0.2)
    names = [p.read_bytes() for p in Path("/proc").glob("[0-9]*/cmdline") if p.exists()]
    assert not any(str(tmp_path).encode() in n and b"mesh" in n for n in names)
    assert not list((tmp_path / "out").glob("*.vtu"))


def test_dask_with_a_killed_worker(tmp_path):
    distributed = pytest.importorskip("distributed")
    files = [write_off(tmp_path / f"part{i}.off", *sphere(40 + i)) for i in range(8)]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
                                  local_directory=str(tmp_path)) as cluster, distributed.Client(cluster) as client:
        victims = list(client.run(os.getpid).values())
        killed = []

        def kill_one(row, finished, count):
            if not killed:
                killed.append(victims[0])
                os.kill(victims[0], signal.SIGKILL)

        rows = holdfast.batch(files, tmp_path / "out", executor=client, progress=kill_one, size=0.05)
    assert killed and [r["status"] for r in rows] == ["done"] * 8, rows
    assert len(rows_of(tmp_path / "out" / "results.jsonl")) == 8
    assert len([p for p in (tmp_path / "out").glob("*.vtu") if not p.stem.endswith("_surface")]) == 8


def test_help_and_version():
    run = subprocess.run([sys.executable, "-m", "holdfast", "--version"], capture_output=True, text=True)
    assert run.stdout.strip() == f"holdfast {holdfast.__version__}"
    assert "--shard" in command("--help").stdout
    assert command().returncode == 2
