"""The calls of the `tetgen` package that people use, done by Holdfast.

    from holdfast.compat import TetGen, tetrahedralize

What is not supported raises NotImplementedError or gives a UserWarning; nothing is silently ignored. The largest
difference: without the switch Y TetGen may split the surface, and Holdfast never does.
"""

from __future__ import annotations

import math
import re
import warnings
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._mesh import mesh as _mesh
from ._surface import Array, Surface, surface_of
from ._tetmesh import TetMesh


def size_of_volume(volume: float) -> float:
    """The edge of the regular tetrahedron with this volume."""
    return float((6 * math.sqrt(2) * volume) ** (1 / 3))


def _bad(switch: str, why: str) -> NotImplementedError:
    return NotImplementedError(f"TetGen's switch {switch}: {why}")


_REFUSED = {
    "r": "a mesh is not refined; mesh its surface again with a smaller size",
    "R": "a mesh is not coarsened",
    "w": "there are no weighted points",
    "v": "there is no Voronoi diagram",
    "m": "give `size` an array, or a background mesh (holdfast.mesh)",
    "i": "add the points as vertices of the surface: those on no triangle become points of the mesh",
    "c": "the convex hull is not kept; `holdfast.mesh(..., keep='box')` keeps everything out to a box",
    "d": "use holdfast.diagnose",
    "l": "there is no incremental flip algorithm",
}
# These only concern output, speed and messages, or what Holdfast does anyway.
_MEANINGLESS = frozenset("pYQVCzefnENBFJIkgXsxb")
_WITHOUT_COUNTERPART = frozenset("ODLMST")


class Switches:
    """TetGen's switches, as Holdfast interprets them.

    >>> s = Switches("pq1.4a0.1Y")
    >>> s.quality, s.max_volume
    (True, 0.1)
    >>> s.max_ratio
    1.4
    """

    def __init__(self, text: str) -> None:
        self.quality = False
        self.max_volume: Optional[float] = None
        self.max_ratio: Optional[float] = None
        self.by_region = False
        self.attributes = False
        self.order = 1
        self.keeps_surface = False
        rest = text.strip().lstrip("-")
        while rest:
            letter, number, rest = self._next(rest)
            self._take(letter, number, text)

    @staticmethod
    def _next(text: str) -> tuple[str, str, str]:
        found = re.match(r"([A-Za-z])((?:[0-9.]+(?:e[+-]?[0-9]+)?)?(?:/[0-9.]*(?:/[0-9.]*)?)?)", text)
        if found is None:
            raise ValueError(f"TetGen's switches: {text!r} is not understood")
        return found.group(1), found.group(2), text[found.end() :]

    def _take(self, letter: str, number: str, text: str) -> None:
        if letter in _REFUSED:
            raise _bad(letter, _REFUSED[letter])
        if letter == "q":
            self.quality = True
            ratio = number.split("/")[0]
            if ratio and float(ratio) > 0:
                self.max_ratio = float(ratio)
        elif letter == "a":
            if number:
                self.max_volume = float(number)
            else:
                self.by_region = True
            self.quality = True
        elif letter == "A":
            self.attributes = True
        elif letter == "Y":
            self.keeps_surface = True
        elif letter == "o":
            self.order = 2 if number == "2" else 1
        elif letter in _WITHOUT_COUNTERPART:
            warnings.warn(f"TetGen's switch {letter} has no counterpart in Holdfast", stacklevel=4)
        elif letter not in _MEANINGLESS:
            raise ValueError(f"TetGen's switches {text!r}: there is no switch {letter}")


