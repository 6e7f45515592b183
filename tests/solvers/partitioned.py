"""Solvers on several processes with meshes in pieces, compared with one process on the whole mesh.

    partitioned.py PROGRAM [--write docs/scaling.md]

DOLFINx (mpirun -n 2) reads a partitioned .xdmf and .msh, OpenFOAM (mpirun -n 2) a case with processorN, VTK a .pvtu and
Gmsh a partitioned .msh: by METIS, and of a surface that was split, meshed in parts, and not joined. Exit code 0 if all
agree, 1 if not, 77 if none of the programs is installed.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PYTHON = "/usr/bin/python3"  # of Debian's packages
MPI = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1",
           WM_PROJECT_DIR="/usr/share/openfoam", OMPI_MCA_btl_vader_single_copy_mechanism="none",
           OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")
SIZE = 0.12

VTK = """
import sys, vtk
reader = vtk.vtkXMLPUnstructuredGridReader(); reader.SetFileName(sys.argv[1]); reader.Update()
grid = reader.GetOutput(); ghost = grid.GetCellData().GetArray("vtkGhostType")
print(sum(ghost.GetValue(i) == 0 for i in range(grid.GetNumberOfCells())), grid.GetNumberOfCells())
"""
GMSH = """
import sys, gmsh
gmsh.initialize(); gmsh.option.setNumber("General.Terminal", 0); gmsh.open(sys.argv[1])
tetrahedra = ghosts = between = 0
parts = set()
for d, tag in gmsh.model.getEntities():
    kind = gmsh.model.getType(d, tag)
    parts.update(gmsh.model.getPartitions(d, tag))
    if "Ghost" in kind:
        ghosts += len(gmsh.model.mesh.getGhostElements(d, tag)[0])
    elif d == 3:
        tetrahedra += sum(len(t) for t in gmsh.model.mesh.getElements(d, tag)[1])
    elif d == 2 and len(gmsh.model.getPartitions(d, tag)) == 2:
        between += sum(len(t) for t in gmsh.model.mesh.getElements(d, tag)[1])
print(tetrahedra, len(parts), ghosts, between)
"""
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application laplacianFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep;
writeInterval 1; writeFormat ascii; writePrecision 12; timeFormat general;
"""
SCHEMES = """FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }
ddtSchemes { default steadyState; } gradSchemes { default leastSquares; } divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
"""
SOLUTION = """FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }
solvers { T { solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; maxIter 5000; } }
SIMPLE { nNonOrthogonalCorrectors 20; }
"""
DECOMPOSED = "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\nnumberOfSubdomains 2; method simple;\n"
HEAT = """FoamFile { version 2.0; format ascii; class volScalarField; object T; }
dimensions [0 0 0 1 0 0 0]; internalField uniform 0;
boundaryField { hot { type fixedValue; value uniform 1; } cold { type fixedValue; value uniform 0; }
side { type zeroGradient; } "procBoundary.*" { type processor; value uniform 0; } }
"""


def run(*command, environment=None):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=environment, timeout=900)
    if done.returncode:
        raise RuntimeError(" ".join(map(str, command)) + "\n" + (done.stdout + done.stderr)[-2000:])
    return done.stdout


def mpirun(count, *command):
    return run("mpirun", "-n", count, *command, environment=MPI)


