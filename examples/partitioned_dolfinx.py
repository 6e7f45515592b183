"""Solves a Poisson problem with DOLFINx on a mesh whose partition Holdfast has made.

    holdfast mesh part.off -o part.xdmf --size 0.1 --partition 2
    mpirun -n 2 /usr/bin/python3 partitioned_dolfinx.py part.xdmf

-div grad u = 1, u = 0 on the boundary, linear elements. As many processes as parts keep the parts and their ghosts; any
other number lets DOLFINx partition. Also takes a .msh. Prints "TETRAHEDRA GHOSTS INTEGRAL ENERGY": the number of cells,
that of ghosts on all processes, the integral of u, and half of that of |grad u|^2. Needs Debian's python3-dolfinx and
python3-h5py, and python3-gmsh for .msh.
"""
import sys
from pathlib import Path

import dolfinx
import dolfinx.fem.petsc
import numpy
import ufl
from mpi4py import MPI
from petsc4py import PETSc

LINEAR = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 1))


def read_parts(path, comm):
    """The mesh of a partitioned NAME.xdmf: process k has the cells of part k, and its ghosts."""
    import h5py

    with h5py.File(path.with_suffix(".h5"), "r") as file:
        part = file["part"][:]
        rows = numpy.flatnonzero(part == comm.rank)
        first, end = (rows[0], rows[-1] + 1) if len(rows) else (0, 0)  # cells are ordered by part
        cells = file["tetrahedra"][first:end].astype(numpy.int64)
        offsets = file["ghost_offsets"][first:end + 1]
        ghosts = file["ghosts"][offsets[0]:offsets[-1]]
        count = file["points"].shape[0]
        share = [count * r // comm.size for r in range(comm.size + 1)]
        points = file["points"][share[comm.rank]:share[comm.rank + 1]]

    def keep(*_):
        """Destinations of each cell: its owner, then those that have it as a ghost."""
        lists = [numpy.append(numpy.int32(comm.rank), ghosts[a:b])
                 for a, b in zip(offsets[:-1] - offsets[0], offsets[1:] - offsets[0])]
        data = numpy.concatenate(lists) if lists else numpy.zeros(0, numpy.int32)
        return dolfinx.cpp.graph.AdjacencyList_int32(
            data.astype(numpy.int32), numpy.cumsum([0] + [len(l) for l in lists]).astype(numpy.int32))

    return dolfinx.mesh.create_mesh(comm, cells, points, LINEAR, partitioner=keep)


def read(path, comm):
    if path.suffix == ".msh":
        import gmsh
        from dolfinx.io import gmshio
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        if comm.rank == 0:
            gmsh.open(str(path))
        mesh = gmshio.model_to_mesh(gmsh.model, comm, 0, gdim=3)[0]
        gmsh.finalize()
        return mesh
    try:
        import h5py
        with h5py.File(path.with_suffix(".h5"), "r") as file:
            parts = int(file["part"][:].max()) + 1 if "part" in file else 0
    except ImportError:
        parts = 0
    if parts == comm.size:
        return read_parts(path, comm)
    with dolfinx.io.XDMFFile(comm, str(path), "r") as file:
        return file.read_mesh(name="mesh")


def solve(mesh):
    space = dolfinx.fem.FunctionSpace(mesh, ("Lagrange", 1))
    mesh.topology.create_connectivity(2, 3)
    facets = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    fixed = dolfinx.fem.dirichletbc(PETSc.ScalarType(0), dolfinx.fem.locate_dofs_topological(space, 2, facets), space)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    problem = dolfinx.fem.petsc.LinearProblem(
        ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, dolfinx.fem.Constant(mesh, PETSc.ScalarType(1)) * v * ufl.dx,
        bcs=[fixed], petsc_options={"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-12})
    solution = problem.solve()

    def integral(form):
        return mesh.comm.allreduce(dolfinx.fem.assemble_scalar(dolfinx.fem.form(form)), MPI.SUM)

    return integral(solution * ufl.dx), integral(0.5 * ufl.inner(ufl.grad(solution), ufl.grad(solution)) * ufl.dx)


def main():
    comm = MPI.COMM_WORLD
    mesh = read(Path(sys.argv[1]), comm)
    cells = mesh.topology.index_map(3)
    ghosts = comm.allreduce(cells.num_ghosts, MPI.SUM)
    total, energy = solve(mesh)
    if comm.rank == 0:
        print(f"{cells.size_global} {ghosts} {total:.12g} {energy:.12g}")


main()
