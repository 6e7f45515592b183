"""plane: triangulates the plane and keeps every segment."""

from __future__ import annotations

import json
import os
import typing
from typing import Any, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._counts import counted
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits, weld_of, whole
from ._masks import plain, require_unmasked
from ._mesh import _listed, _positive
from ._names import Fixed, Names, names_of
from ._surface import Array, PathLike, indices_of, markers_of
from .errors import _raise_unless_done

_MOST_POINTS = 10_000_000
_METHODS, _EARS = ("ears", "swaps", "partition"), ("first", "best", "join")
_STAGES, _ORDERS = ("delaunay", "partition", "swap"), ("given", "random", "halving")


class PlaneMesh:
    """Triangles in the plane, as read-only arrays.

    Points 0 to `n_input_points - 1` are the given points, bit for bit; after `repair`, those that stay
    (with a length some may have moved).
    """

    def __init__(self, result: _core.PlaneResult) -> None:
        self._result = result
        self._report: Optional[dict[str, Any]] = None
        self.n_input_points: int = result.n_input_points
        """Number of given points. The points after them were added for `size`, `angle` or `repair`."""
        self.remarks: list[str] = list(result.remarks)
        """What the file also has, or has in another form."""

    @property
    def points(self) -> Array:
        """(n, 2) coordinates; (n, 3) for a plane in space."""
        return self._result.points

    @property
    def triangles(self) -> Array:
        """(m, 3) indices of points, counterclockwise; in space they are oriented as the first polygon of their
        plane."""
        return self._result.triangles

    @property
    def regions(self) -> Array:
        """(m,) the region of each triangle: the id of a seed, or the next free number from 1."""
        return self._result.regions

    @property
    def segments(self) -> Array:
        """(k, 2) indices of the ends of segments: the given segments, in pieces where points were added on them."""
        return self._result.segments

    @property
    def point_markers(self) -> Optional[Array]:
        """(n,) if points have markers, otherwise None. Points on a segment carry its marker."""
        return _or_none(self._result.point_markers)

    @property
    def segment_markers(self) -> Optional[Array]:
        """(k,) if segments have markers, otherwise None."""
        return _or_none(self._result.segment_markers)

    @property
    def names(self) -> Names:
        """The names of a file: `segments` and `points` of their markers, as of layers of a .dxf. They are written to formats
        that can hold them; `save(path, names=...)` writes others."""
        return Names(*map(Fixed, self._result.names))

    @property
    def report(self) -> dict[str, Any]:
        """The report, as `holdfast plane --report` writes it."""
        if self._report is None:
            self._report = json.loads(self._result.report())
        return self._report

    def save(
        self,
        path: PathLike,
        format: Optional[str] = None,
        *,
        names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[MemoryAmount] = None,
        cancel: Optional[CancelToken] = None,
        progress: Progress = None,
    ) -> list[str]:
        """Writes .off (z = 0), .node with .ele and .edge beside it, .vtu, or any format in which `convert` writes surfaces;
        there, the region of a triangle is its marker. `names` replaces the names of ids; `regions` and `triangles` both
        name regions. The file appears complete or not at all. Returns what the format does not hold. Raises FileError."""
        legacy = format in ("msh2", ".msh2")
        options = limits(time_limit, memory_limit, cancel)
        options.update(legacy_msh=legacy, names=None if names is None else tuple(names_of(names)))
        with Shown(progress, "write") as callback:
            return self._result.save(os.fsdecode(path), ".msh" if legacy else format or "", options, callback)

    def __repr__(self) -> str:
        return f"PlaneMesh({counted(len(self.points), 'point')}, {counted(len(self.triangles), 'triangle')})"


