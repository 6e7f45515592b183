"""The functions: mesh, diagnose, check, delaunay, untangle, read_volume."""

from __future__ import annotations

import json
import numbers
import operator
import os
import typing
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._limits import CancelToken, MemoryAmount, ProgressCallback, Shown, limits
from ._paste import Pasted
from ._repair import repair as repair_surface
from ._surface import Array, PathLike, Surface, indices_of, markers_of, points_of, surface_of
from ._tetmesh import TetMesh
from .errors import Defect, _defects, _raise_unless_done

Progress = Union[None, bool, ProgressCallback]
Size = Any  # a number, an array, a background mesh, a path or a function


def mesh(
    surface: Any,
    triangles: Optional[npt.ArrayLike] = None,
    *,
    segments: Optional[npt.ArrayLike] = None,
    triangle_markers: Optional[npt.ArrayLike] = None,
    segment_markers: Optional[npt.ArrayLike] = None,
    size: Size = None,
    metric: Any = None,
    gradation: float = 0.3,
    growth: bool = True,
    max_volume: Union[None, float, typing.Mapping[Optional[int], float]] = None,
    max_ratio: Optional[float] = None,
    layers: Optional[int] = None,
    fill: bool = False,
    quality: str = "good",
    keep: str = "auto",
    box_margin: float = 0.1,
    holes: typing.Iterable[typing.Sequence[float]] = (),
    regions: typing.Iterable[typing.Sequence[float]] = (),
    drop_outside: bool = False,
    repair: Union[bool, float] = False,
    without: typing.Iterable[str] = (),
    order: str = "random",
    seed: int = 1,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> TetMesh:
    """Fills a surface with tetrahedra and keeps every triangle and segment of it exactly.

    Parameters
    ----------
    surface
        A path, a `Surface`, parts that `paste` put together, an (n, 3) array of points together with `triangles`, or anything shaped like a PyVista or
        VTK PolyData, a `meshio.Mesh` or a `trimesh.Trimesh`. Arrays of float64 points and int32 or uint32 triangles that
        lie together in memory are not copied.
    triangles
        (m, 3) indices from 0.
    segments
        (k, 2) indices: edges to keep that belong to no triangle, or that have markers.
    triangle_markers, segment_markers
        (m,) and (k,) integers that the result repeats.
    size
        How long edges should be, in the surface's unit: a number (the most anywhere), one a point of the surface (0: as
        the surface has it), a background mesh (a path to .mesh with .sol, .vtu, .mtr or .pos; or `(points, tetrahedra,
        sizes)`), or a function that takes an (m, 3) array and gives m sizes, where what is not positive is no limit.
    metric
        The same for sizes that depend on the direction: `(points, tetrahedra, tensors)`, a path, or a function that takes
        an (m, 3) array and gives (m, 3, 3) or (m, 6) numbers (m11 m12 m22 m13 m23 m33): in this metric edges have length 1.
    gradation
        How much sizes grow a unit of length, away from the surface; 0 to 1.
    growth
        Whether sizes may grow inside beyond those of the surface round.
    max_volume
        The most that a tetrahedron may measure: a number, or a dict of numbers by the ids of the mesh's regions (None: anywhere). It holds
        for every tetrahedron, even at the price of flat ones; `TetMesh.report["bounds"]` counts them.
    max_ratio
        The most that the radius of the sphere round a tetrahedron should be over its shortest edge: an aim. Exceptions
        are counted in `TetMesh.report["bounds"]`.
    layers
        Elements across, at least, on every path inside between two sides of a wall or a gap that face each other;
        `TetMesh.report["layers"]` tells the points that it took. At most 100.
    fill
        Add no field points: only what the surface forces. `size`, `metric`, `gradation`, `growth`, `max_volume`,
        `max_ratio` and `layers` have no meaning then.
    quality
        Effort for the elements with field points: "fast", "good" or "best".
    keep
        "auto" (by winding number where the surface is turned consistently, else every bounded region), "bounded",
        "winding" or "box" (everything out to a box, `box_margin` of the largest extent away).
    holes
        (x, y, z) of points in regions to leave empty.
    regions
        (x, y, z, id[, size]): the id, and the longest edge wanted, of the region that holds the point.
    drop_outside
        Drop triangles outside every kept region instead of refusing them.
    repair
        Make the surface valid first, as `holdfast.repair` does: True, or the distance within which vertices are joined.
        The result's `repair` tells what changed.
    without
        Steps to leave out: "flips", "optimise", "points".
    order
        In which missing constraints are cut into the mesh: "random", "given" (as the surface has them) or "halving" (the middle
        one first, then those in the middle of both halves).
    seed, threads
        Of the random orders; 0 threads are all there are. The result is the same on any number of threads.
    time_limit
        Seconds.
    memory_limit
        Of the process: gigabytes, or bytes from a million on, or text with a unit ("500 MB").
    cancel
        A `CancelToken` that another thread may use.
    progress
        True shows a bar; or a function that takes (stage, fraction of the whole call). Where it returns False, the call
        is cancelled; what it raises comes out of the call.

    Raises
    ------
    InvalidSurface
        With `.defects`, if the surface breaks a rule.
    TimeLimit, MemoryLimit, Cancelled, NotRepresentable
        With `.report` of the run so far.
    FileError
        If `surface` is a path that cannot be read.
    ValueError, TypeError
        For arrays of a wrong shape or type, and options that make no sense or do not suit the surface.

    Example
    -------
    >>> import holdfast
    >>> points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    >>> quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    >>> cube = holdfast.mesh(points, triangles, size=0.5)
    >>> cube.n_input_points, round(float(cube.quality().volume.sum()), 12)
    (8, 1.0)
    """
    options = limits(time_limit, memory_limit, cancel)
    steps = {without} if isinstance(without, str) else set(without)
    if unknown := steps - {"flips", "optimise", "points"}:
        raise ValueError(f"without={sorted(unknown)}: only 'flips', 'optimise' and 'points' can be left out")
    if fill and any(x is not None for x in (size, metric, max_volume, max_ratio, layers)):
        raise ValueError("fill=True adds no field points, so that size, metric, max_volume, max_ratio and layers have no meaning; "
                         "leave out one of them")
    pasted = surface if isinstance(surface, Pasted) else None
    what = surface_of(
        surface if pasted is None else pasted.surface,
        triangles,
        segments=segments,
        triangle_markers=triangle_markers,
        segment_markers=segment_markers,
    )
    if pasted is not None and what is not pasted.surface:
        raise ValueError("a pasted surface is meshed as it is: leave out triangles, segments and markers")
    repaired = None
    if pasted is not None and repair is not False:
        raise ValueError("a pasted surface is valid: leave out repair")
    if repair is not False:
        repaired = repair_surface(what, weld=0.0 if repair is True else float(repair), threads=int(threads),
                                  time_limit=time_limit, memory_limit=memory_limit, cancel=cancel, progress=progress)
        what = repaired.surface
    options.update(
        fill=fill,
        gradation=float(gradation),
        growth=bool(growth),
        quality=quality,
        keep=keep,
        box_margin=float(box_margin),
        holes=[_numbers(h, 3, "a hole") for h in holes] + [list(map(float, h)) for h in what.holes],
        regions=_bounded([_region(r) for r in [*regions, *what.regions]], max_volume),
        max_volume=_most_volume(max_volume),
        max_ratio=0.0 if max_ratio is None else _positive(max_ratio, "max_ratio"),
        layers=_layers(layers),
        drop_outside=bool(drop_outside),
        flips="flips" not in steps,
        optimise="optimise" not in steps,
        add_points="points" not in steps,
        order=order,
        seed=int(seed),
        threads=int(threads),
    )
    asked_size = _set_size(size, options, len(what.points))
    asked_metric = _set_metric(metric, options)
    with Shown(progress, "mesh") as callback:
        if pasted is not None:
            result = _core.mesh_pasted(pasted._result, options, asked_size, asked_metric, callback)
        else:
            result = _core.mesh(what._arrays(), options, asked_size, asked_metric, callback)
    _raise_unless_done(result)
    meshed = TetMesh._of(result.volume, result.n_input_points, result)
    meshed.repair = repaired
    return meshed


def _numbers(values: typing.Sequence[float], count: int, what: str) -> list[float]:
    found = [float(v) for v in values]
    if len(found) != count:
        raise ValueError(f"{what} is given by {count} numbers, not {len(found)}")
    return found


def _region(values: typing.Sequence[float]) -> tuple[float, float, float, int, float]:
    if len(values) not in (4, 5):
        raise ValueError(f"a region is given as (x, y, z, id) or (x, y, z, id, size), not by {len(values)} numbers")
    if int(values[3]) != values[3] or not -(2**31) <= int(values[3]) < 2**31:
        raise ValueError(f"the id of a region must be an integer of 32 bits, not {values[3]!r}")
    size = float(values[4]) if len(values) == 5 and values[4] is not None else 0.0
    return (float(values[0]), float(values[1]), float(values[2]), int(values[3]), size)


def _positive(value: Any, what: str) -> float:
    number = float(value)
    if not 0 < number < float("inf"):
        raise ValueError(f"{what}={number}: a positive number is expected")
    return number


def _layers(layers: Optional[int]) -> int:
    if layers is None:
        return 0
    number = operator.index(layers)
    if not 1 <= number <= 100:
        raise ValueError(f"layers={number}: 1 to 100 are expected")
    return number


def _most_volume(most: Union[None, float, typing.Mapping[Optional[int], float]]) -> float:
    """The bound that holds anywhere, 0 for none."""
    anywhere = most.get(None) if isinstance(most, typing.Mapping) else most
    return 0.0 if anywhere is None else _positive(anywhere, "max_volume")


def _bounded(
    regions: list[tuple[float, float, float, int, float]],
    most: Union[None, float, typing.Mapping[Optional[int], float]],
) -> list[tuple[float, float, float, int, float, float]]:
    """The regions with the volume that their tetrahedra may measure, 0 for any."""
    if not isinstance(most, (numbers.Real, typing.Mapping, type(None))):
        raise TypeError("max_volume is a number, or a dict of numbers by the ids of regions")
    by_id = {id: v for id, v in most.items() if id is not None} if isinstance(most, typing.Mapping) else {}
    nowhere = float("nan")  # the region that has the id in the mesh, whatever gives it (holdfast/region_bounds.h)
    bounds = [(nowhere, nowhere, nowhere, int(id), 0.0, _positive(v, "max_volume")) for id, v in sorted(by_id.items())]
    return [(*r, 0.0) for r in regions] + bounds


def _is_background(value: Any) -> bool:
    return isinstance(value, tuple) and len(value) == 3 and np.ndim(value[0]) == 2 and np.ndim(value[1]) == 2


def _set_size(size: Size, options: dict[str, Any], points: int) -> Optional[typing.Callable[[Array], Any]]:
    """Puts what `size` means into the options, or gives the function that it is."""
    if size is None:
        return None
    if isinstance(size, (str, os.PathLike)):
        field = _core.read_size_field(os.fspath(size), {})
        if field.has_mesh:
            options["size_field"] = field
        else:
            options["point_sizes"] = _point_sizes(field.sizes, points)
    elif _is_background(size):
        where, tetrahedra, sizes = size
        options["size_field"] = _core.SizeField(points_of(where), indices_of(tetrahedra, 4, "tetrahedra"),
                                                np.asarray(sizes, np.float64).ravel().tolist(), [])
    elif hasattr(size, "points") and hasattr(size, "point_data"):
        options["size_field"] = _background(size, "size")
    elif callable(size):
        asked: typing.Callable[[Array], Any] = size
        return asked
    elif np.ndim(size) == 0:
        number = float(size)
        if not 0 < number < float("inf"):
            raise ValueError(f"size={number}: a positive length is expected")
        options["size"] = number
    else:
        options["point_sizes"] = _point_sizes(size, points)
    return None


def _point_sizes(sizes: npt.ArrayLike, points: int) -> list[float]:
    array = np.asarray(sizes, np.float64)
    if array.shape != (points,):
        raise ValueError(f"size must be one number, or one a point of the surface, ({points},), not {array.shape}")
    return [float(x) for x in array]


def _as_six(tensors: npt.ArrayLike) -> Array:
    """m11 m12 m22 m13 m23 m33 of (m, 3, 3) or (m, 6) numbers."""
    array = np.asarray(tensors, np.float64)
    if array.ndim == 3 and array.shape[1:] == (3, 3):
        return np.stack([array[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))], axis=1)
    if array.ndim == 2 and array.shape[1] == 6:
        return array
    raise ValueError(f"metrics must have the shape (m, 3, 3) or (m, 6), not {array.shape}")


