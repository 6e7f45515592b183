"""Objects of other packages, by their shape; round trips where the package is there; what takes TetGen's place."""

from __future__ import annotations

import os
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

import holdfast
from conftest import QUADS, box, sphere, two_boxes
from holdfast import compat
from holdfast._surface import surface_of


def poly(points, triangles, **more):
    """Shaped like PyVista's PolyData."""
    faces = np.insert(np.asarray(triangles, np.int64), 0, 3, axis=1).ravel()
    return SimpleNamespace(points=points, faces=faces, n_strips=0, lines=np.empty(0, np.int64), cell_data={}, **more)


def test_shapes_of_other_packages(cube):
    points, triangles = cube
    expected = holdfast.mesh(points, triangles).tetrahedra
    shapes = {
        "pyvista": poly(points, triangles),
        "trimesh": SimpleNamespace(vertices=points, faces=triangles),
        "meshio": SimpleNamespace(points=points, cells=[SimpleNamespace(type="triangle", data=triangles)], cell_data={}),
        "pair": (points, triangles),
        "lists": (points.tolist(), triangles.tolist()),
        "surface": holdfast.Surface(points, triangles),
    }
    for name, shape in shapes.items():
        assert np.array_equal(holdfast.mesh(shape).tetrahedra, expected), name
    for kind in (np.int64, np.uint32, np.uint64, np.int16, np.dtype(">i4")):
        assert np.array_equal(holdfast.mesh(points, triangles.astype(kind)).tetrahedra, expected), kind
    assert np.array_equal(holdfast.mesh(np.asfortranarray(points), triangles[:, ::1]).tetrahedra, expected)
    assert np.array_equal(holdfast.mesh(points.astype(np.float32), triangles).tetrahedra, expected)
    assert np.array_equal(holdfast.mesh(points.astype(int), triangles).tetrahedra, expected)


def test_polygons_lines_and_markers():
    points, _ = box()
    faces = np.concatenate([[4, *q] for q in QUADS])
    mesh = SimpleNamespace(points=points, faces=faces, lines=np.array([2, 0, 7]), cell_data={"marker": np.arange(7)})
    result = holdfast.mesh(mesh)
    assert sorted(set(result.triangle_markers)) == [1, 2, 3, 4, 5, 6] and [0, 7] in result.segments.tolist()


def test_polygons_that_are_not_convex_or_not_plane():
    corners = [(0, 0, 0), (2, 0, 0), (0.5, 0.5, 0.25), (0, 2, 0), (0, 0, 1)]
    dart = SimpleNamespace(points=np.array(corners, float), faces=np.array([4, 0, 1, 2, 3, 3, 0, 4, 1, 3, 1, 4, 2, 3, 2, 4, 3, 3, 3, 4, 0]),
                           cell_data={"marker": np.arange(5)})
    result = holdfast.mesh(dart)
    assert {(0, 1, 2), (0, 2, 3)} <= {tuple(sorted(t)) for t in result.triangles.tolist()}
    assert sorted(set(result.triangle_markers)) == [0, 1, 2, 3, 4]
    with pytest.raises(ValueError, match="polygon 1 has 2 corners"):
        holdfast.diagnose(SimpleNamespace(points=dart.points, faces=np.array([3, 0, 1, 2, 2, 0, 1]), cell_data={}))
    with pytest.raises(ValueError, match="names vertex 9"):
        holdfast.diagnose(SimpleNamespace(points=dart.points, faces=np.array([4, 0, 1, 2, 9]), cell_data={}))


def test_meshio_round_trip(tmp_path):
    meshio = pytest.importorskip("meshio")
    points, triangles, markers = two_boxes()
    mesh = holdfast.mesh(points, triangles, triangle_markers=markers, segments=[(0, 8)], segment_markers=[4],
                         holes=[(1.5, 1.5, 1.5)])
    out = mesh.to_meshio()
    assert np.array_equal(out.points, mesh.points)
    assert holdfast.check((points, triangles), out).rules[4].holds
    out.write(tmp_path / "a.vtu")
    again = holdfast.read_volume(tmp_path / "a.vtu")
    assert len(again) == len(mesh) and np.array_equal(again.regions, mesh.regions)
    assert sorted(again.triangle_markers) == sorted(markers)
    read = meshio.read(tmp_path / "a.vtu")
    surface = meshio.Mesh(points, [("triangle", triangles)], cell_data={"marker": [markers]})
    assert np.array_equal(holdfast.mesh(surface).triangle_markers, markers)
    assert np.array_equal(read.cells_dict["tetra"], mesh.tetrahedra)
    with pytest.raises(TypeError, match="tetrahedra"):
        holdfast.mesh(meshio.Mesh(mesh.points, [("tetra", mesh.tetrahedra)]))
    field = meshio.Mesh(mesh.points, [("tetra", mesh.tetrahedra)], point_data={"size": np.full(len(mesh.points), 0.8)})
    assert len(holdfast.mesh(*box((1, 1, 1), (3, 3, 3)), size=field)) > 0


