"""Exact triangulation of polygons with holes, and surfaces that are put together from loops of points.

Coordinates are integers (multiples of `GRID`), so every decision is exact and a binary STL, whose floats hold
these numbers, loses nothing.
"""
import struct
from collections import Counter

GRID = 1024  # points a millimetre


def turn(a, b, c):
    """Twice the signed area of the triangle a, b, c in the plane."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def area2(loop):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(loop, loop[1:] + loop[:1]))


def _between(a, b, p):
    """Whether p, on the line ab, lies on the closed segment ab."""
    return min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])


def _touch(a, b, c, d):
    """Whether the closed segments ab and cd have a point in common."""
    t1, t2, t3, t4 = turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)
    if ((t1 > 0) != (t2 > 0)) and ((t3 > 0) != (t4 > 0)) and t1 and t2 and t3 and t4:
        return True
    return (t1 == 0 and _between(a, b, c)) or (t2 == 0 and _between(a, b, d)) \
        or (t3 == 0 and _between(c, d, a)) or (t4 == 0 and _between(c, d, b))


def _in_cone(before, corner, after, p):
    """Whether corner-p starts strictly inside the polygon's angle at `corner`."""
    if turn(before, corner, after) > 0:
        return turn(corner, p, before) > 0 and turn(p, corner, after) > 0
    return not (turn(corner, p, after) >= 0 and turn(p, corner, before) >= 0)


def _bridge(polygon, hole, others):
    """Joins a hole to the polygon by the shortest bridge that touches nothing else."""
    start = max(range(len(hole)), key=lambda i: hole[i])
    h = hole[start]
    edges = [(l[i - 1], l[i]) for l in [polygon, hole, *others] for i in range(len(l))]
    order = sorted(range(len(polygon)), key=lambda i: (polygon[i][0] - h[0]) ** 2 + (polygon[i][1] - h[1]) ** 2)
    for i in order:
        p = polygon[i]
        if not _in_cone(polygon[i - 1], p, polygon[(i + 1) % len(polygon)], h):
            continue
        if any(_touch(p, h, a, b) for a, b in edges if p not in (a, b) and h not in (a, b)):
            continue
        return polygon[: i + 1] + hole[start:] + hole[: start + 1] + polygon[i:]
    raise ValueError("a hole sees no corner of its polygon")


def triangulate(outer, holes=()):
    """Triangles, counterclockwise, of a polygon (counterclockwise) without its holes; every corner is kept."""
    polygon = list(outer) if area2(outer) > 0 else list(outer)[::-1]
    holes = [list(h) if area2(h) < 0 else list(h)[::-1] for h in holes]
    want = area2(polygon) + sum(area2(h) for h in holes)
    rest = sorted(holes, key=max, reverse=True)
    while rest:
        polygon = _bridge(polygon, rest[0], rest[1:])
        rest = rest[1:]

    def cut(i):
        """Squared length of the diagonal that cuts the ear at i off, or None where there is no ear."""
        n = len(polygon)
        a2, a, b, c, c2 = (polygon[(i + k) % n] for k in (-2, -1, 0, 1, 2))
        if turn(a, b, c) <= 0 or not _in_cone(a2, a, b, c) or not _in_cone(b, c, c2, a):
            return None
        for p in polygon:
            if p not in (a, b, c) and turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0:
                return None
        return (a[0] - c[0]) ** 2 + (a[1] - c[1]) ** 2

    triangles = []
    ears = [cut(i) for i in range(len(polygon))]
    while len(polygon) > 3:
        lengths = [(length, i) for i, length in enumerate(ears) if length is not None]
        if not lengths:
            raise ValueError("the polygon is not simple")
        i = min(lengths)[1]
        n = len(polygon)
        triangles.append((polygon[i - 1], polygon[i], polygon[(i + 1) % n]))
        del polygon[i], ears[i]
        n -= 1
        for k in (i - 2, i - 1, i, i + 1):
            ears[k % n] = cut(k % n)
        if n > 3 and not any(e is not None for e in ears):  # an ear may open when a far corner is gone
            ears = [cut(k) for k in range(n)]
    triangles.append(tuple(polygon))
    assert all(turn(*t) > 0 for t in triangles) and sum(turn(*t) for t in triangles) == want
    return triangles


class Surface:
    """Triangles with corners in space, outward, put together from faces between shared loops."""

    def __init__(self):
        self.triangles = []

    def face(self, axis, outward, outer, holes=()):
        """A flat face across `axis` (0, 1, 2), whose outside is at +axis or -axis (outward = 1, -1)."""
        u, v = (axis + 1) % 3, (axis + 2) % 3
        level = outer[0][axis]
        assert all(p[axis] == level for loop in [outer, *holes] for p in loop)
        back = {(p[u], p[v]): p for loop in [outer, *holes] for p in loop}
        flat = [[(p[u], p[v]) for p in loop] for loop in [outer, *holes]]
        for a, b, c in triangulate(flat[0], flat[1:]):
            self.triangles.append(tuple(back[p] for p in ((a, b, c) if outward > 0 else (a, c, b))))

    def strip(self, lower, upper):
        """Quadrilaterals, each cut in two, between two loops of as many points; outside is to the right of
        `lower` when `upper` is above."""
        assert len(lower) == len(upper)
        for i in range(len(lower)):
            a, b, c, d = lower[i - 1], lower[i], upper[i], upper[i - 1]
            self.triangles += [(a, b, c), (a, c, d)]

    def fan(self, loop, apex):
        for i in range(len(loop)):
            self.triangles.append((loop[i - 1], loop[i], apex))

    def check(self):
        """Every edge has one triangle on each side, and no triangle has two equal corners."""
        edges = Counter((t[i - 1], t[i]) for t in self.triangles for i in range(3))
        assert all(len(set(t)) == 3 for t in self.triangles)
        assert all(n == 1 and edges[(b, a)] == 1 for (a, b), n in edges.items()), "not closed"

    def volume6(self):
        return sum(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                   + a[2] * (b[0] * c[1] - b[1] * c[0]) for a, b, c in self.triangles)

    def write_stl(self, path):
        """Binary STL in millimetres."""
        with open(path, "wb") as file:
            file.write(b"made by holdfast/examples".ljust(80) + struct.pack("<I", len(self.triangles)))
            for triangle in self.triangles:
                corners = [x / GRID for p in triangle for x in p]
                file.write(struct.pack("<12fH", 0, 0, 0, *corners, 0))

    def write_off(self, path):
        index = {}
        for triangle in self.triangles:
            for p in triangle:
                index.setdefault(p, len(index))
        with open(path, "w", encoding="ascii") as file:
            file.write(f"OFF\n{len(index)} {len(self.triangles)} 0\n")
            for p in index:
                file.write(" ".join(repr(x / GRID) for x in p) + "\n")
            for triangle in self.triangles:
                file.write("3 " + " ".join(str(index[p]) for p in triangle) + "\n")
