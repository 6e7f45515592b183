"""Volumes from files and from objects of other packages: read_volume, info."""

from __future__ import annotations

import json
import os
import typing
from typing import Any, Optional

import numpy as np

from . import _core
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits
from ._masks import plain
from ._meshio import kind_and_cells, tags_of
from ._surface import Array, PathLike, markers_of
from ._tetmesh import TetMesh


def read_volume(
    path: PathLike,
    format: Optional[str] = None,
    *,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> TetMesh:
    """Reads tetrahedra from .vtu, .pvtu, .vtm, .vtk, .mesh, .meshb, .msh, .inp, .unv, .bdf, .nas, .su2, .mfem, .vol, .xdmf,
    .med, .exo, .cgns, .fluent, .k, .cdb, .feb, .xml, .case, .cas, .avs, .ucd, .node with .ele, or a folder polyMesh.
    Raises FileError.

    >>> read_volume("part.vtu")  # doctest: +SKIP
    TetMesh(2817 points, 9213 tetrahedra, 1 region)
    """
    options = limits(time_limit, memory_limit, cancel)
    with Shown(progress, "read") as callback:
        volume, _ = _core.read_volume(os.fsdecode(path), format or "", options, callback)
    known = volume.input_points
    return TetMesh._of(volume, int(np.count_nonzero(known >= 0)) if len(known) else None)


def info(path: PathLike, format: Optional[str] = None) -> dict[str, Any]:
    """The contents of a surface or volume file: counts, sizes, regions and markers with their names and measures,
    shapes of the tetrahedra, with the keys of `holdfast info --json` (docs/command-line.md). Raises FileError.

    >>> holdfast.info("part.vtu")["volume"]  # doctest: +SKIP
    12.5
    """
    name = os.fsdecode(path)
    remarks: list[str] = []
    told: dict[str, Any] = {}
    if _may_be_volume(name, format or ""):
        volume, remarks = _core.read_volume(name, format or "", {}, None)
        if len(volume.tetrahedra):
            told = {"file": name, "kind": "volume", **json.loads(_core.volume_info(volume))}
    if not told:
        surface = _core.read_surface(name, format or "", {}, None)
        remarks = surface.remarks
        told = {"file": name, "kind": "surface", **json.loads(_core.surface_info(surface))}
    return {**told, "remarks": remarks}


def mesh_in(part: Any, options: dict[str, Any]) -> Optional[TetMesh]:
    """The argument as a mesh if it has tetrahedra, otherwise None. `options` holds the limits for reading a file."""
    if isinstance(part, TetMesh):
        return part
    if isinstance(part, (str, bytes, os.PathLike)):
        if not _may_be_volume(os.fsdecode(part), ""):
            return None
        volume, _ = _core.read_volume(os.fsdecode(part), "", options, None)
        return TetMesh._of(volume, None) if len(volume.tetrahedra) else None
    if hasattr(part, "cells_dict") and hasattr(part, "points"):
        cells = part.cells_dict
        return volume_of(part) if 10 in cells or "tetra" in cells else None
    return None


def _may_be_volume(path: str, format: str) -> bool:
    ending = _core.volume_format_of(path.removesuffix(".gz"), format)
    return ending in _core.readable_volume_formats() and (ending != ".node" or os.path.exists(os.path.splitext(path)[0] + ".ele"))


def volume_of(mesh: Any) -> TetMesh:
    """The mesh of an argument."""
    if isinstance(mesh, TetMesh):
        return mesh
    if isinstance(mesh, (str, bytes, os.PathLike)):
        return read_volume(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells") and not hasattr(mesh, "celltypes"):
        return _of_meshio(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):  # PyVista's grid
        cells = mesh.cells_dict
        regions = plain(mesh.cell_data["region"], "region")[np.asarray(mesh.celltypes) == 10] if "region" in mesh.cell_data else None
        return TetMesh(mesh.points, cells[10], regions=regions, triangles=cells.get(5), segments=cells.get(3))
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2 and np.ndim(mesh[0]) == 2:
        return TetMesh(mesh[0], mesh[1])
    raise TypeError(f"a mesh is expected: a TetMesh, a path, (points, tetrahedra), or an object like a meshio.Mesh; "
                    f"not {type(mesh).__name__}")


def _of_meshio(mesh: Any) -> TetMesh:
    blocks = [kind_and_cells(block) for block in mesh.cells]
    names = tags_of(mesh, "region").names

    def tagged(kind: str, own: str) -> tuple[Optional[Array], Optional[Array]]:
        here = [i for i, (of_block, _) in enumerate(blocks) if of_block == kind]
        if not here:
            return None, None
        ids = tags_of(mesh, own).ids
        cells = np.concatenate([plain(blocks[i][1], "cells") for i in here])
        return cells, None if ids is None else np.concatenate([ids[i] for i in here])

    tetrahedra, regions = tagged("tetra", "region")
    triangles, triangle_markers = tagged("triangle", "marker")
    segments, segment_markers = tagged("line", "marker")
    if tetrahedra is None:
        second = any(kind == "tetra10" for kind, _ in blocks)
        raise TypeError("the mesh holds tetrahedra of second order (tetra10), and those of first order are expected: write it "
                        "to a file and read that" if second else "the mesh holds no tetrahedra")
    return TetMesh(mesh.points, tetrahedra, regions=markers_of(regions, "regions"), triangles=triangles,
                   triangle_markers=triangle_markers, segments=segments, segment_markers=segment_markers, names=names)