def write_surface(path):
    """A box of 2 by 1 by 1 with a step, of triangles of about the size; one marker each for hot, cold and side."""
    n = round(1 / SIZE)
    numbers, triangles = {}, []

    def vertex(*p):
        return numbers.setdefault(p, len(numbers))

    for axis, low, high in ((0, 1, 2), (1, 3, 3), (2, 3, 3)):
        extent = [2 * n, n, n]
        u, v = [k for k in range(3) if k != axis]
        for at, marker in ((0, low), (extent[axis], high)):
            for i in range(extent[u]):
                for j in range(extent[v]):
                    def corner(a, b):
                        p = [0, 0, 0]
                        p[axis], p[u], p[v] = at, a, b
                        return vertex(*p)
                    quad = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
                    triangles += [((quad[0], quad[1], quad[2]), marker), ((quad[0], quad[2], quad[3]), marker)]
    path.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(numbers)
                    + "".join("%r %r %r 0\n" % tuple(x / n for x in p) for p in numbers)
                    + "Triangles\n%d\n" % len(triangles)
                    + "".join("%d %d %d %d\n" % (*[v + 1 for v in t], m) for t, m in triangles) + "End\n")


NAMES = ("--name", "1=hot", "--name", "2=cold", "--name", "3=side")


def split(program, folder):
    parts = folder / "parts"
    run(program, "split", folder / "s.mesh", "--parts", 2, "--size", SIZE, "-o", parts, *NAMES)
    for poly in sorted(parts.glob("part_*.poly")):
        run(program, "mesh", poly, "-o", poly.with_suffix(".vtu"), "-q")
    return parts


def foam_case(case):
    (case / "system").mkdir(parents=True)
    (case / "constant").mkdir()
    for name, text in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", SOLUTION),
                       ("decomposeParDict", DECOMPOSED)):
        (case / "system" / name).write_text(text)
    (case / "constant" / "transportProperties").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object transportProperties; }\nDT DT [0 2 -1 0 0 0 0] 1;\n")


def temperatures(folder):
    text = (folder / "1" / "T").read_text()
    text = text[text.index("nonuniform"):]
    return [float(x) for x in text[text.index("(") + 1:text.index(")")].split()]


def openfoam(folder, write_whole, write_pieces):
    """Rows for a case written as a whole and in two pieces. Fields are compared sorted: cells are in another order."""
    whole, pieces = folder / "whole", folder / "pieces"
    for case, write in ((whole, write_whole), (pieces, write_pieces)):
        foam_case(case)
        write(case)
    (whole / "0").mkdir()
    (whole / "0" / "T").write_text(HEAT)
    run("laplacianFoam", "-case", whole, environment=MPI)
    text = mpirun(2, "checkMesh", "-parallel", "-case", pieces)
    if "Mesh OK" not in text:
        raise RuntimeError("checkMesh -parallel: " + text[-2000:])
    for k in range(2):
        (pieces / f"processor{k}" / "0").mkdir()
        (pieces / f"processor{k}" / "0" / "T").write_text(HEAT)
    mpirun(2, "laplacianFoam", "-parallel", "-case", pieces)
    one = sorted(temperatures(whole))
    two = sorted(temperatures(pieces / "processor0") + temperatures(pieces / "processor1"))
    if len(one) != len(two):
        raise RuntimeError(f"OpenFOAM: {len(one)} cells and {len(two)}")
    return [("checkMesh -parallel says Mesh OK", 1, 1, 0),
            ("laplacianFoam -parallel on processorN: largest difference of T", max(abs(a - b) for a, b in zip(one, two)), 0, 1e-7)]


def dolfinx(whole, pieces, what):
    script = HERE.parent.parent / "examples" / "partitioned_dolfinx.py"
    cells, _, integral, energy = map(float, run(PYTHON, script, whole, environment=MPI).split())
    found = [float(x) for x in mpirun(2, PYTHON, script, pieces).split()]
    rows = [(f"DOLFINx, mpirun -n 2, {what}: cells", found[0], cells, 0),
            (f"DOLFINx, mpirun -n 2, {what}: integral of u", found[2], integral, 1e-8 * abs(integral)),
            (f"DOLFINx, mpirun -n 2, {what}: energy", found[3], energy, 1e-8 * abs(energy))]
    return rows


def has(module):
    return subprocess.run([PYTHON, "-c", f"import {module}"], capture_output=True).returncode == 0


