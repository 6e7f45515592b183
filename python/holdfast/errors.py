"""Exceptions of calls that fail. Nothing here ends the process, prints, or handles signals."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Optional

__all__ = [
    "Cancelled",
    "Defect",
    "FileError",
    "HoldfastError",
    "InternalError",
    "InvalidSurface",
    "MemoryLimit",
    "NotRepresentable",
    "TimeLimit",
]


@dataclass(frozen=True)
class Defect:
    """One broken rule of a valid surface and the entities that break it, by their indices in the input.

    >>> import holdfast
    >>> points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
    >>> holdfast.diagnose(points, [(0, 1, 2), (0, 1, 2)])[0].kind
    'repeated facet'
    """

    kind: str
    """The rule: "facets cross", "repeated facet" and so on."""
    vertices: tuple[int, ...]
    triangles: tuple[int, ...]
    segments: tuple[int, ...]
    where: tuple[tuple[float, float, float], ...]
    """One point, or the two ends of an intersection, in the surface's unit, rounded."""
    message: str
    """One sentence with indices, coordinates and what to do."""

    def __str__(self) -> str:
        return f"{self.kind}: {self.message}"


class HoldfastError(Exception):
    """Base of all errors of this package. `report` is the report of the run so far (a dict)."""

    def __init__(self, message: str, report: Optional[dict[str, Any]] = None) -> None:
        super().__init__(message)
        self.report: dict[str, Any] = report if report is not None else {}

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuilt, (type(self), self.args, self.__dict__))


class InvalidSurface(HoldfastError, ValueError):
    """The surface breaks rules that a valid one keeps; `defects` says which and where."""

    def __init__(
        self,
        message: str,
        report: Optional[dict[str, Any]] = None,
        defects: tuple[Defect, ...] = (),
    ) -> None:
        super().__init__(message, report)
        self.defects: list[Defect] = list(defects)


class TimeLimit(HoldfastError, TimeoutError):
    """`time_limit` ran out."""


class MemoryLimit(HoldfastError, MemoryError):
    """`memory_limit` was reached."""


class Cancelled(HoldfastError):
    """A `CancelToken` or the progress callback asked to stop."""


class NotRepresentable(HoldfastError):
    """The surface is valid, but some added point has no position in doubles."""


class InternalError(HoldfastError, RuntimeError):
    """An invariant of the library broke. Please report it with the surface and the call."""


class FileError(HoldfastError, OSError):
    """A file cannot be read or written. `filename` and `where` ("line 12") say which and where in it; `errno` is the system's
    number where the system refused it (`errno.ENOENT`), else None."""

    def __init__(self, message: str, filename: str = "", where: str = "", errno: int = 0) -> None:
        HoldfastError.__init__(self, message)
        self.filename = filename
        self.where = where
        if errno:
            self.errno = errno
            self.strerror = os.strerror(errno)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (*self.args, self.filename, self.where, self.errno or 0))

    def __str__(self) -> str:
        return str(self.args[0])


def _rebuilt(kind: type[HoldfastError], args: tuple[Any, ...], state: dict[str, Any]) -> HoldfastError:
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(state)
    return error


_DONE, _INVALID, _TIME, _MEMORY, _CANCELLED, _NOT_REPRESENTABLE = range(6)
_BY_OUTCOME: dict[int, type[HoldfastError]] = {
    _TIME: TimeLimit,
    _MEMORY: MemoryLimit,
    _CANCELLED: Cancelled,
    _NOT_REPRESENTABLE: NotRepresentable,
}


def _interrupted(outcome: int, message: str) -> HoldfastError:
    """The exception that the extension raises when a call has no report."""
    return _BY_OUTCOME.get(outcome, HoldfastError)(message)


def _defects(raw: list[Any]) -> tuple[Defect, ...]:
    return tuple(Defect(*defect) for defect in raw)


def _raise_unless_done(result: Any) -> None:
    """Raises the exception for the outcome of a result of the extension."""
    if result.outcome == _DONE:
        return
    report = json.loads(result.report())
    if result.outcome != _INVALID:
        raise _BY_OUTCOME[result.outcome](result.message or "cancelled", report)
    defects = _defects(result.defects)
    first = f": {defects[0]}" if defects else ""
    more = f" (and {len(defects) - 1} more)" if len(defects) > 1 else ""
    raise InvalidSurface(f"{result.message}{first}{more}", report, defects)
