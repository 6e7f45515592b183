"""Reads a mesh file with one program and prints the contents that it found, as a line of JSON.

Usage: read_with.py PROGRAM FILE. Keys: points, tetrahedra, volumes (by region), areas (by marker), region_names and
marker_names (ids by name); a key is missing if the program has no such data.
"""
import collections
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np


def measures(points, tets, regions, triangles, markers):
    points, tets, triangles = np.asarray(points, float), np.asarray(tets, int), np.asarray(triangles, int)
    found = {"points": len(points), "tetrahedra": len(tets)}
    edges = points[tets[:, 1:4]] - points[tets[:, :1]]
    volumes = np.linalg.det(edges) / 6
    if regions is not None:
        found["volumes"] = {int(r): float(volumes[np.asarray(regions) == r].sum()) for r in set(np.asarray(regions).tolist())}
    else:
        found["volume"] = float(volumes.sum())
    if markers is not None and len(triangles):
        sides = points[triangles[:, 1:3]] - points[triangles[:, :1]]
        areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
        found["areas"] = {int(m): float(areas[np.asarray(markers) == m].sum()) for m in set(np.asarray(markers).tolist())}
    return found


def with_meshio(path):
    import meshio

    meshes = [meshio.read(path)]
    beside = path.with_name(path.stem + "_surface" + path.suffix)
    if beside.exists():
        meshes.append(meshio.read(beside))
    tets, regions, triangles, markers, names = [], [], [], [], {}
    for mesh in meshes:
        names.update(mesh.field_data)
        moved = mesh.point_data.get("volume_vertex")
        for i, block in enumerate(mesh.cells):
            data = mesh.cell_data
            keys = [k for k in ("region", "marker", "gmsh:physical", "medit:ref", "nastran:ref", "netgen:index", "cell_tags")
                    if k in data]
            if block.type.startswith("tetra"):
                tets += block.data[:, :4].tolist()
                key = "region" if "region" in keys else keys[0] if keys else None
                regions += data[key][i].ravel().tolist() if key else []
            if block.type.startswith("triangle"):
                corners = block.data[:, :3] if moved is None else np.asarray(moved)[block.data[:, :3]]
                triangles += corners.astype(int).tolist()
                key = "marker" if "marker" in keys else keys[0] if keys else None
                markers += data[key][i].ravel().tolist() if key else []
    mesh = meshes[0]
    if path.suffix == ".med":  # MED's families by their groups, and its tetrahedra, which have the other orientation
        from assembly import MARKERS, REGIONS

        ids = {family: i for family, groups in mesh.cell_tags.items() for i, name in (MARKERS | REGIONS).items() if name in groups}
        regions, markers = [ids[r] for r in regions], [ids[m] for m in markers]
        tets = np.asarray(tets)[:, [0, 2, 1, 3]]
        names = {(MARKERS | REGIONS)[i]: (i, 3 if i in REGIONS else 2) for i in ids.values()}
    found = measures(mesh.points, tets, regions if len(regions) == len(tets) else None, np.array(triangles, int).reshape(-1, 3),
                     markers if triangles and len(markers) == len(triangles) else None)
    if names:
        pairs = {n: np.asarray(v).reshape(-1, 2) for n, v in names.items() if np.asarray(v).size % 2 == 0}
        found["region_names"] = {n: int(i) for n, v in pairs.items() for i, d in v if d == 3}
        found["marker_names"] = {n: int(i) for n, v in pairs.items() for i, d in v if d == 2}
    if mesh.cell_sets:
        sets = {name.lower(): sum(len(s) for s in parts if s is not None) for name, parts in mesh.cell_sets.items()}
        found["sets"] = sets
    return found


