"""repair: makes any surface valid."""

from __future__ import annotations

import json
from typing import Any, Optional, Union

import numpy.typing as npt

from . import _core
from ._counts import counted
from ._limits import CancelToken, MemoryAmount, Progress, Shown, is_truth, length, limits, threads_of, whole
from ._surface import Array, Surface, _of_data, surface_of
from .errors import _raise_unless_done


class Repair:
    """A valid surface, and all changes that `repair` made."""

    def __init__(self, given: Surface, result: _core.RepairResult) -> None:
        self._given = given
        self._result = result
        self._report: Optional[dict[str, Any]] = None
        self.surface: Surface = _of_data(result.surface)
        """The surface: the given points with their indices, then the new ones."""
        self.surface.holes, self.surface.regions = list(given.holes), list(given.regions)
        self.max_displacement: float = result.max_displacement
        """No point of the surface is further than this from the given surface, nor is the given surface further from
        it, except on triangles that were dropped or fill holes."""

    @property
    def parents(self) -> tuple[Array, Array]:
        """(first, all): triangle i is a part of the given triangles `all[first[i]:first[i + 1]]`, or of none if it
        fills a hole."""
        return self._result.parents

    @property
    def moved(self) -> dict[int, float]:
        """How far given points moved, by their indices. Usually empty without a tolerance."""
        return {int(m["vertex"]): float(m["distance"]) for m in self.report["moved"]}

    @property
    def dropped(self) -> dict[int, str]:
        """The reasons why given triangles were dropped, by their indices."""
        return {int(d["facet"]): str(d["reason"]) for d in self.report["dropped"]}

    @property
    def marker_sets(self) -> dict[int, list[int]]:
        """Markers of the surface that stand for several given markers, because triangles with these overlapped."""
        return {int(k): [int(m) for m in v] for k, v in self.report["marker_sets"].items()}

    @property
    def report(self) -> dict[str, Any]:
        """The report, as `holdfast repair --report` writes it."""
        if self._report is None:
            self._report = json.loads(self._result.report())
        return self._report

    def check(self) -> dict[str, Any]:
        """Verifies the repair exactly and independently of the repair itself: "holds", and the "rules" one by one."""
        with Shown(None, "check") as callback:
            found: dict[str, Any] = json.loads(
                _core.check_repair(self._given._arrays(), self._result, {}, callback))
        return found

    def __repr__(self) -> str:
        return (f"Repair({counted(len(self.surface.points), 'point')}, {counted(len(self.surface.triangles), 'triangle')}, "
                f"at most {self.max_displacement:.3g} away)")


def repair(
    surface: Any,
    triangles: Optional[npt.ArrayLike] = None,
    *,
    segments: Optional[npt.ArrayLike] = None,
    triangle_markers: Optional[npt.ArrayLike] = None,
    segment_markers: Optional[npt.ArrayLike] = None,
    weld: float = 0.0,
    join: float = 0.0,
    fill_holes: Union[bool, int] = False,
    union: bool = False,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    cancel: Optional[CancelToken] = None,
    progress: Progress = None,
) -> Repair:
    """Makes a surface valid: triangles are cut where they cross, touch or overlap, and nothing else changes.

    Parameters
    ----------
    surface, triangles, segments, triangle_markers, segment_markers
        As `mesh` takes them: a path, a `Surface`, an object of another package, or (n, 3) points with (m, 3) triangles.
    weld
        First join points within this distance of each other, and put points within this distance of a side or triangle
        on it. Sides with one triangle each, and sides of two bodies that touch with their edges, get a point where they
        pass each other within this distance. A length in the surface's unit, 0 or more; 0 joins nothing.
    join
        Then give triangles that overlap within this distance, as faces of bodies that touch, the same triangles where
        they overlap. Points stay. A length in the surface's unit, 0 or more. If it is as long as features, an eighth of
        it is tried, a 64th, and none.
    fill_holes
        Close holes: True for all, or the largest number of sides of a border, 3 or more; False or 0: none.
    union
        Drop triangles with material on both sides or on neither.
    threads, time_limit, memory_limit, cancel, progress
        As in `mesh`.

    Returns
    -------
    Repair
        `surface` has the given (n, 3) points, bit for bit except those in `moved`, then new points; `max_displacement`
        and the distances of `moved` are in the surface's unit. Triangles with corners that are not finite or out of
        range are in `dropped`.

    Raises
    ------
    NotRepresentable
        If no doubles were found for the new points.
    TimeLimit, MemoryLimit, Cancelled, FileError
        As `mesh` does.
    ValueError, TypeError
        For arrays of a wrong shape or type, and lengths that are negative, not finite, or not numbers.

    How it works and what it is based on: docs/repairing.md; George, Borouchaki, Saltel 2003, section 9.

    Example
    -------
    Two tetrahedra that pass through each other:

    >>> import holdfast, numpy as np
    >>> p = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    >>> t = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    >>> repaired = holdfast.repair(np.vstack([p, p + 0.2]), np.vstack([t, t + 4]))
    >>> holdfast.diagnose(repaired.surface).valid, repaired.check()["holds"], repaired.moved
    (True, True, {})
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(weld=length(weld, "weld"), join=length(join, "join"), fill_holes=most_sides(fill_holes), union=bool(union),
                   threads=threads_of(threads))
    what = surface_of(surface, triangles, segments=segments, triangle_markers=triangle_markers,
                      segment_markers=segment_markers)
    with Shown(progress, "repair") as callback:
        result = _core.repair(what._arrays(), options, callback)
    _raise_unless_done(result)
    return Repair(what, result)


def most_sides(fill_holes: Union[bool, int]) -> int:
    """The largest number of sides of a hole to fill; 0: fill none."""
    if is_truth(fill_holes):
        return 2**62 if fill_holes else 0
    sides = whole(fill_holes, "fill_holes")
    if sides < 0 or 0 < sides < 3:
        raise ValueError(f"fill_holes={sides}: a hole has three sides at least")
    return min(sides, 2**62)