def plane(
    points: Any,
    segments: Optional[npt.ArrayLike] = None,
    *,
    holes: typing.Iterable[typing.Sequence[float]] = (),
    regions: typing.Iterable[typing.Sequence[float]] = (),
    point_markers: Optional[npt.ArrayLike] = None,
    segment_markers: Optional[npt.ArrayLike] = None,
    method: str = "swaps",
    ears: Optional[str] = None,
    partition_first: bool = False,
    delaunay: bool = False,
    hull: bool = False,
    size: Optional[float] = None,
    angle: Optional[float] = None,
    keep_boundary: bool = False,
    max_points: Optional[int] = None,
    stop_after: Optional[str] = None,
    order: Optional[str] = None,
    tolerance: float = 0.0,
    arcs: Optional[float] = None,
    repair: Union[bool, float] = False,
    seed: int = 1,
    format: Optional[str] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> PlaneMesh:
    """Fills outlines in the plane with triangles and keeps every segment. Points are added only for a size or an angle.

    Parameters
    ----------
    points
        (n, 2) coordinates; (n, 3) coordinates of points in one plane in space; or the path of a .poly or .node
        (Triangle), of lines (.dxf), or of polygons in space (.off, .obj, .ply, ...).
    segments
        (k, 2) indices from 0. Outlines, nested or not, and segments with free ends. Every region that segments separate
        from the outside is kept; without segments, everything within the convex hull.
    holes
        (x, y) of points in regions to leave empty; (x, y, z) in space.
    regions
        (x, y, id[, area]): the id of the region that contains the point, and the largest area of its triangles, with
        `size` or `angle`.
    point_markers, segment_markers
        (n,) and (k,) integers that the result repeats.
    method
        "ears", "swaps" or "partition": how missing segments are recovered. Each method solves every valid input.
    ears
        For the method "ears": "first", "best" (the corner whose triangle is closest to a regular one) or "join" (the second
        construction of the paper's §2.1.2).
    partition_first
        For the method "partition": remove added points when all segments exist, not after each segment.
    delaunay
        Finally swap edges until the triangles are constrained Delaunay.
    hull
        Keep everything within the convex hull except holes.
    size
        Add points until no edge is longer than this, in the points' unit. The triangles are then constrained Delaunay,
        with angles of at least 20 degrees.
    angle
        Add points until no angle is smaller than this, in degrees: 0 to 34. Up to 26.45 this ends for every input.
    keep_boundary
        Add points only inside, none on segments.
    max_points
        Largest number of points added for `size` and `angle`; 10,000,000 by default.
    stop_after
        "delaunay", "partition" or "swap=K" (after K swaps): return the mesh after this stage, with "intermediate" in
        the report.
    order
        Which missing segment is laid next, for "swaps" and "partition": "given", "random" or "halving"; by default one
        near the previous one.
    tolerance
        How far points in space may be from their mean plane; rounding is always allowed.
    arcs
        Divide the arcs of a .dxf into straight pieces of at most so many degrees, 0.1 to 120; by default they are
        refused.
    repair
        First cut segments where they cross, overlap or pass through points, and join points at one place. A length also
        joins points within it of each other and of segments. `report["repair"]` says what was done. Points that
        become others are left out of (n, 2) points, and stay unused in space; new points come after those that stay.
    seed
        The seed of the random orders.
    format
        The ending to use (".poly") if the file's own does not give the format.
    time_limit, memory_limit, cancel, progress
        As in `mesh`.

    Raises
    ------
    InvalidSurface
        With `.defects`: repeated points, points on segments, segments that cross, overlap or have no length, and segments that
        enclose nothing. Indices count from 0, `where` has z = 0.
    TimeLimit, MemoryLimit, Cancelled
        With `.report` of the run so far.
    FileError
        If `points` is a path that cannot be read.
    ValueError, TypeError
        For arrays of a wrong shape or type, and options that make no sense.

    Example
    -------
    A square with a square hole:

    >>> import holdfast
    >>> points = [(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2)]
    >>> segments = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
    >>> mesh = holdfast.plane(points, segments, holes=[(1.5, 1.5)])
    >>> mesh.points.shape, mesh.triangles.shape
    ((8, 2), (8, 3))
    >>> fine = holdfast.plane(points, segments, holes=[(1.5, 1.5)], size=0.5, angle=25)
    >>> fine.report["mesh"]["least_angle"] >= 25, bool((fine.points[:8] == points).all())
    (True, True)
    """
    options = limits(time_limit, memory_limit, cancel)
    refines = size is not None or angle is not None
    stop_after, swaps = _stage(stop_after)
    _require_sense(method, ears, order, partition_first, stop_after, refines, keep_boundary, max_points)
    holes, regions = _listed(holes, "holes"), _listed(regions, "regions")
    if stop_after is not None and (delaunay or holes or regions):
        raise ValueError("stop_after: delaunay, holes and regions come after it")
    options.update(
        method=method,
        ears=ears,
        partition_first=bool(partition_first),
        delaunay=bool(delaunay),
        hull=bool(hull),
        size=0.0 if size is None else _positive(size, "size"),
        angle=None if angle is None else _angle(angle),
        keep_boundary=bool(keep_boundary),
        max_points=_MOST_POINTS if max_points is None else whole(max_points, "max_points"),
        stop_after=stop_after,
        stop_after_swaps=swaps,
        order=order,
        arcs=0.0 if arcs is None else _positive(arcs, "arcs"),
        repair=weld_of(repair),
        seed=whole(seed, "seed"),
    )
    if isinstance(points, (str, bytes, os.PathLike)):
        if segments is not None or point_markers is not None or segment_markers is not None or holes or regions:
            raise ValueError("a file holds its own segments, markers, holes and regions: leave them out")
        with Shown(progress, "plane") as callback:
            result = _core.plane_file(os.fsdecode(points), format or "", float(tolerance), options, callback)
    else:
        if format is not None:
            raise ValueError("format: there is no file to read")
        if arcs is not None:
            raise ValueError("arcs: only files have arcs")
        array = _coordinates(points)
        ends = None if segments is None else indices_of(segments, 2, "segments")
        seeds = [_seed(r) for r in regions]
        places = [_place(h, array.shape[1]) for h in holes]
        marks = (markers_of(point_markers, "point_markers"), markers_of(segment_markers, "segment_markers"))
        with Shown(progress, "plane") as callback:
            if array.shape[1] == 3:
                if seeds:
                    raise ValueError("points in space have no regions here: leave them out")
                result = _core.plane_in_space((array, ends, *marks, places), float(tolerance), options, callback)
            else:
                if tolerance != 0:
                    raise ValueError("tolerance: points of two coordinates lie in the plane")
                result = _core.plane((array, ends, *marks, places, seeds), options, callback)
    _raise_unless_done(result)
    return PlaneMesh(result)


def _stage(text: Optional[str]) -> Tuple[Optional[str], int]:
    """The stage and, for swap=K, the number."""
    name, equals, count = (text or "").partition("=")
    if name != "swap":
        return text, 0
    if not equals or not (count.isascii() and count.isdigit()) or int(count) >= 2**63:
        raise ValueError(f"stop_after={text!r}: swap=K is expected, after K swaps")
    return name, int(count)


def _require_sense(
    method: str,
    ears: Optional[str],
    order: Optional[str],
    partition_first: bool,
    stop_after: Optional[str],
    refines: bool,
    keep_boundary: bool,
    max_points: Optional[int],
) -> None:
    """Refuses options that would have no effect."""
    for what, value, known in (("method", method, _METHODS), ("ears", ears, _EARS), ("order", order, _ORDERS),
                               ("stop_after", stop_after, _STAGES)):
        if value is not None and value not in known:
            raise ValueError(f"{what}={value!r}: there is {', '.join(known)}")
    if ears is not None and method != "ears":
        raise ValueError(f"ears={ears!r} does nothing without method='ears'")
    if order is not None and method == "ears":
        raise ValueError("order: the method ears lays no segments one by one")
    if partition_first and method != "partition":
        raise ValueError("partition_first does nothing without method='partition'")
    if stop_after is not None and (method == "ears" or (stop_after == "partition" and method != "partition")
                                   or (stop_after == "swap" and method != "swaps")):
        raise ValueError(f"stop_after={stop_after!r}: the method {method} has no such stage")
    if stop_after is not None and refines:
        raise ValueError("stop_after: size and angle come after it")
    if keep_boundary and not refines:
        raise ValueError("keep_boundary does nothing without size or angle: no point is added")
    if max_points is not None and not refines:
        raise ValueError("max_points does nothing without size or angle: no point is added")
    if max_points is not None and max_points < 0:
        raise ValueError(f"max_points={max_points}: a number of points is expected")


def _angle(angle: Any) -> float:
    try:
        degrees = float(angle)
    except (TypeError, ValueError):
        raise TypeError(f"angle={angle!r}: a number of degrees is expected") from None
    if not 0 <= degrees <= 34:
        raise ValueError(f"angle={degrees}: 0 to 34 degrees are expected")
    return degrees


def _coordinates(values: Any) -> Array:
    array = plain(values, "points")
    if array.dtype == object or array.dtype.kind not in "fiu":
        raise TypeError(f"points must be real numbers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"points must have the shape (n, 2) or (n, 3), not {array.shape}")
    if array.dtype.kind == "f" and array.dtype.itemsize > 8:
        raise TypeError(f"points are {array.dtype}, which doubles do not hold")
    found = np.ascontiguousarray(array, np.float64)
    if array.dtype.kind in "iu" and np.any(found.astype(array.dtype) != array):
        raise ValueError("points are whole numbers beyond 2^53, which doubles do not hold")
    return found


def _place(values: typing.Sequence[float], count: int) -> tuple[float, ...]:
    require_unmasked(values, "hole")
    found = tuple(float(v) for v in values)
    if len(found) != count:
        raise ValueError(f"a hole is given by {count} numbers, not {len(found)}")
    return found


def _seed(values: typing.Sequence[float]) -> tuple[float, float, int, float]:
    require_unmasked(values, "region")
    if len(values) not in (3, 4):
        raise ValueError(f"a region is given as (x, y, id) or (x, y, id, area), not by {len(values)} numbers")
    if int(values[2]) != values[2] or not -(2**31) <= int(values[2]) < 2**31:
        raise ValueError(f"the id of a region must be an integer of 32 bits, not {values[2]!r}")
    area = float(values[3]) if len(values) == 4 and values[3] is not None else 0.0
    if not 0 <= area < float("inf"):
        raise ValueError(f"the area of a region must be positive, or 0 for any, not {area}")
    return (float(values[0]), float(values[1]), int(values[2]), area)


def _or_none(array: Array) -> Optional[Array]:
    return array if len(array) else None
