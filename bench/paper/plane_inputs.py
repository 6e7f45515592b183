"""Points and segments in the plane for figures 1 to 5 and §2.4, and what `holdfast plane` makes of them."""
import json
from math import cos, pi, sin

from process import run


class Input:
    def __init__(self, points, segments, holes=()):
        self.points, self.segments, self.holes = points, segments, holes

    def write(self, path):
        lines = [f"{len(self.points)} 2 0 0", *(f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.points))]
        lines += [f"{len(self.segments)} 0", *(f"{i} {a} {b}" for i, (a, b) in enumerate(self.segments))]
        lines += [str(len(self.holes)), *(f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.holes))]
        path.write_text("\n".join(lines) + "\n", encoding="ascii")


def ring(points, first=0):
    n = len(points)
    return [(first + i, first + (i + 1) % n) for i in range(n)]


def convex(n):
    points = [(10 * cos(2 * pi * i / n), 7 * sin(2 * pi * i / n)) for i in range(n)]
    return Input(points, ring(points))


def comb(n):
    """An outline of n points whose every second one is reflex."""
    points = [(float(i), 0.3 if i % 2 else 10.0) for i in range(n - 2)]
    points += [(float(n), -1.0), (-3.0, -1.0)]
    return Input(points, ring(points))


def quadrilateral(n, m):
    """Fig. 4: n points on the upper and the lower side of a flat quadrilateral, m on the left and the right one, and a
    segment between each two of these, the uppermost first."""
    height = 0.9
    low = [(float(i), 0.0) for i in range(n + 1)]
    high = [(i + 0.25, height) for i in range(n, -1, -1)]
    levels = [height * (m - k) / (m + 1) for k in range(m)]
    right = [(n + 0.25 * y / height + 0.05 * y * (height - y), y) for y in levels]
    left = [(0.25 * y / height - 0.05 * y * (height - y), y) for y in levels]
    points = low + high + right + left
    first = 2 * n + 2
    return Input(points, [(first + m + k, first + k) for k in range(m)])


def pencil(n, m):
    """The case that equation (1) assumes: all n edges that the first segment crosses come from one point above."""
    low = [(float(i) - (n - 1) / 2, 0.0) for i in range(n)]
    far = 4.0 * n
    levels = [1 - (k + 1) / (m + 1) for k in range(m)]
    points = low + [(0.0, 1.0)] + [(s * (far + y * (1 - y)), y) for y in levels for s in (-1, 1)]
    return Input(points, [(n + 1 + 2 * k, n + 2 + 2 * k) for k in range(m)])


def triangulate(options, folder, given, *extra, limit=600):
    """Points, triangles and the report of a run, or None beyond the limit."""
    poly, out, report = folder / "in.poly", folder / "out.off", folder / "report.json"
    given.write(poly)
    done = run([options.build / "holdfast", "plane", poly, "-o", out, "--report", report, "-q", *extra], limit)
    if done.code is None:
        return None
    if done.code != 0:
        raise RuntimeError(done.output)
    words = out.read_text(encoding="ascii").split()
    count, faces = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * i: 6 + 3 * i])) for i in range(count)]
    at = 4 + 3 * count
    triangles = [tuple(map(int, words[at + 4 * i + 1: at + 4 * i + 4])) for i in range(faces)]
    return points, triangles, json.loads(report.read_text(encoding="utf-8"))
