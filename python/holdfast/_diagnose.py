"""The function diagnose."""

from __future__ import annotations

import json
import typing
from typing import Any, Optional

import numpy.typing as npt

from . import _core
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits, threads_of
from ._surface import surface_of
from .errors import Defect, _defects


class Diagnosis(list[Defect]):
    """The defects of a surface, a list, with a summary. Empty for a surface that breaks no rule.

    `summary` is a dict: "causes" (defects grouped by probable cause, each with a message that says what to do), "gaps",
    "open_sides", "parts" and "encloses" (how many regions the surface bounds; None if it is not valid).
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
        """How many regions the surface bounds; None if it is not valid."""
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
    options.update(most=most, threads=threads_of(threads))
    what = surface_of(surface, triangles, segments=segments)
    with Shown(progress, "diagnose") as callback:
        defects, summary = _core.diagnose(what._arrays(), options, callback)
    return Diagnosis(_defects(defects), json.loads(summary))
