"""Meshes as objects of other packages: meshio, VTK, PyVista."""

from __future__ import annotations

import importlib
import itertools
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._meshio import fields_of, pairs_of
from ._surface import Array

if TYPE_CHECKING:
    from . import _tetmesh

_VTK_LINE, _VTK_TRIANGLE, _VTK_TETRA = 3, 5, 10


def wanted(module: str, what: str, package: Optional[str] = None) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{what}() needs the package {package or module}, which is not installed") from error


def to_meshio(mesh: _tetmesh.TetMesh) -> Any:
    meshio = wanted("meshio", "to_meshio")
    counts = (len(mesh.tetrahedra), len(mesh.triangles), len(mesh.segments))
    cells = [("tetra", mesh.tetrahedra), ("triangle", mesh.triangles), ("line", mesh.segments)]
    if mesh.order == 2:
        cells = [("tetra10", mesh.tetrahedra10), ("triangle6", mesh.triangles6), ("line3", mesh.segments3)]
    region = [mesh._regions(), np.zeros(counts[1], np.int32), np.zeros(counts[2], np.int32)]
    marker = [np.zeros(counts[0], np.int32), mesh.triangle_markers, mesh.segment_markers]
    there = [i for i in range(3) if counts[i] > 0]
    return meshio.Mesh(
        np.array(mesh.nodes),
        [(cells[i][0], np.array(cells[i][1])) for i in there],
        cell_data={"region": [np.array(region[i]) for i in there], "marker": [np.array(marker[i]) for i in there]},
        field_data=fields_of(mesh.names),
    )


def to_vtk(mesh: _tetmesh.TetMesh) -> Any:
    support = wanted("vtkmodules.util.numpy_support", "to_vtk", "vtk")
    core = wanted("vtkmodules.vtkCommonCore", "to_vtk", "vtk")
    model = wanted("vtkmodules.vtkCommonDataModel", "to_vtk", "vtk")
    numpy_to_vtk, to_ids = support.numpy_to_vtk, support.numpy_to_vtkIdTypeArray
    cells, types, region, marker = _vtk_cells(mesh)
    points = core.vtkPoints()
    points.SetData(numpy_to_vtk(np.array(mesh.nodes), deep=True))
    counts = _vtk_counts(types)
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    array = model.vtkCellArray()
    array.SetData(to_ids(offsets, deep=True), to_ids(cells, deep=True))
    grid = model.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(types, deep=True), array)
    for name, values in (("region", region), ("marker", marker)):
        data = numpy_to_vtk(values, deep=True)
        data.SetName(name)
        grid.GetCellData().AddArray(data)
    for name, rows in _field_arrays(mesh):
        pairs = numpy_to_vtk(rows, deep=True)
        pairs.SetName(name)
        grid.GetFieldData().AddArray(pairs)
    return grid


def _field_arrays(mesh: _tetmesh.TetMesh) -> list[tuple[str, Array]]:
    """The names as in .vtu: pairs of ids and dimensions."""
    by_name = itertools.groupby(sorted(pairs_of(mesh.names)), key=lambda row: row[0])
    return [(name, np.array([row[1:] for row in rows], np.int32)) for name, rows in by_name]


def to_pyvista(mesh: _tetmesh.TetMesh) -> Any:
    pyvista = wanted("pyvista", "to_pyvista")
    cells, types, region, marker = _vtk_cells(mesh)
    counts = _vtk_counts(types)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64) if len(counts) else np.empty(0, np.int64)
    grid = pyvista.UnstructuredGrid(np.insert(cells, starts, counts), types, np.array(mesh.nodes))
    grid.cell_data["region"] = region
    grid.cell_data["marker"] = marker
    for name, rows in _field_arrays(mesh):
        grid.field_data[name] = rows
    return grid


def _vtk_cells(mesh: _tetmesh.TetMesh) -> tuple[Array, Array, Array, Array]:
    """Corners of all cells, their types, regions and markers."""
    if mesh.order == 2:
        blocks = ((mesh.tetrahedra10, 24), (mesh.triangles6, 22), (mesh.segments3, 21))
    else:
        blocks = ((mesh.tetrahedra, _VTK_TETRA), (mesh.triangles, _VTK_TRIANGLE), (mesh.segments, _VTK_LINE))
    cells = np.concatenate([b.astype(np.int64).ravel() for b, _ in blocks])
    types = np.concatenate([np.full(len(b), t, np.uint8) for b, t in blocks])
    lower = len(mesh.triangles) + len(mesh.segments)
    region = np.concatenate([mesh._regions(), np.zeros(lower, np.int32)])
    marker = np.concatenate([np.zeros(len(mesh.tetrahedra), np.int32), mesh.triangle_markers, mesh.segment_markers])
    return cells, types, region, marker


def _vtk_counts(types: Array) -> Array:
    """Nodes of cells: quadratic tetrahedra, triangles and edges are types 24, 22, 21."""
    counts = np.zeros(25, np.int64)
    for kind, nodes in ((_VTK_TETRA, 4), (_VTK_TRIANGLE, 3), (_VTK_LINE, 2), (24, 10), (22, 6), (21, 3)):
        counts[kind] = nodes
    return counts[types]
