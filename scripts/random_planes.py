"""Triangulates N random planes by every method, in parallel processes, and checks the triangles.

    random_planes.py --program build/release/tests/random/random_planes [--count 100000] [--seed 1] [--jobs 2]

A block of seeds is one process. Every block that is done is one line of build/random/planes-<hash of the program>.jsonl, so that
an interrupted run goes on where it stopped. A block that crashes or takes too long is run again seed by seed, to find the one
that does it. Exit code: 0 if nothing failed, else 1.
"""
import argparse
import concurrent.futures
import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

from blocks import known_blocks

ROOT = Path(__file__).resolve().parent.parent
BLOCK = 200
SECONDS_A_PLANE = 5  # of a block, on the average: a hundred times what they take
SECONDS_OF_ONE = 300
COUNTED = re.compile(r"(\d+) (planes|runs solved|enclose nothing|spoilt ones named|failed|triangles|ears|joined|swaps|points added)")


def call(program, first, count, seconds):
    """What was counted, and lines that tell of failures."""
    command = [program, "--count", str(count), "--seed", str(first)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None, f"no end after {seconds} s"
    lines = done.stdout.splitlines()
    if done.returncode not in (0, 1) or not lines:
        return None, f"exit code {done.returncode} {done.stderr.strip()[-200:]}"
    return {what: int(number) for number, what in COUNTED.findall(lines[-1])}, lines[:-1]


def run_block(program, first, count):
    counts, lines = call(program, first, count, SECONDS_A_PLANE * count)
    if counts is not None:
        return {"first": first, "count": count, "counts": counts, "lines": lines}
    total, told = {}, []
    for seed in range(first, first + count):
        counts, lines = call(program, seed, 1, SECONDS_OF_ONE)
        if counts is None:
            counts, lines = {"planes": 1, "failed": 1}, [f"seed {seed}: {lines}"]
        told += lines
        for what, number in counts.items():
            total[what] = total.get(what, 0) + number
    return {"first": first, "count": count, "counts": total, "lines": told}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1, help="of the first; the others follow")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    digest = hashlib.sha256(options.program.read_bytes()).hexdigest()[:12]
    path = ROOT / "build" / "random" / f"planes-{digest}.jsonl"
    path.parent.mkdir(parents=True, exist_ok=True)
    known = known_blocks(path)
    end = options.seed + options.count
    blocks = [(first, min(BLOCK, end - first)) for first in range(options.seed, end, BLOCK)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, open(path, "a", encoding="utf-8") as file:
        missing = [block for block in blocks if block not in known]
        for record in pool.map(lambda block: run_block(options.program, *block), missing):
            known[record["first"], record["count"]] = record
            file.write(json.dumps(record) + "\n")
            file.flush()
            for line in record["lines"]:
                print(line, flush=True)
    total = {}
    for block in blocks:
        for what, number in known[block]["counts"].items():
            total[what] = total.get(what, 0) + number
    print(f"seeds {options.seed} to {end - 1}: " + ", ".join(f"{number:,} {what}" for what, number in total.items()))
    return 1 if total.get("failed") else 0


if __name__ == "__main__":
    sys.exit(main())
