"""Holdfast fills any triangulated surface with tetrahedra and keeps every triangle of it exactly.

>>> import holdfast
>>> mesh = holdfast.mesh("part.stl", size=2.0)  # doctest: +SKIP
>>> mesh.save("part.vtu")  # doctest: +SKIP
"""

from ._core import CancelToken, __version__
from ._check import CheckResult, Rule, check
from ._convert import convert
from ._diagnose import Diagnosis, diagnose
from ._mesh import delaunay, mesh
from ._names import Names
from ._paste import Pasted, paste
from ._plane import PlaneMesh, plane
from ._repair import Repair, repair
from ._shapes import Quality
from ._surface import Surface, read_surface
from ._tetmesh import TetMesh
from ._untangle import untangle
from ._volume import info, read_volume
from ._batch import batch
from .errors import (
    Cancelled,
    Defect,
    FileError,
    HoldfastError,
    InternalError,
    InvalidSurface,
    MemoryLimit,
    NotRepresentable,
    TimeLimit,
)

__all__ = [
    "CancelToken",
    "Cancelled",
    "CheckResult",
    "Defect",
    "Diagnosis",
    "FileError",
    "HoldfastError",
    "InternalError",
    "InvalidSurface",
    "MemoryLimit",
    "Names",
    "NotRepresentable",
    "Pasted",
    "PlaneMesh",
    "Quality",
    "Repair",
    "Rule",
    "Surface",
    "TetMesh",
    "TimeLimit",
    "__version__",
    "batch",
    "check",
    "convert",
    "delaunay",
    "diagnose",
    "info",
    "mesh",
    "paste",
    "plane",
    "read_surface",
    "read_volume",
    "repair",
    "untangle",
]
