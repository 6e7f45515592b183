"""Whole programs on large surfaces: `holdfast mesh --fill` on one and two threads, TetGen, Gmsh with Delaunay and
with HXT, all of which keep the surface; then where holdfast's time goes, from its reports."""
import filecmp
import json
import struct
from math import cos, pi, sin
from statistics import median

from process import MEASURABLE, apart, run, take_turns
from stages import medians, table

MEMORY = 2 << 30  # bytes that are ready for a program, see process.ready_memory
OURS, OURS_ON_TWO, TETGEN, HXT, SLOW = "holdfast", "holdfast, 2 threads", "TetGen -pYQ", "Gmsh HXT", "Gmsh Delaunay"


def torus(rows, columns):
    """A torus with ripples, every second row shifted by half a step: (points, triangles). `rows` is even."""
    points = []
    for i in range(rows):
        for j in range(columns):
            u, v = 2 * pi * i / rows, 2 * pi * (j + 0.5 * (i % 2)) / columns
            r = 1 + 0.05 * sin(9 * u) * cos(7 * v)
            points.append(((3 + r * cos(v)) * cos(u), (3 + r * cos(v)) * sin(u), r * sin(v)))
    triangles = []
    for i in range(rows):
        here, there, odd = i * columns, (i + 1) % rows * columns, i % 2
        for j in range(columns):
            a, b = here + j, here + (j + 1) % columns
            c, d = there + (j + odd) % columns, there + (j - 1 + odd) % columns
            triangles += [(a, b, c), (a, c, d)]
    return points, triangles


def write_stl(path, points, triangles):
    record = struct.Struct("<12fH")
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            file.write(record.pack(0, 0, 0, *points[a], *points[b], *points[c], 0))


