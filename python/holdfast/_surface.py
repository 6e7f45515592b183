"""Surfaces from files, arrays and objects of other packages, which are recognised by their attributes."""

from __future__ import annotations

import importlib
import os
import typing
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._counts import counted
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits
from ._masks import plain
from ._meshio import kind_and_cells, names_in_fields, tags_of
from ._names import Names, names_of

Array = npt.NDArray[Any]
PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Region = tuple[float, float, float, int, float]
Hole = tuple[float, float, float]

_INTEGERS = {np.dtype(t) for t in (np.int32, np.int64, np.uint32, np.uint64)}
_FLOATS = {np.dtype(t) for t in (np.float32, np.float64)}


class Surface:
    """A triangulated surface. Arrays read from a file are read-only.

    Every function that takes a surface accepts this. Optional arrays are None if absent.

    >>> import numpy as np
    >>> s = Surface(np.eye(4, 3), [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)])
    >>> s
    Surface(4 points, 4 triangles)
    """

    def __init__(
        self,
        points: npt.ArrayLike,
        triangles: npt.ArrayLike,
        *,
        segments: Optional[npt.ArrayLike] = None,
        triangle_markers: Optional[npt.ArrayLike] = None,
        segment_markers: Optional[npt.ArrayLike] = None,
        point_markers: Optional[npt.ArrayLike] = None,
        holes: typing.Sequence[Hole] = (),
        regions: typing.Sequence[Region] = (),
        remarks: typing.Sequence[str] = (),
        names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]] = None,
    ) -> None:
        self.points: Array = points_of(points)
        """(n, 3) coordinates."""
        self.triangles: Array = indices_of(triangles, 3, "triangles")
        """(m, 3) indices of points, from 0."""
        self.segments: Optional[Array] = None if segments is None else indices_of(segments, 2, "segments")
        """(k, 2) indices of the ends of segments that are sides of no triangle or have markers."""
        self.triangle_markers: Optional[Array] = markers_of(triangle_markers, "triangle_markers")
        self.segment_markers: Optional[Array] = markers_of(segment_markers, "segment_markers")
        self.point_markers: Optional[Array] = markers_of(point_markers, "point_markers")
        self.holes: list[Hole] = list(holes)
        """Points in regions to leave empty, from the file."""
        self.regions: list[Region] = list(regions)
        """(x, y, z, id, size) of regions, from the file; a size of 0 means none."""
        self.remarks: list[str] = list(remarks)
        """What the file also has, or has in another form."""
        self.names: Names = names_of(names)
        """Names of markers, and of regions numbered by `regions`. Meshes of the surface get them."""

    def __repr__(self) -> str:
        extra = "" if self.segments is None else f", {counted(len(self.segments), 'segment')}"
        return f"Surface({counted(len(self.points), 'point')}, {counted(len(self.triangles), 'triangle')}{extra})"

    def _arrays(self) -> tuple[Any, ...]:
        return (self.points, self.triangles, self.segments, self.point_markers, self.triangle_markers,
                self.segment_markers, tuple(self.names))

    def _given(self) -> tuple[Any, ...]:
        """The arrays, with the regions and holes of the file."""
        return self._arrays(), [tuple(r) for r in self.regions], [list(map(float, h)) for h in self.holes]


def points_of(values: npt.ArrayLike, what: str = "points") -> Array:
    """(n, 3) coordinates of a type that the extension takes without a copy."""
    array = plain(values, what)
    if array.shape == (0,):
        array = np.empty((0, 3))
    if array.dtype == object or array.dtype.kind not in "fiu":
        raise TypeError(f"{what} must be real numbers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{what} must have the shape (n, 3), not {array.shape}")
    if array.dtype.isnative and array.dtype in _FLOATS:
        return array
    if array.dtype.kind == "f" and array.dtype.itemsize > 8:
        raise TypeError(f"{what} are {array.dtype}, which doubles do not hold")
    if array.dtype.kind in "iu":
        return array.astype(np.uint64 if array.dtype.kind == "u" else np.int64, copy=False)
    return array.astype(np.float64)


def indices_of(values: npt.ArrayLike, columns: int, what: str) -> Array:
    """(m, columns) indices of a type that the extension takes without a copy."""
    array = plain(values, what)
    if array.size == 0 and (array.ndim < 2 or array.shape == (0, columns)):  # of any type, as `np.empty` gives floats
        array = np.empty((0, columns), np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{what} must be integers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what} must have the shape (m, {columns}), not {array.shape}")
    return array if array.dtype in _INTEGERS and array.dtype.isnative else array.astype(np.int64)


