"""The result of meshing: arrays, the report, and conversions to objects of other packages."""

from __future__ import annotations

import html
import json
import os
import tempfile
import typing
from typing import Any, Optional, Union

import numpy as np
import numpy.ma as ma
import numpy.typing as npt

from . import _core, _other_packages
from ._convert import convert
from ._counts import counted
from ._limits import CancelToken, MemoryAmount, Progress, Shown, limits
from ._names import Fixed, Names, names_of
from ._repair import Repair
from ._shapes import Quality, frozen, quality_of, regions_beside
from ._surface import Array, PathLike, Surface, _or_none, indices_of, markers_of, points_of, surface_of

_ARRAYS = {"points", "tetrahedra", "regions", "triangles", "segments"}


class TetMesh:
    """Tetrahedra that keep a surface. All arrays are read-only and may outlive the mesh.

    The first `n_input_points` points are the surface's, bit for bit and in its order (each place once); then come the
    points that were added. Indices are from 0.

    >>> import holdfast
    >>> mesh = holdfast.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ...                      [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], fill=True)
    >>> mesh
    TetMesh(4 points, 1 tetrahedron, 1 region)
    >>> mesh.tetrahedra.shape, mesh.regions
    ((1, 4), array([1], dtype=int32))
    """

    points: Array
    """(n, 3) float64."""
    tetrahedra: Array
    """(m, 4) int32, in VTK's order: the fourth corner is on the side to which the first three turn counterclockwise."""
    regions: Array
    """(m,) int32: the region of each tetrahedron, from 1 unless seeds number it."""
    triangles: Array
    """(k, 3) int32: every kept triangle of the surface, with its orientation there."""
    segments: Array
    """(s, 2) int32."""
    n_input_points: Optional[int]
    """The number of points of the surface; None if a file does not say."""

    def __init__(
        self,
        points: npt.ArrayLike,
        tetrahedra: npt.ArrayLike,
        *,
        regions: Optional[npt.ArrayLike] = None,
        triangles: Optional[npt.ArrayLike] = None,
        triangle_markers: Optional[npt.ArrayLike] = None,
        segments: Optional[npt.ArrayLike] = None,
        segment_markers: Optional[npt.ArrayLike] = None,
        point_markers: Optional[npt.ArrayLike] = None,
        names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]] = None,
    ) -> None:
        volume = _core.Volume(
            points_of(points),
            indices_of(tetrahedra, 4, "tetrahedra"),
            markers_of(regions, "regions"),
            None if triangles is None else indices_of(triangles, 3, "triangles"),
            markers_of(triangle_markers, "triangle_markers"),
            None if segments is None else indices_of(segments, 2, "segments"),
            markers_of(segment_markers, "segment_markers"),
            markers_of(point_markers, "point_markers"),
            names=tuple(names_of(names)),
        )
        for name, array, count in (
            ("regions", volume.regions, len(volume.tetrahedra)),
            ("triangle_markers", volume.triangle_markers, len(volume.triangles)),
            ("segment_markers", volume.segment_markers, len(volume.segments)),
            ("point_markers", volume.point_markers, len(volume.points)),
        ):
            if len(array) not in (0, count):
                raise ValueError(f"{name}: {len(array)} for {count}")
        for name, array in (("tetrahedra", volume.tetrahedra), ("triangles", volume.triangles),
                            ("segments", volume.segments)):
            bad = (array < 0) | (array >= len(volume.points))
            if bad.any():
                raise ValueError(f"{name}[{int(np.argmax(bad.any(axis=1)))}] names a point that there is not")
        self._set(volume, None)

    def _set(self, volume: _core.Volume, n_input_points: Optional[int], result: Any = None) -> None:
        self._volume = volume
        self._result = result
        self._report: Optional[dict[str, Any]] = None
        self.repair: Optional[Repair] = None
        """The changes that `mesh(..., repair=True)` made first; `repair.surface` is the surface that was meshed."""
        self.pasted: Any = None
        """The `Pasted` parts that `mesh` filled, or None; `pasted.surface` is the surface that was meshed."""
        self._triangle_regions: Optional[ma.MaskedArray[Any, Any]] = None
        self.curve_report: dict[str, Any] = {}
        self.points = volume.points
        self.tetrahedra = volume.tetrahedra
        self.regions = volume.regions
        self.triangles = volume.triangles
        self.segments = volume.segments
        self.n_input_points = n_input_points

    def __setattr__(self, name: str, value: Any) -> None:
        """`save` would not write an array that took the place of one of these."""
        if name in _ARRAYS and name in self.__dict__:
            raise AttributeError(f"{name} of a mesh cannot be replaced: TetMesh(points, tetrahedra, ...) makes a mesh of "
                                 "other arrays, and save(path, scale=...) scales")
        super().__setattr__(name, value)

    @classmethod
    def _of(cls, volume: _core.Volume, n_input_points: Optional[int], result: Any = None) -> "TetMesh":
        mesh = cls.__new__(cls)
        mesh._set(volume, n_input_points, result)
        return mesh

    @property
    def names(self) -> Names:
        """Names of triangle, segment and point markers and of regions, one dictionary each. They are written to files
        that can hold them; `save(path, names=...)` writes others."""
        return Names(*map(Fixed, self._volume.names))

    @property
    def triangle_markers(self) -> Array:
        """(k,) int32; zeros if the surface has none."""
        return self._markers(self._volume.triangle_markers, len(self.triangles))

    @property
    def segment_markers(self) -> Array:
        """(s,) int32; zeros if the surface has none."""
        return self._markers(self._volume.segment_markers, len(self.segments))

    @property
    def point_markers(self) -> Array:
        """(n,) int32; zeros if the surface has none, and for added points."""
        return self._markers(self._volume.point_markers, len(self.points))

    @staticmethod
    def _markers(array: Array, count: int) -> Array:
        if len(array) == count:
            return array
        zeros: Array = np.zeros(count, np.int32)
        zeros.setflags(write=False)
        return zeros

    @property
    def input_points(self) -> Array:
        """(n,) int64: for each point the first of the input's points at its place, -1 for an added point. Empty if not
        known."""
        if len(self._volume.input_points) or self.n_input_points is None:
            return self._volume.input_points
        found = np.arange(len(self.points), dtype=np.int64)
        found[self.n_input_points :] = -1
        found.setflags(write=False)
        return found

    @property
    def triangle_regions(self) -> "ma.MaskedArray[Any, Any]":
        """(k, 2) int32: regions in front of each triangle (seen from there its corners turn counterclockwise) and
        behind it; masked on a side without a region."""
        if self._triangle_regions is None:
            self._triangle_regions = self._find_triangle_regions()
        return self._triangle_regions

    def _find_triangle_regions(self) -> "ma.MaskedArray[Any, Any]":
        if self._result is not None and hasattr(self._result, "triangle_regions"):
            ids, none = self._result.triangle_regions()
            if len(ids) == len(self.triangles):
                return frozen(ids, none)
        return regions_beside(self.tetrahedra, self.regions, self.triangles)

    @property
    def report(self) -> dict[str, Any]:
        """What the run did and decided, with the keys of the program's `--report`; {} if there was no run."""
        if self._report is None:
            self._report = {} if self._result is None else json.loads(self._result.report())
        return self._report

    @property
    def marker_sets(self) -> dict[int, list[int]]:
        """Markers of `triangles` that stand for several markers of the pasted parts: {marker: markers of the parts}."""
        return {int(marker): list(of) for marker, of in self.report.get("marker_sets", {}).items()}

    @property
    def warnings(self) -> list[str]:
        """Decisions of the mesher, and warnings about the input."""
        return [str(w["message"]) for w in self.report.get("warnings", [])]

    def quality(self) -> Quality:
        """Shape of every tetrahedron.

        >>> import holdfast
        >>> mesh = holdfast.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        ...                      [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], fill=True)
        >>> float(mesh.quality().volume.sum())
        0.16666666666666666
        """
        return quality_of(self.points, self.tetrahedra)

    def info(self) -> dict[str, Any]:
        """Counts, sizes, regions and markers with their names and measures, shapes of the tetrahedra: the keys of
        `holdfast info --json` (listed in docs/command-line.md)."""
        return dict(json.loads(_core.volume_info(self._volume)))

    @property
    def order(self) -> int:
        """2 if edges have nodes in their middle, otherwise 1."""
        return 2 if len(self._volume.mid_points) else 1

    def second_order(self, curved: Any = None, tolerance: Optional[float] = None) -> "TetMesh":
        """The same mesh with a node in the middle of each edge. `nodes`, `tetrahedra10` and so on hold the nodes, and
        `save` writes them. `not_positive` lists the tetrahedra that are too flat for such nodes.

        Parameters
        ----------
        curved
            A smooth surface, given by finer triangles (any input of `mesh`): nodes on edges of triangles are put on it,
            unless an element would not be positive everywhere. `curve_report` counts them.
        tolerance
            How far a node may move; by default a tenth of its edge.

        >>> import holdfast
        >>> mesh = holdfast.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        ...                      [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], fill=True).second_order()
        >>> mesh.order, mesh.nodes.shape, mesh.tetrahedra10.shape
        (2, (10, 3), (1, 10))
        """
        smooth = None if curved is None else surface_of(curved)
        if tolerance is not None and (smooth is None or not 0 < tolerance < float("inf")):
            raise ValueError("tolerance: a positive length beside `curved` is expected")
        volume, told = _core.second_order(
            self._volume,
            None if smooth is None else smooth.points,
            None if smooth is None else smooth.triangles,
            0.0 if tolerance is None else float(tolerance),
        )
        mesh = TetMesh._of(volume, self.n_input_points, self._result)
        mesh._report = self._report
        mesh.curve_report = {} if smooth is None else dict(told)
        return mesh

    @property
    def not_positive(self) -> Array:
        """(k,) tetrahedra of second order whose Jacobian is not proven positive everywhere, ascending. With straight edges they
        are so flat that their nodes, rounded to doubles, invert them. Solvers refuse them. Empty for a mesh of first order."""
        return _core.not_positive_elements(self._volume)

    @property
    def nodes(self) -> Array:
        """(n, 3): the points, then the nodes in the middle of edges."""
        return np.concatenate([self.points, self._volume.mid_points])

    @property
    def tetrahedra10(self) -> Array:
        """(m, 10) indices into `nodes`: the corners, then the nodes on their edges 01 12 02 03 13 23, as VTK, meshio
        and Abaqus have them (Gmsh swaps the last two). Only for a mesh of second order."""
        return self._with_nodes(self.tetrahedra, self._volume.mid_tetrahedra)

    @property
    def triangles6(self) -> Array:
        """(k, 6) indices into `nodes`: the corners, then the nodes on their edges 01 12 02."""
        return self._with_nodes(self.triangles, self._volume.mid_triangles)

    @property
    def segments3(self) -> Array:
        """(s, 3) indices into `nodes`: the ends, then the node between them."""
        return self._with_nodes(self.segments, self._volume.mid_segments.reshape(-1, 1))

    def _with_nodes(self, corners: Array, nodes: Array) -> Array:
        if self.order == 1:
            raise ValueError("the mesh is of first order; second_order() gives it nodes on its edges")
        return np.concatenate([corners, nodes], axis=1)

    def neighbours(self) -> Array:
        """(m, 4) int32: the tetrahedron behind the face opposite each corner, or -1."""
        return _core.neighbours(self._volume)

    def surface(self) -> Surface:
        """The mesh's facets and segments, and the faces on its boundary and between regions, as a surface."""
        data = _core.surface_of(self._volume)
        return Surface(
            data.points,
            data.triangles,
            segments=_or_none(data.segments),
            triangle_markers=_or_none(data.triangle_markers),
            segment_markers=_or_none(data.segment_markers),
            point_markers=_or_none(data.point_markers),
            names=Names(*data.names),
        )

    def save(
        self,
        path: PathLike,
        format: Optional[str] = None,
        *,
        binary: bool = False,
        one_file: bool = False,
        gzip: bool = False,
        shells: bool = False,
        order: Optional[int] = None,
        names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]] = None,
        only: Union[None, str, typing.Sequence[str]] = None,
        each_region: bool = False,
        scale: Optional[float] = None,
        compress: bool = True,
        threads: int = 1,
        time_limit: Optional[float] = None,
        memory_limit: Optional[MemoryAmount] = None,
        cancel: Optional[CancelToken] = None,
        progress: Progress = None,
    ) -> list[str]:
        """Writes a file, which appears complete or not at all. It is of second order if the mesh is.

        Parameters
        ----------
        path
            .vtu, .vtm, .vtk, .mesh, .meshb, .msh, .inp, .unv, .bdf, .nas, .su2, .mfem, .vol, .xdmf, .med, .exo, .cgns,
            .fluent, .k, .cdb, .feb, .xml, .node, or a folder polyMesh (OpenFOAM); or .stl, .ply, .obj, .off,
            .gts or .poly for the boundary and the interfaces.
            docs/formats.md lists what each format holds.
        format
            The ending to use if the name does not give the format; also "msh2" (version 2.2 of .msh), "fluent" or "openfoam"
            (`path` is the case).
        binary
            .msh: numbers as bytes.
        one_file
            .vtu, .xdmf: triangles and segments in the same file, not in a second file NAME_surface.
        gzip
            OpenFOAM: compressed files.
        shells
            .inp: triangles as shell elements, too.
        order, names, only, each_region, scale
            As in `holdfast.convert`: elements of first or second order, names of ids, a part, a file for each
            region, another unit. The mesh itself stays as it is.
        compress
            .vtu: blocks compressed by zlib, on `threads` threads.
        time_limit, memory_limit, cancel, progress
            As in `mesh`.

        Returns
        -------
        list of str
            What the format cannot hold, one sentence each.

        Raises
        ------
        FileError
            If the file cannot be written.
        ValueError
            For an option that does nothing in the format.

        >>> import holdfast, os, tempfile
        >>> mesh = holdfast.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        ...                      [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], fill=True)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     told = mesh.save(os.path.join(folder, "one.msh"), "msh2", binary=True)
        ...     holdfast.read_volume(os.path.join(folder, "one.msh"))
        TetMesh(4 points, 1 tetrahedron, 1 region)
        """
        kind = (format or os.path.splitext(os.fsdecode(path))[1]).lower().removeprefix(".")
        surfaces = kind in ("stl", "ply", "obj", "off", "gts", "poly")
        if order == 2 and not surfaces and not each_region and all(x is None for x in (names, only, scale)):
            mesh = self if self.order == 2 else self.second_order()
            if len(mesh.not_positive) == 0:  # otherwise `convert` warns of these
                return mesh.save(path, format, binary=binary, one_file=one_file, gzip=gzip, shells=shells, compress=compress,
                                 threads=threads, time_limit=time_limit, memory_limit=memory_limit, cancel=cancel, progress=progress)
        if surfaces or each_region or any(x is not None for x in (order, names, only, scale)):
            with tempfile.TemporaryDirectory() as folder:
                inner = os.path.join(folder, "mesh.vtu")
                self.save(inner, compress=False, time_limit=time_limit, memory_limit=memory_limit, cancel=cancel)
                return convert(inner, path, format=format, binary=binary, one_file=one_file, gzip=gzip, shells=shells,
                               order=order, names=names, only=only, each_region=each_region, scale=scale, threads=threads,
                               time_limit=time_limit, memory_limit=memory_limit)
        legacy = format in ("msh2", ".msh2")
        ending = _core.volume_format_of(os.fsdecode(path), ".msh" if legacy else format or "")
        for option, given, of in (
            ("binary", binary, (".msh",)),
            ("one_file", one_file, (".vtu", ".xdmf")),
            ("gzip", gzip, (".openfoam",)),
            ("shells", shells, (".inp",)),
        ):
            if given and ending not in of:
                raise ValueError(f"{option} does nothing for {ending}: it is for {', '.join(of)}")
        how = {"format": ending, "threads": threads, "compress": compress, "legacy_msh": legacy, "binary": binary,
               "one_file": one_file, "gzip": gzip, "shells": shells}
        options = limits(time_limit, memory_limit, cancel)
        with Shown(progress, "write") as callback:
            return _core.write_volume(os.fsdecode(path), self._volume, how, options, callback)

    def to_meshio(self) -> Any:
        """A `meshio.Mesh` with cell data "region" and "marker". Raises ImportError without meshio."""
        return _other_packages.to_meshio(self)

    def to_vtk(self) -> Any:
        """A `vtkUnstructuredGrid` with cell arrays "region" and "marker". Raises ImportError without VTK."""
        return _other_packages.to_vtk(self)

    def to_pyvista(self) -> Any:
        """A `pyvista.UnstructuredGrid` with cell data "region" and "marker". Raises ImportError without PyVista."""
        return _other_packages.to_pyvista(self)

    def _regions(self) -> Array:
        return self._markers(self.regions, len(self.tetrahedra))

    def __len__(self) -> int:
        return len(self.tetrahedra)

    def _counts(self) -> list[tuple[int, str, str]]:
        regions = len(np.unique(self.regions)) if len(self.regions) else 1 if len(self.tetrahedra) else 0
        return [
            (len(self.points), "point", "points"),
            (len(self.tetrahedra), "tetrahedron", "tetrahedra"),
            (regions, "region", "regions"),
        ]

    def __repr__(self) -> str:
        return f"TetMesh({', '.join(counted(*c) for c in self._counts())})"

    def _repr_html_(self) -> str:
        rows = [(f"{count:,}", one if count == 1 else many) for count, one, many in self._counts()]
        if self.n_input_points is not None:
            rows.append((f"{len(self.points) - self.n_input_points:,}", "added points"))
        rows.append((f"{len(self.triangles):,}", "triangles kept"))
        if len(self.tetrahedra):
            least = self.quality().min_dihedral
            rows.append((f"{least.min():.3g}°", "least dihedral angle"))
            rows.append((f"{100 * np.mean(least < 10):.3g} %", "of tetrahedra below 10°"))
        cells = "".join(f"<tr><td style='text-align:right'>{html.escape(a)}</td><td>{html.escape(b)}</td></tr>"
                        for a, b in rows)
        return f"<table><thead><tr><th colspan='2'>TetMesh</th></tr></thead><tbody>{cells}</tbody></table>"

    def __getstate__(self) -> dict[str, Any]:
        volume = self._volume
        regions = self.triangle_regions if self._result is not None else None
        return {
            "arrays": [np.array(a) for a in (volume.points, volume.tetrahedra, volume.regions, volume.triangles,
                                             volume.triangle_markers, volume.segments, volume.segment_markers,
                                             volume.point_markers, volume.input_points)]
                      + [tuple(volume.names)],
            "mid_nodes": None if self.order == 1 else [
                np.array(a) for a in (volume.mid_points, volume.mid_tetrahedra.reshape(-1, 2), volume.mid_triangles,
                                      volume.mid_segments)],
            "curve_report": self.curve_report,
            "n_input_points": self.n_input_points,
            "report": self.report,
            "triangle_regions": regions,
            "repair": self.repair,
            "pasted": self.pasted,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        volume = _core.Volume(*state["arrays"])
        if state["mid_nodes"] is not None:
            volume = _core.with_mid_nodes(volume, *state["mid_nodes"])
        self._set(volume, state["n_input_points"])
        self.curve_report = state["curve_report"]
        self._report = state["report"]
        regions = state["triangle_regions"]
        self._triangle_regions = None if regions is None else frozen(regions.data, np.asarray(regions.mask))
        self.repair, self.pasted = state.get("repair"), state.get("pasted")
