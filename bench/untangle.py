"""Success and time of `holdfast untangle` on meshes tangled in many ways.

    untangle.py HOLDFAST [--grids 4 8 16] [--surfaces FILE.off ...] [--only WORD] [--work DIR]

Meshes are jittered grids and results of `holdfast mesh --fill`. Each is tangled: free vertices displaced at random,
vertices rounded, the boundary moved without the inside. One line per case.
"""
import argparse
import json
import math
import random
import struct
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path


def read_mesh(path):
    words = iter(path.read_text().split())
    points, tets, facets = [], [], []
    for word in words:
        if word == "Vertices":
            points = [[float(next(words)) for _ in range(4)][:3] for _ in range(int(next(words)))]
        elif word == "Tetrahedra":
            tets = [[int(next(words)) for _ in range(5)] for _ in range(int(next(words)))]
        elif word == "Triangles":
            facets = [[int(next(words)) for _ in range(4)] for _ in range(int(next(words)))]
    return points, tets, facets


def write_mesh(path, mesh):
    points, tets, facets = mesh
    out = ["MeshVersionFormatted 2\nDimension 3\n", f"Vertices\n{len(points)}\n"]
    out += ["%r %r %r 0\n" % tuple(p) for p in points]
    out += [f"Tetrahedra\n{len(tets)}\n", *(" ".join(map(str, t)) + "\n" for t in tets)]
    out += [f"Triangles\n{len(facets)}\n", *(" ".join(map(str, f)) + "\n" for f in facets), "End\n"]
    path.write_text("".join(out))


def grid(n, jitter, rng):
    """n^3 cells of 6 tetrahedra each, the inner vertices jittered; boundary triangles are facets."""
    number = lambda i, j, k: (i * (n + 1) + j) * (n + 1) + k + 1
    points = [[c + (rng.uniform(-jitter, jitter) if all(0 < x < n for x in (i, j, k)) else 0) for c in (i, j, k)]
              for i in range(n + 1) for j in range(n + 1) for k in range(n + 1)]
    tets = []
    for i in range(n):
        for j in range(n):
            for k in range(n):
                for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
                    at, corners = [i, j, k], [number(i, j, k)]
                    for axis in order:
                        at[axis] += 1
                        corners.append(number(*at))
                    if order in ((0, 2, 1), (2, 1, 0), (1, 0, 2)):
                        corners[2], corners[3] = corners[3], corners[2]
                    tets.append([*corners, 1])
    count = Counter(tuple(sorted(f)) for t in tets for f in faces(t))
    return points, tets, [[*f, 1] for f, c in count.items() if c == 1]


def faces(t):
    return (t[0], t[1], t[2]), (t[0], t[1], t[3]), (t[0], t[2], t[3]), (t[1], t[2], t[3])


def fixed_vertices(mesh):
    return {v for f in mesh[2] for v in f[:3]}


def extent(points):
    return [(min(p[k] for p in points), max(p[k] for p in points)) for k in range(3)]


def local_size(mesh):
    total, count = [0.0] * (len(mesh[0]) + 1), [0] * (len(mesh[0]) + 1)
    for t in mesh[1]:
        for i in range(4):
            for k in range(i):
                d = math.dist(mesh[0][t[i] - 1], mesh[0][t[k] - 1])
                for v in (t[i], t[k]):
                    total[v] += d
                    count[v] += 1
    return [s / c if c else 0 for s, c in zip(total, count)]


def displaced(mesh, share, rng):
    fixed, size = fixed_vertices(mesh), local_size(mesh)
    return ([p if v in fixed else [x + rng.gauss(0, share) * size[v] for x in p]
             for v, p in enumerate(mesh[0], 1)], *mesh[1:])


def rounded(mesh, how, everything):
    fixed = fixed_vertices(mesh)
    return ([p if v in fixed and not everything else [how(x) for x in p] for v, p in enumerate(mesh[0], 1)],
            *mesh[1:])


