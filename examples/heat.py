"""Steady heat conduction in a part, by linear elements, with NumPy and SciPy alone.

    heat.py part.mesh [-o temperature.vtk] [--conductivity 0.045]

The lowest points are held at 20 degrees and the highest at 100; nothing flows through the rest of the surface. Lengths
are millimetres, the conductivity is in W/(mm K) (steel: 0.045). Prints the heat that flows through the part, which is the
same at the hot and the cold end. Needs python3-scipy. Exit code: 77 without it.
"""
import argparse
import sys

try:
    import numpy as np
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def read_mesh(path):
    """Points and tetrahedra of a .mesh file."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()

    def table(name, columns):
        at = words.index(name)
        count = int(words[at + 1])
        return np.array(words[at + 2: at + 2 + columns * count], dtype=float).reshape(count, columns)[:, :-1]

    return table("Vertices", 4), table("Tetrahedra", 5).astype(np.int64) - 1


def stiffness(points, tets, conductivity):
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    volume = np.linalg.det(edges) / 6
    inner = np.linalg.inv(edges).transpose(0, 2, 1)  # gradients of the last three hat functions
    gradients = np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1)
    local = conductivity * volume[:, None, None] * (gradients @ gradients.transpose(0, 2, 1))
    rows = np.repeat(tets, 4, axis=1).ravel()
    columns = np.tile(tets, (1, 4)).ravel()
    return coo_matrix((local.ravel(), (rows, columns)), shape=(len(points),) * 2).tocsr()


def write_vtk(path, points, tets, temperature):
    with open(path, "w", encoding="ascii") as out:
        out.write("# vtk DataFile Version 3.0\ntemperature\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n")
        np.savetxt(out, points, "%.17g")
        out.write(f"CELLS {len(tets)} {5 * len(tets)}\n")
        np.savetxt(out, np.insert(tets, 0, 4, axis=1), "%d")
        out.write(f"CELL_TYPES {len(tets)}\n" + "10\n" * len(tets))
        out.write(f"POINT_DATA {len(points)}\nSCALARS temperature double 1\nLOOKUP_TABLE default\n")
        np.savetxt(out, temperature, "%.9g")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("-o", dest="output")
    parser.add_argument("--conductivity", type=float, default=0.045)
    arguments = parser.parse_args()
    points, tets = read_mesh(arguments.mesh)
    matrix = stiffness(points, tets, arguments.conductivity)
    height = points[:, 2]
    hot, cold = height == height.max(), height == height.min()
    free = ~(hot | cold)
    temperature = np.where(hot, 100.0, 20.0)
    temperature[free] = spsolve(matrix[free][:, free], -(matrix[free][:, ~free] @ temperature[~free]))
    heat = matrix @ temperature
    print(f"{len(points)} points, {len(tets)} tetrahedra; {temperature.min():.1f} to {temperature.max():.1f} degrees")
    print(f"{heat[hot].sum():.1f} W flow in at {hot.sum()} points, {-heat[cold].sum():.1f} W out at {cold.sum()} points")
    if arguments.output:
        write_vtk(arguments.output, points, tets, temperature)
    return 0 if abs(heat[hot].sum() + heat[cold].sum()) < 1e-6 * heat[hot].sum() else 1


if __name__ == "__main__":
    sys.exit(main())
