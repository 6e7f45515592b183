"""Makes a background mesh with a metric at each vertex, FILE.mesh and FILE.sol beside it: a layer along a plane.

    make_layer.py FILE.mesh --low X Y Z --high X Y Z [--axis x|y|z] [--at A] [--across H] [--along T] [--growth G]

Edges across the plane have length H in it, G more of the distance from it, and T at most; along the plane they have T.
The mesh fills the box from low to high; A is the plane's place on the axis (default: the middle).
"""
import argparse
from itertools import product
from pathlib import Path


def layers(low, high, at, across, along, growth):
    """Where the sizes are given: from the plane outward, one size apart."""
    places = {low, high}
    for way in (-1, 1):
        x = at
        while low <= x <= high:
            places.add(x)
            x += way * min(along, across + growth * abs(x - at))
    return sorted(places)


def background(low, high, axis, at, across, along, growth):
    """Vertices, tetrahedra, and the metrics m11 m12 m22 m13 m23 m33 at the vertices."""
    others = [k for k in range(3) if k != axis]
    vertices, metrics, tetrahedra = [], [], []
    for x in layers(low[axis], high[axis], at, across, along, growth):
        size = [along] * 3
        size[axis] = min(along, across + growth * abs(x - at))
        for i, j in product((0, 1), (0, 1)):
            corner = [0.0] * 3
            corner[axis] = x
            corner[others[0]] = (low, high)[i][others[0]]
            corner[others[1]] = (low, high)[j][others[1]]
            vertices.append(corner)
            metrics.append((size[0]**-2, 0, size[1]**-2, 0, 0, size[2]**-2))
    for k in range(0, len(vertices) - 4, 4):  # boxes between layers, each cut round the diagonal from 0 to 7
        for a, b in ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)):
            tetrahedra.append([k, k + a, k + b, k + 7])
    return vertices, tetrahedra, metrics


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("--low", type=float, nargs=3, required=True)
    parser.add_argument("--high", type=float, nargs=3, required=True)
    parser.add_argument("--axis", choices="xyz", default="z")
    parser.add_argument("--at", type=float)
    parser.add_argument("--across", type=float, default=0.02)
    parser.add_argument("--along", type=float, default=0.2)
    parser.add_argument("--growth", type=float, default=0.3)
    options = parser.parse_args()
    axis = "xyz".index(options.axis)
    at = (options.low[axis] + options.high[axis]) / 2 if options.at is None else options.at
    vertices, tetrahedra, metrics = background(options.low, options.high, axis, at, options.across, options.along,
                                               options.growth)
    head = "MeshVersionFormatted 2\nDimension 3\n"
    with open(options.file.with_suffix(".mesh"), "w", encoding="ascii") as mesh:
        mesh.write(f"{head}Vertices\n{len(vertices)}\n" + "".join(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in vertices))
        mesh.write(f"Tetrahedra\n{len(tetrahedra)}\n"
                   + "".join(" ".join(str(v + 1) for v in t) + " 0\n" for t in tetrahedra) + "End\n")
    with open(options.file.with_suffix(".sol"), "w", encoding="ascii") as sol:
        sol.write(f"{head}SolAtVertices\n{len(metrics)}\n1 3\n"
                  + "".join(" ".join(map(repr, m)) + "\n" for m in metrics) + "End\n")


if __name__ == "__main__":
    main()
