"""The same input gives the same bits: compares meshes of surfaces that this file makes with known digests
(tests/golden/bits.txt), or with those of another build of the program.

    same_bits.py PROGRAM --golden FILE [--write]     --write: store these digests as the known ones
    same_bits.py PROGRAM --other PROGRAM
    same_bits.py PROGRAM --other PROGRAM --corpus DIR [--every N]     every N-th surface of a folder

Surfaces are made by additions, multiplications, divisions and square roots, so with the same bits everywhere. A
digest is that of a .meshb file, which holds the coordinates' bits, the tetrahedra and the regions, uncompressed.
"""
import argparse
import hashlib
import os
import struct
import subprocess
import sys
import tempfile
from math import sqrt  # exact up to one rounding, unlike all else in math
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import make_hard  # noqa: E402
import make_paper  # noqa: E402


class Lehmer:
    """Random numbers that depend only on the seed, on every platform."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self, low=0.0, high=1.0):
        self.state = self.state * 6364136223846793005 + 1442695040888963407 & (1 << 64) - 1
        return low + (self.state >> 11) / (1 << 53) * (high - low)


def scaled_to(p, length):
    factor = length / sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])
    return tuple(factor * x for x in p)


def sphere(level, radius=1.0, at=(0.0, 0.0, 0.0), noise=0.0, seed=1):
    """A refined octahedron, each vertex at the radius, or slightly more or less."""
    points = [(1., 0., 0.), (-1., 0., 0.), (0., 1., 0.), (0., -1., 0.), (0., 0., 1.), (0., 0., -1.)]
    facets = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(level):
        middle = {}

        def half(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(scaled_to(tuple(x + y for x, y in zip(points[a], points[b])), 1.0))
            return middle[key]
        facets = [f for a, b, c in facets for ab, bc, ca in [(half(a, b), half(b, c), half(c, a))]
                  for f in [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]]
    random = Lehmer(seed)
    radii = [radius * (1 + noise * random(-1, 1)) for _ in points]
    return [tuple(r * x + o for x, o in zip(p, at)) for p, r in zip(points, radii)], facets


def torus(n, m, radius=1.0, thickness=0.4):
    """Points of circles by fractions: (1 - t^2, 2 t) / (1 + t^2)."""
    def circle(k, count):
        quarter, part = divmod(4 * k, count)
        t = part / count
        c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        return [(c, s), (-s, c), (-c, -s), (s, -c)][quarter]
    points = []
    for i in range(n):
        c, s = circle(i, n)
        for j in range(m):
            u, v = circle(j, m)
            r = radius + thickness * u
            points.append((r * c, r * s, thickness * v))
    facets = []
    for i in range(n):
        for j in range(m):
            a, b, c, d = (x % n * m + y % m for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            facets += [(a, b, c), (a, c, d)]
    return points, facets


def prism():
    """Schönhardt's, in integers."""
    points = [(60, 0, 0), (-30, 52, 0), (-30, -52, 0), (52, 30, 60), (-52, 30, 60), (0, -60, 60)]
    facets = [(0, 2, 1), (3, 4, 5)]
    for k in range(3):
        j = (k + 1) % 3
        facets += [(k, j, 3 + j), (k, 3 + j, 3 + k)]
    return points, facets


