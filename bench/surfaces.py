"""Whole programs on large surfaces: `holdfast mesh --fill` on one and two threads, TetGen, Gmsh with Delaunay and
with HXT, all of which keep the surface; then where holdfast's time goes, from its reports."""
import json
import multiprocessing
import struct
from math import cos, pi, sin
from statistics import median

from process import run

MEMORY = 2 << 30  # bytes that a program finds ready, see process.ready_memory
TARGETS = (("reading", "read", "delaunay", 0.30), ("validation", "validate", "total", 0.15))


def torus(rows, columns):
    """A torus with ripples, every second row half a step on: (points, triangles). `rows` is even."""
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


def write_surface(folder, count):
    """About `count` triangles in both formats; returns how many. In a process of its own, see run.write_apart."""
    def write():
        points, triangles = torus(rows, columns)
        write_stl(folder / "surface.stl", points, triangles)
        write_off(folder / "surface.off", points, triangles)

    rows = max(4, round((count / 4) ** 0.5) * 2)
    columns = max(3, count // (2 * rows))
    writer = multiprocessing.Process(target=write)
    writer.start()
    writer.join()
    return 2 * rows * columns


def write_geo(path, algorithm):
    """Gmsh keeps a discrete surface; sizes from nowhere, so that it adds as few points as it can."""
    path.write_text(f'Merge "surface.stl";\nSurface Loop(1) = {{1}};\nVolume(1) = {{1}};\nMesh.Algorithm3D = {algorithm};\n'
                    "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\nMesh.MeshSizeMax = 1e22;\n"
                    "Mesh.Optimize = 0;\n", encoding="ascii")


def programs(options, folder):
    """name -> (command, file that it must write)."""
    def gmsh(name):
        return (["gmsh", "-3", "-nt", "1", "-bin", "-o", f"{name}.msh", f"{name}.geo"], f"{name}.msh")

    def holdfast(threads):
        return ([options.build.resolve() / "holdfast", "mesh", "surface.stl", "-o", f"{threads}.meshb", "--fill", "-q", "--threads",
                 threads, "--report", f"{threads}.json"], f"{threads}.meshb")

    write_geo(folder / "delaunay.geo", 1)
    write_geo(folder / "hxt.geo", 10)
    return {"holdfast": holdfast(1), "holdfast, 2 threads": holdfast(2),
            "TetGen -pYQ": (["tetgen", "-pYQ", "surface.off"], "surface.1.ele"),
            "Gmsh Delaunay": gmsh("delaunay"), "Gmsh HXT": gmsh("hxt")}


def measure(options, folder):
    """(name -> [(seconds, peak bytes)], reports of holdfast on one thread); a program that fails has no entry."""
    results, reports = {}, []
    failed = set()
    for _ in range(options.runs):
        for name, (command, target) in programs(options, folder).items():
            if name in failed:
                continue
            (folder / target).unlink(missing_ok=True)
            code, _, seconds, peak = run(command, options.timeout, folder, MEMORY)
            if code == 0 and (folder / target).exists():
                results.setdefault(name, []).append((seconds, peak))
            else:
                failed.add(name)
                results.pop(name, None)
        if "holdfast" in results:
            reports.append(json.loads((folder / "1.json").read_text(encoding="utf-8")))
    same = (folder / "1.meshb").exists() and (folder / "2.meshb").exists() and (
        (folder / "1.meshb").read_bytes() == (folder / "2.meshb").read_bytes())
    return results, reports, failed, same


def bench_surfaces(options, folder):
    lines = ["| triangles | program | seconds (median) | peak memory, MB | time against holdfast |", "|---|---|---|---|---|"]
    profile = []
    stages = []
    for count in options.triangles:
        size = write_surface(folder, count)
        results, reports, failed, same = measure(options, folder)
        base = median(r[0] for r in results["holdfast"]) if "holdfast" in results else None
        for name, values in results.items():
            seconds, peak = (median(v[i] for v in values) for i in (0, 1))
            ratio = f"{seconds / base:.2f}" if base else "-"
            lines.append(f"| {size} | {name} | {seconds:.2f} | {peak / 1e6:.0f} | {ratio} |")
            print(lines[-1], flush=True)
        for name in sorted(failed):
            lines.append(f"| {size} | {name} | failed, or over {options.timeout:.0f} s | | |")
        if not same:
            lines.append(f"| {size} | holdfast: one and two threads differ | | | |")
        if reports:
            seconds = {stage: median(r["seconds"].get(stage, 0) for r in reports) for stage in reports[0]["seconds"]}
            stages = stages or [s for s in seconds if s != "total"]
            total = seconds["total"]
            profile.append(f"| {size} | {total:.2f} | " + " | ".join(f"{100 * seconds.get(s, 0) / total:.1f}" for s in stages) +
                           " | " + " | ".join(f"{seconds[a] / seconds[b]:.2f} ({limit})" for _, a, b, limit in TARGETS) + " |")
    lines += ["", "Where the time of `holdfast mesh --fill` on one thread goes, in percent:", "",
              "| triangles | seconds | " + " | ".join(stages) + " | " +
              " | ".join(f"{a} / {b} (target)" for _, a, b, _ in TARGETS) + " |",
              "|---" * (len(stages) + 2 + len(TARGETS)) + "|", *profile]
    return lines
