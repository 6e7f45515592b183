"""The forms of `size` and `metric` of mesh: a number, an array, a background mesh, a path or a function."""

from __future__ import annotations

import os
import typing
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._limits import is_truth
from ._masks import plain
from ._surface import Array, indices_of, points_of

Size = Any  # a number, an array, a background mesh, a path or a function


def _is_background(value: Any) -> bool:
    return isinstance(value, tuple) and len(value) == 3 and np.ndim(value[0]) == 2 and np.ndim(value[1]) == 2


def set_size(size: Size, options: dict[str, Any], points: int) -> Optional[typing.Callable[[Array], Any]]:
    """Sets `size` in the options, or returns it if it is a function."""
    if size is None:
        return None
    if isinstance(size, (str, bytes, os.PathLike)):
        field = _core.read_size_field(os.fsdecode(size), {})
        if field.has_mesh:
            options["size_field"] = field
        else:
            options["point_sizes"] = _point_sizes(field.sizes, points)
    elif _is_background(size):
        where, tetrahedra, sizes = size
        options["size_field"] = _core.SizeField(points_of(where), indices_of(tetrahedra, 4, "tetrahedra"),
                                                plain(sizes, "sizes", np.float64).ravel().tolist(), [])
    elif hasattr(size, "points") and hasattr(size, "point_data"):
        options["size_field"] = _background(size, "size")
    elif callable(size):
        asked: typing.Callable[[Array], Any] = size
        return asked
    elif np.ndim(size) == 0:
        if is_truth(size):
            raise TypeError(f"size={size}: a length is expected, in the surface's unit")
        number = float(size)
        if not 0 < number < float("inf"):
            raise ValueError(f"size={number}: a positive length is expected")
        options["size"] = number
    else:
        options["point_sizes"] = _point_sizes(size, points)
    return None


def _point_sizes(sizes: npt.ArrayLike, points: int) -> list[float]:
    array = plain(sizes, "size", np.float64)
    if array.shape != (points,):
        raise ValueError(f"size must be one number, or one a point of the surface, ({points},), not {array.shape}")
    return [float(x) for x in array]


def _as_six(tensors: npt.ArrayLike) -> Array:
    """The (m, 6) numbers m11 m12 m22 m13 m23 m33 of tensors given as (m, 3, 3) or (m, 6) numbers."""
    array = plain(tensors, "metric", np.float64)
    if array.ndim == 3 and array.shape[1:] == (3, 3):
        with np.errstate(invalid="ignore"):  # numbers that are not finite are reported elsewhere
            skew = np.abs(array - array.transpose(0, 2, 1)).max(axis=(1, 2), initial=0)
        if (wrong := np.flatnonzero(skew > 1e-6 * np.abs(array).max(axis=(1, 2), initial=0))).size > 0:
            raise ValueError(f"metrics must be symmetric, and number {wrong[0]} is not")
        return np.stack([array[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))], axis=1)
    if array.ndim == 2 and array.shape[1] == 6:
        return array
    raise ValueError(f"metrics must have the shape (m, 3, 3) or (m, 6), not {array.shape}")


def _background(mesh: Any, name: str) -> _core.SizeField:
    """A `meshio.Mesh` with a point array "size" or "metric"."""
    data = mesh.point_data
    if name not in data:
        raise ValueError(f"the background mesh has no point data '{name}'")
    cells = [plain(b.data, "cells") for b in mesh.cells if b.type == "tetra"]
    tetrahedra = np.concatenate(cells) if cells else np.empty((0, 4), np.int64)
    values = plain(data[name], name, np.float64)
    if name == "size":
        return _core.SizeField(points_of(mesh.points), indices_of(tetrahedra, 4, "tetrahedra"), values.ravel().tolist(), [])
    return _core.SizeField(points_of(mesh.points), indices_of(tetrahedra, 4, "tetrahedra"), [], _as_six(values).tolist())


def set_metric(metric: Any, options: dict[str, Any]) -> Optional[typing.Callable[[Array], Array]]:
    if metric is None:
        return None
    if "size_field" in options:
        raise ValueError("size and metric cannot both be background meshes")
    if isinstance(metric, (str, bytes, os.PathLike)):
        options["size_field"] = _core.read_size_field(os.fsdecode(metric), {})
        if not options["size_field"].has_metrics:
            raise ValueError(f"metric={os.fsdecode(metric)!r}: the file holds sizes, not metrics; give it as size")
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