def _background(mesh: Any, name: str) -> _core.SizeField:
    """A `meshio.Mesh` with a point array "size" or "metric"."""
    data = mesh.point_data
    if name not in data:
        raise ValueError(f"the background mesh has no point data '{name}'")
    cells = [np.asarray(b.data) for b in mesh.cells if b.type == "tetra"]
    tetrahedra = np.concatenate(cells) if cells else np.empty((0, 4), np.int64)
    values = np.asarray(data[name], np.float64)
    if name == "size":
        return _core.SizeField(points_of(mesh.points), indices_of(tetrahedra, 4, "tetrahedra"), values.ravel().tolist(), [])
    return _core.SizeField(points_of(mesh.points), indices_of(tetrahedra, 4, "tetrahedra"), [], _as_six(values).tolist())


def _set_metric(metric: Any, options: dict[str, Any]) -> Optional[typing.Callable[[Array], Array]]:
    if metric is None:
        return None
    if "size_field" in options:
        raise ValueError("size and metric cannot both be background meshes")
    if isinstance(metric, (str, os.PathLike)):
        options["size_field"] = _core.read_size_field(os.fspath(metric), {})
        if not options["size_field"].has_metrics:
            raise ValueError(f"metric={os.fspath(metric)!r}: the file holds sizes, not metrics; give it as size")
    elif _is_background(metric):
        where, tetrahedra, tensors = metric
        options["size_field"] = _core.SizeField(points_of(where), indices_of(tetrahedra, 4, "tetrahedra"), [],
                                                _as_six(tensors).tolist())
    elif hasattr(metric, "points") and hasattr(metric, "point_data"):
        options["size_field"] = _background(metric, "metric")
    elif callable(metric):
        return lambda points: _as_six(metric(points))
    else:
        raise TypeError("metric must be a function, a path or (points, tetrahedra, tensors)")
    return None


