"""Compares two builds of holdfast: whether they make the same meshes, and how fast each is.

    beside.py OLD NEW --corpus DIR [--count N] [--speed M] [--most-bytes B] [--options "--fill"]

N surfaces of the folder of at most B bytes, evenly spread over its names, are meshed by both. A digest is that of the
vertices, tetrahedra and regions in the .meshb file, whatever else the file holds and whatever its version.
Then M of these surfaces that take NEW a tenth of a second or more are meshed five times by each, by turns; the figure
is the median of the ratios new : old of processor time, for each surface and for all together.
"""
import argparse
import hashlib
import os
import statistics
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

VERTICES, TETRAHEDRA, END = 4, 8, 54
RUNS = 5
SHORTEST = 0.1  # seconds; less is start-up and files


def digest(data):
    """Of the vertices and tetrahedra of a .meshb file."""
    (version,) = struct.unpack_from("<i", data, 4)
    place = "<iq" if version >= 3 else "<ii"
    found, at = hashlib.sha256(), 8
    while True:
        keyword, end = struct.unpack_from(place, data, at)
        if keyword == END:
            return found.hexdigest()[:16]
        if keyword in (VERTICES, TETRAHEDRA):
            found.update(data[at + struct.calcsize(place):end])
        at = end


def mesh(program, surface, out, options):
    """Exit code, digest and processor seconds."""
    child = subprocess.Popen([program, "mesh", surface, "-o", out, "--quiet", *options], stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    made = digest(out.read_bytes()) if out.exists() else ""
    out.unlink(missing_ok=True)
    return child.returncode, made, usage.ru_utime + usage.ru_stime


def spread(items, count):
    """At most `count` of them, each once."""
    count = min(count, len(items))
    return [items[i * len(items) // count] for i in range(count)]


def compare(args, surfaces, out):
    """The surfaces that are slow enough to be timed."""
    slow, different = [], []
    for surface in surfaces:
        old, new = (mesh(program, surface, out, args.options.split()) for program in (args.old, args.new))
        if old[:2] != new[:2]:
            different.append(surface)
            print(f"{surface.name}: {old[0]} {old[1]} and {new[0]} {new[1]}", flush=True)
        elif new[2] >= SHORTEST:
            slow.append(surface)
    print(f"{len(surfaces) - len(different)} of {len(surfaces)} have the same vertices, tetrahedra and regions",
          flush=True)
    return slow


def time(args, surfaces, out):
    all_ratios = []
    for surface in surfaces:
        ratios = []
        for _ in range(RUNS):
            old, new = (mesh(program, surface, out, args.options.split())[2] for program in (args.old, args.new))
            ratios.append(new / old)
        all_ratios.append(statistics.median(ratios))
        print(f"{surface.name}: {all_ratios[-1]:.3f} ({new:.2f} s)", flush=True)
    if all_ratios:
        print(f"median of {len(all_ratios)} surfaces: {statistics.median(all_ratios):.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=os.path.abspath)
    parser.add_argument("new", type=os.path.abspath)
    parser.add_argument("--corpus", type=Path, required=True)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--speed", type=int, default=20)
    parser.add_argument("--most-bytes", type=int, default=200_000)
    parser.add_argument("--options", default="--fill --time-limit 60")
    args = parser.parse_args()
    surfaces = spread(sorted(p for p in args.corpus.iterdir() if p.is_file() and p.stat().st_size <= args.most_bytes),
                      args.count)
    if not surfaces:
        sys.exit(f"no surfaces in {args.corpus}")
    with tempfile.TemporaryDirectory() as name:
        out = Path(name) / "out.meshb"
        slow = compare(args, surfaces, out)
        time(args, spread(slow, args.speed), out)


if __name__ == "__main__":
    main()
