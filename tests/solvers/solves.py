"""Problems whose answers are known, solved by the programs on meshes of Holdfast.

Each function takes the program and a folder and returns rows (what, found, expected, tolerance). `second_order` says
whether the program has elements of second order (mesh --order 2).
"""
import math
import os
import re
import subprocess
from pathlib import Path

import numpy as np

import read_with
from assembly import box, mesh, write_triangles


def run(command, folder, environment=None, timeout=600):
    done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True, timeout=timeout,
                          env=environment)
    return done.returncode, done.stdout + done.stderr


def write_boxes(path, boxes, markers, spacing):
    """Boxes side by side in x as one .mesh; `markers[i]` has the six sides' markers. The side between two boxes occurs once."""
    triangles = []
    for i, ((low, high), sides) in enumerate(zip(boxes, markers)):
        triangles += [(corners, sides[side - 1]) for corners, side in box(low, high, spacing) if i == 0 or side != 1]
    write_triangles(path, triangles)


LENGTH, YOUNG, POISSON = 10.0, 1000.0, 0.3


def read_inp(path):
    """Nodes, elements and the sides of the surface 'tip' of an .inp."""
    nodes, elements, tip, block = {}, {}, [], ""
    for line in path.read_text().splitlines():
        if line.startswith("*"):
            block = line.upper()
            continue
        fields = [f.strip() for f in line.rstrip(",").split(",")]
        if block.startswith("*NODE"):
            nodes[int(fields[0])] = np.array([float(x) for x in fields[1:4]])
        elif block.startswith("*ELEMENT"):
            elements[int(fields[0])] = [int(v) for v in fields[1:]]
        elif block.startswith("*SURFACE, NAME=TIP"):
            tip.append((int(fields[0]), int(fields[1][1:])))
    return nodes, elements, tip


SIDES = {1: (0, 1, 2, 4, 5, 6), 2: (0, 3, 1, 7, 8, 4), 3: (1, 3, 2, 8, 9, 5), 4: (2, 3, 0, 9, 7, 6)}


def cantilever(program, folder, across, order):
    """The ratio of the deflection of a beam's end to that of Timoshenko's beam."""
    surface = folder / "beam.mesh"
    write_boxes(surface, [((0.0, 0.0, 0.0), (LENGTH, 1.0, 1.0))], [(1, 2, 3, 3, 3, 3)], 1.0 / across)
    inp = folder / f"beam{across}_{order}.inp"
    command = [program, "mesh", surface, "-o", inp, "--size", 1.0 / across, "--name", "1=root", "--name", "2=tip", "--name",
               "region:1=beam", "--region", f"5,0.5,0.5,1", "-q"] + (["--order", "2"] if order == 2 else [])
    code, text = run(command, folder)
    if code:
        raise ValueError(text)
    nodes, elements, tip = read_inp(inp)
    loads = {}
    for element, side in tip:
        corners = [elements[element][i] for i in SIDES[side][:6 if order == 2 else 3]]
        a, b, c = (nodes[v] for v in corners[:3])
        area = np.linalg.norm(np.cross(b - a, c - a)) / 2
        # Loads of a constant traction: all at the midpoints of the edges of a triangle of second order.
        for v in corners[3:] if order == 2 else corners:
            loads[v] = loads.get(v, 0) + area / 3
    deck = folder / f"deck{across}_{order}.inp"
    deck.write_text(f"*INCLUDE, INPUT={inp.name}\n*MATERIAL, NAME=M\n*ELASTIC\n{YOUNG}, {POISSON}\n"
                    "*SOLID SECTION, ELSET=beam, MATERIAL=M\n*BOUNDARY\nroot, 1, 3\n*STEP\n*STATIC\n*CLOAD\n"
                    + "".join(f"{v}, 3, {-p!r}\n" for v, p in loads.items())
                    + "*NODE PRINT, NSET=tip\nU\n*END STEP\n")
    code, text = run(["ccx", deck.stem], folder)
    if "Job finished" not in text:
        raise ValueError("ccx: " + text[-400:])
    rows = [line.split() for line in deck.with_suffix(".dat").read_text().splitlines()]
    found = -np.mean([float(r[3]) for r in rows if len(r) == 4 and r[0].isdigit()])
    shear = YOUNG / (2 * (1 + POISSON)) * 10 * (1 + POISSON) / (12 + 11 * POISSON)
    return found / (LENGTH ** 3 / (3 * YOUNG / 12) + LENGTH / shear)


