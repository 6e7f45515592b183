"""Speed against TetGen, CGAL and Gmsh, measured in one go: programs take turns, medians and ratios are told.

    run.py --build build/release [--corpus DIR] [--runs 5] [--surfaces 200] [--part delaunay|surfaces|growth|mesh]

Delaunay: 1 million uniformly random points, the vertices of a rippled torus, and of the largest surface of the
corpus; seconds that each program takes for the triangulation alone (spatial sort included), one thread and two.
Surfaces: generated ones, against TetGen and Gmsh (surfaces.py). Growth: growth.py.
Mesh: surfaces of the corpus, evenly over all sizes, `holdfast mesh --fill` against `tetgen -pY`; seconds of the
whole process with reading and writing. Writes docs/benchmarks.md.
"""
import argparse
import json
import multiprocessing
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import corpus  # noqa: E402  (finds the surfaces)
from growth import bench_delaunay_growth, bench_fig13  # noqa: E402
from process import run  # noqa: E402
from surfaces import bench_surfaces, torus  # noqa: E402


MEMORY = 2 << 30  # bytes that a program finds ready, see process.ready_memory; also in ready_memory.h

# ------------------------------------------------------------------------------------------------- Delaunay


def write_node(path, points):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(points)} 3 0 0\n")
        file.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))


def random_points(count):
    generator = random.Random(1)
    return [(generator.random(), generator.random(), generator.random()) for _ in range(count)]


def largest_surface(folder):
    return max((p for p in folder.rglob("*.off") if p.parent.name != "invalid"), key=lambda p: p.stat().st_size)


def vertices_of(path):
    """Distinct vertices of an OFF file."""
    words = path.read_text(encoding="ascii", errors="replace").split("\n", 2)
    count = int(words[1].split()[0])
    rows = words[2].split("\n", count)[:count]
    return list(dict.fromkeys(tuple(float(x) for x in row.split()[:3]) for row in rows))


def delaunay_tools(build, folder):
    """name -> function of a .node file: (seconds, tetrahedra, peak bytes)."""
    def holdfast(node, threads=1):
        report = folder / "report.json"
        code, text, _, peak = run([build / "holdfast", "delaunay", node, "-o", folder / "out.vtu", "-q", "--report", report,
                                   "--threads", threads], memory=MEMORY)
        if code != 0:
            sys.exit(f"holdfast delaunay ended with {code}: {text}")
        told = json.loads(report.read_text())
        return told["seconds"]["delaunay"], told["mesh"]["tetrahedra"], peak

    def cgal(node, threads=1):
        _, text, _, peak = run([build / "cgal_delaunay", node, threads])
        found = re.search(r"seconds (\S+) tetrahedra (\d+)", text)
        return float(found[1]), int(found[2]), peak

    def tetgen(node):
        _, text, _, peak = run([build / "tetgen_delaunay", node])
        return (float(re.search(r"Delaunay seconds:\s+(\S+)", text)[1]),
                int(re.search(r"Mesh tetrahedra:\s+(\d+)", text)[1]), peak)

    return {"holdfast": holdfast, "CGAL": cgal, "TetGen": tetgen,
            "holdfast, 2 threads": lambda node: holdfast(node, 2), "CGAL with TBB, 2 threads": lambda node: cgal(node, 2)}


def write_apart(node, make):
    """In a process of its own: a child's peak memory, as the system counts it, is not below its parent's."""
    writer = multiprocessing.Process(target=lambda: write_node(node, make()))
    writer.start()
    writer.join()


def bench_delaunay(options, folder, surfaces):
    node = folder / "points.node"
    sets = [(f"{options.points} random points in a cube", lambda: random_points(options.points)),
            ("500000 points of a rippled torus", lambda: torus(1000, 500)[0])]
    if surfaces:
        path = largest_surface(surfaces)
        sets.append((f"vertices of {path.stem} (corpus)", lambda: vertices_of(path)))
    lines = ["| points | program | seconds (median) | points/s | tetrahedra | bytes a tetrahedron, whole process "
             "| time against holdfast |", "|---|---|---|---|---|---|---|"]
    for title, make in sets:
        write_apart(node, make)
        with open(node, encoding="ascii") as file:
            count = int(file.readline().split()[0])
        tools = delaunay_tools(options.build, folder)
        results = {name: [] for name in tools}
        for _ in range(options.runs):
            for name, tool in tools.items():
                results[name].append(tool(node))
        base = median(r[0] for r in results["holdfast"])
        for name, rows in results.items():
            seconds = median(r[0] for r in rows)
            lines.append(f"| {title}  | {name} | {seconds:.3f} | {count / seconds:,.0f} | {rows[0][1]} "
                         f"| {rows[0][2] / rows[0][1]:.0f} | {seconds / base:.2f} |")
            print(lines[-1], flush=True)
    return lines


# ----------------------------------------------------------------------------------------------------- mesh


