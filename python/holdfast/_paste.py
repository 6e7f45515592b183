"""Pastes parts that touch."""

from __future__ import annotations

import json
import os
import typing
from typing import Any, Optional

from . import _core
from ._counts import counted
from ._limits import CancelToken, MemoryAmount, Progress, Shown, length, limits, threads_of
from ._surface import Array, Surface, _is_table, _of_data, _stem, surface_of
from ._tetmesh import TetMesh
from ._volume import mesh_in
from .errors import _raise_unless_done


class Pasted:
    """Parts as one conformal surface for `mesh`: every region of the mesh belongs to one part. If the parts are meshes,
    one mesh.

    Points and triangles are numbered through all parts in order.
    """

    def __init__(self, result: _core.PasteResult, volumes: Optional[_core.PastedVolumes] = None) -> None:
        self._result = result
        self._volumes = volumes
        self.mesh: Optional[TetMesh] = None if volumes is None else TetMesh._of(volumes.volume, None, volumes)
        """The tetrahedra if the parts are meshes: those that stay, and those that replace others."""
        self.origin: Optional[Array] = None if volumes is None else volumes.origin
        """(m,) int64, with `mesh`: the number of each tetrahedron in all parts together; -1: a new one."""
        self.surface: Surface = _of_data(result.surface)
        """The points of all parts, then new ones; triangles that parts have in common occur once."""
        self.marker_sets: dict[int, list[int]] = dict(result.marker_sets)
        """The markers behind each marker of triangles that parts share under different markers."""
        self.moved: dict[int, float] = dict(result.moved)
        """Points that moved, with their distances."""
        self.regions: list[int] = list(result.regions)
        """For each part, the id of its regions without a seed."""
        self.apart: list[tuple[int, int, float]] = list(result.apart)
        """(part, nearest, distance) of parts that touch no other."""
        self.max_displacement: float = result.max_displacement
        """The largest distance between the surface and the parts, rounded up."""

    @property
    def shared_triangles(self) -> int:
        """Number of triangles of the surface that several parts share."""
        return self._result.shared_facets

    @property
    def parents(self) -> list[tuple[int, ...]]:
        """For each triangle, the triangles of the parts that it is a part of: several if parts touch there."""
        return self._result.parents

    @property
    def report(self) -> dict[str, Any]:
        """All changes, with the keys of the program's `--report`."""
        found: dict[str, Any] = json.loads((self._volumes or self._result).report())
        return found

    def with_seeds(
        self,
        *,
        threads: int = 1,
        time_limit: Optional[float] = None,
        memory_limit: Optional[MemoryAmount] = None,
        cancel: Optional[CancelToken] = None,
        progress: Progress = None,
    ) -> Surface:
        """The surface with a point in each piece of the parts' regions (`regions`), and one in each space that the parts
        enclose and none contains (`holes`), as `holdfast paste -o NAME.poly` writes them. A mesh of it has the parts'
        regions, also by other programs that take such points. The points are found by a mesh.

        Parameters
        ----------
        threads, time_limit, memory_limit, cancel, progress
            As in `mesh`.

        Raises
        ------
        TimeLimit, MemoryLimit, Cancelled
            As `mesh` does.
        ValueError
            If the parts are meshes: the regions are those of `mesh`.

        Example
        -------
        >>> import holdfast
        >>> quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        >>> triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        >>> def box(x0, x1):
        ...     return [(x, y, z) for x in (x0, x1) for y in (0, 1) for z in (0, 1)], triangles
        >>> sorted(id for x, y, z, id, size in holdfast.paste(box(0, 1), box(1, 3)).with_seeds().regions)
        [1, 2]
        """
        if self._volumes is not None:
            raise ValueError("the parts are meshes, whose regions are in `mesh`; points in regions are for surfaces")
        options = limits(time_limit, memory_limit, cancel)
        options["threads"] = threads_of(threads)
        with Shown(progress, "seeds") as callback:
            return _of_data(_core.with_seeds(self._result, options, callback))

    def __repr__(self) -> str:
        return (f"Pasted({counted(len(self.regions), 'part')}, {counted(len(self.surface.points), 'point')}, "
                f"{counted(len(self.surface.triangles), 'triangle')})")


def parts_in(surface: Any) -> Optional[list[Any]]:
    """The parts in a list or tuple; None for a single surface, such as (points, triangles)."""
    if not isinstance(surface, (list, tuple)):
        return None
    if len(surface) == 2 and _is_table(surface[0]):
        return None
    return list(surface)