def markers_of(values: Optional[npt.ArrayLike], what: str) -> Optional[Array]:
    """(m,) integers, or None."""
    if values is None:
        return None
    array = plain(values, what)
    if array.ndim != 1:
        raise ValueError(f"{what} must have the shape (m,), not {array.shape}")
    if array.dtype.kind == "f" and np.all((array == np.floor(array)) & (np.abs(array) < 2**63)):
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise TypeError(f"{what} must be integers, not {array.dtype}")
    return array if array.dtype in _INTEGERS and array.dtype.isnative else array.astype(np.int64)


def surface_of(
    surface: Any,
    triangles: Optional[npt.ArrayLike] = None,
    *,
    segments: Optional[npt.ArrayLike] = None,
    triangle_markers: Optional[npt.ArrayLike] = None,
    segment_markers: Optional[npt.ArrayLike] = None,
    reading: Optional[dict[str, Any]] = None,
) -> Surface:
    """The surface of an argument. Segments and markers that are given replace those of the surface. `reading` holds the
    limits for reading a file."""
    if triangles is not None:
        found = Surface(surface, triangles)
    elif isinstance(surface, (str, bytes, os.PathLike)):
        found = _of_data(_core.read_surface(os.fsdecode(surface), "", reading or {}, None))
    else:
        found = _told_by_shape(surface)
    if segments is None and triangle_markers is None and segment_markers is None:
        return found
    return Surface(
        found.points,
        found.triangles,
        segments=found.segments if segments is None else segments,
        triangle_markers=found.triangle_markers if triangle_markers is None else triangle_markers,
        segment_markers=(found.segment_markers if segments is None else None)
        if segment_markers is None
        else segment_markers,
        point_markers=found.point_markers,
        holes=found.holes,
        regions=found.regions,
        remarks=found.remarks,
        names=found.names,
    )


def _told_by_shape(surface: Any) -> Surface:
    if isinstance(surface, Surface):
        return surface
    if hasattr(surface, "GetPolys") and hasattr(surface, "GetPoints"):
        return _of_vtk(surface)
    if _is_grid(surface):
        raise _not_a_surface(surface)
    if hasattr(surface, "points") and hasattr(surface, "cells") and not hasattr(surface, "faces"):
        return _of_meshio(surface)
    if hasattr(surface, "points") and hasattr(surface, "faces"):
        return _of_pyvista(surface)
    if hasattr(surface, "vertices") and hasattr(surface, "faces"):
        return Surface(surface.vertices, surface.faces)
    if isinstance(surface, (tuple, list)) and len(surface) == 2 and _is_table(surface[0]):
        return Surface(surface[0], surface[1])
    raise _not_a_surface(surface)


def _not_a_surface(given: Any) -> TypeError:
    hint = "; its `extract_surface()`, or VTK's vtkDataSetSurfaceFilter, gives one" if _is_grid(given) else ""
    return TypeError(
        f"a surface is expected: a path, an (n, 3) array with `triangles`, or an object like a PyVista or VTK "
        f"PolyData, a meshio.Mesh or a trimesh.Trimesh; not {type(given).__name__}{hint}"
    )


def _is_grid(given: Any) -> bool:
    """Whether it is an unstructured grid of PyVista or VTK, whose cells are of any kind."""
    return hasattr(given, "celltypes") or hasattr(given, "GetCellTypesArray")


def _is_table(values: Any) -> bool:
    try:
        return np.ndim(values) == 2
    except ValueError:  # rows of different lengths
        return False


class _Polygons(typing.NamedTuple):
    triangles: Array
    origin: Array
    """For each triangle, the polygon that it comes from."""


def _triangles_of(points: Array, offsets: Array, corners: Array) -> _Polygons:
    """Polygons as triangles, cut as the readers of files cut them."""
    counts = np.diff(offsets)
    if np.all(counts == 3):
        return _Polygons(corners.reshape(-1, 3), np.arange(len(counts)))
    if np.any(counts < 3):
        first = int(np.argmax(counts < 3))
        raise ValueError(f"polygon {first} has {int(counts[first])} corners")
    return _Polygons(*_core.triangles_of_polygons(points_of(points), offsets, corners))


