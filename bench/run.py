"""Speed compared with TetGen, CGAL and Gmsh: programs take turns; reports medians, ratios, and whether targets are met.

    run.py --build build/release [--native build/native] [--corpus DIR] [--runs 5] [--part PART]... [--again PART]...

Parts, each described in its module: delaunay, surfaces, fig15, growth, recovery, mesh, flips, native, plane. Rows are
kept in <build>/bench/<part>.json (kept.py), and a part that is known for these programs and options is not measured
again, unless --again asks for it. --part restricts what is measured. docs/benchmarks.md is written from all known rows;
its text on parts that are not known for this program is kept, and marked as such.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Callable, NamedTuple

import delaunay
import fig15
import flips
import growth
import mesh
import native
import plane
import recovery
import surfaces
import targets
from field_targets import kept as field_targets
from kept import NotMeasured, Rows, digest
from process import run
from target import table

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import corpus  # noqa: E402  (finds the surfaces)


class Part(NamedTuple):
    title: str
    bench: Callable  # of options, a scratch folder and rows: lines of Markdown, and figures for the targets
    peers: tuple  # Debian packages that it runs


PARTS = {
    "delaunay": Part("Delaunay", delaunay.bench, ("tetgen", "libcgal-dev")),
    "surfaces": Part("Large surfaces", surfaces.bench, ("tetgen", "gmsh")),
    "fig15": Part("The paper's Fig. 15", fig15.bench, ("tetgen",)),
    "growth": Part("Growth", growth.bench, ()),
    "recovery": Part("Growth of recovery", recovery.bench, ()),
    "mesh": Part("`holdfast mesh --fill` against `tetgen -pY`", mesh.bench, ("tetgen",)),
    "flips": Part("Without flips", flips.bench, ()),
    "native": Part("Built for this machine", native.bench, ()),
    "plane": Part("The plane", plane.bench, ("libcgal-dev", "nodejs")),
}


def version_of(package):
    done = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True, check=False)
    return done.stdout or "?"


def machine():
    names = re.findall(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{names[0] if names else 'unknown processor'}, {os.cpu_count()} cores seen, {memory:.0f} GiB"


def key_of(name, options):
    """The programs that rows of a part depend on."""
    key = {"holdfast": digest(options.build / "holdfast"), **{package: version_of(package) for package in PARTS[name].peers}}
    if name == "native" and (options.native / "holdfast").exists():
        key["native"] = digest(options.native / "holdfast")
    return key


def rows_of(name, options, measuring):
    return Rows(options.build / "bench" / f"{name}.json", key_of(name, options), measuring, measuring and name in options.again)


def measure(name, options):
    with tempfile.TemporaryDirectory(prefix="holdfast-bench-") as folder:
        lines, _ = PARTS[name].bench(options, Path(folder), rows_of(name, options, measuring=True))
    print("\n".join([PARTS[name].title, *lines]), flush=True)


def known(options):
    """name -> lines and figures, None for a part that is not completely measured."""
    def part(name):
        try:
            return PARTS[name].bench(options, None, rows_of(name, options, measuring=False))
        except NotMeasured as row:
            return [f"Not measured yet ({row}): `make bench ARGS=\"--part {name}\"`."], None

    return {name: part(name) for name in PARTS}


EARLIER = "*Measured earlier, with another build than the one named above.*"


class Earlier:
    """The existing document: sections by title, and rows of the targets by their texts."""

    def __init__(self, path):
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        parts = re.split(r"^## (.*)\n", text, flags=re.M)
        self.sections = {title: body.strip().splitlines() for title, body in zip(parts[1::2], parts[2::2])}
        rows = [line for line in self.sections.get("Targets", []) if line.startswith("| ")]
        self.targets = {row[2:].split(" | ")[0]: row for row in rows}

    def section(self, title, lines, known):
        """`lines`, or the existing ones if they are not known."""
        before = self.sections.get(title)
        if known or not before or before[0].startswith("Not measured yet"):
            return lines
        return before if before[0] == EARLIER else [EARLIER, "", *before]

    def target(self, line):
        if "| not measured |" not in line:
            return line
        text = line[2:].split(" | ")[0]
        return next((row for told, row in self.targets.items() if told.startswith(text)), line)


def field_lines(options, earlier):
    """The targets that bench/field.py stored with its rows."""
    told = field_targets(options.build / "field_targets.json", digest(options.build / "holdfast"))
    lines = ["Meshes to compute with, beside Gmsh, TetGen and Netgen: [field.md](field.md), by `make field`.", "", *told]
    measured = not told[0].startswith("Not measured yet")
    return ["## Meshes with field points", "", *earlier.section("Meshes with field points", lines, measured), ""]


def document(options):
    version = run([options.build / "holdfast", "--version"]).output.strip()
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False)
    parts = known(options)
    earlier = Earlier(options.output)
    figures = {name: told for name, (_, told) in parts.items() if told}
    lines = ["# Benchmarks", "",
             f"Written by `make bench` on {time.strftime('%Y-%m-%d')}: {version} at {commit.stdout.strip()}, against Debian's TetGen "
             f"{version_of('tetgen')}, CGAL {version_of('libcgal-dev')} and Gmsh {version_of('gmsh')}; {machine()}. A portable x86-64 "
             "build but where it says native. The programs took turns; each found memory that the machine has at hand, but for the "
             "surfaces of the corpus (bench/process.py says why).", "",
             "## Targets", "", *map(earlier.target, table(targets.targets(figures))), "",
             (ROOT / "bench" / "missed.md").read_text(encoding="utf-8").strip(), ""]
    for name, (told, figure) in parts.items():
        title = PARTS[name].title
        lines += [f"## {title}", "", *earlier.section(title, told, figure is not None), ""]
    return "\n".join(lines + field_lines(options, earlier)).rstrip() + "\n"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--native", type=Path, default=ROOT / "build" / "native", help="folder of the build for this machine")
    parser.add_argument("--corpus", default=os.environ.get("HOLDFAST_CORPUS", ""))
    parser.add_argument("--part", choices=PARTS, action="append", help="measure only these (default: all)")
    parser.add_argument("--again", choices=PARTS, action="append", default=[], help="measure these anew")
    parser.add_argument("--runs", type=int, default=5, help="turns of every program")
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--long-timeout", type=float, default=600, help="of a turn of recovery's growth")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--triangles", type=int, nargs="+", default=[10_000, 100_000, 1_000_000], help="of generated surfaces")
    parser.add_argument("--growth", type=int, nargs="+", default=[1_600, 16_000, 160_000, 1_600_000], help="points")
    parser.add_argument("--many", type=int, default=10_000_000, help="points that are triangulated once")
    parser.add_argument("--plates", type=int, nargs="+", default=[12, 36, 115, 370], help="k, of k x k holes")
    parser.add_argument("--copies", type=int, nargs="+", default=[1, 2, 4, 6], help="k, of k x k x k housings")
    parser.add_argument("--fig13", type=int, nargs="+", default=[4, 8, 12, 16, 24], help="n of the paper's Fig. 13")
    parser.add_argument("--surfaces", type=int, default=200, help="about so many of the corpus beside TetGen")
    parser.add_argument("--real", type=int, default=150, help="about so many of the corpus without flips")
    parser.add_argument("--native-triangles", type=int, default=100_000)
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "benchmarks.md")
    options = parser.parse_args()
    options.build, options.native = options.build.resolve(), options.native.resolve()
    options.surfaces_in = corpus.locate(options.corpus, core_only=False)
    return options


def main():
    options = parse_arguments()
    for name in [n for n in PARTS if n in (options.part or PARTS) or n in options.again]:
        started = time.monotonic()
        measure(name, options)
        print(f"{name}: {time.monotonic() - started:.0f} s", flush=True)
    options.output.parent.mkdir(exist_ok=True)
    options.output.write_text(document(options), encoding="utf-8")
    print(f"written: {options.output}")


if __name__ == "__main__":
    main()
