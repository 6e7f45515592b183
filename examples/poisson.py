"""Solves a Poisson problem on meshes of Holdfast with DOLFINx, and shows that the error falls as theory says.

    poisson.py path/to/holdfast [--levels 3]

-div grad u = f on the unit cube, u = sin(pi x) sin(pi y) sin(pi z), linear elements: the L2 error falls with the square
of the size. Each level halves `--size` and the triangles of the cube's surface, which the mesh keeps. Needs Debian's
python3-dolfinx; run it by /usr/bin/python3. Exit code: 0 if the rate is what it should be, 77 without DOLFINx.
"""
import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import dolfinx.fem
    import dolfinx.fem.petsc
    import dolfinx.mesh
    import numpy
    import ufl
    from mpi4py import MPI
    from petsc4py import PETSc
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def write_cube(path, n):
    """The unit cube's surface as 12 n^2 triangles."""
    numbers, triangles = {}, []

    def vertex(p):
        return numbers.setdefault(p, len(numbers))

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    def corner(u, v):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, u, v
                        return vertex(tuple(p))
                    a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
                    quad = [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
                    triangles += quad if side else [t[::-1] for t in quad]
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(numbers)} {len(triangles)} 0\n")
        out.writelines("%r %r %r\n" % tuple(x / n for x in p) for p in numbers)
        out.writelines("3 %d %d %d\n" % t for t in triangles)


def read_gmf(path):
    """Vertices and tetrahedra of a .mesh file."""
    words = path.read_text().split()
    at = words.index("Vertices")
    count = int(words[at + 1])
    points = numpy.array(words[at + 2: at + 2 + 4 * count], dtype=float).reshape(count, 4)[:, :3]
    at = words.index("Tetrahedra")
    count = int(words[at + 1])
    tets = numpy.array(words[at + 2: at + 2 + 5 * count], dtype=numpy.int64).reshape(count, 5)[:, :4] - 1
    return points, tets


def error_on(points, tets):
    """The L2 error of the solution with linear elements."""
    cell = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 1))
    mesh = dolfinx.mesh.create_mesh(MPI.COMM_SELF, tets, points, cell)
    space = dolfinx.fem.FunctionSpace(mesh, ("Lagrange", 1))
    x = ufl.SpatialCoordinate(mesh)
    exact = ufl.sin(ufl.pi * x[0]) * ufl.sin(ufl.pi * x[1]) * ufl.sin(ufl.pi * x[2])
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    facets = dolfinx.mesh.locate_entities_boundary(mesh, 2, lambda p: numpy.full(p.shape[1], True))
    fixed = dolfinx.fem.dirichletbc(PETSc.ScalarType(0), dolfinx.fem.locate_dofs_topological(space, 2, facets), space)
    problem = dolfinx.fem.petsc.LinearProblem(
        ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, 3 * math.pi ** 2 * exact * v * ufl.dx(degree=4), bcs=[fixed],
        petsc_options={"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-10})
    solution = problem.solve()
    return math.sqrt(dolfinx.fem.assemble_scalar(dolfinx.fem.form((solution - exact) ** 2 * ufl.dx(degree=4))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("holdfast", type=Path)
    parser.add_argument("--levels", type=int, default=3)
    arguments = parser.parse_args()
    errors = []
    with tempfile.TemporaryDirectory() as folder:
        for level in range(arguments.levels):
            n = 4 << level
            surface, volume = Path(folder, "cube.off"), Path(folder, "cube.mesh")
            write_cube(surface, n)
            subprocess.run([arguments.holdfast, "mesh", surface, "-o", volume, "-q", "--size", str(1 / n)], check=True)
            points, tets = read_gmf(volume)
            errors.append(error_on(points, tets))
            rate = f", rate {math.log2(errors[-2] / errors[-1]):.2f}" if level else ""
            print(f"size 1/{n}: {len(tets)} tetrahedra, L2 error {errors[-1]:.3e}{rate}", flush=True)
    last = math.log2(errors[-2] / errors[-1])
    return 0 if 1.8 < last < 2.4 else 1


if __name__ == "__main__":
    sys.exit(main())