def _offsets_of(counted: Array) -> tuple[Array, Array]:
    """The offsets and corners of cells in VTK's old form, [3, a, b, c, 4, ...]."""
    flat = plain(counted, "cells").ravel()
    if flat.size % 4 == 0 and np.all(flat[::4] == 3):
        corners = flat.reshape(-1, 4)[:, 1:].ravel()
        return np.arange(0, corners.size + 1, 3), corners
    starts: list[int] = []
    at = 0
    while at < flat.size:
        starts.append(at)
        at += int(flat[at]) + 1
    if at != flat.size:
        raise ValueError("the list of polygons ends inside one")
    counts = flat[starts]
    keep = np.ones(flat.size, bool)
    keep[starts] = False
    return np.concatenate([[0], np.cumsum(counts)]), flat[keep]


def _lines_of(offsets: Array, corners: Array) -> Array:
    """Polylines as segments."""
    pieces = [corners[b:e] for b, e in zip(offsets[:-1], offsets[1:])]
    found = [np.stack([p[:-1], p[1:]], axis=1) for p in pieces if len(p) > 1]
    return np.concatenate(found) if found else np.empty((0, 2), np.int64)


def _split_markers(markers: Optional[Array], lines: Array, polygons: int) -> tuple[Optional[Array], Optional[Array]]:
    """Markers of segments and polygons, of the offsets of polylines: VTK counts points and lines before polygons."""
    if markers is None:
        return None, None
    behind = len(markers) - polygons
    pieces = np.maximum(np.diff(lines) - 1, 0)
    return np.repeat(markers[behind - len(pieces) : behind], pieces) if len(pieces) else None, markers[behind:]


def _names_of_fields(fields: Any) -> Names:
    """Names in arrays of the whole mesh, as our .vtu has them: pairs of id and dimension."""
    arrays = {name: np.asarray(fields[name]) for name in fields.keys()}
    return names_in_fields({name: pairs for name, pairs in arrays.items() if pairs.ndim == 2 and pairs.shape[1] == 2})


def _named(data: Any, *names: str) -> Optional[Array]:
    for name in names:
        try:
            found = data[name]
        except (KeyError, TypeError, IndexError, AttributeError):
            continue
        if found is not None:
            return plain(found, name)
    return None


def _of_pyvista(mesh: Any) -> Surface:
    points = plain(mesh.points, "points")
    if getattr(mesh, "n_strips", 0):
        raise ValueError("the surface has triangle strips; call .triangulate() first")
    offsets, corners = _offsets_of(mesh.faces)
    cells = _triangles_of(points, offsets, corners)
    lines = plain(getattr(mesh, "lines", np.empty(0, np.int64)), "lines")
    ends = _offsets_of(lines) if lines.size else (np.empty(0, np.int64), lines)
    segments = _lines_of(*ends) if lines.size else None
    of_lines, markers = _split_markers(_named(getattr(mesh, "cell_data", None), "marker"), ends[0], len(offsets) - 1)
    return Surface(points, cells.triangles, segments=segments, triangle_markers=None if markers is None else markers[cells.origin],
                   segment_markers=of_lines, names=_names_of_fields(getattr(mesh, "field_data", None) or {}))


def _of_vtk(mesh: Any) -> Surface:
    vtk_to_numpy = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy
    if mesh.GetPoints() is None:
        return Surface(np.empty((0, 3)), np.empty((0, 3), np.int64))
    if mesh.GetNumberOfStrips():
        raise ValueError("the surface has triangle strips; use vtkTriangleFilter first")

    def cells_of(cells: Any) -> tuple[Array, Array]:
        return vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())

    points = vtk_to_numpy(mesh.GetPoints().GetData())
    cells = _triangles_of(points, *cells_of(mesh.GetPolys()))
    lines = cells_of(mesh.GetLines()) if mesh.GetNumberOfLines() else (np.empty(0, np.int64), np.empty(0, np.int64))
    segments = _lines_of(*lines) if mesh.GetNumberOfLines() else None
    array = mesh.GetCellData().GetArray("marker")
    given = None if array is None else vtk_to_numpy(array)
    of_lines, markers = _split_markers(given, lines[0], mesh.GetNumberOfPolys())
    data = mesh.GetFieldData()
    tables = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]  # None for words
    fields = {table.GetName(): vtk_to_numpy(table) for table in tables if table is not None}
    return Surface(points, cells.triangles, segments=segments, triangle_markers=None if markers is None else markers[cells.origin],
                   segment_markers=of_lines, names=_names_of_fields(fields))


