"""The function untangle."""

from __future__ import annotations

import typing
from typing import Any, Optional

from . import _core
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits, whole
from ._masks import plain
from ._tetmesh import TetMesh
from ._volume import volume_of
from .errors import _raise_unless_done


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
    """Makes every tetrahedron of a mesh positive and keeps its boundary bit for bit.

    `fixed` are points to keep besides those of the boundary, triangles and segments; `refill` may add and remove points
    where moves and exchanges are not enough. `improve` improves elements once all are positive. It adds and removes
    points, so it needs `refill`. Raises InvalidSurface if the boundary or the connectivity is wrong, NotRepresentable
    if no positive mesh was found, and as `mesh` for limits.

    >>> import holdfast
    >>> tangled = holdfast.TetMesh([(0, 0, 0), (3, 0, 0), (0, 3, 0), (0, 0, 3), (2, 2, 2)],
    ...                            [(0, 1, 2, 4), (0, 1, 4, 3), (0, 4, 2, 3), (4, 1, 2, 3)])
    >>> (holdfast.untangle(tangled).quality().volume > 0).all()
    True
    """
    options = limits(time_limit, memory_limit, cancel)
    options.update(fixed=[int(v) for v in plain(list(fixed), "fixed")], refill=bool(refill), improve=bool(improve),
                   seed=whole(seed, "seed"))
    what = volume_of(mesh)
    with Shown(progress, "untangle") as callback:
        result = _core.untangle(what._volume, options, callback)
    _raise_unless_done(result)
    return TetMesh._of(result.volume, what.n_input_points, result)