def calculix(program, folder, second_order):
    rows = []
    shares = [cantilever(program, folder, n, 1) for n in (1, 2, 4)]
    for n, share in zip((1, 2, 4), shares):
        rows.append((f"CalculiX: cantilever, first order, {n} across, over Timoshenko", share, 0.55, 0.45))
    rows.append(("CalculiX: first order gets better with each halving", float(shares[0] < shares[1] < shares[2]), 1, 0))
    if second_order:
        for n in (1, 2):
            rows.append((f"CalculiX: cantilever, second order, {n} across, over Timoshenko",
                         cantilever(program, folder, n, 2), 0.99, 0.02))
    return rows


def openfoam(program, folder, second_order):
    """Heat between two patches: the temperature is linear."""
    case = folder / "case"
    read_with.make_case(case)
    mesh(program, folder, case / "constant" / "polyMesh", size=0.25)
    code, text = read_with.foam(case, "checkMesh")
    rows = [("OpenFOAM: checkMesh says Mesh OK", float("Mesh OK" in text), 1, 0)]
    (case / "0").mkdir()
    (case / "constant" / "transportProperties").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object transportProperties; }\nDT DT [0 2 -1 0 0 0 0] 1;\n")
    (case / "0" / "T").write_text(
        "FoamFile { version 2.0; format ascii; class volScalarField; object T; }\ndimensions [0 0 0 1 0 0 0];\n"
        "internalField uniform 0;\nboundaryField {\ninlet { type fixedValue; value uniform 0; }\n"
        'outlet { type fixedValue; value uniform 3; }\n"(left|right|bottom|top)" { type zeroGradient; }\n}\n')
    code, text = read_with.foam(case, "laplacianFoam")
    if code:
        raise ValueError("laplacianFoam: " + text[-600:])
    values = (case / "1" / "T").read_text()
    values = values[values.index("nonuniform"):]
    temperatures = np.array([float(x) for x in values[values.index("(") + 1:values.index(")")].split()])
    folder = case / "constant" / "polyMesh"
    points = np.array([[float(x) for x in p.split()] for p in read_with.foam_list(folder / "points", r"\(([-\d.e+ ]+)\)")])
    faces = [list(map(int, f.split())) for f in read_with.foam_list(folder / "faces", r"3\(([\d ]+)\)")]
    owner = [int(o) for o in read_with.foam_list(folder / "owner", r"\n(\d+)(?=\n)")]
    neighbour = [int(o) for o in read_with.foam_list(folder / "neighbour", r"\n(\d+)(?=\n)")]
    corners = [set() for _ in temperatures]
    for cells in (owner, neighbour):
        for face, cell in zip(faces, cells):
            corners[cell].update(face)
    centres = np.array([points[sorted(c)].mean(axis=0) for c in corners])
    rows.append(("OpenFOAM: laplacianFoam, largest error of T = x", float(np.abs(temperatures - centres[:, 0]).max()), 0, 2e-3))
    return rows


SOLUTION = "sin(pi*x/3)*sin(pi*y/2)*sin(pi*z)"
SOURCE = "pi^2*(1./9+1./4+1)"


def freefem(program, folder, second_order):
    errors = {1: [], 2: []}
    for size in (0.4, 0.2):
        name = folder / f"poisson{size}.meshb"
        mesh(program, folder, name, size=size)
        for order in (1, 2):
            script = folder / "poisson.edp"
            script.write_text(
                f'load "msh3"\nmesh3 Th = readmesh3("{name}");\nfespace Vh(Th, P{order}3d);\nVh u, v;\n'
                f'func e = {SOLUTION};\nfunc f = {SOURCE}*{SOLUTION};\n'
                "solve P(u, v, solver=CG, eps=1e-10) = int3d(Th, qforder=6)(dx(u)*dx(v) + dy(u)*dy(v) + dz(u)*dz(v))\n"
                "  - int3d(Th, qforder=8)(f*v) + on(1, 2, 3, 4, 5, 6, u=0);\n"
                'cout.precision(15);\ncout << "@ " << sqrt(int3d(Th, qforder=8)((u-e)^2)) << endl;\n')
            script.write_text(script.read_text().replace(f"P{order}3d", "P13d" if order == 1 else "P23d"))
            code, text = run(["FreeFem++", "-nw", "-v", "0", script], folder,
                             dict(os.environ, FF_LOADPATH=read_with.freefem_path()))
            found = re.search(r"@ ([\d.e+-]+)", text)
            if not found:
                raise ValueError("FreeFEM: " + text[-500:])
            errors[order].append(float(found[1]))
    return [(f"FreeFEM: Poisson, rate of P{k} in L2", math.log2(e[0] / e[1]), k + 1, 0.35) for k, e in errors.items()]