def bench_mesh(options, folder, surfaces):
    paths = sorted((surfaces / "valid").glob("*.off"), key=lambda p: (p.stat().st_size, p.name))
    paths = paths[:: max(1, len(paths) // options.surfaces)]
    manifest = corpus.manifest_of(surfaces)
    ratios, failed, rows = [], {"holdfast": [], "TetGen": []}, []
    for path in paths:
        if corpus.describe(path, manifest.get(path.stem))[1] != "closed":
            continue
        local = folder / "surface.off"
        local.write_bytes(path.read_bytes())
        times = {"holdfast": [], "TetGen": []}
        for _ in range(options.mesh_runs):
            # No memory is readied: few need more than some MB, and touching it empties the processor's caches.
            # Both find no old files of theirs: to replace four takes half a millisecond.
            for old in folder.glob("out.*"):
                old.unlink()
            code, _, seconds, _ = run([options.build / "holdfast", "mesh", local, "-o", folder / "out.node", "--fill", "-q"],
                                      options.timeout)
            times["holdfast"].append(seconds if code == 0 else None)
            for old in folder.glob("surface.1.*"):
                old.unlink()
            code, _, seconds, _ = run(["tetgen", "-pYQ", local], options.timeout)
            times["TetGen"].append(seconds if code == 0 and (folder / "surface.1.ele").exists() else None)
        for name, values in times.items():
            if None in values:
                failed[name].append(path.stem)
        if not any(None in values for values in times.values()):
            ours, theirs = median(times["holdfast"]), median(times["TetGen"])
            ratios.append(ours / theirs)
            rows.append((path.stem, ours, theirs))
    if not ratios:
        return ["No surface was meshed by both."]
    ratios.sort()
    quartile = [ratios[len(ratios) * k // 4] for k in (1, 2, 3)]
    total = [sum(r[i] for r in rows) for i in (1, 2)]
    lines = [f"{len(ratios)} closed valid surfaces, evenly over all sizes, that both meshed ({options.mesh_runs} turns "
             "each, the median counts). Time of holdfast over time of TetGen: "
             f"median **{quartile[1]:.2f}**, quartiles {quartile[0]:.2f} and {quartile[2]:.2f}. "
             f"Sum of times: holdfast {total[0]:.1f} s, TetGen {total[1]:.1f} s.", "",
             f"Not meshed: holdfast {len(failed['holdfast'])}, TetGen {len(failed['TetGen'])} "
             "(its result was not checked further).", "",
             "| slowest against TetGen | holdfast s | TetGen s | ratio |", "|---|---|---|---|"]
    for name, ours, theirs in sorted(rows, key=lambda r: r[2] / r[1])[:10]:
        lines.append(f"| {name} | {ours:.3f} | {theirs:.3f} | {ours / theirs:.2f} |")
    if failed["holdfast"]:
        lines += ["", "holdfast failed on: " + ", ".join(failed["holdfast"])]
    print("\n".join(lines))
    return lines


def machine():
    names = re.findall(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return f"{names[0] if names else 'unknown processor'}, {os.cpu_count()} cores seen"


def version_of(package):
    done = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True, check=False)
    return done.stdout or "?"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--corpus", default=os.environ.get("HOLDFAST_CORPUS", ""))
    parser.add_argument("--runs", type=int, default=5, help="turns of every Delaunay program")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--surfaces", type=int, default=200, help="about so many surfaces of the corpus")
    parser.add_argument("--mesh-runs", type=int, default=3)
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--triangles", type=int, nargs="+", default=[10_000, 100_000, 1_000_000], help="of generated surfaces")
    parser.add_argument("--growth", type=int, nargs="+", default=[1_600, 16_000, 160_000, 1_600_000], help="points")
    parser.add_argument("--fig13", type=int, nargs="+", default=[4, 8, 12, 16, 24], help="n of the paper's Fig. 13")
    parser.add_argument("--part", choices=["delaunay", "surfaces", "growth", "mesh"], action="append", help="default: all")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "benchmarks.md")
    options = parser.parse_args()
    surfaces = corpus.locate(options.corpus, core_only=False)
    parts = options.part or ["delaunay", "surfaces", "growth", "mesh"]
    version = run([options.build / "holdfast", "--version"])[1].strip()
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False).stdout.strip()
    lines = ["# Benchmarks", "", f"Written by `make bench` on {time.strftime('%Y-%m-%d')}: {version} at {commit}, against Debian's "
             f"TetGen {version_of('tetgen')} and CGAL {version_of('libcgal-dev')}; {machine()}. The programs took turns; "
             "each found memory that the machine has at hand, but for the surfaces of the corpus (bench/process.py says why). "
             "Meshes with field points, to compute with, stand in [field.md](field.md), made by `make field`.", ""]
    with tempfile.TemporaryDirectory(prefix="holdfast-bench-") as name:
        folder = Path(name)
        if "delaunay" in parts:
            lines += ["## Delaunay", "", "One thread unless it says more; the triangulation alone, spatial sort included; median of "
                      f"{options.runs} turns.", "", *bench_delaunay(options, folder, surfaces), ""]
        if "surfaces" in parts:
            lines += ["## Large surfaces", "", "Rippled tori as binary STL (TetGen: OFF), whole process with reading and writing; median of "
                      f"{options.runs} turns.", "", *bench_surfaces(options, folder), ""]
        if "growth" in parts:
            points = bench_delaunay_growth(options, folder, lambda node, n: write_apart(node, lambda: random_points(n)))
            lines += ["## Growth", "", "Delaunay of random points, one thread:", "", *points, "",
                      "The paper's worst case (Fig. 13, m = n / 2), `holdfast mesh --fill`:", "", *bench_fig13(options, folder), ""]
        if "mesh" in parts:
            lines += ["## `holdfast mesh --fill` against `tetgen -pY`", ""]
            lines += [*bench_mesh(options, folder, surfaces), ""] if surfaces else ["No corpus: not measured.", ""]
    options.output.parent.mkdir(exist_ok=True)
    options.output.write_text("\n".join(lines), encoding="utf-8")
    print(f"written: {options.output}")


if __name__ == "__main__":
    main()