def test_names_go_to_other_packages_and_come_back(tmp_path):
    meshio = pytest.importorskip("meshio")
    points, triangles, markers = two_boxes()
    names = {"triangles": {1: "outer", 2: "core"}, "regions": {1: "core"}}
    mesh = holdfast.mesh(holdfast.Surface(points, triangles, triangle_markers=np.where(np.asarray(markers) == markers[0], 1, 2), names=names))
    assert mesh.names.triangles == names["triangles"] and mesh.names.regions == names["regions"]
    out = mesh.to_meshio()
    assert {name: pair.tolist() for name, pair in out.field_data.items()} == {"core": [1, 3], "outer": [1, 2], "core_2": [2, 2]}
    again = holdfast.mesh(out)
    assert again.names.triangles == {1: "outer", 2: "core_2"} and again.names.regions == names["regions"]
    mesh.save(tmp_path / "a.msh")
    read = holdfast.mesh(meshio.read(tmp_path / "a.msh"))
    assert set(read.names.triangles.values()) >= {"outer"}
    pytest.importorskip("vtkmodules")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    fields = mesh.to_vtk().GetFieldData()
    assert vtk_to_numpy(fields.GetArray("core")).tolist() == [[1, 3], [2, 2]]


def test_sets_of_meshio_are_markers(cube):
    meshio = pytest.importorskip("meshio")
    points, triangles = cube
    cells = [("triangle", triangles[:4]), ("line", [(0, 1)]), ("triangle", triangles[4:])]
    sets = {"low": [[0, 1], [], None], "side": [None, None, np.array([0, 7])], "rim": [[], [0], []], "gmsh:bounding_entities": [[3], [], []]}
    mesh = holdfast.mesh(meshio.Mesh(points, cells, cell_sets=sets))
    assert mesh.triangle_markers.tolist() == [1, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 2] and mesh.segment_markers.tolist() == [1]
    assert mesh.names.triangles == {1: "low", 2: "side"} and mesh.names.segments == {1: "rim"}


def test_tags_of_meshio_may_be_columns(cube, tmp_path):
    meshio = pytest.importorskip("meshio")
    points, triangles = cube
    mesh = holdfast.mesh(points, triangles, triangle_markers=range(12), fill=True)
    mesh.save(tmp_path / "a.vtk")  # whose arrays have one column in meshio
    read = meshio.read(tmp_path / "a.vtk")
    assert read.cell_data["marker"][1].shape == (12, 1)
    assert sorted(holdfast.mesh(read, fill=True).triangle_markers) == list(range(12))
    assert np.array_equal(holdfast.untangle(read).regions, mesh.regions)


def test_cells_of_meshio_that_are_no_surface_are_named(cube):
    meshio = pytest.importorskip("meshio")
    points, _ = cube
    with pytest.raises(TypeError, match="hexahedron cells and no triangles"):
        holdfast.mesh(meshio.Mesh(points, [("hexahedron", [(0, 1, 3, 2, 4, 5, 7, 6)])]))
    second = holdfast.mesh(*cube).second_order().to_meshio()
    with pytest.raises(TypeError, match="tetra10"):
        holdfast.check(cube, second)


