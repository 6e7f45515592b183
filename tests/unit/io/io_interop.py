"""Reads with VTK, meshio and Gmsh what io_interop_test wrote, and compares it with the original.

Usage: io_interop.py FOLDER. FOLDER holds expected.json and volume.* files. Exit code 0: all agree,
1: one does not, 77: none of the readers is installed. Uses whichever readers it finds.
"""

import json
import pathlib
import shutil
import subprocess
import sys


def entities(corners, tags):
    return sorted([list(map(int, c)), int(t)] for c, t in zip(corners, tags))


def differences(expected, found):
    for key, want in expected.items():
        if key in found and found[key] != want:
            yield f"{key}: expected {want}, found {found[key]}"


def hexes(points):
    return [float(x).hex() for point in points for x in point]


def read_vtk(path):
    import vtk

    reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader()
    if path.suffix == ".vtk":
        reader.ReadAllScalarsOn()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    arrays = {name: grid.GetCellData().GetArray(name) for name in ("kind", "region", "marker")}
    cells = {10: [], 5: [], 3: []}
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        corners = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        kind = {10: 3, 5: 2, 3: 1}[cell.GetCellType()]
        if arrays["kind"].GetTuple1(i) != kind:
            raise ValueError(f"cell {i} has the wrong kind")
        tag = arrays["region" if kind == 3 else "marker"].GetTuple1(i)
        cells[cell.GetCellType()].append((corners, tag))
    points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    named = {"tetrahedra": 10, "facets": 5, "segments": 3}
    found = {name: entities(*zip(*cells[t])) if cells[t] else [] for name, t in named.items()}
    markers = grid.GetPointData().GetArray("marker")
    found["vertex_markers"] = [int(markers.GetTuple1(i)) for i in range(len(points))]
    return {"points": hexes(points), **found}


def vertex_markers(mesh, suffix):
    """Markers of the points as meshio has them; a .msh has them as elements that are points."""
    if suffix != ".msh":
        return [int(m) for m in mesh.point_data["medit:ref" if suffix == ".mesh" else "marker"]]
    markers = [0] * len(mesh.points)
    for i, block in enumerate(mesh.cells):
        if block.type == "vertex":
            for corner, tag in zip(block.data, mesh.cell_data["gmsh:physical"][i]):
                markers[int(corner[0])] = int(tag)
    return markers


def read_meshio(path):
    import meshio

    mesh = meshio.read(path)
    names = {".mesh": ("medit:ref",) * 2, ".msh": ("gmsh:physical",) * 2}
    region, marker = names.get(path.suffix, ("region", "marker"))
    cells = {"tetra": [], "triangle": [], "line": []}
    for i, block in enumerate(mesh.cells):
        if block.type == "vertex":
            continue
        tags = mesh.cell_data[region if block.type == "tetra" else marker][i]
        cells[block.type] += list(zip(block.data, tags))
    named = {"tetrahedra": "tetra", "facets": "triangle", "segments": "line"}
    found = {name: entities(*zip(*cells[t])) if cells[t] else [] for name, t in named.items()}
    return {"points": hexes(mesh.points), "vertex_markers": vertex_markers(mesh, path.suffix), **found}


def read_gmsh(path):
    """Gmsh must load the file without a complaint, and count its contents."""
    run = subprocess.run(["gmsh", "-0", str(path)], capture_output=True, text=True, timeout=60)
    text = run.stdout + run.stderr
    if run.returncode != 0 or "Error" in text or "Warning" in text:
        raise ValueError("gmsh complains: " + text)
    return {}


def available():
    readers = []
    for name, read, suffixes in (
        ("vtk", read_vtk, {".vtu", ".vtk"}),
        ("meshio", read_meshio, {".vtu", ".vtk", ".mesh", ".msh"}),
    ):
        try:
            __import__(name)
            readers.append((name, read, suffixes))
        except ImportError:
            print(f"{name} is not installed")
    if shutil.which("gmsh"):
        readers.append(("gmsh", read_gmsh, {".msh", ".mesh"}))
    return readers


def main():
    folder = pathlib.Path(sys.argv[1])
    expected = json.loads((folder / "expected.json").read_text())
    readers = available()
    if not readers:
        return 77
    failures = 0
    for name, read, suffixes in readers:
        for path in sorted(folder.glob("volume*.*")):
            if path.suffix not in suffixes:
                continue
            try:
                wrong = list(differences(expected, read(path)))
            except Exception as error:  # any exception of a foreign reader is a finding
                wrong = [repr(error)]
            print(name, path.name, "; ".join(wrong) or "agrees")
            failures += bool(wrong)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
