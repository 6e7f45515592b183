"""The portable build and one with -march=native (preset `native`): Delaunay, and a surface filled. Predicates round the
same way in both, since nothing is contracted, so the meshes must be the same, bit for bit."""
from statistics import median

import surfaces
from delaunay import holdfast
from kept import digest
from points import write_random
from process import apart, take_turns

PORTABLE, NATIVE = "portable", "-march=native"


def programs(options):
    return {PORTABLE: (options.build / "holdfast").resolve(), NATIVE: (options.native / "holdfast").resolve()}


def delaunay(options, folder):
    node = folder / "native.node"
    apart(write_random, node, options.points)
    return take_turns({name: lambda p=program: holdfast(p, node, folder) for name, program in programs(options).items()}, options.runs)


def fill_once(program, folder, timeout):
    told = surfaces.holdfast(program, folder, 1, timeout)
    return told and {"seconds": told["report"]["seconds"]["total"], "mesh": digest(folder / "1.meshb")}


def fill(options, folder):
    apart(surfaces.write_surface, folder, options.native_triangles)
    return take_turns({name: lambda p=program: fill_once(p, folder, options.timeout) for name, program in programs(options).items()},
                      options.runs)


def measure(options, folder, task):
    told = task(options, folder)
    if not all(told.values()):
        return None
    return {"seconds": {name: median(t["seconds"] for t in turns) for name, turns in told.items()},
            "same": len({t["mesh"] for turns in told.values() for t in turns}) == 1}


def bench(options, folder, rows):
    if not (options.native / "holdfast").exists():
        return [f"No build in {options.native}: not measured."], None
    lines = [f"Seconds that the program tells, one thread; median of {options.runs} turns.", "",
             "| task | portable | -march=native | portable over native | same mesh, bit for bit |", "|---|---:|---:|---:|---|"]
    figures = []
    for title, task in ((f"Delaunay of {options.points:,} random points", delaunay),
                        (f"`mesh --fill` of a torus of {options.native_triangles:,} triangles", fill)):
        row = rows.get(f"{title}, {options.runs} turns", measure, options, folder, task)
        if not row:
            lines.append(f"| {title} | failed | | | |")
            continue
        one, other = (row["seconds"][name] for name in (PORTABLE, NATIVE))
        lines.append(f"| {title} | {one:.3f} | {other:.3f} | {one / other:.2f} | {'yes' if row['same'] else 'NO'} |")
        figures.append({"task": title, "ratio": one / other, "same": row["same"]})
    return lines, figures