def test_vtk_round_trip():
    pytest.importorskip("vtkmodules")
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource

    source = vtkSphereSource()
    source.Update()
    mesh = holdfast.mesh(source.GetOutput())
    grid = mesh.to_vtk()
    assert grid.GetNumberOfCells() == len(mesh) + len(mesh.triangles) + len(mesh.segments)
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), mesh.points)
    assert np.array_equal(vtk_to_numpy(grid.GetCellData().GetArray("region"))[: len(mesh)], mesh.regions)
    cube = vtkCubeSource()  # quads, corners three times
    cube.Update()
    data = cube.GetOutput()
    markers, pairs = numpy_to_vtk(np.arange(6, dtype=np.int32), deep=True), numpy_to_vtk(np.array([[5, 2]], np.int32), deep=True)
    markers.SetName("marker")
    pairs.SetName("top")
    data.GetCellData().AddArray(markers)
    data.GetFieldData().AddArray(pairs)
    boxed = holdfast.mesh(data)
    assert boxed.names.triangles == {5: "top"} and set(boxed.triangle_markers.tolist()) == set(range(6))
    assert boxed.n_input_points == 8 and boxed.quality().volume.sum() == pytest.approx(1)


def test_missing_packages_are_named(cube, monkeypatch):
    import builtins

    real = builtins.__import__

    def without(name, *rest):
        if name.split(".")[0] in ("pyvista", "meshio", "vtkmodules"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    mesh = holdfast.mesh(*cube, fill=True)
    monkeypatch.setattr("importlib.import_module", without)
    for call, package in ((mesh.to_pyvista, "pyvista"), (mesh.to_meshio, "meshio"), (mesh.to_vtk, "vtk")):
        with pytest.raises(ImportError, match=package):
            call()


def fake_pyvista():
    """As much of PyVista as the package uses."""

    class UnstructuredGrid:
        def __init__(self, cells, types, points):
            self.cells, self.celltypes, self.points, self.cell_data, self.field_data = cells, types, points, {}, {}

    class PolyData:
        def __init__(self, points, faces):
            self.points, self.faces, self.cell_data, self.field_data = points, faces, {}, {}

    return SimpleNamespace(UnstructuredGrid=UnstructuredGrid, PolyData=PolyData)


def test_a_grid_is_told_to_give_its_surface(cube):
    grid = fake_pyvista().UnstructuredGrid(None, None, cube[0])
    with pytest.raises(TypeError, match="UnstructuredGrid; its `extract_surface"):
        holdfast.mesh(grid)


def test_pyvista_grid_and_accessor(cube, monkeypatch):
    import sys

    fake = fake_pyvista()
    monkeypatch.setitem(sys.modules, "pyvista", fake)
    mesh = holdfast.mesh(*cube)
    grid = mesh.to_pyvista()
    assert grid.cells[0] == 4 and (grid.celltypes == 10).sum() == len(mesh)
    assert len(grid.cell_data["region"]) == len(grid.celltypes)
    named = holdfast.mesh(holdfast.Surface(*cube, triangle_markers=[3] * 12, names={"triangles": {3: "wall"}})).to_pyvista()
    assert named.field_data["wall"].tolist() == [[3, 2]]
    skin = fake.PolyData(cube[0], np.insert(cube[1], 0, 3, axis=1).ravel())
    skin.lines = np.array([3, 0, 1, 2, 2, 4, 5])
    skin.cell_data["marker"] = np.array([7, 8] + [3] * 12)
    skin.field_data = dict(named.field_data, TimeValue=np.array([1, 2]))
    read = surface_of(skin, None)
    assert read.segment_markers.tolist() == [7, 7, 8] and set(read.triangle_markers.tolist()) == {3}
    assert read.names.triangles == {3: "wall"} and not read.names.points
    from holdfast import pyvista_accessor

    assert pyvista_accessor.register()
    surface = fake.PolyData(cube[0], np.insert(cube[1], 0, 3, axis=1).ravel())
    assert (surface.holdfast.mesh(fill=True).celltypes == 10).sum() == len(holdfast.mesh(*cube, fill=True))
    assert surface.holdfast.diagnose().valid
    tet = compat.TetGen(surface)
    tet.tetrahedralize()
    assert (tet.grid.celltypes == 10).all() and tet.mesh.points.shape == (8, 3)


def test_tetgen_calls(cube):
    tet = compat.TetGen(*cube)
    nodes, elements = tet.tetrahedralize(switches="pq1.4a0.001YQ")
    assert tet.result.quality().volume.max() <= 0.001 * (1 + 1e-12)
    assert np.array_equal(nodes[:8], cube[0]) and elements is tet.elem and len(elements) > 200
    filled, few = compat.tetrahedralize(*cube, "pY")
    assert len(few) < len(elements) and len(filled) == 8
    points, triangles, _ = two_boxes()
    two = compat.TetGen(points, triangles)
    two.add_region(5, (0.5, 0.5, 0.5))
    two.add_hole((1.5, 1.5, 1.5))
    two.tetrahedralize(order=1, quality=False, regionattrib=True)
    assert set(two.attributes) == {5}


def test_tetgen_calls_that_cannot_be_had(cube):
    tet = compat.TetGen(*cube)
    with pytest.raises(RuntimeError):
        tet.node
    for switches in ("pr", "pw", "pc", "pR"):
        with pytest.raises(NotImplementedError):
            tet.tetrahedralize(switches=switches)
    with pytest.raises(ValueError):
        tet.tetrahedralize(switches="p?")
    with pytest.raises(NotImplementedError):
        tet.tetrahedralize(order=3)
    with pytest.warns(UserWarning, match="mindihedral"):
        tet.tetrahedralize(mindihedral=20)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tet.tetrahedralize(switches="pY")


def test_tetgen_order_2_has_tetgens_order(cube):
    nodes, elements = compat.TetGen(*cube).tetrahedralize(order=2, quality=False)
    assert elements.shape[1] == 10
    for column, (a, b) in enumerate(((2, 3), (0, 3), (0, 1), (1, 2), (1, 3), (0, 2))):
        assert np.allclose(nodes[elements[:, 4 + column]], (nodes[elements[:, a]] + nodes[elements[:, b]]) / 2)


def test_switches():
    assert compat.Switches("-pq1.414a0.1AY").max_volume == 0.1
    glued = compat.Switches("pq1.4/15a.5e1")
    assert glued.quality and glued.max_volume == 5.0
    assert compat.Switches("pa").by_region
    assert compat.size_of_volume(np.sqrt(2) / 12) == pytest.approx(1)


def test_float32_surface_keeps_its_values():
    points, triangles = sphere(16)
    single = points.astype(np.float32)
    mesh = holdfast.mesh(single, triangles)
    assert np.array_equal(mesh.points[: len(single)], single.astype(np.float64))


def boxes():
    """A box in a box; regions 1 and 2."""
    corners = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    sides = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6),
                      (0, 6, 2), (1, 3, 7), (1, 7, 5)])
    return np.concatenate([4 * corners, corners + 1]), np.concatenate([sides, sides + 8])