def moved(mesh, how, everything):
    fixed = fixed_vertices(mesh)
    box = extent(mesh[0])
    longest = max(high - low for low, high in box) or 1

    def place(p):
        unit = how(*((x - (low + high) / 2) / longest for x, (low, high) in zip(p, box)))
        return [(low + high) / 2 + longest * u for u, (low, high) in zip(unit, box)]

    return ([place(p) if everything or v in fixed else p for v, p in enumerate(mesh[0], 1)], *mesh[1:])


def shear(x, y, z):
    return x + 0.8 * z, y, z


def twist(x, y, z):
    a = 1.5 * z
    return x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z


def bend(x, y, z):
    a, r = 1.5 * x, 1 / 1.5 + z
    return r * math.sin(a), y, r * math.cos(a) - 1 / 1.5


def squeeze(x, y, z):
    return x, y * (0.15 + 1.7 * (x + 0.5) ** 2), z * (0.15 + 1.7 * (x + 0.5))


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def to_grid(step):
    return lambda x: round(x / step) * step


def cases(mesh, rng):
    longest = max(high - low for low, high in extent(mesh[0]))
    for share in (0.1, 0.3, 1.0, 5.0):
        yield f"displaced {share}", lambda: displaced(mesh, share, rng)
    yield "float32 inside", lambda: rounded(mesh, single, False)
    yield "float32 all", lambda: rounded(mesh, single, True)
    for parts in (10, 50, 1000):
        yield f"grid/{parts} inside", lambda: rounded(mesh, to_grid(longest / parts), False)
    yield "grid/100000 all", lambda: rounded(mesh, to_grid(longest / 100000), True)
    for how in (shear, twist, bend, squeeze):
        yield f"{how.__name__} boundary", lambda: moved(mesh, how, False)
        yield f"{how.__name__} all", lambda: moved(mesh, how, True)


def run(holdfast, name, case, mesh, work):
    source, target, report = work / "tangled.mesh", work / "out.mesh", work / "report.json"
    write_mesh(source, mesh)
    target.unlink(missing_ok=True)
    start = time.monotonic()
    ended = subprocess.run([holdfast, "untangle", source, "-o", target, "--report", report, "-q", "--time-limit", "300"],
                           stderr=subprocess.PIPE, text=True, check=False)
    seconds = time.monotonic() - start
    told = json.loads(report.read_text()) if report.exists() else {}
    i = told.get("input", {})
    print(f"{name:24.24} {case:20} exit {ended.returncode} {seconds:7.2f} s  tets {i.get('tetrahedra')} free "
          f"{i.get('free_vertices')} neg {i.get('negative')} null {i.get('null')} | moved {told.get('moved')} swaps "
          f"{told.get('swapped')} cavities {told.get('cavities')} +{told.get('added')} -{told.get('removed')} rounds "
          f"{told.get('rounds')} {({k: round(v, 2) for k, v in told.get('seconds', {}).items() if v > 0.05})}"
          f"{' ' + ended.stderr.splitlines()[0][:90] if ended.stderr else ''}", flush=True)
    return ended.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("holdfast")
    parser.add_argument("--grids", type=int, nargs="*", default=[4, 8, 16])
    parser.add_argument("--surfaces", type=Path, nargs="*", default=[])
    parser.add_argument("--only", default="")
    parser.add_argument("--work", type=Path, default=Path("build/untangle"))
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    rng = random.Random(1)
    meshes = [(f"grid {n}", grid(n, 0.2, rng)) for n in arguments.grids]
    for surface in arguments.surfaces:
        filled = arguments.work / "filled.mesh"
        subprocess.run([arguments.holdfast, "mesh", surface, "-o", filled, "--fill", "-q"], check=True)
        meshes.append((surface.stem, read_mesh(filled)))
    codes = Counter()
    for name, mesh in meshes:
        for case, tangle in cases(mesh, rng):
            if arguments.only in case:
                codes[run(arguments.holdfast, name, case, tangle(), arguments.work)] += 1
    print(f"{sum(codes.values())} cases: " + ", ".join(f"exit {c}: {n}" for c, n in sorted(codes.items())))
    return 0 if set(codes) <= {0, 4} else 1


if __name__ == "__main__":
    sys.exit(main())