class TetGen:
    """`TetGen(mesh)` or `TetGen(v, f)`, then `tetrahedralize(...)`; then `.node`, `.elem`, `.grid`, `.mesh`.

    >>> import numpy as np
    >>> v = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    >>> tet = TetGen(v, np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]))
    >>> nodes, elements = tet.tetrahedralize(order=1, switches="pY")
    >>> nodes.shape, elements.shape
    ((4, 3), (1, 4))
    """

    def __init__(self, *args: Any) -> None:
        if len(args) == 1:
            self._surface: Surface = surface_of(args[0])
        elif len(args) in (2, 3):
            self._surface = surface_of(args[0], args[1], triangle_markers=args[2] if len(args) == 3 else None)
        else:
            raise TypeError("TetGen takes a mesh, or vertices and faces")
        self._regions: list[tuple[int, tuple[float, float, float], float]] = []
        self._holes: list[tuple[float, float, float]] = []
        self._result: Optional[TetMesh] = None

    @property
    def v(self) -> Array:
        return self._surface.points

    @property
    def f(self) -> Array:
        return self._surface.triangles

    @property
    def mesh(self) -> Any:
        """The surface as PyVista's PolyData. Raises ImportError without PyVista."""
        from ._other_packages import wanted

        pyvista = wanted("pyvista", "TetGen.mesh")
        faces = np.insert(np.asarray(self.f, np.int64), 0, 3, axis=1).ravel()
        return pyvista.PolyData(np.array(self.v, np.float64), faces)

    def add_region(self, id: int, point_in_region: Any, max_vol: float = 0.0) -> None:
        """Numbers the region that holds a point, and bounds the volume of its elements."""
        x, y, z = (float(c) for c in point_in_region)
        self._regions.append((int(id), (x, y, z), float(max_vol)))

    def add_hole(self, point: Any) -> None:
        """Leaves the region that holds a point empty."""
        x, y, z = (float(c) for c in point)
        self._holes.append((x, y, z))

    def make_manifold(self, verbose: bool = False) -> None:
        """Does nothing: Holdfast accepts surfaces that are not manifold, and moves nothing."""
        raise NotImplementedError("make_manifold: Holdfast needs no manifold; holdfast.diagnose says what is wrong, if anything")

    def tetrahedralize(
        self,
        plc: bool = True,
        quality: bool = True,
        nobisect: bool = True,
        order: int = 1,
        mindihedral: Optional[float] = None,
        minratio: Optional[float] = None,
        maxvolume: Optional[float] = None,
        varvolume: bool = False,
        fixedvolume: bool = False,
        regionattrib: bool = False,
        switches: Optional[str] = None,
        verbose: int = 0,
        quiet: bool = True,
        **others: Any,
    ) -> tuple[Array, Array]:
        """Points and tetrahedra. `switches`, if given, overrides all other options, as in the tetgen package."""
        if order not in (1, 2):
            raise NotImplementedError(f"order={order}: elements are of first or second order")
        if not plc:
            raise NotImplementedError("plc=False: use holdfast.delaunay for points alone")
        for name, value in others.items():
            if value not in (None, False, 0):
                warnings.warn(f"tetrahedralize: {name}={value!r} has no counterpart in Holdfast", stacklevel=2)
        if switches is not None:
            asked = Switches(switches)
        else:
            asked = Switches("pY")
            asked.quality = quality
            asked.order = order
            asked.max_volume = maxvolume if maxvolume and maxvolume > 0 else None
            asked.by_region = varvolume
            asked.attributes = regionattrib
            if not nobisect:
                warnings.warn("nobisect=False: Holdfast keeps the surface as it is all the same", stacklevel=2)
            asked.max_ratio = minratio
            if mindihedral is not None:
                warnings.warn(f"mindihedral={mindihedral}: Holdfast makes angles as good as it finds; TetMesh.quality() "
                              "tells what they are", stacklevel=2)
        self._result = self._run(asked)
        if asked.order == 2:
            self._result = self._result.second_order()
        return self.node, self.elem

    def _run(self, asked: Switches) -> TetMesh:
        regions = [(x, y, z, id) for id, (x, y, z), _ in self._regions]
        bounds: dict[Optional[int], float] = {}
        for id, _, volume in self._regions:
            if volume > 0:
                bounds[id] = min(volume, bounds.get(id, volume))
        if not asked.quality and not bounds:
            return _mesh(self._surface, fill=True, holes=self._holes, regions=regions)
        if asked.max_volume is not None:
            bounds[None] = asked.max_volume
        return _mesh(self._surface, max_volume=bounds, max_ratio=asked.max_ratio, holes=self._holes, regions=regions)

    def _done(self) -> TetMesh:
        if self._result is None:
            raise RuntimeError("there is no mesh yet; call tetrahedralize first")
        return self._result

    @property
    def result(self) -> TetMesh:
        """The `holdfast.TetMesh`."""
        return self._done()

    @property
    def node(self) -> Array:
        """(n, 3) points, followed by the nodes on edges with order 2."""
        return self._done().nodes

    @property
    def elem(self) -> Array:
        """(m, 4) tetrahedra; with order 2 (m, 10), in TetGen's order."""
        mesh = self._done()
        return mesh.tetrahedra if mesh.order == 1 else mesh.tetrahedra10[:, [0, 1, 2, 3, 9, 7, 4, 5, 8, 6]]

    @property
    def attributes(self) -> Array:
        """(m,) regions."""
        return self._done().regions

    @property
    def grid(self) -> Any:
        """A `pyvista.UnstructuredGrid` of the tetrahedra. Raises ImportError without PyVista."""
        from ._other_packages import wanted

        pyvista = wanted("pyvista", "TetGen.grid")
        mesh = self._done()
        cells = np.insert(mesh.tetrahedra.astype(np.int64), 0, 4, axis=1).ravel()
        grid = pyvista.UnstructuredGrid(cells, np.full(len(mesh.tetrahedra), 10, np.uint8), np.array(mesh.points))
        grid.cell_data["region"] = np.array(mesh.regions)
        return grid

    def write(self, filename: Any, binary: bool = True) -> None:
        """Writes the mesh; the ending gives the format (`TetMesh.save`)."""
        self._done().save(filename, compress=binary)


def tetrahedralize(
    v: npt.ArrayLike, f: Optional[npt.ArrayLike] = None, switches: str = "pq1.414Y", **options: Any
) -> tuple[Array, Array]:
    """`tetrahedralize(V, F, "pq1.414Y")`: points and tetrahedra.

    >>> v = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> tetrahedralize(v, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], "pY")[1].shape
    (1, 4)
    """
    tet = TetGen(v) if f is None else TetGen(v, f)
    return tet.tetrahedralize(switches=switches, **options)