@pytest.mark.parametrize("ending", ["vtu", "msh", "inp", "med", "xdmf", "unv", "bdf", "vol", "mfem", "node"])
def test_convert_keeps_what_there_is(tmp_path, ending):
    names = {"regions": {1: "shell", 2: "core"}}
    mesh = holdfast.mesh(holdfast.Surface(*boxes(), names=names), keep="bounded", fill=True)
    mesh.save(tmp_path / "a.vtu")
    holdfast.convert(tmp_path / "a.vtu", tmp_path / f"b.{ending}")
    found, said = holdfast.info(tmp_path / f"b.{ending}"), mesh.info()
    assert (found["vertices"], found["tetrahedra"], found["triangles"]) == (said["vertices"], said["tetrahedra"], said["triangles"])
    assert [r["id"] for r in found["regions"]] == [1, 2]
    if ending != "node":
        assert [r["name"] for r in found["regions"]] == ["shell", "core"]
    assert len(holdfast.read_volume(tmp_path / f"b.{ending}").tetrahedra) == found["tetrahedra"]


def test_convert_takes_parts_and_tells_what_is_lost(tmp_path):
    mesh = holdfast.mesh(*boxes(), keep="bounded", fill=True)
    mesh.save(tmp_path / "a.vtu", names={"regions": {2: "core"}})
    told = holdfast.convert(tmp_path / "a.vtu", tmp_path / "core.stl", only="region=core", scale=2)
    assert any("tetrahedra" in line for line in told)
    assert holdfast.info(tmp_path / "core.stl")["volume"] == pytest.approx(8)
    holdfast.convert(tmp_path / "a.vtu", tmp_path / "each.ply", each_region=True)
    assert {p.name for p in tmp_path.glob("each*")} == {"each_core.ply", "each_region_1.ply"}
    with pytest.raises(ValueError):
        holdfast.convert(tmp_path / "a.vtu", tmp_path / "no.stl", only="part")
    with pytest.raises(ValueError):
        holdfast.convert(tmp_path / "a.vtu", tmp_path / "no.stl", binary=True)
    with pytest.raises(holdfast.FileError) as caught:
        holdfast.convert(tmp_path / "there_is_none.vtu", tmp_path / "no.stl")
    assert caught.value.filename.endswith("there_is_none.vtu")
    assert not (tmp_path / "no.stl").exists()


