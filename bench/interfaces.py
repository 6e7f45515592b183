#!/usr/bin/env python3
"""The effect on elements of meshing a surface in parts: the demo part whole and in parts.

    interfaces.py PROGRAM FOLDER [--size 1.2] [--parts 2 8 64] [--jobs 2] [--write docs/scaling.md]

Prints the tetrahedra by their least dihedral angle, in per cent, in bins of ten degrees.
"""
import argparse
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

from scale import replace_block  # noqa: E402


def histogram(report):
    """Of least dihedral angles, in bins of ten degrees: the report has five."""
    fine = json.loads(report.read_text())["field"]["after"]["least_dihedral_histogram"]
    return [sum(fine[k:k + 2]) for k in range(0, len(fine), 2)]


def mesh(program, surface, report, *options):
    subprocess.run([program, "mesh", surface, "-o", report.with_suffix(".vtu"), "--quiet", "--report", report, *options], check=True)
    return histogram(report)


def mesh_in_parts(program, surface, count, size, folder, jobs):
    subprocess.run([program, "split", surface, "--parts", str(count), "--size", repr(size), "-o", folder], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    parts = json.loads((folder / "manifest.json").read_text())["parts"]
    with ThreadPoolExecutor(jobs) as pool:
        of_parts = pool.map(lambda k: mesh(program, folder / parts[k]["surface"], folder / f"report-{k}.json"), range(len(parts)))
        return [sum(bins) for bins in zip(*of_parts)]


def table(rows):
    bins = [f"{10 * k}-{10 * k + 10}" for k in range(len(rows[0][1]))]
    lines = ["| parts | tetrahedra | " + " | ".join(bins) + " | most points from one part |", "|---" * (len(bins) + 3) + "|"]
    shares = [[100 * x / sum(counts) for x in counts] for _, counts in rows]
    for (parts, counts), own in zip(rows, shares):
        far = max(abs(x - y) for x, y in zip(own, shares[0]))
        lines.append(f"| {parts} | {sum(counts):,} | " + " | ".join(f"{x:.2f}" for x in own) + f" | {far:.2f} |")
    return "\n".join(lines) + "\n"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--size", type=float, default=1.2)
    options.add_argument("--parts", type=int, nargs="+", default=[2, 8, 64])
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--write", type=Path)
    arguments = options.parse_args()
    program, folder = arguments.program.resolve(), arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    surface = folder / "part.stl"
    subprocess.run([sys.executable, ROOT / "examples" / "make_part.py", surface], check=True, stdout=subprocess.DEVNULL)
    rows = [(1, mesh(program, surface, folder / "whole.json", "--size", repr(arguments.size)))]
    for count in arguments.parts:
        rows.append((count, mesh_in_parts(program, surface, count, arguments.size, folder / f"parts-{count}", arguments.jobs)))
    text = table(rows)
    print(text)
    if arguments.write:
        replace_block(arguments.write, "interfaces", text)


if __name__ == "__main__":
    sys.exit(main())