def write_off(path, points, triangles):
    """With the coordinates rounded as in the STL file."""
    single = struct.Struct("<3f")
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines("{!r} {!r} {!r}\n".format(*single.unpack(single.pack(*p))) for p in points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def grid_of(count):
    """Rows and columns of a torus of about `count` triangles."""
    rows = max(4, round((count / 4) ** 0.5) * 2)
    return rows, max(3, count // (2 * rows))


def write_surface(folder, count):
    points, triangles = torus(*grid_of(count))
    write_stl(folder / "surface.stl", points, triangles)
    write_off(folder / "surface.off", points, triangles)


def write_geo(path, algorithm):
    """Gmsh keeps a discrete surface; without any sizes, so that it adds as few points as possible."""
    path.write_text(f'Merge "surface.stl";\nSurface Loop(1) = {{1}};\nVolume(1) = {{1}};\nMesh.Algorithm3D = {algorithm};\n'
                    "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\nMesh.MeshSizeMax = 1e22;\n"
                    "Mesh.Optimize = 0;\n", encoding="ascii")


def whole(folder, command, target, timeout, report=None):
    """Wall seconds and peak memory of a program that writes `target`, and its report; None if it writes nothing."""
    (folder / target).unlink(missing_ok=True)
    done = run(command, timeout, folder, MEMORY)
    if done.code != 0 or not (folder / target).exists():
        return None
    return {"wall": done.wall, "peak": done.peak, "report": json.loads((folder / report).read_text(encoding="utf-8")) if report else None}


def holdfast(program, folder, threads, timeout):
    command = [program, "mesh", "surface.stl", "-o", f"{threads}.meshb", "--fill", "-q", "--threads", threads,
               "--report", f"{threads}.json"]
    return whole(folder, command, f"{threads}.meshb", timeout, f"{threads}.json")


def gmsh(folder, name, algorithm, timeout):
    write_geo(folder / f"{name}.geo", algorithm)
    return whole(folder, ["gmsh", "-3", "-nt", "1", "-bin", "-o", f"{name}.msh", f"{name}.geo"], f"{name}.msh", timeout)


def programs(options, folder):
    ours, limit = (options.build / "holdfast").resolve(), options.timeout
    return {OURS: lambda: holdfast(ours, folder, 1, limit), OURS_ON_TWO: lambda: holdfast(ours, folder, 2, limit),
            TETGEN: lambda: whole(folder, ["tetgen", "-pYQ", "surface.off"], "surface.1.ele", limit),
            HXT: lambda: gmsh(folder, "hxt", 10, limit)}


def measure(options, folder, count, with_slow):
    apart(write_surface, folder, count)
    told = take_turns(programs(options, folder), options.runs)
    if with_slow:
        told |= take_turns({SLOW: lambda: gmsh(folder, "delaunay", 1, options.timeout)}, 1)
    row = {name: turns and {"wall": median(t["wall"] for t in turns), "peak": median(t["peak"] for t in turns)}
           for name, turns in told.items()}
    both = told[OURS] and told[OURS_ON_TWO]
    return {"programs": row, "same": bool(both) and filecmp.cmp(folder / "1.meshb", folder / "2.meshb", shallow=False),
            "stages": [medians([t["report"] for t in told[name]]) for name in (OURS, OURS_ON_TWO)] if both else None}


def program_lines(size, row, options):
    base = row["programs"][OURS]
    for name, told in row["programs"].items():
        shown = f"{name} (one turn)" if name == SLOW else name
        if told:
            ratio = f"{told['wall'] / base['wall']:.2f}" if base else "-"
            yield f"| {size:,} | {shown} | {told['wall']:.2f} | {told['peak'] / 1e6:.0f} | {ratio} |"
        else:
            yield f"| {size:,} | {shown} | failed, or over {options.timeout:.0f} s | | |"
    if not row["same"]:
        yield f"| {size:,} | holdfast: one and two threads DIFFER | | | |"


def figures_of(size, row):
    """Of a surface that Holdfast meshed on one and on two threads."""
    one, two = row["stages"]
    ours, tetgen = row["programs"][OURS], row["programs"][TETGEN]
    return {"triangles": size, "tetgen": tetgen and tetgen["wall"] / ours["wall"],
            "memory": ours["peak"] / tetgen["peak"] if tetgen and tetgen["peak"] > MEASURABLE else None,
            "validate": one["validate"] / one["total"], "read": one["read"] / one["delaunay"],
            "validate_one": one["validate"], "validate_two": two["validate"],
            "threads": one["validate"] / two["validate"], "same": row["same"]}


def bench(options, folder, rows):
    told, with_slow = {}, True
    for count in sorted(options.triangles):
        n, m = grid_of(count)
        row = rows.get(f"{count} triangles, {options.runs} turns of {options.timeout:.0f} s", measure, options, folder, count, with_slow)
        told[2 * n * m] = row
        with_slow = row["programs"].get(SLOW) is not None
    figures = [figures_of(size, row) for size, row in told.items() if row["stages"]]
    lines = ["Rippled tori as binary STL (TetGen: OFF), whole process with reading and writing, wall clock; median of "
             f"{options.runs} turns, but Gmsh's Delaunay, which takes minutes, has one, and none beyond the size that it fails on. Gmsh "
             "keeps the surface, as TetGen does. A peak below 64 MB may be that of the process that measures.", "",
             "| triangles | program | seconds | peak memory, MB | time against holdfast |", "|---:|---|---:|---:|---:|"]
    for size, row in told.items():
        lines += program_lines(size, row, options)
    lines += ["", "Where the time of `holdfast mesh --fill` on one thread goes:", "",
              *table("triangles", {f"{size:,}": row["stages"][0] for size, row in told.items() if row["stages"]}), "",
              "Reading against Delaunay, and validation on one and on two threads:", "",
              "| triangles | reading / Delaunay | validation / whole | validation, s | on two threads, s | one over two |",
              "|---:|---:|---:|---:|---:|---:|"]
    for f in figures:
        lines.append(f"| {f['triangles']:,} | {f['read']:.2f} | {f['validate']:.2f} | {f['validate_one']:.4f} | {f['validate_two']:.4f} "
                     f"| {f['threads']:.2f} |")
    return lines, figures
