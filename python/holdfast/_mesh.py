"""The functions mesh and delaunay."""

from __future__ import annotations

import json
import numbers
import typing
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._limits import CancelToken, MemoryAmount, Progress, Shown, is_truth, length, limits, threads_of, weld_of, whole
from ._masks import require_unmasked
from ._parts import given
from ._repair import Repair, most_sides
from ._repair import repair as repair_surface
from ._size import Size, set_metric, set_size
from ._surface import Array, points_of
from ._tetmesh import TetMesh
from .errors import _raise_unless_done


def mesh(
    surface: Any,
    triangles: Optional[npt.ArrayLike] = None,
    *,
    segments: Optional[npt.ArrayLike] = None,
    triangle_markers: Optional[npt.ArrayLike] = None,
    segment_markers: Optional[npt.ArrayLike] = None,
    size: Size = None,
    metric: Any = None,
    gradation: Optional[float] = None,
    growth: bool = True,
    max_volume: Union[None, float, typing.Mapping[Optional[int], float]] = None,
    max_ratio: Optional[float] = None,
    layers: Optional[int] = None,
    fill: bool = False,
    quality: str = "good",
    keep: str = "auto",
    box_margin: Optional[float] = None,
    holes: typing.Iterable[typing.Sequence[float]] = (),
    regions: typing.Iterable[typing.Sequence[float]] = (),
    drop_outside: bool = False,
    repair: Union[bool, float] = False,
    fill_holes: Union[bool, int] = False,
    union: bool = False,
    paste: Union[bool, float] = False,
    overlap: str = "refuse",
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
        A path, a `Surface`, a list of several parts (which get regions of their own if they have triangles in common or
        are pasted), parts that `paste` put together, an (n, 3) array of points together with `triangles`, or anything
        shaped like a PyVista or VTK PolyData, a `meshio.Mesh` or a `trimesh.Trimesh`. Contiguous arrays of float64
        points and int32 or uint32 triangles are not copied.
    triangles
        (m, 3) indices from 0.
    segments
        (k, 2) indices: edges to keep that are sides of no triangle or have markers.
    triangle_markers, segment_markers
        (m,) and (k,) integers, copied to the result.
    size
        How long edges should be, in the surface's unit: a number (the largest size anywhere), one number per point of the
        surface (0: that of the surface), a background mesh (a path to .mesh with .sol, .vtu, .mtr or .pos; or
        `(points, tetrahedra, sizes)`), or a function that takes an (m, 3) array and returns m sizes. A size that is not
        positive is no limit.
    metric
        Sizes that depend on the direction: `(points, tetrahedra, tensors)`, a path, or a function that takes an (m, 3)
        array and returns (m, 3, 3) or (m, 6) numbers (m11 m12 m22 m13 m23 m33). In this metric edges should have length
        1.
    gradation
        How fast sizes grow away from the surface, per unit of length; 0 to 1. By default 0.3, and up to 0.5 on surfaces
        full of needles. Unless this is given, points that help little there are removed again.
    growth
        Whether sizes inside may grow beyond those of the surrounding surface.
    max_volume
        The largest volume of a tetrahedron: a number, or a dict of numbers by region id of the mesh (None: anywhere).
        Every tetrahedron keeps the bound, even if flat ones result; `TetMesh.report["bounds"]` counts those.
    max_ratio
        The largest ratio wanted of a tetrahedron's circumradius to its shortest edge. This is an aim;
        `TetMesh.report["bounds"]` counts exceptions.
    layers
        The least number of elements on every path inside between two facing sides of a wall or a gap, at most 100.
        `TetMesh.report["layers"]` counts the points added for it.
    fill
        Add no field points, only the points that the surface forces. `size`, `metric`, `gradation`, `growth`,
        `max_volume`, `max_ratio`, `layers`, `quality` and sizes of regions would then do nothing, and are refused.
    quality
        Effort for the elements with field points: "fast", "good" or "best".
    keep
        "auto" (by winding number if the surface is consistently oriented, and with the regions of seeds; otherwise every
        bounded region), "bounded",
        "winding" or "box" (everything up to a box, `box_margin` of the largest extent away: 0.1 unless given).
    holes
        (x, y, z) of points in regions to leave empty.
    regions
        (x, y, z, id[, size]): the id of the region that contains the point, and the longest edge wanted there.
    drop_outside
        Drop triangles outside every kept region instead of refusing them.
    repair
        Make the surface valid first, as `holdfast.repair` does: True, or the distance within which vertices are joined.
        The result's `repair` says what changed. If the surface then has no mesh in doubles, it is repaired again, and
        sheets that are some last bits apart are joined.
    fill_holes, union
        With `repair`: as `holdfast.repair` takes them.
    paste
        Make parts that touch fit together first, as `holdfast.paste` does: True, or the distance within which points of
        later parts are put on an earlier part. The parts are those of the list, or the connected components of one
        surface.
    overlap
        With several parts or `paste`: which part gets space that several parts contain: "first", "last" or "new" (a region
        of its own). By default parts that overlap are refused.
    without
        Steps to leave out: "flips", "optimise", "points".
    order
        The order in which missing constraints are cut into the mesh: "random", "given" (the surface's order) or
        "halving" (the middle one first, then those in the middle of both halves).
    seed, threads
        The seed of the random orders, and the number of threads (0: all available). The result does not depend on the
        number of threads.
    time_limit
        Seconds.
    memory_limit
        Memory of the process in gigabytes, or in bytes from a million on, or text with a unit ("500 MB").
    cancel
        A `CancelToken` that another thread may use.
    progress
        True shows a bar. A function is called with (stage, fraction of the whole call); the call is cancelled if it
        returns False, and its exceptions end the call.

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
    holes, regions = _listed(holes, "holes"), _listed(regions, "regions")
    _require_sense(fill, quality, steps, metric, growth, {
        "size": size is not None, "metric": metric is not None, "gradation": gradation is not None, "growth=False": not growth,
        "max_volume": max_volume is not None, "max_ratio": max_ratio is not None, "layers": layers is not None,
        "the size of a region": any(len(r) == 5 and r[4] for r in regions), f"quality={quality!r}": quality != "good"})
    weld = weld_of(repair)
    if weld is None and (most_sides(fill_holes) or union):
        raise ValueError("fill_holes and union do nothing without repair: the surface is meshed as it is")
    if box_margin is not None and keep != "box":
        raise ValueError(f'box_margin does nothing with keep={keep!r}: it is for keep="box"')
    options["threads"] = threads_of(threads)
    what, pasted = given(
        surface, triangles, {"segments": segments, "triangle_markers": triangle_markers, "segment_markers": segment_markers},
        paste=paste, overlap=overlap, repairs=weld is not None, options=options, progress=progress)
    repaired, unrepaired = None, what
    if weld is not None:
        repaired = repair_surface(what, weld=weld, fill_holes=fill_holes,
                                  union=union, threads=threads,
                                  time_limit=time_limit, memory_limit=memory_limit, cancel=cancel, progress=progress)
        what = repaired.surface
    options.update(
        fill=fill,
        gradation=None if gradation is None else length(gradation, "gradation"),
        growth=bool(growth),
        quality=quality,
        keep=keep,
        box_margin=0.1 if box_margin is None else _positive(box_margin, "box_margin"),
        holes=[_numbers(h, 3, "a hole") for h in holes] + [list(map(float, h)) for h in what.holes],
        regions=_bounded([_region(r) for r in [*regions, *what.regions]], max_volume),
        max_volume=_most_volume(max_volume),
        max_ratio=0.0 if max_ratio is None else _positive(max_ratio, "max_ratio"),
        layers=_layers(layers),
        drop_outside=bool(drop_outside or union),  # corners of what a union drops stay
        flips="flips" not in steps,
        optimise="optimise" not in steps,
        add_points="points" not in steps,
        order=order,
        seed=whole(seed, "seed"),
    )
    asked_size = set_size(size, options, len(what.points))
    asked_metric = set_metric(metric, options)
    with Shown(progress, "mesh") as callback:
        if pasted is not None:
            result = _core.mesh_pasted(pasted._result, options, asked_size, asked_metric, callback)
        else:
            result = _core.mesh(what._arrays(), options, asked_size, asked_metric, callback)
        if repaired is not None and (joined := _core.mesh_joined(unrepaired._arrays(), repaired._result, result, options, asked_size,
                                                                asked_metric, callback)):
            repaired, result = Repair(unrepaired, joined[0]), joined[1]
    _raise_unless_done(result)
    meshed = TetMesh._of(result.volume, result.n_input_points, result)
    meshed.repair = repaired
    if pasted is not None:
        meshed.pasted = pasted
        meshed.report.update(parts=json.loads(pasted._result.parts()), shared_facets=pasted.shared_triangles)
    return meshed


def _require_sense(fill: bool, quality: str, steps: set[str], metric: Any, growth: bool,
                   for_field_points: typing.Mapping[str, bool]) -> None:
    """Refuses options that would have no effect, as the program does."""
    if fill and (idle := [option for option, is_given in for_field_points.items() if is_given]):
        raise ValueError(f"fill=True adds no field points, so that {', '.join(idle)} would do nothing; leave out one of them")
    if not fill and "points" in steps:
        raise ValueError("without='points' does nothing without fill=True: field points are wanted then")
    if "optimise" in steps and (quality != "good" or "points" in steps):
        raise ValueError("quality and without='points' do nothing with without='optimise': they are for the optimisation")
    if metric is not None and not growth:
        raise ValueError("growth=False does nothing with metric: its tensors say all of the sizes inside")


def _listed(rows: Any, what: str) -> list[Any]:
    """The points as a list; a single point is refused."""
    listed = list(rows) if isinstance(rows, typing.Iterable) else [rows]
    if any(np.ndim(row) == 0 for row in listed):
        raise TypeError(f"{what}={rows!r}: a list is expected, of one sequence of numbers for each")
    return listed


def _numbers(values: typing.Sequence[float], count: int, what: str) -> list[float]:
    require_unmasked(values, what)
    found = [float(v) for v in values]
    if len(found) != count:
        raise ValueError(f"{what} is given by {count} numbers, not {len(found)}")
    return found


def _region(values: typing.Sequence[float]) -> tuple[float, float, float, int, float]:
    require_unmasked(values, "a region")
    if len(values) not in (4, 5):
        raise ValueError(f"a region is given as (x, y, z, id) or (x, y, z, id, size), not by {len(values)} numbers")
    if not isinstance(values[3], numbers.Real) or int(values[3]) != values[3] or not -(2**31) <= int(values[3]) < 2**31:
        raise ValueError(f"the id of a region must be an integer of 32 bits, not {values[3]!r}")
    size = float(values[4]) if len(values) == 5 and values[4] is not None else 0.0
    return (float(values[0]), float(values[1]), float(values[2]), int(values[3]), size)


def _positive(value: Any, what: str) -> float:
    if is_truth(value):
        raise TypeError(f"{what}={value!r}: a positive number is expected")
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{what}={value!r}: a positive number is expected") from None
    if not 0 < number < float("inf"):
        raise ValueError(f"{what}={number}: a positive number is expected")
    return number


def _layers(layers: Optional[int]) -> int:
    if layers is None:
        return 0
    number = whole(layers, "layers")
    if not 1 <= number <= 100:
        raise ValueError(f"layers={number}: 1 to 100 are expected")
    return number


def _most_volume(most: Union[None, float, typing.Mapping[Optional[int], float]]) -> float:
    """The bound for all regions, 0 for none."""
    anywhere = most.get(None) if isinstance(most, typing.Mapping) else most
    return 0.0 if anywhere is None else _positive(anywhere, "max_volume")


def _bounded(
    regions: list[tuple[float, float, float, int, float]],
    most: Union[None, float, typing.Mapping[Optional[int], float]],
) -> list[tuple[float, float, float, int, float, float]]:
    """The regions with the largest volume of their tetrahedra, 0 for any."""
    if not isinstance(most, (numbers.Real, typing.Mapping, type(None))):
        raise TypeError("max_volume is a number, or a dict of numbers by the ids of regions")
    by_id = {id: v for id, v in most.items() if id is not None} if isinstance(most, typing.Mapping) else {}
    for id in by_id:
        if is_truth(id) or not isinstance(id, numbers.Integral):
            raise TypeError(f"max_volume: {id!r} is no id of a region, which is an integer")
    nowhere = float("nan")  # the region that has the id in the mesh, whatever gives it (holdfast/region_bounds.h)
    bounds = [(nowhere, nowhere, nowhere, int(id), 0.0, _positive(v, "max_volume")) for id, v in sorted(by_id.items())]
    return [(*r, 0.0) for r in regions] + bounds


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
    """(m, 4) int32: Delaunay tetrahedra of (n, 3) points. Repeated points stay unused. There are no tetrahedra if all
    points are coplanar.

    >>> import holdfast
    >>> holdfast.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).shape
    (1, 4)
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(seed=whole(seed, "seed"), threads=threads_of(threads))
    with Shown(progress, "delaunay") as callback:
        return _core.delaunay(points_of(points), options, callback)