def with_vtk(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    if path.suffix == ".exo":
        return exodus_with_vtk(path)
    if path.suffix == ".fluent":
        return fluent_with_vtk(path)

    def read(name):
        reader = {".vtu": vtk.vtkXMLUnstructuredGridReader, ".vtk": vtk.vtkUnstructuredGridReader}[name.suffix]()
        if name.suffix == ".vtk":
            reader.ReadAllScalarsOn()
        reader.SetFileName(str(name))
        reader.Update()
        return reader.GetOutput()

    if path.suffix == ".vtm":
        reader = vtk.vtkXMLMultiBlockDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        blocks = reader.GetOutput()
        grids = [blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())]
    else:
        grids = [read(path)]
        beside = path.with_name(path.stem + "_surface.vtu")
        if beside.exists():
            grids.append(read(beside))
    tets, regions, triangles, markers = [], [], [], []
    found_names = {}
    for grid in grids:
        arrays = grid.GetCellData()
        moved = grid.GetPointData().GetArray("volume_vertex")
        region = arrays.GetArray("region")
        marker = arrays.GetArray("marker")
        for i in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(i)
            corners = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
            if cell.GetCellType() in (10, 24):
                tets.append(corners[:4])
                regions.append(region.GetTuple1(i))
            elif cell.GetCellType() in (5, 22):
                triangles.append([int(moved.GetTuple1(c)) if moved else c for c in corners[:3]])
                markers.append(marker.GetTuple1(i))
        fields = grid.GetFieldData()
        for k in range(fields.GetNumberOfArrays()):
            array = fields.GetArray(k)
            if array is not None and array.GetNumberOfComponents() == 2:
                for pair in vtk_to_numpy(array):
                    found_names[(array.GetName(), int(pair[1]))] = int(pair[0])
    points = vtk_to_numpy(grids[0].GetPoints().GetData())
    found = measures(points, tets, regions, np.array(triangles, int).reshape(-1, 3), markers or None)
    found["region_names"] = {n: i for (n, d), i in found_names.items() if d == 3}
    found["marker_names"] = {n: i for (n, d), i in found_names.items() if d == 2 and not n.startswith("holdfast:")}
    return found


def fluent_with_vtk(path):
    """A block for each zone of cells, without names."""
    import vtk

    reader = vtk.vtkFLUENTReader()
    reader.SetFileName(str(path))
    reader.Update()
    blocks = reader.GetOutput()
    grids = [blocks.GetBlock(i) for i in range(blocks.GetNumberOfBlocks())]
    tets = [[grid.GetCell(i).GetPointId(k) for k in range(4)] for grid in grids for i in range(grid.GetNumberOfCells())
            if grid.GetCellType(i) == 10]
    return measures([grids[0].GetPoint(i) for i in range(grids[0].GetNumberOfPoints())], tets, None, [], None)


def exodus_with_vtk(path):
    """Blocks and side sets are data sets of their own, by their names."""
    import vtk

    reader = vtk.vtkExodusIIReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    found = {"volumes_by_name": {}, "areas": {}, "tetrahedra": 0}
    for kind in (reader.ELEM_BLOCK, reader.SIDE_SET):
        for i in range(reader.GetNumberOfObjects(kind)):
            reader.SetObjectStatus(kind, i, 1)
    reader.Update()
    for of_kind, kind in ((reader.GetOutput().GetBlock(0), reader.ELEM_BLOCK), (reader.GetOutput().GetBlock(4), reader.SIDE_SET)):
        for i in range(of_kind.GetNumberOfBlocks()):
            grid, size = of_kind.GetBlock(i), 0.0
            for k in range(grid.GetNumberOfCells()):
                corners = [np.array(grid.GetPoint(grid.GetCell(k).GetPointId(c))) for c in range(4 if kind == reader.ELEM_BLOCK else 3)]
                sides = [c - corners[0] for c in corners[1:]]
                size += np.linalg.det(sides) / 6 if len(sides) == 3 else np.linalg.norm(np.cross(*sides)) / 2
            name = reader.GetObjectName(kind, i)
            found["volumes_by_name" if kind == reader.ELEM_BLOCK else "areas"][name] = round(float(size), 9)
            found["tetrahedra"] += grid.GetNumberOfCells() if kind == reader.ELEM_BLOCK else 0
    return found