def test_save_takes_what_the_writers_take(tmp_path):
    mesh = holdfast.mesh(*boxes(), keep="bounded", fill=True).second_order()
    mesh.save(tmp_path / "a.msh", binary=True)
    assert b"4.1 1 8" in (tmp_path / "a.msh").read_bytes()[:40]
    mesh.save(tmp_path / "b.vtu", one_file=True)
    assert not (tmp_path / "b_surface.vtu").exists()
    mesh.save(tmp_path / "c.inp", shells=True)
    assert "TYPE=S6" in (tmp_path / "c.inp").read_text()
    mesh.save(tmp_path / "case", "openfoam", gzip=True)
    assert holdfast.info(tmp_path / "case")["tetrahedra"] == len(mesh)
    assert holdfast.read_volume(tmp_path / "a.msh").order == 2
    mesh.save(tmp_path / "e.mesh", order=1, scale=2, only="region=2")
    found = holdfast.info(tmp_path / "e.mesh")
    assert (found["order"], found["volume"]) == (1, pytest.approx(8))
    holdfast.mesh(*boxes(), keep="bounded", fill=True).save(tmp_path / "f.med", order=2)
    assert holdfast.info(tmp_path / "f.med")["order"] == 2
    mesh.save(tmp_path / "g.stl")
    assert holdfast.info(tmp_path / "g.stl")["triangles"] == 24
    for option in ("binary", "one_file", "gzip", "shells"):
        with pytest.raises(ValueError):
            mesh.save(tmp_path / "d.mesh", **{option: True})
    assert not (tmp_path / "d.mesh").exists()


def test_max_volume_of_a_region_that_no_seed_numbers():
    mesh = holdfast.mesh(*boxes(), keep="bounded", max_volume={2: 0.01})
    volumes = mesh.quality().volume
    assert volumes[mesh.regions == 2].max() <= 0.01 < volumes[mesh.regions == 1].max()
    with pytest.raises(ValueError, match="its regions are 1, 2"):
        holdfast.mesh(*boxes(), keep="bounded", max_volume={7: 0.01})
    for id in "core", 1.5, True:
        with pytest.raises(TypeError, match="is no id of a region"):
            holdfast.mesh(*boxes(), keep="bounded", max_volume={id: 0.01})


def test_names_of_files_that_are_no_utf8(tmp_path):
    folder = os.fsencode(tmp_path) + b"/d\xe4"
    os.mkdir(folder)
    name = os.fsdecode(folder + b"/w\xfcrfel.off")
    points, triangles = boxes()
    with open(name, "w", encoding="ascii") as off:
        off.write(f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join("%r %r %r\n" % tuple(map(float, p)) for p in points)
                  + "".join("3 %d %d %d\n" % tuple(t) for t in triangles))
    mesh = holdfast.mesh(name, keep="bounded")
    for written in "n.vtu", "n.msh", "n.stl":
        mesh.save(os.path.join(os.fsdecode(folder), written))
        assert os.path.exists(os.path.join(folder, os.fsencode(written)))
    assert len(holdfast.read_volume(os.path.join(os.fsdecode(folder), "n.vtu")).tetrahedra) == len(mesh.tetrahedra)
    assert holdfast.info(name)["file"] == holdfast.info(os.fsencode(name))["file"] == name
    assert len(holdfast.read_surface([name, name]).triangles) == 2 * len(triangles)
    missing = os.fsdecode(folder + b"/no\xfc.stl")
    with pytest.raises(holdfast.FileError) as told:
        holdfast.mesh(missing)
    assert told.value.filename == missing
    str(told.value).encode()  # can be printed
    with pytest.raises(ValueError, match="null byte"):
        holdfast.mesh("a\0b.stl")
