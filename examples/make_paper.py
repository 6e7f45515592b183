"""Makes the surfaces that the paper (George, Borouchaki, Saltel 2003) tries its method on.

    make_paper.py worst FILE [-n N] [-m M] [--height H] [--free]   Fig. 13: a box with N x N squares above and below,
                                    and M rectangles of two triangles between them, each side one edge; --free takes
                                    them off the sides of the box
    make_paper.py dangling FILE [-n N] [-m M] [--height H]         Fig. 14: a box of N x N x M squares round two large
                                    triangles that touch nothing; 20 x 20 x 3 has the paper's 2,082 triangles
    make_paper.py touching FILE [-n N] [--ny NY] [--height H]      Fig. 15: two large triangles across a box, so that
                                    its sides are pencils of edges; 93 x 69 has the paper's 26,326 triangles
    make_paper.py semiconductor FILE [-n N] [--thickness T]        Fig. 19: four materials, one of them T thin
    make_paper.py gap FILE [-n N] [--gap G]                        two blocks with a gap of G times their size

H, T and G are in proportion to the longest side. FILE is .off, or .smesh with markers and region seeds.
"""
import argparse

from polygons import GRID, Surface

SIZE = 1 << 43  # grid points along the longest side: a gap of 1e-12 is eight of them


class Blocks(Surface):
    """Faces of a rectilinear grid: `cuts` holds the coordinates of its planes along each axis."""

    def __init__(self, *cuts):
        super().__init__()
        self.cuts = cuts
        self.markers = []
        self.regions = []

    def point(self, *index):
        return tuple(cut[i] for cut, i in zip(self.cuts, index))

    def add(self, triangles, marker):
        self.triangles += triangles
        self.markers += [marker] * len(triangles)

    def square(self, axis, index, marker):
        """The square of the grid across `axis` whose least corner has that index."""
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corner = list(index)
            corner[u] += du
            corner[v] += dv
            corners.append(self.point(*corner))
        a, b, c, d = corners
        self.add([(a, b, c), (a, c, d)], marker)

    def sheet(self, axis, level, marker):
        """All squares of one plane of the grid."""
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for i in range(len(self.cuts[u]) - 1):
            for j in range(len(self.cuts[v]) - 1):
                index = [0, 0, 0]
                index[axis], index[u], index[v] = level, i, j
                self.square(axis, index, marker)

    def materials(self, material):
        """The faces between cells of different material: `material(i, j, k)`, 0 for none."""
        cells = [len(cut) - 1 for cut in self.cuts]

        def at(cell):
            return material(*cell) if all(0 <= c < n for c, n in zip(cell, cells)) else 0

        for axis in range(3):
            for index in _box([n + (a == axis) for a, n in enumerate(cells)]):
                below = tuple(i - (a == axis) for a, i in enumerate(index))
                pair = sorted((at(below), at(index)))
                if pair[0] != pair[1]:
                    self.square(axis, index, 10 * pair[0] + pair[1])
        seen = {0}
        for cell in _box(cells):
            if at(cell) not in seen:
                seen.add(at(cell))
                middle = [(cut[c] + cut[c + 1]) / 2 for cut, c in zip(self.cuts, cell)]
                self.regions.append((middle, at(cell)))

    def write(self, path):
        if path.endswith(".smesh"):
            self.write_smesh(path)
        elif path.endswith(".off"):
            self.write_off(path)
        else:
            raise SystemExit(f"{path}: .off and .smesh can be written")

    def write_smesh(self, path):
        index = {}
        for triangle in self.triangles:
            for p in triangle:
                index.setdefault(p, len(index))
        lines = [f"{len(index)} 3 0 0"]
        lines += [f"{i} " + " ".join(repr(x / GRID) for x in p) for p, i in index.items()]
        lines.append(f"{len(self.triangles)} 1")
        lines += ["3 " + " ".join(str(index[p]) for p in t) + f" {m}" for t, m in zip(self.triangles, self.markers)]
        lines += ["0", str(len(self.regions))]
        lines += [f"{i} " + " ".join(repr(x / GRID) for x in p) + f" {ident}" for i, (p, ident) in enumerate(self.regions)]
        with open(path, "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")


def _box(counts):
    return ((i, j, k) for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2]))