def with_gmsh(path):
    """Gmsh saves the mesh as text of version 2.2, which is then parsed here."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "again.msh"
        run = subprocess.run(["gmsh", str(path), "-0", "-format", "msh22", "-o", str(out)], capture_output=True,
                             text=True, timeout=120)
        text = run.stdout + run.stderr
        if "Error" in text or not out.exists():
            raise ValueError("gmsh: " + text[-400:])
        found = read_msh_22(out.read_text(errors="replace"))
        if path.suffix == ".vtk":  # of whose arrays Gmsh reads none
            return {"points": found["points"], "tetrahedra": found["tetrahedra"], "volume": sum(found["volumes"].values())}
        return found


def read_msh_22(text):
    lines = text.splitlines()

    def section(name):
        if f"${name}" not in lines:
            return []
        start = lines.index(f"${name}") + 2
        return lines[start:lines.index(f"$End{name}")]

    nodes = {int(l.split()[0]): [float(x) for x in l.split()[1:4]] for l in section("Nodes")}
    number = {tag: i for i, tag in enumerate(nodes)}
    tets, regions, triangles, markers = [], [], [], []
    for line in section("Elements"):
        values = [int(v) for v in line.split()]
        tags, corners = values[3:3 + values[2]], [number[v] for v in values[3 + values[2]:]]
        tag = tags[0] if tags[0] else tags[1]
        if values[1] in (4, 11):
            tets.append(corners[:4])
            regions.append(tag)
        elif values[1] in (2, 9):
            triangles.append(corners[:3])
            markers.append(tag)
    found = measures(list(nodes.values()), tets, regions, np.array(triangles, int).reshape(-1, 3), markers or None)
    names = [re.match(r'(\d) (\d+) "(.*)"', l) for l in section("PhysicalNames")]
    found["region_names"] = {m[3]: int(m[2]) for m in names if m and m[1] == "3"}
    found["marker_names"] = {m[3]: int(m[2]) for m in names if m and m[1] == "2"}
    return found


def with_dolfinx(path):
    from mpi4py import MPI
    from dolfinx import io

    comm = MPI.COMM_WORLD
    if path.suffix == ".xdmf":
        with io.XDMFFile(comm, str(path), "r") as file:
            mesh = file.read_mesh(name="mesh")
            cells = file.read_meshtags(mesh, name="mesh")
        mesh.topology.create_connectivity(2, 0)
        mesh.topology.create_connectivity(2, 3)
        with io.XDMFFile(comm, str(path.with_name(path.stem + "_surface.xdmf")), "r") as file:
            facets = file.read_meshtags(mesh, name="mesh")
    else:
        import gmsh

        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(path))
        from dolfinx.io import gmshio
        mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, comm, 0)
    x = mesh.geometry.x
    dofs = mesh.geometry.dofmap
    tets = np.array([dofs.links(i)[:4] for i in range(mesh.topology.index_map(3).size_local)])
    # Cells of DOLFINx have no orientation.
    edges = x[tets[:, 1:4]] - x[tets[:, :1]]
    tets[np.linalg.det(edges) < 0] = tets[np.linalg.det(edges) < 0][:, [0, 2, 1, 3]]
    regions = np.zeros(len(tets), int)
    regions[cells.indices] = cells.values
    mesh.topology.create_connectivity(2, 3)
    mesh.topology.create_connectivity(3, 2)
    from dolfinx.cpp.mesh import entities_to_geometry
    triangles = np.asarray(entities_to_geometry(getattr(mesh, "_mesh", mesh), 2, facets.indices, False))[:, :3]
    return measures(x, tets, regions, triangles, facets.values)


def with_netgen(path):
    from netgen.meshing import Mesh

    mesh = Mesh()
    mesh.Load(str(path))
    points = [p.p for p in mesh.Points()]
    tets = [[v.nr - 1 for v in e.vertices] for e in mesh.Elements3D()]
    regions = [e.index for e in mesh.Elements3D()]
    triangles, markers = [], []
    for e in mesh.Elements2D():
        triangles.append([v.nr - 1 for v in e.vertices][:3])
        markers.append(mesh.FaceDescriptor(e.index).bc)
    tets = [[t[0], t[2], t[1], t[3]] for t in tets]  # Netgen's order
    found = measures(points, tets, regions, triangles, markers)
    found["region_names"] = {mesh.GetMaterial(r): r for r in set(regions)}
    found["marker_names"] = {mesh.GetBCName(m - 1): m for m in set(markers)}
    return found


def with_sfepy(path):
    from sfepy.discrete.fem import Mesh

    mesh = Mesh.from_file(str(path))
    conn, ids = mesh.get_conn("3_4", ret_cells=True)
    return measures(mesh.coors, conn, mesh.cmesh.cell_groups[ids], [], None)


def with_getfem(path):
    import getfem

    mesh = getfem.Mesh("import", "gmsh", str(path))
    points = mesh.pts().T
    ids = mesh.cvid()
    pid, idx = mesh.pid_from_cvid()
    idx = np.asarray(idx, int)
    tets = np.array([pid[idx[i]:idx[i + 1]][:4] for i in range(len(ids))], int)
    edges = points[tets[:, 1:4]] - points[tets[:, :1]]
    turned = np.linalg.det(edges) < 0
    tets[turned] = tets[turned][:, [0, 2, 1, 3]]
    where = {cv: i for i, cv in enumerate(ids)}
    regions = np.zeros(len(tets), int)
    triangles, markers = [], []
    for r in mesh.regions():
        cvs, faces = mesh.region(int(r))
        whole = [face not in (0, 1, 2, 3) for face in faces]
        for cv, face, is_whole in zip(cvs, faces, whole):
            if is_whole:
                regions[where[cv]] = r
            else:
                triangles.append(np.asarray(mesh.pid_in_faces(np.array([[cv], [face]])), int).ravel()[:3])
                markers.append(int(r))
    # An interface has two sides, and GetFEM lists both.
    once = {(frozenset(t.tolist()), m): t for t, m in zip(triangles, markers)}
    return measures(points, tets, regions, list(once.values()), [m for _, m in once] or None)


def with_freefem(path):
    load = {".mesh": 'mesh3 Th = readmesh3("{}");', ".meshb": 'mesh3 Th = readmesh3("{}");',
            ".msh": 'load "gmsh"\nmesh3 Th = gmshload3("{}");'}[path.suffix].format(path)
    text = f'load "msh3"\n{load}\n' + 'cout.precision(15);\ncout << "@ points " << Th.nv << endl << "@ tetrahedra " << Th.nt << endl;\n'
    for region in (10, 20):
        text += f'cout << "@ volume {region} " << int3d(Th, {region})(1.) << endl;\n'
    for marker in range(1, 8):
        text += f'cout << "@ area {marker} " << int2d(Th, {marker})(1.) << endl;\n'
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "read.edp"
        script.write_text(text)
        environment = dict(os.environ, FF_LOADPATH=freefem_path())
        run = subprocess.run(["FreeFem++", "-nw", "-v", "0", str(script)], capture_output=True, text=True, timeout=120,
                             env=environment)
    rows = [line.split()[1:] for line in run.stdout.splitlines() if line.startswith("@")]
    if len(rows) < 11:
        raise ValueError("FreeFEM: " + (run.stdout + run.stderr)[-400:])
    found = {row[0]: int(row[1]) for row in rows[:2]}
    found["volumes"] = {int(r[1]): float(r[2]) for r in rows if r[0] == "volume"}
    found["areas"] = {int(r[1]): float(r[2]) for r in rows if r[0] == "area"}
    return found


def freefem_path():
    for pattern in ("/usr/lib/*/freefem++", "/usr/lib/freefem++"):
        for folder in sorted(Path("/").glob(pattern[1:])):
            libraries = sorted({str(p.parent) for p in folder.rglob("msh3.so")})
            if libraries:
                return ";".join(libraries)
    return ""


FOAM_FOLDER = "/usr/share/openfoam"
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application laplacianFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep;
writeInterval 1; writeFormat ascii; writePrecision 12; timeFormat general; timePrecision 6; runTimeModifiable false;
"""
SCHEMES = """FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }
ddtSchemes { default steadyState; } gradSchemes { default leastSquares; } divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; }
snGradSchemes { default corrected; } fluxRequired { default no; T; }
"""
SOLUTION = """FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }
solvers { T { solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; } } SIMPLE { nNonOrthogonalCorrectors 40; }
"""


