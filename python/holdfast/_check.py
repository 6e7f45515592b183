"""The function check."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Optional

from . import _core
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits
from ._surface import surface_of
from ._volume import volume_of


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
    """Checks exactly, and independently of the mesher, that a mesh keeps a surface.

    `surface` is what `mesh` takes (`(points, triangles)` for arrays), `mesh` a `TetMesh`, a path, or an object like a
    `meshio.Mesh`. `outside_dropped` accepts missing triangles outside every tetrahedron, `box` accepts a mesh that
    extends to an enclosing box.

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