class Diagnosis(list[Defect]):
    """The defects of a surface, a list, with what they come to. Empty for a surface that breaks no rule.

    `summary` is a dict: "causes" (grouped by what has probably gone wrong, each with a message that says what to do),
    "gaps", "open_sides", "parts" and "encloses" (how many regions the surface bounds; None where it is not valid).
    """

    def __init__(self, defects: typing.Iterable[Defect], summary: dict[str, Any]) -> None:
        super().__init__(defects)
        self.summary = summary

    @property
    def defects(self) -> list[Defect]:
        """The same, as a plain list."""
        return list(self)

    @property
    def valid(self) -> bool:
        """Whether the surface breaks no rule. An open one may be valid, yet enclose nothing."""
        return not self

    @property
    def encloses(self) -> Optional[int]:
        """How many regions the surface bounds; None where it is not valid."""
        found = self.summary["encloses"]
        return None if found is None else int(found)

    def __repr__(self) -> str:
        if self.valid:
            return f"Diagnosis(valid, encloses {self.encloses} region{'' if self.encloses == 1 else 's'})"
        return "Diagnosis(" + "; ".join(c["message"] for c in self.summary["causes"]) + ")"


def diagnose(
    surface: Any,
    triangles: Optional[npt.ArrayLike] = None,
    *,
    segments: Optional[npt.ArrayLike] = None,
    most: Optional[int] = None,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> Diagnosis:
    """Finds every broken rule of a valid surface, exactly; at most `most` of them.

    Raises TimeLimit, MemoryLimit, Cancelled and FileError; never InvalidSurface.

    >>> import holdfast
    >>> holdfast.diagnose([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ...                   [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    Diagnosis(valid, encloses 1 region)
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(most=most, threads=int(threads))
    what = surface_of(surface, triangles, segments=segments)
    with Shown(progress, "diagnose") as callback:
        defects, summary = _core.diagnose(what._arrays(), options, callback)
    return Diagnosis(_defects(defects), json.loads(summary))


@dataclass(frozen=True)
class Rule:
    """One rule of the promise and whether it holds."""

    name: str
    holds: bool
    detail: str


@dataclass(frozen=True)
class CheckResult:
    """True if every rule of the promise holds.

    >>> bool(CheckResult([Rule("volumes positive", True, "")]))
    True
    """

    rules: list[Rule]

    @property
    def holds(self) -> bool:
        return all(rule.holds for rule in self.rules)

    def __bool__(self) -> bool:
        return self.holds

    @property
    def broken(self) -> list[Rule]:
        return [rule for rule in self.rules if not rule.holds]

    def __str__(self) -> str:
        return "\n".join(f"{'holds ' if r.holds else 'BROKEN'}  {r.name}{': ' + r.detail if r.detail else ''}"
                         for r in self.rules)


def check(
    surface: Any,
    mesh: Any,
    *,
    outside_dropped: bool = False,
    box: bool = False,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> CheckResult:
    """Checks exactly, and independently of how it was made, that a mesh keeps a surface.

    `surface` is what `mesh` takes (`(points, triangles)` for arrays), `mesh` a `TetMesh`, a path, or an object like a
    `meshio.Mesh`. `outside_dropped` accepts missing triangles outside every tetrahedron, `box` a mesh that goes out to a
    box.

    >>> import holdfast
    >>> s = holdfast.Surface([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    >>> holdfast.check(s, holdfast.mesh(s)).holds
    True
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(outside_dropped=bool(outside_dropped), box=bool(box))
    what = surface_of(surface)
    volume = volume_of(mesh)._volume
    with Shown(progress, "check") as callback:
        found = json.loads(_core.check(what._arrays(), volume, options, callback))
    return CheckResult([Rule(r["name"], r["holds"], r["detail"]) for r in found["rules"]])


def delaunay(
    points: npt.ArrayLike,
    *,
    seed: int = 1,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> Array:
    """(m, 4) int32: Delaunay tetrahedra of (n, 3) points. Repeated points are left unused; none where all are coplanar.

    >>> import holdfast
    >>> holdfast.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).shape
    (1, 4)
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(seed=int(seed), threads=int(threads))
    with Shown(progress, "delaunay") as callback:
        return _core.delaunay(points_of(points), options, callback)


def untangle(
    mesh: Any,
    *,
    fixed: typing.Iterable[int] = (),
    refill: bool = True,
    improve: bool = False,
    seed: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> TetMesh:
    """Makes every tetrahedron of a mesh positive, with its boundary fixed bit for bit.

    `fixed` are points to keep besides those of the boundary, triangles and segments; `refill` may add and remove points
    where moves and exchanges do not do. `improve` makes elements better when all are positive; it adds and removes points,
    and so needs `refill`. Raises InvalidSurface if the boundary or the connectivity is wrong, NotRepresentable if no positive
    mesh was found, and as `mesh` for limits.

    >>> import holdfast
    >>> tangled = holdfast.TetMesh([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3), (2, 2, 2)],
    ...                            [(0, 1, 2, 4), (0, 1, 4, 3), (0, 4, 2, 3), (4, 1, 2, 3)])
    >>> (holdfast.untangle(tangled).quality().volume > 0).all()
    True
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(fixed=[int(v) for v in fixed], refill=bool(refill), improve=bool(improve), seed=int(seed))
    what = volume_of(mesh)
    with Shown(progress, "untangle") as callback:
        result = _core.untangle(what._volume, options, callback)
    _raise_unless_done(result)
    return TetMesh._of(result.volume, what.n_input_points, result)


def read_volume(
    path: PathLike,
    format: Optional[str] = None,
    *,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> TetMesh:
    """Reads tetrahedra from .vtu, .vtm, .vtk, .mesh, .meshb, .msh, .inp, .unv, .bdf, .nas, .su2, .mfem, .vol, .xdmf, .med,
    .node with .ele, or a folder polyMesh. Raises FileError.

    >>> read_volume("part.vtu")  # doctest: +SKIP
    TetMesh(2817 points, 9213 tetrahedra, 1 region)
    """
    options = limits(time_limit, memory_limit, cancel)
    with Shown(progress, "read") as callback:
        volume, _ = _core.read_volume(os.fspath(path), format or "", options, callback)
    known = volume.input_points
    return TetMesh._of(volume, int(np.count_nonzero(known >= 0)) if len(known) else None)


def info(path: PathLike, format: Optional[str] = None) -> dict[str, Any]:
    """What a surface or volume file holds: counts, sizes, regions and markers with their names and measures, shapes of the
    tetrahedra, with the keys of `holdfast info --json` (docs/command-line.md). Raises FileError.

    >>> holdfast.info("part.vtu")["volume"]  # doctest: +SKIP
    12.5
    """
    name = os.fspath(path)
    ending = _core.volume_format_of(name.removesuffix(".gz"), format or "")
    remarks: list[str] = []
    told: dict[str, Any] = {}
    stem = os.path.splitext(name)[0]
    if ending in _core.volume_formats() and (ending != ".node" or os.path.exists(stem + ".ele")):
        volume, remarks = _core.read_volume(name, format or "", {}, None)
        if len(volume.tetrahedra):
            told = {"file": name, "kind": "volume", **json.loads(_core.volume_info(volume))}
    if not told:
        surface = _core.read_surface(name, format or "", {}, None)
        remarks = surface.remarks
        told = {"file": name, "kind": "surface", **json.loads(_core.surface_info(surface))}
    return {**told, "remarks": remarks}


def volume_of(mesh: Any) -> TetMesh:
    """The mesh that an argument means."""
    if isinstance(mesh, TetMesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        return read_volume(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells") and not hasattr(mesh, "celltypes"):
        return _of_meshio(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):  # PyVista's grid
        cells = mesh.cells_dict
        regions = mesh.cell_data["region"][np.asarray(mesh.celltypes) == 10] if "region" in mesh.cell_data else None
        return TetMesh(mesh.points, cells[10], regions=regions, triangles=cells.get(5), segments=cells.get(3))
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2 and np.ndim(mesh[0]) == 2:
        return TetMesh(mesh[0], mesh[1])
    raise TypeError(f"a mesh is expected: a TetMesh, a path, (points, tetrahedra), or an object like a meshio.Mesh; "
                    f"not {type(mesh).__name__}")


_REGION_NAMES = ("region", "gmsh:physical", "medit:ref")
_MARKER_NAMES = ("marker", "gmsh:physical", "medit:ref")


def _of_meshio(mesh: Any) -> TetMesh:
    data = getattr(mesh, "cell_data", None) or {}

    def blocks(kind: str, names: typing.Sequence[str]) -> tuple[Optional[Array], Optional[Array]]:
        here = [i for i, b in enumerate(mesh.cells) if b.type == kind]
        if not here:
            return None, None
        name = next((n for n in names if n in data), None)
        cells = np.concatenate([np.asarray(mesh.cells[i].data) for i in here])
        return cells, None if name is None else np.concatenate([np.asarray(data[name][i]) for i in here])

    tetrahedra, regions = blocks("tetra", _REGION_NAMES)
    triangles, triangle_markers = blocks("triangle", _MARKER_NAMES)
    segments, segment_markers = blocks("line", _MARKER_NAMES)
    if tetrahedra is None:
        raise TypeError("the mesh holds no tetrahedra")
    return TetMesh(mesh.points, tetrahedra, regions=markers_of(regions, "regions"), triangles=triangles,
                   triangle_markers=triangle_markers, segments=segments, segment_markers=segment_markers)