DOLFINX = """
import sys, math, numpy as np, ufl
from mpi4py import MPI
from petsc4py import PETSc
from dolfinx import fem, io
with io.XDMFFile(MPI.COMM_WORLD, sys.argv[1], "r") as file:
    mesh = file.read_mesh(name="mesh")
mesh.topology.create_connectivity(2, 3)
with io.XDMFFile(MPI.COMM_WORLD, sys.argv[1].replace(".xdmf", "_surface.xdmf"), "r") as file:
    facets = file.read_meshtags(mesh, name="mesh")
for order in (1, 2):
    V = fem.FunctionSpace(mesh, ("CG", order))
    x = ufl.SpatialCoordinate(mesh)
    exact = ufl.sin(math.pi*x[0]/3)*ufl.sin(math.pi*x[1]/2)*ufl.sin(math.pi*x[2])
    u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
    outer = np.concatenate([facets.find(i) for i in range(1, 7)])
    dofs = fem.locate_dofs_topological(V, 2, outer)
    bc = fem.dirichletbc(PETSc.ScalarType(0), dofs, V)
    problem = fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v))*ufl.dx,
        math.pi**2*(1/9+1/4+1)*exact*v*ufl.dx, bcs=[bc], petsc_options={"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-10})
    uh = problem.solve()
    print("@", order, math.sqrt(fem.assemble_scalar(fem.form((uh - exact)**2*ufl.dx))))
"""


def dolfinx(program, folder, second_order):
    errors = {1: [], 2: []}
    for size in (0.4, 0.2):
        name = folder / f"poisson{size}.xdmf"
        mesh(program, folder, name, size=size)
        code, text = run(["/usr/bin/python3", "-c", DOLFINX, name], folder)
        for order, error in re.findall(r"@ (\d) ([\d.e+-]+)", text):
            errors[int(order)].append(float(error))
        if code or not errors[2]:
            raise ValueError("DOLFINx: " + text[-500:])
    return [(f"DOLFINx: Poisson, rate of P{k} in L2", math.log2(e[0] / e[1]), k + 1, 0.35) for k, e in errors.items()]


GETFEM = """
import sys, getfem as gf, numpy as np
m = gf.Mesh("import", "gmsh", sys.argv[1])
mf = gf.MeshFem(m, 3); mf.set_classical_fem(1)
mim = gf.MeshIm(m, 2)
md = gf.Model("real")
md.add_fem_variable("u", mf)
for region, young in ((10, 1.0), (20, 3.0)):
    # Without a Poisson ratio the stress is E times the strain.
    md.add_linear_term(mim, f"{young}*((Grad_u+Grad_u')/2):Grad_Test_u", region)
md.add_initialized_data("g", [1.0, 0, 0])
md.add_source_term_brick(mim, "u", "g", 2)
md.add_Dirichlet_condition_with_multipliers(mim, "u", mf, 1)
md.solve()
u = md.variable("u").reshape(-1, 3)
x = mf.basic_dof_nodes().T[::3]
print("@", u[x[:, 0] > 1.999, 0].mean())
"""