def box(low=(0, 0, 0), high=(1, 1, 1)):
    points = [tuple((high if k >> i & 1 else low)[i] for i in range(3)) for k in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def joined(*surfaces):
    points, facets = [], []
    for p, f in surfaces:
        facets += [tuple(v + len(points) for v in t) for t in f]
        points += p
    return points, facets


def turned_in(surface):
    return surface[0], [(a, c, b) for a, b, c in surface[1]]


def grid_sheet(n, height):
    """A bumpy sheet that is open all round."""
    random = Lehmer(5)
    points = [(i / n, j / n, height * random()) for i in range(n + 1) for j in range(n + 1)]
    at = lambda i, j: i * (n + 1) + j  # noqa: E731
    return points, [t for i in range(n) for j in range(n)
                    for t in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]


def with_dangling(surface):
    """An isolated triangle, chain of segments and point inside."""
    points, facets = surface
    n = len(points)
    points = points + [(-.3, -.2, .1), (.3, -.25, .15), (.05, .4, .05), (0., 0., -.3), (.2, .1, -.35), (.1, -.3, -.2),
                       (-.2, .1, .45)]
    return points, facets + [(n, n + 1, n + 2)], [(n + 3, n + 4), (n + 4, n + 5)]


def write_surface(path, points, facets, segments=()):
    lines = ["MeshVersionFormatted 2", "Dimension 3", f"Vertices {len(points)}"]
    lines += [f"{float(x)!r} {float(y)!r} {float(z)!r} 0" for x, y, z in points]
    lines += [f"Triangles {len(facets)}"] + [f"{a + 1} {b + 1} {c + 1} {1 + k % 3}" for k, (a, b, c) in enumerate(facets)]
    if segments:
        lines += [f"Edges {len(segments)}"] + [f"{a + 1} {b + 1} 4" for a, b in segments]
    path.write_text("\n".join(lines + ["End", ""]))


def write_background(folder, tensors):
    """Cells of a grid in five tetrahedra each, with a size or a tensor at each vertex."""
    n = 4
    at = lambda i, j, k: (i * (n + 1) + j) * (n + 1) + k  # noqa: E731
    places = [tuple(-2 + 4 * x / n for x in (i, j, k))
              for i in range(n + 1) for j in range(n + 1) for k in range(n + 1)]
    tets = []
    for i in range(n):
        for j in range(n):
            for k in range(n):
                c = [at(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2)) for b in range(8)]
                tets += [(c[0], c[1], c[3], c[7]), (c[0], c[3], c[2], c[7]), (c[0], c[2], c[6], c[7]),
                         (c[0], c[6], c[4], c[7]), (c[0], c[4], c[5], c[7]), (c[0], c[5], c[1], c[7])]
    lines = ["MeshVersionFormatted 2", "Dimension 3", f"Vertices {len(places)}"]
    lines += ["%r %r %r 0" % p for p in places]
    lines += [f"Tetrahedra {len(tets)}"] + [" ".join(str(v + 1) for v in t) + " 0" for t in tets]
    path = folder / ("metric.mesh" if tensors else "size.mesh")
    path.write_text("\n".join(lines + ["End", ""]))
    values = []
    for x, y, z in places:
        if tensors:
            along, across = 1 / 0.5 ** 2, 1 / (0.15 + 0.1 * (x * x + y * y) / 8) ** 2
            u = scaled_to((1 + x / 4, y / 4, 0.5 + z / 8), 1.0)
            m = [[(along if i == j else 0) + (across - along) * u[i] * u[j] for j in range(3)] for i in range(3)]
            values.append("%r %r %r %r %r %r" % (m[0][0], m[0][1], m[1][1], m[0][2], m[1][2], m[2][2]))
        else:
            values.append(repr(0.15 + 0.1 * (x * x + y * y + z * z) / 12))
    path.with_suffix(".sol").write_text(
        f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices {len(places)}\n1 {3 if tensors else 1}\n"
        + "\n".join(values) + "\nEnd\n")
    return path


