"""Surfaces of a folder through `batch`, and each of them by `holdfast.mesh` in a process of this script's: the same
bytes, the same errors.

    corpus.py FOLDER [--count 500] [--jobs N] [--fill]

Every COUNT-th part of the folder's surfaces, evenly. Exit code: 1 if any differs.
"""
from __future__ import annotations

import argparse
import concurrent.futures
import sys
import tempfile
from collections import Counter
from pathlib import Path

import holdfast

ENDINGS = {".stl", ".off", ".obj", ".ply", ".mesh", ".meshb", ".poly", ".smesh", ".vtp"}
TIME_LIMIT = 120.0


def mesh_here(path: str, output: str, fill: bool) -> str:
    """How `holdfast.mesh` ends, as `batch` calls it; its mesh is written."""
    try:
        holdfast.mesh(path, fill=fill, time_limit=TIME_LIMIT).save(output)
    except holdfast.InvalidSurface:
        return "invalid"
    except (holdfast.TimeLimit, holdfast.MemoryLimit):
        return "limit"
    except (holdfast.HoldfastError, ValueError):
        return "failed"
    return "done"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--fill", action="store_true")
    given = parser.parse_args()
    by_stem = {p.stem: p for p in sorted(given.folder.rglob("*")) if p.suffix.lower() in ENDINGS}
    files = list(by_stem.values())
    files = [files[i * len(files) // given.count] for i in range(given.count)] if given.count < len(files) else files
    differing = 0
    with tempfile.TemporaryDirectory() as folder:
        rows = holdfast.batch(files, Path(folder) / "batch", jobs=given.jobs, time_limit=TIME_LIMIT, fill=given.fill)
        with concurrent.futures.ProcessPoolExecutor(given.jobs) as pool:
            here = [Path(folder) / f"{Path(r['file']).stem}.vtu" for r in rows]
            ends = list(pool.map(mesh_here, [r["file"] for r in rows], map(str, here), [given.fill] * len(rows)))
        for row, path, end in zip(rows, here, ends):
            same = row["status"] == end and (end != "done" or path.read_bytes() == Path(row["output"]).read_bytes())
            if not same and "limit" not in (row["status"], end):
                differing += 1
                print(f"{row['file']}: {row['status']} by batch ({row['message']}), {end} here")
    print(f"{len(rows)} surfaces: {dict(Counter(ends))}; {differing} differ")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