def foam(case, *command):
    environment = dict(os.environ, WM_PROJECT_DIR=FOAM_FOLDER)
    run = subprocess.run([*command, "-case", str(case)], capture_output=True, text=True, timeout=300, env=environment)
    return run.returncode, run.stdout + run.stderr


def make_case(case):
    (case / "system").mkdir(parents=True, exist_ok=True)
    (case / "constant").mkdir(exist_ok=True)
    (case / "system" / "controlDict").write_text(CONTROL)
    (case / "system" / "fvSchemes").write_text(SCHEMES)
    (case / "system" / "fvSolution").write_text(SOLUTION)


def with_openfoam(path):
    """A case with a polyMesh, or a file that OpenFOAM's own programs convert."""
    with tempfile.TemporaryDirectory() as folder:
        if path.is_dir():
            case = path
        else:
            case = Path(folder) / "case"
            make_case(case)
            code, text = foam(case, {".msh": "gmshToFoam", ".unv": "ideasUnvToFoam", ".fluent": "fluent3DMeshToFoam"}[path.suffix], str(path))
            if code:
                raise ValueError("conversion: " + text[-400:])
        make_case(case)
        code, text = foam(case, "checkMesh")
        if code or "Mesh OK" not in text:
            raise ValueError("checkMesh: " + text[-1200:])
        found = {}
        found["points"] = int(re.search(r"points:\s+(\d+)", text)[1])
        found["tetrahedra"] = int(re.search(r"tetrahedra:\s+(\d+)", text)[1])
        found["volume"] = float(re.search(r"Total volume = ([\d.e+-]+)\.", text)[1])
        found["areas"] = foam_areas(case / "constant" / "polyMesh")
        zones = case / "constant" / "polyMesh" / "cellZones"
        if zones.exists():
            found["zones"] = foam_zones(case / "constant" / "polyMesh")
        return found


