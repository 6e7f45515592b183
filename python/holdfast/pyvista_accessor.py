"""`surface.holdfast.mesh(...)` on PyVista's PolyData, if PyVista has accessors; loaded by its entry point."""

from __future__ import annotations

import importlib
from typing import Any

from ._diagnose import Diagnosis, diagnose
from ._mesh import mesh


class HoldfastAccessor:
    """The accessor `surface.holdfast` of PyVista."""

    def __init__(self, surface: Any) -> None:
        self._surface = surface

    def mesh(self, **options: Any) -> Any:
        """A `pyvista.UnstructuredGrid`; `options` are those of `holdfast.mesh`."""
        return mesh(self._surface, **options).to_pyvista()

    def diagnose(self, **options: Any) -> Diagnosis:
        """The defects of the surface, as `holdfast.diagnose` gives them."""
        return diagnose(self._surface, **options)


def register() -> bool:
    """Adds the accessor to PyVista; returns False if PyVista is missing or has no accessors."""
    try:
        pyvista = importlib.import_module("pyvista")
    except ImportError:
        return False
    add = getattr(pyvista, "register_dataset_accessor", None)
    if add is not None:
        add("holdfast", pyvista.PolyData)(HoldfastAccessor)
        return True
    if hasattr(pyvista, "PolyData") and not hasattr(pyvista.PolyData, "holdfast"):
        pyvista.PolyData.holdfast = property(HoldfastAccessor)
        return True
    return hasattr(pyvista, "PolyData")


register()