def getfem(program, folder, second_order):
    """Two materials in a row under tension: their elongations add up."""
    surface = folder / "bar.mesh"
    write_boxes(surface, [((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), ((1.0, 0.0, 0.0), (2.0, 1.0, 1.0))],
                [(1, 7, 3, 3, 3, 3), (7, 2, 3, 3, 3, 3)], 0.5)
    name = folder / "bar.msh"
    code, text = run([program, "mesh", surface, "-o", name, "--size", 0.4, "--region", "0.5,0.5,0.5,10", "--region",
                      "1.5,0.5,0.5,20", "-q"], folder)
    if code:
        raise ValueError(text)
    code, text = run(["/usr/bin/python3", "-c", GETFEM, name], folder)
    found = re.search(r"@ ([\d.e+-]+)", text)
    if not found:
        raise ValueError("GetFEM: " + text[-500:])
    return [("GetFEM: end of a bar of two materials (E = 1 and 3) under tension", float(found[1]), 4 / 3, 1e-6)]


GETDP = """
Group { Low = Region[1]; High = Region[2]; Om = Region[{10, 20}]; }
Constraint { { Name T; Case { { Region Low; Value 0.; } { Region High; Value 3.; } } } }
FunctionSpace { { Name H; Type Form0; BasisFunction { { Name s; NameOfCoef v; Function BF_Node; Support Region[{Om, Low, High}];
                  Entity NodesOf[All]; } } Constraint { { NameOfCoef v; EntityType NodesOf; NameOfConstraint T; } } } }
Jacobian { { Name J; Case { { Region All; Jacobian Vol; } } } }
Integration { { Name I; Case { { Type Gauss; Case { { GeoElement Tetrahedron; NumberOfPoints 4; } } } } } }
Formulation { { Name F; Type FemEquation; Quantity { { Name u; Type Local; NameOfSpace H; } }
                Equation { Integral { [ Dof{d u}, {d u} ]; In Om; Jacobian J; Integration I; } } } }
Resolution { { Name R; System { { Name A; NameOfFormulation F; } } Operation { Generate[A]; Solve[A]; SaveSolution[A]; } } }
PostProcessing { { Name P; NameOfFormulation F; Quantity { { Name e; Value { Integral { [ SquNorm[{u} - X[]] ]; In Om; Jacobian J;
                   Integration I; } } } } } }
PostOperation { { Name O; NameOfPostProcessing P; Operation { Print[ e[Om], OnGlobal, Format Table, File "e.txt" ]; } } }
"""


def getdp(program, folder, second_order):
    """A potential between two sides is linear."""
    mesh(program, folder, folder / "a.msh", "--format", "msh2")
    (folder / "p.pro").write_text(GETDP)
    code, text = run(["getdp", "p.pro", "-msh", "a.msh", "-solve", "R", "-pos", "O"], folder)
    if code:
        raise ValueError("GetDP: " + text[-500:])
    error = math.sqrt(abs(float((folder / "e.txt").read_text().split()[-1])))
    return [("GetDP: Laplace between two sides, error of u = x in L2", error, 0, 1e-9)]


ESCRIPT = """
import sys
from esys.escript import FunctionOnBoundary, Lsup, Scalar, insertTaggedValues, kronecker, whereZero
from esys.escript.linearPDEs import LinearPDE
from esys.finley import ReadGmsh
domain = ReadGmsh(sys.argv[1], 3)
x = domain.getX()
# Held at one side, which the formula finds, and a flux through the other by its name: u = x.
pde = LinearPDE(domain, numEquations=1)
flux = insertTaggedValues(Scalar(0.0, FunctionOnBoundary(domain)), outlet=1.0)
pde.setValue(A=kronecker(3), y=flux, q=whereZero(x[0]), r=0.0)
pde.setSymmetryOn()
pde.getSolverOptions().setTolerance(1e-12)
print("@", Lsup(pde.getSolution() - x[0]))
"""


def escript(program, folder, second_order):
    """A flux through the side named 'outlet' makes a linear field, on elements of both orders."""
    rows = []
    (folder / "p.py").write_text(ESCRIPT)
    for order in (1, 2):
        mesh(program, folder, folder / f"a{order}.msh", "--order", order)
        code, text = run(["run-escript3", folder / "p.py", folder / f"a{order}.msh"], folder)
        found = re.search(r"@ ([\d.e+-]+)", text)
        if not found:
            raise ValueError("escript: " + text[-500:])
        rows.append((f"escript: flux through a named side, order {order}, largest error of u = x", float(found[1]), 0, 1e-9))
    return rows


DOLFIN = """
import sys, numpy as np
from dolfin import *
set_log_level(40)
mesh = Mesh()
with XDMFFile(sys.argv[1]) as file:
    file.read(mesh)
values = MeshValueCollection("size_t", mesh, 2)
with XDMFFile(sys.argv[1].replace(".xdmf", "_surface.xdmf")) as file:
    file.read(values, "marker")
sides = MeshFunction("size_t", mesh, values)
V = FunctionSpace(mesh, "CG", 1)
u, v, found = TrialFunction(V), TestFunction(V), Function(V)
solve(inner(grad(u), grad(v)) * dx == Constant(0) * v * dx, found,
      [DirichletBC(V, Constant(0), sides, 1), DirichletBC(V, Constant(3), sides, 2)])
print("@", np.abs(found.vector().get_local() - V.tabulate_dof_coordinates()[:, 0]).max())
"""


def dolfin(program, folder, second_order):
    mesh(program, folder, folder / "a.xdmf")
    code, text = run(["/usr/bin/python3", "-c", DOLFIN, folder / "a.xdmf"], folder)
    found = re.search(r"@ ([\d.e+-]+)", text)
    if not found:
        raise ValueError("DOLFIN: " + text[-500:])
    return [("DOLFIN: Laplace between two sides, largest error of u = x", float(found[1]), 0, 1e-9)]


ALL = {"calculix": calculix, "openfoam": openfoam, "freefem": freefem, "dolfinx": dolfinx, "getfem": getfem,
       "getdp": getdp, "escript": escript, "dolfin": dolfin}
