"""Parts that touch: surfaces for the tests of `paste`, each a pair of vertices and triangles."""

import math
import struct

Part = tuple[list[tuple[float, float, float]], list[tuple[int, int, int]]]


def box(low, high, steps) -> Part:
    """A box whose sides have grids of steps[k] cells along axis k, facing outwards; diagonals alternate."""
    steps = (steps,) * 3 if isinstance(steps, int) else steps
    index: dict[tuple[int, int, int], int] = {}
    points: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, int, int]] = []

    def vertex(at):
        if at not in index:
            index[at] = len(points)
            points.append(tuple(low[k] + (high[k] - low[k]) * at[k] / steps[k] if at[k] < steps[k] else high[k]
                                for k in range(3)))
        return index[at]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, steps[axis]):
            for i in range(steps[u]):
                for j in range(steps[v]):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        at = [0, 0, 0]
                        at[axis], at[u], at[v] = end, i + di, j + dj
                        corners.append(vertex(tuple(at)))
                    a, b, c, d = corners
                    pair = [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
                    triangles += pair if end else [t[::-1] for t in pair]
    return points, triangles


def cylinder(radius, low, high, sides, turn=0.0, layers=1) -> Part:
    """Round the z axis, with a vertex in the middle of each end."""
    points: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, int, int]] = []
    for layer in range(layers + 1):
        z = low + (high - low) * layer / layers
        for k in range(sides):
            angle = 2 * math.pi * k / sides + turn
            points.append((radius * math.cos(angle), radius * math.sin(angle), z))
    for layer in range(layers):
        for k in range(sides):
            a, b = layer * sides + k, layer * sides + (k + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    for z, first, up in ((low, 0, False), (high, layers * sides, True)):
        middle = len(points)
        points.append((0.0, 0.0, z))
        for k in range(sides):
            a, b = first + k, first + (k + 1) % sides
            triangles.append((middle, a, b) if up else (middle, b, a))
    return points, triangles


def ring(inner: Part, outer: Part) -> Part:
    """The outer part without the inner one, which lies strictly inside."""
    points = outer[0] + inner[0]
    n = len(outer[0])
    return points, outer[1] + [(n + a, n + c, n + b) for a, b, c in inner[1]]


def wedge(first, last, height, steps) -> Part:
    """A sector of a disc of radius 1 round the z axis, between two angles in degrees, in `steps` layers."""
    a, b = math.radians(first), math.radians(last)
    corners = [(0.0, 0.0), (math.cos(a), math.sin(a)), (math.cos(b), math.sin(b))]
    points = [(x, y, height * k / steps) for k in range(steps + 1) for x, y in corners]
    triangles = [(0, 2, 1), (3 * steps, 3 * steps + 1, 3 * steps + 2)]
    for k in range(steps):
        for i in range(3):
            p, q = 3 * k + i, 3 * k + (i + 1) % 3
            # The diagonals of both plane sides begin at the axis, as those of the next wedge do.
            triangles += [(p, q, p + 3), (q, q + 3, p + 3)] if i == 2 else [(p, q, q + 3), (p, q + 3, p + 3)]
    return points, triangles


def rotated(part: Part, degrees=(17.0, 31.0, 59.0), by=(0.1, 0.2, 0.3)) -> Part:
    x, y, z = (math.radians(d) for d in degrees)

    def turn(p):
        a, b, c = p
        b, c = b * math.cos(x) - c * math.sin(x), b * math.sin(x) + c * math.cos(x)
        a, c = a * math.cos(y) + c * math.sin(y), -a * math.sin(y) + c * math.cos(y)
        a, b = a * math.cos(z) - b * math.sin(z), a * math.sin(z) + b * math.cos(z)
        return a + by[0], b + by[1], c + by[2]

    return [turn(p) for p in part[0]], part[1]


def as_float32(part: Part) -> Part:
    return [tuple(struct.unpack("<3f", struct.pack("<3f", *p))) for p in part[0]], part[1]


def volume(part: Part) -> float:
    points, triangles = part
    total = []
    for a, b, c in triangles:
        p, q, r = points[a], points[b], points[c]
        total.append(p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2])
                     + p[2] * (q[0] * r[1] - q[1] * r[0]))
    return math.fsum(total) / 6


def write_off(path, part: Part) -> None:
    points, triangles = part
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def write_stl(path, part: Part) -> None:
    points, triangles = part
    with open(path, "wb") as file:
        file.write(b" " * 80 + struct.pack("<I", len(triangles)))
        for t in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in points[v]), 0))