def paste(
    *parts: Any,
    tolerance: float = 0.0,
    overlap: str = "refuse",
    names: Optional[typing.Sequence[str]] = None,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> Pasted:
    """Pastes parts that touch. Each common face occurs once, with the same triangles for both parts.

    Parameters
    ----------
    parts
        Two or more surfaces, each in any form that `mesh` takes, or a list of them; or one surface, whose connected
        components are the parts. Or two or more meshes: `TetMesh`, files with tetrahedra, objects like a `meshio.Mesh`
        or a PyVista grid. If all parts have tetrahedra, these stay, except at triangles that change.
    tolerance
        Points of later parts within this distance of an earlier part are put on it: a length in the surfaces' unit, 0
        or more. The first part stays as it is; with 0 all parts do. It should be smaller than the parts' details.
    overlap
        Which part gets space that several parts contain: "first", "last", "new" (a region of its own), or "refuse". Meshes
        that overlap are always refused.
    names
        One name per part, for its regions and markers without a name. By default the stem of the part's file, or "part
        k".
    threads, time_limit, memory_limit, cancel, progress
        As in `mesh`.

    Returns
    -------
    Pasted
        `surface` has the (n, 3) points of all parts in order, then new ones, and (m, 3) triangles; `moved` has the
        points that moved, with their distances in the surfaces' unit. If the parts are meshes, `mesh` has the
        tetrahedra, `surface` is their boundary, and indices number the points on the boundaries in order.

    Raises
    ------
    InvalidSurface
        If parts overlap and `overlap` is "refuse". The message names both parts and the depth of the overlap.
    NotRepresentable
        If no surface was found. The message names a detail of a part that is smaller than the tolerance, if there is
        one.
    TimeLimit, MemoryLimit, Cancelled, FileError
        As `mesh` does.
    ValueError, TypeError
        For no part, a single part that is one component, arrays of a wrong shape or type, and options that make no
        sense.

    How it works and what it is based on: docs/pasting.md; George, Borouchaki, Saltel 2003, section 9.

    Example
    -------
    >>> import holdfast
    >>> quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    >>> def box(x0, x1):
    ...     return [(x, y, z) for x in (x0, x1) for y in (0, 1) for z in (0, 1)], triangles
    >>> pasted = holdfast.paste(box(0, 1), box(1, 3))
    >>> mesh = holdfast.mesh(pasted, fill=True)
    >>> sorted(set(mesh.regions.tolist())), len(pasted.surface.triangles)
    ([1, 2], 22)
    """
    options = limits(time_limit, memory_limit, cancel)
    if not isinstance(overlap, str):
        raise TypeError(f'overlap={overlap!r}: "refuse", "first", "last" or "new" is expected')
    if len(parts) == 1 and (listed := parts_in(parts[0])) is not None:
        parts = tuple(listed)
    options.update(tolerance=length(tolerance, "tolerance"), overlap=overlap, threads=threads_of(threads))
    called = names_of_parts(parts, names)
    meshes = _meshes_in(parts, options)
    if meshes is None:
        return pasted_parts([surface_of(part, reading=options) for part in parts], called, options, progress)
    if len(meshes) < 2:
        raise ValueError("at least two meshes are needed to paste")
    with Shown(progress, "paste") as callback:
        result = _core.paste_volumes([mesh._volume for mesh in meshes], called, options, callback)
    _raise_unless_done(result)
    return Pasted(result.boundary, result)


def pasted_parts(
    surfaces: typing.Sequence[Surface], names: typing.Sequence[str], options: dict[str, Any], progress: Progress
) -> Pasted:
    with Shown(progress, "paste") as callback:
        result = _core.paste([s._given() for s in surfaces], names, options, callback)
    _raise_unless_done(result)
    return Pasted(result)


def _meshes_in(parts: typing.Sequence[Any], options: dict[str, Any]) -> Optional[list[TetMesh]]:
    """The parts as meshes if all have tetrahedra; None if they are surfaces."""
    found: list[TetMesh] = []
    for part in parts:
        mesh = mesh_in(part, options)
        if mesh is None:
            if any(isinstance(other, TetMesh) for other in parts):
                raise TypeError("meshes are pasted to meshes, and surfaces to surfaces: `TetMesh.surface()` is the surface of one")
            return None
        found.append(mesh)
    return found or None


def names_of_parts(parts: typing.Sequence[Any], names: Optional[typing.Sequence[str]]) -> list[str]:
    if names is None:
        return [_stem(p) if isinstance(p, (str, bytes, os.PathLike)) else f"part {k}" for k, p in enumerate(parts, 1)]
    found = [] if isinstance(names, str) else list(names)
    if isinstance(names, str) or not all(isinstance(name, str) for name in found):
        raise TypeError(f"names={names!r}: a list of texts is expected, one for each part")
    if len(found) != len(parts):
        raise ValueError(f"names={names!r}: one for each of {len(parts)} parts is expected")
    return [str(name) for name in found]
