"""Makes polyhedra that cannot be filled with tetrahedra unless points are added, or only just.

    make_hard.py schonhardt FILE.off [--twist DEGREES]   a twisted prism (Schönhardt 1928); 0 < twist < 60
    make_hard.py chazelle FILE.off [-n N] [--gap GAP]    N+1 notches from above, N+1 from below, meeting along the
                                                         hyperbolic paraboloid z = xy up to GAP (Chazelle 1984)
"""
import argparse
from math import cos, pi, sin

from polygons import GRID, Surface, triangulate


def schonhardt(twist=30.0, radius=1.0, height=1.0):
    """Two triangles, one turned against the other; the diagonals of the sides bend inward."""
    surface = Surface()
    low, high = ([(round(radius * GRID * cos(2 * pi * k / 3 + a)), round(radius * GRID * sin(2 * pi * k / 3 + a)), z)
                  for k in range(3)] for a, z in ((0.0, 0), (twist * pi / 180, round(height * GRID))))
    surface.triangles = [tuple(low[::-1]), tuple(high)]
    for k in range(3):
        j = (k + 1) % 3
        surface.triangles += [(low[k], low[j], high[j]), (low[k], high[j], high[k])]
    return surface


def chazelle(n=3, gap=None):
    """Wedges cut into a box from above along x = i, and from below along y = j, for i, j = 0..n."""
    one = 16 * GRID
    gap = max(1, round(one / n**2 if gap is None else gap * one))
    low, high = -one, (n + 1) * one
    bottom, top = -2 * n * one, 2 * n * n * one + 2 * one

    def width(depth):  # of a notch at its mouth: in proportion to its depth, so that its sides are flat
        return depth // (16 * n * n)

    def row(place, level, edge):
        """Corners along one side of the box: the mouths of its notches and their tips."""
        corners = [place(low, level)]
        for i in range(n + 1):
            tip = edge(i)
            w = width(abs(level - tip))
            corners += [place(i * one - w, level), place(i * one, tip), place(i * one + w, level)]
        return corners + [place(high, level)]

    tops = [row(lambda x, z, y=y: (x, y, z), top, lambda i, y=y: i * y + gap) for y in (low, high)]
    bottoms = [row(lambda y, z, x=x: (x, y, z), bottom, lambda j, x=x: j * x) for x in (low, high)]
    surface = Surface()

    def sheet(first, second):
        for k in range(1, len(first)):
            a, b, c, d = first[k - 1], first[k], second[k], second[k - 1]
            surface.triangles.extend([(a, b, c), (a, c, d)])

    def wall(axis, outline):
        back = {tuple(x for i, x in enumerate(p) if i != axis): p for p in outline}
        for triangle in triangulate(list(back)):
            surface.triangles.append(tuple(back[p] for p in triangle))

    sheet(tops[0], tops[1])
    sheet(bottoms[0], bottoms[1])
    for y, line in zip((low, high), tops):
        wall(1, [(low, y, bottom), (high, y, bottom), *line[::-1]])
    for x, line in zip((low, high), bottoms):
        wall(0, [(x, low, top), (x, high, top), *line[::-1]])
    orient(surface)
    return surface


def orient(surface):
    """Turns the triangles so that neighbours agree and the volume is positive."""
    sides = {}
    for t, triangle in enumerate(surface.triangles):
        for i in range(3):
            sides.setdefault(frozenset((triangle[i - 1], triangle[i])), []).append(t)
    flip = {0: False}
    stack = [0]
    while stack:
        t = stack.pop()
        triangle = surface.triangles[t]
        mine = {(triangle[i - 1], triangle[i]) for i in range(3)}
        for a, b in mine:
            for other in sides[frozenset((a, b))]:
                if other not in flip:
                    theirs = surface.triangles[other]
                    same = any((theirs[i - 1], theirs[i]) == (a, b) for i in range(3))
                    flip[other] = flip[t] != same
                    stack.append(other)
    turned = [t[::-1] if flip[i] else t for i, t in enumerate(surface.triangles)]
    surface.triangles = turned
    if surface.volume6() < 0:
        surface.triangles = [t[::-1] for t in turned]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["schonhardt", "chazelle"])
    parser.add_argument("off")
    parser.add_argument("--twist", type=float, default=30.0)
    parser.add_argument("-n", type=int, default=3)
    parser.add_argument("--gap", type=float)
    arguments = parser.parse_args()
    made = schonhardt(arguments.twist) if arguments.kind == "schonhardt" else chazelle(arguments.n, arguments.gap)
    made.check()
    made.write_off(arguments.off)
    print(f"{arguments.off}: {len(made.triangles)} triangles")
