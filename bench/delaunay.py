"""Delaunay alone: Holdfast, CGAL and TetGen on one thread, Holdfast and CGAL with TBB on two.

Uniformly random points, the vertices of rippled tori (surfaces.py), and of the largest surface of the corpus; the seconds
that a program reports for the triangulation, including the spatial sort.
"""
import json
import re
import sys
from statistics import median

import sample
from kept import digest
from points import count_of, vertices_of, write_list, write_random
from process import MEASURABLE, apart, run, take_turns
from surfaces import MEMORY, grid_of, torus

OURS, OURS_ON_TWO, CGAL, CGAL_ON_TWO, TETGEN = "holdfast", "holdfast, 2 threads", "CGAL", "CGAL with TBB, 2 threads", "TetGen"


def holdfast(program, node, folder, threads=1, memory=MEMORY):
    """Seconds of the triangulation, tetrahedra, peak memory and a digest of the mesh."""
    report, mesh = folder / "report.json", folder / "out.meshb"
    done = run([program, "delaunay", node, "-o", mesh, "-q", "--report", report, "--threads", threads], memory=memory)
    if done.code != 0:
        sys.exit(f"holdfast delaunay ended with {done.code}: {done.output}")
    told = json.loads(report.read_text(encoding="utf-8"))
    return {"seconds": told["seconds"]["delaunay"], "tetrahedra": told["mesh"]["tetrahedra"], "peak": done.peak, "mesh": digest(mesh)}


def peer(command, seconds, tetrahedra):
    """The same for another program, which prepares its memory itself; the last two are patterns of its output."""
    done = run(command)
    return {"seconds": float(re.search(seconds, done.output)[1]), "tetrahedra": int(re.search(tetrahedra, done.output)[1]),
            "peak": done.peak}


def programs(build, node, folder):
    def cgal(threads):
        return peer([build / "cgal_delaunay", node, threads], r"seconds (\S+)", r"tetrahedra (\d+)")

    return {OURS: lambda: holdfast(build / "holdfast", node, folder), CGAL: lambda: cgal(1),
            TETGEN: lambda: peer([build / "tetgen_delaunay", node], r"Delaunay seconds:\s+(\S+)", r"Mesh tetrahedra:\s+(\d+)"),
            OURS_ON_TWO: lambda: holdfast(build / "holdfast", node, folder, 2), CGAL_ON_TWO: lambda: cgal(2)}


def measure(options, folder, write, *arguments):
    node = folder / "points.node"
    apart(write, node, *arguments)
    told = take_turns(programs(options.build, node, folder), options.runs)
    rows = {name: {"seconds": median(t["seconds"] for t in turns), "tetrahedra": turns[0]["tetrahedra"],
                   "peak": median(t["peak"] for t in turns)} for name, turns in told.items()}
    meshes = {t["mesh"] for name in (OURS, OURS_ON_TWO) for t in told[name]}
    return {"points": count_of(node), "programs": rows, "same": len(meshes) == 1}


def vertices_of_torus(count):
    return torus(*grid_of(count))[0]


def sets(options):
    """(title, writer of a file, its arguments)"""
    yield f"{options.points:,} random points in a cube", write_random, options.points
    for count in options.triangles:
        yield f"vertices of a torus of {count:,} triangles", write_list, vertices_of_torus, count
    if options.surfaces_in:
        path = sample.largest(options.surfaces_in)
        yield f"vertices of {path.stem} (corpus)", write_list, vertices_of, path


def figures_of(title, row):
    seconds = {name: r["seconds"] for name, r in row["programs"].items()}
    peak = {name: r["peak"] for name, r in row["programs"].items()}
    return {"set": title, "points": row["points"], "cgal": seconds[CGAL] / seconds[OURS], "tetgen": seconds[TETGEN] / seconds[OURS],
            "threads": seconds[OURS] / seconds[OURS_ON_TWO], "same": row["same"],
            "memory": peak[OURS] / peak[TETGEN] if peak[TETGEN] > MEASURABLE else None}


def bench(options, folder, rows):
    lines = ["One thread unless it says more; the triangulation alone, spatial sort included; median of "
             f"{options.runs} turns. One and two threads of Holdfast must write the same file.", "",
             "| points | program | seconds | points/s | tetrahedra | bytes a tetrahedron, whole process | time against holdfast |",
             "|---|---|---:|---:|---:|---:|---:|"]
    figures = []
    for title, write, *arguments in sets(options):
        row = rows.get(f"{title}, {options.runs} turns", measure, options, folder, write, *arguments)
        base = row["programs"][OURS]["seconds"]
        for name, told in row["programs"].items():
            lines.append(f"| {title} | {name} | {told['seconds']:.3f} | {row['points'] / told['seconds']:,.0f} | {told['tetrahedra']} "
                         f"| {told['peak'] / told['tetrahedra']:.0f} | {told['seconds'] / base:.2f} |")
        if not row["same"]:
            lines.append(f"| {title} | holdfast: one and two threads DIFFER | | | | | |")
        figures.append(figures_of(title, row))
    return lines, figures
