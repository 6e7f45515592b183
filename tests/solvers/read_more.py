"""More of read_with.py: legacy DOLFIN, GetDP, escript, PETSc, code_saturne and rheolef."""
import json
import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from assembly import MARKERS, REGIONS


def with_dolfin(path):
    """Legacy DOLFIN reads its own XML, and XDMF: the volume's file, and that of its surface."""
    import dolfin

    dolfin.set_log_level(40)

    def read(name, what, mesh, dimension):
        values = dolfin.MeshValueCollection("size_t", mesh, dimension)
        with dolfin.XDMFFile(str(name)) as file:
            file.read(values, what)
        return dolfin.MeshFunction("size_t", mesh, values)

    if path.suffix == ".xml":
        mesh = dolfin.Mesh(str(path))
        cells, facets = (dolfin.MeshFunction("size_t", mesh, k, mesh.domains()) for k in (3, 2))
    else:
        mesh = dolfin.Mesh()
        with dolfin.XDMFFile(str(path)) as file:
            file.read(mesh)
        cells = read(path, "region", mesh, 3)
        facets = read(path.with_name(path.stem + "_surface.xdmf"), "marker", mesh, 2)
    mesh.init(2, 0)
    areas = {i: sum(facet_area(mesh, f) for f in np.flatnonzero(facets.array() == i)) for i in MARKERS}
    volumes = {i: sum(dolfin.Cell(mesh, c).volume() for c in np.flatnonzero(cells.array() == i)) for i in REGIONS}
    return {"points": mesh.num_vertices(), "tetrahedra": mesh.num_cells(), "volumes": volumes, "areas": areas}


def facet_area(mesh, facet):
    a, b, c = mesh.coordinates()[mesh.topology()(2, 0)(facet)]
    return np.linalg.norm(np.cross(b - a, c - a)) / 2


GETDP = """
Group { %(groups)s Whole = Region[{%(ids)s}]; Sides = Region[{%(sides)s}]; }
FunctionSpace { { Name H; Type Form0; BasisFunction { { Name s; NameOfCoef v; Function BF_Node; Support Whole;
                  Entity NodesOf[All]; } } } }
Jacobian { { Name J; Case { { Region Sides; Jacobian Sur; } { Region All; Jacobian Vol; } } } }
Integration { { Name I; Case { { Type Gauss; Case { %(elements)s } } } } }
Formulation { { Name F; Type FemEquation; Quantity { { Name u; Type Local; NameOfSpace H; } }
                Equation { Integral { [ Dof{u}, {u} ]; In Whole; Jacobian J; Integration I; } } } }
Resolution { { Name R; System { { Name A; NameOfFormulation F; } } Operation { InitSolution[A]; SaveSolution[A]; } } }
PostProcessing { { Name P; NameOfFormulation F; Quantity { { Name size; Value { Integral { [ 1 ]; In Whole; Jacobian J;
                   Integration I; } } } } } }
PostOperation { { Name O; NameOfPostProcessing P; Operation { %(prints)s } } }
"""


def with_getdp(path):
    """GetDP's own integrals over the groups with the physical tags."""
    ids = [*MARKERS, *REGIONS]
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "p.pro").write_text(GETDP % {
            "groups": " ".join(f"G{i} = Region[{i}];" for i in ids), "ids": ", ".join(map(str, ids)),
            "sides": ", ".join(map(str, MARKERS)),
            "elements": " ".join(f"{{ GeoElement {e}; NumberOfPoints 4; }}"
                                 for e in ("Triangle", "Tetrahedron", "Triangle2", "Tetrahedron2")),
            "prints": " ".join(f'Print[ size[G{i}], OnGlobal, Format Table, File "{i}.txt" ];' for i in ids)})
        run = subprocess.run(["getdp", "p.pro", "-msh", str(path), "-solve", "R", "-pos", "O"], cwd=folder, capture_output=True,
                             text=True, timeout=120)
        text = run.stdout + run.stderr
        if run.returncode or "Error" in text:
            raise ValueError("getdp: " + text[-400:])
        # Its Gauss weights have twelve digits.
        sizes = {i: round(float(Path(folder, f"{i}.txt").read_text().split()[-1]), 9) for i in ids}
    return {"volumes": {i: sizes[i] for i in REGIONS}, "areas": {i: sizes[i] for i in MARKERS}}


ESCRIPT = """
import json, sys
from esys.escript import Function, FunctionOnBoundary, Scalar, insertTaggedValues, integrate
from esys.finley import ReadGmsh
domain = ReadGmsh(sys.argv[1], 3)
def size(space, name):
    return integrate(insertTaggedValues(Scalar(0.0, space(domain)), **{name: 1.0}))
print(json.dumps({"points": domain.getNumDataPointsGlobal(),
                  "volumes_by_name": {n: size(Function, n) for n in sys.argv[2].split(",")},
                  "areas": {n: size(FunctionOnBoundary, n) for n in sys.argv[3].split(",")}}))
"""


