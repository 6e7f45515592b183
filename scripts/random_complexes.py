"""Meshes N random complexes in parallel processes, with and without flips, and checks every mesh.

    random_complexes.py --program build/release/tests/random/random_complexes [--count 100000] [--seed 1]

The complexes of a seed are numbered from 0; a block of them is one process. Every block that is done is one line of
build/random/<hash of the program>-<seed>.jsonl, so that an interrupted run goes on where it stopped. A block that
crashes or takes too long is run again complex by complex, to find the number that does it. The table goes to
standard output and to build/random/table.md. Exit code: 0 if every complex kept the promise, else 1.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from blocks import known_blocks

ROOT = Path(__file__).resolve().parent.parent
BLOCK = 250
SECONDS_A_COMPLEX = 4  # of a block, on the average: some hundred times what they take
SECONDS_OF_ONE = 400   # longer than all of its meshes may take by the program's own limit
COLUMNS = ["complexes", "valid", "meshes", "with_points", "not_in_doubles", "failed", "seconds"]


def call(options, first, count, seconds):
    """(how it ended: "ok" or why not, lines that tell something, counts by family)."""
    command = [options.program, "--seed", str(options.seed), "--first", str(first), "--count", str(count), "--json"]
    try:
        ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return f"no end after {seconds} s", [], {}
    lines = ended.stdout.decode(errors="replace").splitlines()
    if ended.returncode not in (0, 1) or not lines or not lines[-1].startswith("{"):
        what = signal.Signals(-ended.returncode).name if ended.returncode < 0 else f"exit code {ended.returncode}"
        return f"{what} {' '.join(lines[-3:])}", lines, {}
    return "ok", lines[:-1], json.loads(lines[-1])


def add(total, counts):
    for family, row in counts.items():
        mine = total.setdefault(family, dict.fromkeys(COLUMNS, 0))
        for column in COLUMNS:
            mine[column] += row[column]


def run_block(options, first, count):
    """The record of a block; one complex after the other where they do not end well together."""
    how, lines, counts = call(options, first, count, SECONDS_A_COMPLEX * count)
    if how == "ok":
        return {"first": first, "count": count, "lines": lines, "counts": counts}
    lines, counts = [], {}
    for number in range(first, first + count):
        how, some, row = call(options, number, 1, SECONDS_OF_ONE)
        add(counts, row)
        lines += some
        if how != "ok":
            lines.append(f"FAILED: --seed {options.seed} --first {number} --count 1: {how}")
            add(counts, {"(no end)": dict.fromkeys(COLUMNS, 0) | {"complexes": 1, "failed": 1}})
    return {"first": first, "count": count, "lines": lines, "counts": counts}


def run_all(options, results):
    known = known_blocks(results)
    blocks = [(first, min(BLOCK, options.count - first)) for first in range(0, options.count, BLOCK)]
    todo = [block for block in blocks if block not in known]
    print(f"seed {options.seed}: {options.count} complexes in {len(blocks)} blocks, {len(blocks) - len(todo)} done "
          f"before, {options.jobs} at a time", flush=True)
    started, lock, finished = time.monotonic(), threading.Lock(), [0]

    def work(block):
        record = run_block(options, *block)
        with lock, open(results, "a", encoding="utf-8") as file:
            known[block] = record
            finished[0] += 1
            file.write(json.dumps(record) + "\n")
            for line in record["lines"]:
                if line.startswith("FAILED"):
                    print(line, flush=True)
            if finished[0] % 20 == 0:
                print(f"[{time.monotonic() - started:.0f} s] {finished[0]} of {len(todo)} blocks", flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(work, todo))
    return [known[block] for block in blocks]


def table_of(total):
    rows = sorted(total.items()) + [("all", {c: sum(row[c] for row in total.values()) for c in COLUMNS})]
    lines = ["| family | " + " | ".join(c.replace("_", " ") for c in COLUMNS) + " |", "|---" * (len(COLUMNS) + 1) + "|"]
    for family, row in rows:
        lines.append(f"| {family} | " + " | ".join(f"{row[c]:.0f}" for c in COLUMNS) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes at a time")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "random", help="folder of the results")
    options = parser.parse_args()

    options.output.mkdir(parents=True, exist_ok=True)
    digest = hashlib.sha256(options.program.read_bytes()).hexdigest()[:12]
    with tempfile.TemporaryDirectory(prefix="holdfast-random-") as private:  # it may be rebuilt meanwhile
        options.program = shutil.copy2(options.program, private)
        records = run_all(options, options.output / f"{digest}-{options.seed}.jsonl")
    total = {}
    for record in records:
        add(total, record["counts"])
    told = sorted({line for record in records for line in record["lines"]})
    print(*told, sep="\n")
    table = table_of(total)
    (options.output / "table.md").write_text("\n".join(table) + "\n")
    print(*table, sep="\n")
    failed = sum(row["failed"] for row in total.values())
    print(f"{failed} of {options.count} random complexes of seed {options.seed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