def even(n, low=0, high=SIZE):
    return [low + (high - low) * i // n for i in range(n + 1)]


def ring(low, high, z):
    return [(low[0], low[1], z), (high[0], low[1], z), (high[0], high[1], z), (low[0], high[1], z)]


def rectangle(surface, corners, marker):
    a, b, c, d = corners
    surface.add([(a, b, c), (a, c, d)], marker)


def box_with_levels(nx, ny, levels, height):
    """Squares above and below; along the sides, between `levels` horizontal rectangles, only long edges."""
    surface = Blocks(even(nx), even(ny, 0, SIZE * ny // max(nx, ny)), [0, height])
    surface.sheet(2, 0, 1)
    surface.sheet(2, 1, 2)
    x, y, _ = surface.cuts
    rings = [ring((0, 0), (x[-1], y[-1]), z) for z in levels]
    for corners in rings:
        rectangle(surface, corners, 4)
    for z, corners in ((0, rings[0]), (height, rings[-1])):
        rim = [[(v, 0, z) for v in x], [(x[-1], v, z) for v in y],
               [(v, y[-1], z) for v in reversed(x)], [(0, v, z) for v in reversed(y)]]
        for k, line in enumerate(rim):
            a, b = corners[k], corners[(k + 1) % 4]
            pencil = [(line[i], line[i + 1], a) for i in range(len(line) - 1)]
            surface.add([*pencil, (line[-1], b, a)], 3)
    for low, high in zip(rings, rings[1:]):
        for k in range(4):
            rectangle(surface, [low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]], 3)
    return surface


def worst(n, m, height, free):
    if not free:
        return box_with_levels(n, n, even(m + 1, 0, height)[1:-1], height)
    surface = box_of_squares(n, 3, height)
    for z in even(m + 1, 0, height)[1:-1]:
        rectangle(surface, ring((SIZE // 16, SIZE // 16), (SIZE - SIZE // 16, SIZE - SIZE // 16), z), 4)
    return surface


def box_of_squares(n, layers, height):
    surface = Blocks(even(n), even(n), even(layers, 0, height))
    for axis in range(3):
        surface.sheet(axis, 0, 1 if axis == 2 else 3)
        surface.sheet(axis, len(surface.cuts[axis]) - 1, 2 if axis == 2 else 3)
    return surface


def dangling(n, layers, height):
    surface = box_of_squares(n, layers, height)
    inset = SIZE // 10
    rectangle(surface, ring((inset, inset), (SIZE - inset, SIZE - inset), height // 2), 4)
    return surface


def touching(nx, ny, height):
    return box_with_levels(nx, ny, [height // 2], height)


def semiconductor(n, thickness):
    """Substrate (1), a thin oxide on all of it (2), a gate on the middle of that (3), and a passivation (4) round it."""
    layers = [0, SIZE // 4, SIZE // 4 + thickness, SIZE // 2, SIZE // 2 + SIZE // 8]
    surface = Blocks(even(3 * n), even(3 * n), layers)

    def material(i, j, k):
        in_the_middle = n <= i < 2 * n and n <= j < 2 * n
        return [1, 2, 3 if in_the_middle else 4, 4][k]

    surface.materials(material)
    return surface


def gap(n, width):
    surface = Blocks(even(n), even(n), [0, SIZE // 4, SIZE // 4 + width, SIZE // 2 + width])
    surface.materials(lambda i, j, k: [1, 0, 2][k])
    return surface


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["worst", "dangling", "touching", "semiconductor", "gap"])
    parser.add_argument("file")
    parser.add_argument("-n", type=int)
    parser.add_argument("-m", type=int)
    parser.add_argument("--ny", type=int)
    parser.add_argument("--height", type=float, default=0.3)
    parser.add_argument("--thickness", type=float, default=0.01)
    parser.add_argument("--gap", type=float, default=1e-6)
    parser.add_argument("--free", action="store_true")
    a = parser.parse_args()

    def length(x):
        if not 1 <= round(x * SIZE) <= SIZE:
            raise SystemExit(f"{x:g} of the size is not between {1 / SIZE:.2g} and 1")
        return round(x * SIZE)

    made = {"worst": lambda: worst(a.n or 16, a.m or 16, length(a.height), a.free),
            "dangling": lambda: dangling(a.n or 20, a.m or 3, length(a.height)),
            "touching": lambda: touching(a.n or 93, a.ny or a.n or 69, length(a.height)),
            "semiconductor": lambda: semiconductor(a.n or 4, length(a.thickness)),
            "gap": lambda: gap(a.n or 8, length(a.gap))}[a.kind]()
    made.write(a.file)
    print(f"{a.file}: {len(made.triangles)} triangles")


if __name__ == "__main__":
    main()