def _of_meshio(mesh: Any) -> Surface:
    points = plain(mesh.points, "points")
    if points.ndim == 2 and points.shape[1] == 2:
        raise ValueError("the mesh is plane: its points have two coordinates")
    triangles: list[Array] = []
    markers: list[Array] = []
    segments: list[Array] = []
    segment_markers: list[Array] = []
    tags = tags_of(mesh, "marker")
    for i, block in enumerate(mesh.cells):
        kind, cells = kind_and_cells(block)
        cells = plain(cells, "cells")
        marks = np.zeros(len(cells), np.int64) if tags.ids is None else tags.ids[i]
        if kind in ("triangle", "triangle6", "triangle7"):
            triangles.append(cells[:, :3])
            markers.append(marks)
        elif kind in ("quad", "quad8", "quad9", "polygon"):
            corners = cells[:, :4] if kind != "polygon" else cells
            width = corners.shape[1]
            found = _triangles_of(points, np.arange(0, corners.size + 1, width), corners.ravel())
            triangles.append(found.triangles)
            markers.append(marks[found.origin])
        elif kind in ("line", "line3"):
            segments.append(cells[:, :2])
            segment_markers.append(marks)
    solid = [kind for kind, _ in map(kind_and_cells, mesh.cells) if kind.startswith(("tet", "hex", "wedge", "pyramid"))]
    if not triangles and solid:
        held = "tetrahedra" if solid[0].startswith("tet") else f"{solid[0]} cells"
        raise TypeError(f"the mesh holds {held} and no triangles; a surface is expected")
    marked = tags.ids is not None
    return Surface(
        points,
        np.concatenate(triangles) if triangles else np.empty((0, 3), np.int64),
        segments=np.concatenate(segments) if segments else None,
        triangle_markers=np.concatenate(markers) if marked and markers else None,
        segment_markers=np.concatenate(segment_markers) if marked and segments else None,
        names=tags.names,
    )


def _or_none(array: Array) -> Optional[Array]:
    return array if len(array) else None


def _of_data(data: _core.SurfaceData) -> Surface:
    return Surface(
        data.points,
        data.triangles,
        segments=_or_none(data.segments),
        triangle_markers=_or_none(data.triangle_markers),
        segment_markers=_or_none(data.segment_markers),
        point_markers=_or_none(data.point_markers),
        holes=data.holes,
        regions=data.regions,
        remarks=data.remarks,
        names=Names(*data.names),
    )


def read_surface(
    path: Union[PathLike, typing.Iterable[PathLike]],
    format: Optional[str] = None,
    *,
    tolerance: float = 0.0,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> Surface:
    """Reads a surface from .stl, .off, .obj, .ply, .3mf, .amf, .gltf, .glb, .wrl (VRML), .ts (GOCAD), .mesh, .meshb,
    .poly, .smesh, .node, .msh, .vtu, .vtp or .vtk.

    Parameters
    ----------
    path
        The file, which may be compressed by gzip; or several files, whose indices are shifted. The triangles of a file
        without markers get the next free marker, from 1, and the file's name.
    format
        The ending to use (".stl") if the file's own does not give the format.
    tolerance
        How far corners of a facet of several polygons or with holes (`.poly`) may lie from its plane, in the file's unit;
        rounding is always allowed. Single polygons need no plane.
    time_limit, memory_limit, cancel, progress
        As in `mesh`.

    Raises
    ------
    FileError
        If there is no such file, or it is not in the format of its ending.

    Example
    -------
    >>> read_surface("part.stl")  # doctest: +SKIP
    Surface(1042 points, 2080 triangles)
    """
    options = limits(time_limit, memory_limit, cancel)
    if not 0 <= tolerance < float("inf"):
        raise ValueError(f"tolerance={tolerance}: a finite length, not negative, is expected")
    options["tolerance"] = float(tolerance)
    paths = [path] if isinstance(path, (str, bytes, os.PathLike)) else list(path)
    with Shown(progress, "read") as callback:
        parts = [_core.read_surface(os.fsdecode(p), format or "", options, callback) for p in paths]
    if not parts:
        raise ValueError("there is no surface")
    return _of_data(parts[0] if len(parts) == 1 else _core.join(parts, [_stem(p) for p in paths]))


def _stem(path: PathLike) -> str:
    name = os.path.basename(os.fsencode(path)).decode("utf-8", "replace")  # for people, as the program reports it
    return os.path.splitext(name[:-3] if name.endswith(".gz") else name)[0]