def foam_list(path, pattern):
    text = path.read_text()
    return re.findall(pattern, text[text.index("\n(") :])


def foam_areas(folder):
    points = np.array([[float(x) for x in p.split()] for p in foam_list(folder / "points", r"\(([-\d.e+ ]+)\)")])
    faces = [list(map(int, f.split())) for f in foam_list(folder / "faces", r"3\(([\d ]+)\)")]
    areas = {}
    for name, entries in re.findall(r"(\S+)\s*\{([^}]*)\}", (folder / "boundary").read_text().split("}", 1)[1]):
        count, start = (int(re.search(k + r"\s+(\d+)", entries)[1]) for k in ("nFaces", "startFace"))
        corners = points[faces[start:start + count]]
        if count:
            areas[name] = float(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2)
    return areas


def foam_zones(folder):
    text = (folder / "cellZones").read_text().split("}", 1)[1]
    return {m[1]: int(m[2]) for m in re.finditer(r"(\S+)\s*\{\s*type\s+cellZone;\s*cellLabels\s+List<label>\s+(\d+)", text)}


def with_ccx(path):
    """CalculiX reads the sets in a step that heats nothing; the volumes are those of its own output."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "deck.inp"
        deck.write_text(f"*INCLUDE, INPUT={path}\n"
                        "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n"
                        + "".join(f"*SOLID SECTION, ELSET={s}, MATERIAL=M\n" for s in ("core", "shell"))
                        + "*BOUNDARY\ninlet, 1, 3\n*STEP\n*STATIC\n*DLOAD\n"
                        + "*DSLOAD\n"  # pressure on a surface
                        + "outlet, P, 1.\n"
                        + "".join(f"*EL PRINT, ELSET={s}, TOTALS=ONLY\nEVOL\n" for s in ("core", "shell"))
                        + "*SECTION PRINT, SURFACE=outlet, NAME=SP\nSOF\n*NODE PRINT, NSET=inlet, TOTALS=ONLY\nRF\n*END STEP\n")
        run = subprocess.run(["ccx", "deck"], cwd=folder, capture_output=True, text=True, timeout=300)
        if "Job finished" not in run.stdout:
            raise ValueError("ccx: " + run.stdout[-600:])
        data = (Path(folder) / "deck.dat").read_text()
    volumes = re.findall(r"total volume for set (\S+) and time.*?\n\s*\n\s*([\d.E+-]+)", data)
    force = re.search(r"total force \(fx,fy,fz\) for set INLET.*?\n\s*\n\s*([\dE+.-]+)\s", data)
    return {"volumes_by_name": {n.lower(): float(v) for n, v in volumes},
            "force": float(force[1]) if force else None}


def with_libmed(path):
    """The output of mdump, of the MED library: counts, and the groups of every family."""
    run = subprocess.run(["mdump", str(path), "NODALE", "FULL_INTERLACE", "1"], capture_output=True, text=True, errors="replace",
                         timeout=120)
    text = run.stdout + run.stderr
    if "ERREUR" in text or "Erreur" in text:
        raise ValueError("mdump: " + text[-400:])
    found = {"points": int(re.search(r"Nombre de noeuds : (\d+)", text)[1]),
             "tetrahedra": int(re.search(r"type MED_TETRA(?:4|10) : (\d+)", text)[1])}
    families = re.findall(r"Famille de nom (region|surface)_(\d+) et de numero.*?gro = (\S+)", text, re.S)
    found["region_names"] = {name: int(i) for kind, i, name in families if kind == "region"}
    found["marker_names"] = {name: int(i) for kind, i, name in families if kind == "surface"}
    return found


def with_parser(path):
    """MFEM's text, version 1.0 to 1.3 (mfem.org, "Mesh formats")."""
    lines = [line.split("#")[0].strip() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line]

    def section(name):
        start = lines.index(name)
        return [[float(x) if "." in x or "e" in x else int(x) for x in line.split()]
                for line in lines[start + 2:start + 2 + int(lines[start + 1])]]

    if not lines[0].startswith("MFEM mesh v1"):
        raise ValueError(lines[0])
    start = lines.index("vertices")
    count, width = int(lines[start + 1]), int(lines[start + 2])
    points = [[float(x) for x in line.split()] for line in lines[start + 3:start + 3 + count]]
    if width != 3 or len(points) != count:
        raise ValueError("vertices")
    elements, boundary = section("elements"), section("boundary")
    if {e[1] for e in elements} != {4} or {b[1] for b in boundary} != {2}:
        raise ValueError("tetrahedra and triangles are expected")
    found = measures(points, [e[2:] for e in elements], [e[0] for e in elements], [b[2:] for b in boundary],
                     [b[0] for b in boundary])
    for key, name in (("region_names", "attribute_sets"), ("marker_names", "bdr_attribute_sets")):
        if name in lines:
            at = lines.index(name)
            sets = [re.match(r'"(.*)" 1 (\d+)$', line) for line in lines[at + 2:at + 2 + int(lines[at + 1])]]
            found[key] = {m[1]: int(m[2]) for m in sets}
    return found


if __name__ == "__main__":
    sys.stdout.flush()
    keep = os.dup(1)
    os.dup2(2, 1)  # output of the programs is not part of the answer
    import read_more

    read = globals().get("with_" + sys.argv[1]) or getattr(read_more, "with_" + sys.argv[1])
    answer = read(Path(sys.argv[2]))
    os.write(keep, (json.dumps(answer) + "\n").encode())