def compare(program, folder, by_msh):
    """Yields rows (what, found, expected, tolerance)."""
    write_surface(folder / "s.mesh")
    run(program, "mesh", folder / "s.mesh", "-o", folder / "whole.vtu", "--size", SIZE, *NAMES)
    parts = split(program, folder)
    run(program, "join", parts, "-o", folder / "joined.vtu")
    run(program, "check", folder / "s.mesh", folder / "joined.vtu")

    def write(source, pieces):
        """By METIS from a mesh; or the parts themselves."""
        def to(path, *options):
            if pieces == 0:
                run(program, "convert", source, path, *options)
            elif source == parts:
                run(program, "join", parts, "-o", path, "--as-parts", *options)
            else:
                run(program, "convert", source, path, "--partition", pieces, *options)
        return to

    for name, whole, pieces in (("METIS", folder / "whole.vtu", write(folder / "whole.vtu", 2)),
                                ("parts of `split`", folder / "joined.vtu", write(parts, 2))):
        place = folder / ("metis" if name == "METIS" else "split")
        place.mkdir()
        as_one = write(whole, 0)
        as_one(place / "one.xdmf")
        as_one(place / "one.mesh")
        words = (place / "one.mesh").read_text().split()
        count = int(words[words.index("Tetrahedra") + 1])
        for ending in ("pvtu", "msh", "xdmf"):
            pieces(place / f"two.{ending}")
        if has("vtk"):
            owned, everything = map(int, run(PYTHON, "-c", VTK, place / "two.pvtu").split())
            yield f"VTK, .pvtu, {name}: tetrahedra that are no ghosts", owned, count, 0
            yield f"VTK, .pvtu, {name}: there are ghosts", float(everything > owned), 1, 0
        if has("gmsh"):
            found, parts_found, ghosts, between = map(int, run(PYTHON, "-c", GMSH, place / "two.msh").split())
            yield f"Gmsh, .msh, {name}: tetrahedra", found, count, 0
            yield f"Gmsh, .msh, {name}: parts", parts_found, 2, 0
            yield f"Gmsh, .msh, {name}: ghosts and faces between parts are there", float(ghosts > 0 and between > 0), 1, 0
        if has("dolfinx") and shutil.which("mpirun"):
            yield from dolfinx(place / "one.xdmf", place / "two.xdmf", f".xdmf, {name}")
            if has("gmsh") and by_msh:
                yield from dolfinx(place / "one.xdmf", place / "two.msh", f".msh, {name}")
        if shutil.which("laplacianFoam") and shutil.which("mpirun"):
            for row in openfoam(place, lambda case: as_one(case, "--format", "openfoam"),
                                lambda case: pieces(case, "--format", "openfoam")):
                yield f"OpenFOAM, {name}: {row[0]}", *row[1:]


BEGIN, END = "<!-- solvers -->\n", "<!-- end of solvers -->\n"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("--write", type=Path)
    options.add_argument("--no-msh", action="store_true", help="leave out DOLFINx on the .msh")
    arguments = options.parse_args()
    if not shutil.which("mpirun") and not has("vtk") and not has("gmsh"):
        print("skipped: none of the programs is installed")
        return 77
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for row in compare(arguments.program.resolve(), Path(folder), not arguments.no_msh):
            rows.append(row)
            print(*row, "" if abs(row[1] - row[2]) <= row[3] else "WRONG", flush=True)
    if arguments.write:
        table = "| | found | expected |\n|---|---|---|\n" + "".join(
            f"| {what} | {found:.9g} | {expected:.9g}{f' ± {tolerance:.1g}' if tolerance else ''} |\n"
            for what, found, expected, tolerance in rows)
        text = arguments.write.read_text()
        before, _, rest = text.partition(BEGIN)
        arguments.write.write_text(before + BEGIN + "\n" + table + "\n" + END + rest.partition(END)[2])
    wrong = [row for row in rows if abs(row[1] - row[2]) > row[3]]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