def with_escript(path):
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder, "read.py")
        script.write_text(ESCRIPT)
        run = subprocess.run(["run-escript3", str(script), str(path), ",".join(REGIONS.values()),
                              ",".join(MARKERS.values())], capture_output=True, text=True, timeout=120)
    if run.returncode:
        raise ValueError("escript: " + run.stderr[-400:])
    return json.loads(run.stdout.strip().splitlines()[-1])


def with_petsc(path):
    """PETSc's DMPlex; its labels have the names and the tags."""
    from petsc4py import PETSc

    PETSc.Options()["dm_plex_gmsh_use_regions"] = 1
    mesh = PETSc.DMPlex().createFromFile(str(path), "mesh", interpolate=True)
    (first_vertex, last_vertex), (first_cell, last_cell) = mesh.getDepthStratum(0), mesh.getHeightStratum(0)
    found = {"points": last_vertex - first_vertex, "tetrahedra": last_cell - first_cell, "volumes": {}, "areas": {},
             "region_names": {}, "marker_names": {}}
    for name in (mesh.getLabelName(i) for i in range(mesh.getNumLabels())):
        if name in ("depth", "celltype"):
            continue
        for tag in mesh.getLabelIdIS(name).getIndices():
            entities = mesh.getStratumIS(name, tag).getIndices()
            depth = max(mesh.getLabelValue("depth", e) for e in entities)
            size = sum(mesh.computeCellGeometryFVM(e)[0] for e in entities if mesh.getLabelValue("depth", e) == depth)
            found["volumes" if depth == 3 else "areas"][int(tag)] = size
            found["region_names" if depth == 3 else "marker_names"][name] = int(tag)
    return found


SATURNE = Path("/usr/lib/code_saturne")


def with_saturne(path):
    """code_saturne's preprocessor, and the volume that its solver finds."""
    with tempfile.TemporaryDirectory() as folder:
        texts = []
        of_sections = ["--grp-cel", "section", "--grp-fac", "section"] if path.suffix == ".cgns" else []
        for command in ([SATURNE / "cs_preprocess", path, *of_sections, "--out", "mesh_input"], [SATURNE / "cs_solver", "--quality"]):
            run = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True, errors="replace",
                                 timeout=300)
            texts.append(run.stdout + "".join(p.read_text(errors="replace") for p in Path(folder).glob("*.log")))
            if run.returncode:
                raise ValueError("code_saturne: " + texts[-1][-400:])
    found = {"tetrahedra": int(re.search(r"Number of cells:?\s+:?\s*(\d+)", texts[0])[1]),
             "points": int(re.search(r"Number of vertices[^\d\n]*(\d+)", texts[0])[1]),
             "volume": float(re.search(r"Total volume for the domain =\s*(\S+)", texts[1])[1])}
    groups = set(re.findall(r'Group "([^"]*)"', texts[0]))
    wanted = set(MARKERS.values()) | set(REGIONS.values())
    if not groups & wanted:  # numbers only
        if not {str(i) for i in (*MARKERS, *REGIONS)} <= groups:
            raise ValueError(f"code_saturne: groups {sorted(groups)}")
    elif not wanted <= groups or not groups - wanted <= {str(i) for i in (*MARKERS, *REGIONS)}:
        raise ValueError(f"code_saturne: groups {sorted(groups)}")
    else:
        found["region_names"] = {n: i for i, n in REGIONS.items()}
        found["marker_names"] = {n: i for i, n in MARKERS.items()}
    return found


def with_rheolef(path):
    """The .geo that rheolef's msh2geo makes: nodes, elements, and domains of faces and cells."""
    run = subprocess.run(["msh2geo", str(path)], capture_output=True, text=True, timeout=120)
    if run.returncode:
        raise ValueError("msh2geo: " + run.stderr[-400:])
    head, *domains = run.stdout.split("\ndomain\n")
    count = {name: int(n) for name, n in re.findall(r"^\s*(nodes|tetrahedra|triangles)\s+(\d+)$", head, re.M)}
    lines = head.split("end header\n")[1].strip().splitlines()
    points = np.array([list(map(float, line.split())) for line in lines[:count["nodes"]]])
    elements = {kind: np.array([list(map(int, line.split()[1:])) for line in lines if line.startswith(kind + "\t")])
                for kind in "Tt"}
    found = {"points": count["nodes"], "tetrahedra": count["tetrahedra"], "volumes_by_name": {}, "areas": {}}
    for domain in domains:
        name, header, *members = domain.split("\n")
        dimension = int(header.split()[1])
        corners = points[elements["T" if dimension == 3 else "t"][[abs(int(m)) for m in members if m.strip()]]]
        sides = corners[:, 1:] - corners[:, :1]
        if dimension == 3:
            found["volumes_by_name"][name] = round(float(np.linalg.det(sides[:, :3]).sum() / 6), 9)
        else:
            found["areas"][name] = float(np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2)
    return found