def surfaces(folder):
    made = {
        "prism": prism(), "sphere": sphere(3), "rough": sphere(3, noise=0.2, seed=7),
        "spiky": sphere(2, noise=0.85, seed=3), "torus": torus(24, 12), "thin": torus(32, 12, thickness=0.05),
        "nested": joined(sphere(2), sphere(1, radius=0.3, at=(0.2, 0.1, 0.0))),
        "hollow": joined(sphere(2), turned_in(box((-.3, -.3, -.3), (.2, .25, .3)))),
        "slab": box((0, 0, 0), (1, 1, 1 / 1024)), "far": sphere(2, at=(2.0 ** 20, 3.0, -5.0)),
        "dangling": with_dangling(sphere(2)), "sheet": grid_sheet(8, 0.3),
        "large": sphere(6, noise=0.001),
    }
    for name, surface in made.items():
        write_surface(folder / f"{name}.mesh", *surface)
    make_hard.chazelle(2).write_off(folder / "chazelle.off")
    unit = make_paper.SIZE
    make_paper.dangling(6, 3, unit * 3 // 20).write(str(folder / "paper14.smesh"))
    make_paper.touching(12, 9, unit // 5).write(str(folder / "paper15.off"))
    make_paper.semiconductor(4, unit // 1000).write(str(folder / "paper19.smesh"))
    write_background(folder, False)
    write_background(folder, True)
    random = Lehmer(11)
    (folder / "points.xyz").write_text("".join("%d %d %d\n" % tuple(int(random(0, 12)) for _ in range(3)) if k % 2 else
                                               "%r %r %r\n" % tuple(random(0, 12) for _ in range(3))
                                               for k in range(600)))


# Name, and the arguments that make its mesh; {out} is the mesh.
CASES = {
    "prism": "mesh prism.mesh --fill -o {out}",
    "prism-torture": "mesh prism.mesh --fill --without flips -o {out}",
    "prism-field": "mesh prism.mesh --size 25 -o {out}",
    "chazelle": "mesh chazelle.off --fill -o {out}",
    "chazelle-seed": "mesh chazelle.off --fill --seed 7 -o {out}",
    "chazelle-torture": "mesh chazelle.off --fill --without flips -o {out}",
    "chazelle-field": "mesh chazelle.off -o {out}",
    "chazelle-forced": "mesh chazelle.off --fill --without optimise -o {out}",
    "spiky": "mesh spiky.mesh --fill -o {out}",
    "spiky-torture": "mesh spiky.mesh --fill --without flips -o {out}",
    "rough": "mesh rough.mesh --fill -o {out}",
    "rough-field": "mesh rough.mesh --quality good -o {out}",
    "rough-best": "mesh rough.mesh --quality best -o {out}",
    "sphere-fast": "mesh sphere.mesh --quality fast -o {out}",
    "sphere-field": "mesh sphere.mesh --size-field size.mesh -o {out}",
    "sphere-metric": "mesh sphere.mesh --size-field metric.mesh -o {out}",
    "torus": "mesh torus.mesh -o {out}",
    "torus-fill": "mesh torus.mesh --fill -o {out}",
    "thin": "mesh thin.mesh --fill -o {out}",
    "nested": "mesh nested.mesh --no-growth -o {out}",
    "hollow": "mesh hollow.mesh -o {out}",
    "slab": "mesh slab.mesh --fill -o {out}",
    "far": "mesh far.mesh -o {out}",
    "dangling": "mesh dangling.mesh --fill --without flips -o {out}",
    "dangling-field": "mesh dangling.mesh -o {out}",
    "sheet-box": "mesh sheet.mesh --keep box=0.5 --fill -o {out}",
    "sheet-box-field": "mesh sheet.mesh --keep box -o {out}",
    "paper14": "mesh paper14.smesh --fill -o {out}",
    "paper15": "mesh paper15.off --fill -o {out}",
    "paper19": "mesh paper19.smesh --fill -o {out}",
    "large-threads": "mesh large.mesh --threads 2 -o {out}",
    "delaunay": "delaunay points.xyz -o {out}",
    "untangle": "untangle tangled.mesh -o {out}",
    "untangle-refill": "untangle knotted.mesh -o {out}",
}


def tangle(program, folder, name, share, reach):
    """A filled sphere with some inner vertices displaced."""
    source = folder / "untangled.mesh"
    if not source.exists():
        run(program, folder, "mesh sphere.mesh --size 0.4 -o untangled.mesh")
    lines = source.read_text().split("\n")
    first = next(i for i, line in enumerate(lines) if line.strip() == "Vertices") + 2
    count = int(lines[first - 1])
    random = Lehmer(9)
    for i in range(first, first + count):
        x, y, z, tag = lines[i].split()
        p = [float(x), float(y), float(z)]
        if p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 0.97 or random() > share:
            continue
        lines[i] = " ".join(repr(c + random(-reach, reach)) for c in p) + " " + tag
    (folder / name).write_text("\n".join(lines))


def run(program, folder, words):
    done = subprocess.run([program, *words.split()], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"holdfast {words} ended with {done.returncode}:\n{done.stderr}")


def as_version_3(data):
    """A .meshb of version 2 with the positions of version 3, in which the known digests were made."""
    one, version = struct.unpack_from("<ii", data, 0)
    if (one, version) != (1, 2):
        return data
    out, at = struct.pack("<ii", 1, 3), 8
    while True:
        keyword, end = struct.unpack_from("<ii", data, at)
        if keyword == 54:
            return out + struct.pack("<iq", 54, 0)
        out += struct.pack("<iq", keyword, len(out) + 12 + end - at - 8) + data[at + 8:end]
        at = end


def digest(path):
    return hashlib.sha256(as_version_3(path.read_bytes())).hexdigest()[:32]


def digests(program, only=None):
    found = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        surfaces(folder)
        tangle(program, folder, "tangled.mesh", 0.3, 0.3)
        tangle(program, folder, "knotted.mesh", 1.0, 3.0)
        for case, words in CASES.items():
            if only and case not in only:
                continue
            run(program, folder, words.format(out="out.meshb") + " --quiet")
            found[case] = digest(folder / "out.meshb")
    return found


def compare_corpus(program, other, corpus, every):
    """Both programs on surfaces of a folder; differences are listed."""
    different = 0
    with tempfile.TemporaryDirectory() as name:
        for path in sorted(p for p in Path(corpus).iterdir() if p.is_file())[::every]:
            for options in (["--fill"], []):
                ends = []
                for k, p in enumerate((program, other)):
                    out = Path(name) / f"{k}.meshb"
                    done = subprocess.run([p, "mesh", path, "-o", out, "--quiet", "--time-limit", "60", *options],
                                          capture_output=True)
                    ends.append((done.returncode, digest(out) if done.returncode == 0 else ""))
                    out.unlink(missing_ok=True)
                if ends[0] != ends[1] and 5 not in (ends[0][0], ends[1][0]):
                    different += 1
                    print(f"{path.name} {' '.join(options)}: {ends[0]} and {ends[1]}", flush=True)
    print(f"{different} differ")
    return different


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--other")
    parser.add_argument("--golden")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--corpus")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--only", nargs="*")
    args = parser.parse_args()
    args.program = os.path.abspath(args.program)
    if args.other and not os.access(args.other, os.X_OK):
        print(f"there is no {args.other}: `make libcxx` builds it")
        sys.exit(77)
    if args.corpus:
        sys.exit(1 if compare_corpus(args.program, os.path.abspath(args.other), args.corpus, args.every) else 0)
    ours = digests(args.program, args.only)
    if args.write:
        Path(args.golden).write_text("".join(f"{name} {value}\n" for name, value in ours.items()))
        return
    theirs = (digests(os.path.abspath(args.other), args.only) if args.other else
              dict(line.split() for line in Path(args.golden).read_text().splitlines()))
    different = [name for name in ours if ours[name] != theirs.get(name)]
    for name in different:
        print(f"{name}: {ours[name]} and {theirs.get(name)}   (holdfast {CASES[name].format(out='out.meshb')})")
    print(f"{len(ours) - len(different)} of {len(ours)} meshes have the same bits")
    sys.exit(1 if different else 0)


if __name__ == "__main__":
    main()
