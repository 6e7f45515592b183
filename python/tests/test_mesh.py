"""mesh and its result."""

from __future__ import annotations

import copy
import pickle
import warnings

import numpy as np
import pytest

import holdfast
from conftest import box, sphere, two_boxes, write_off


def volume_of(mesh):
    return mesh.quality().volume.sum()


def test_cube(cube):
    mesh = holdfast.mesh(*cube)
    assert mesh.points.dtype == np.float64 and mesh.points.shape[1] == 3
    assert mesh.tetrahedra.dtype == np.int32 and mesh.tetrahedra.shape[1] == 4
    assert mesh.regions.dtype == np.int32 and set(mesh.regions) == {1}
    assert mesh.n_input_points == 8
    assert np.array_equal(mesh.points[:8].view(np.uint64), cube[0].view(np.uint64))
    assert np.array_equal(mesh.triangles, cube[1])
    assert (mesh.quality().volume > 0).all()
    assert volume_of(mesh) == pytest.approx(1)
    assert holdfast.check(cube, mesh).holds


def test_fill_adds_nothing_to_a_cube(cube):
    mesh = holdfast.mesh(*cube, fill=True)
    assert len(mesh.points) == 8
    assert mesh.report["field_points"] == 0


def test_size_as_number_array_field_and_function(cube):
    coarse = holdfast.mesh(*cube, size=1.0)
    fine = holdfast.mesh(*cube, size=0.25)
    assert len(fine) > 3 * len(coarse)
    by_function = holdfast.mesh(*cube, size=lambda p: np.full(len(p), 0.25))
    assert np.array_equal(by_function.tetrahedra, fine.tetrahedra) or 0.5 < len(by_function) / len(fine) < 2
    per_point = holdfast.mesh(*cube, size=np.full(8, 0.25), growth=False)
    assert len(per_point) > len(coarse)
    background = holdfast.mesh(*box((-1, -1, -1), (2, 2, 2)), fill=True)
    field = (background.points, background.tetrahedra, np.full(len(background.points), 0.25))
    assert 0.5 < len(holdfast.mesh(*cube, size=field)) / len(fine) < 2


def test_metric_stretches(cube):
    flat = holdfast.mesh(*cube, metric=lambda p: np.tile(np.diag([100.0, 4.0, 4.0]), (len(p), 1, 1)))
    thin = holdfast.mesh(*cube, metric=lambda p: np.tile(np.array([4.0, 0, 4, 0, 0, 4]), (len(p), 1)))
    assert len(flat) > 1.5 * len(thin)


def test_metric_that_is_not_symmetric_is_refused(cube):
    with pytest.raises(ValueError, match="symmetric"):
        holdfast.mesh(*cube, metric=lambda p: np.tile([[4.0, 1, 0], [0, 4, 0], [0, 0, 4]], (len(p), 1, 1)))


def test_empty_arrays_of_any_type(cube):
    assert len(holdfast.mesh(*cube, segments=np.empty((0, 2))).tetrahedra) > 0


def test_function_of_sizes_is_asked_with_arrays(cube):
    shapes = []

    def size(points):
        shapes.append(points.shape)
        return 0.1 + 0.2 * points[:, 0]

    mesh = holdfast.mesh(*cube, size=size)
    assert {shape[1:] for shape in shapes} == {(3,)}
    assert sum(shape[0] for shape in shapes) > 1.25 * len(shapes)
    assert np.array_equal(mesh.points, holdfast.mesh(*cube, size=lambda p: list(size(p))).points)


def test_function_of_sizes_may_give_one_number_for_all(cube):
    assert np.array_equal(holdfast.mesh(*cube, size=lambda p: 0.2).points,
                          holdfast.mesh(*cube, size=lambda p: np.full(len(p), 0.2)).points)
    with pytest.raises(ValueError, match="NaN"):
        holdfast.mesh(*cube, size=lambda p: np.nan)


def test_function_without_a_return_is_told(cube):
    def size(points):
        0.1 + 0.2 * points[:, 0]

    with pytest.raises(ValueError, match="size gave None: has it a `return`?"):
        holdfast.mesh(*cube, size=size)


@pytest.mark.parametrize("bad", [lambda p: "x", lambda p: np.zeros((len(p), 2)), lambda p: None])
def test_function_of_sizes_that_gives_nonsense(cube, bad):
    with pytest.raises((ValueError, TypeError)):
        holdfast.mesh(*cube, size=bad)


def test_regions_markers_and_sides():
    points, triangles, markers = two_boxes()
    mesh = holdfast.mesh(points, triangles, triangle_markers=markers, regions=[(0.5, 0.5, 0.5, 7), (1.5, 1.5, 1.5, 9, 0.3)])
    assert set(mesh.regions) == {7, 9}
    assert np.array_equal(mesh.triangle_markers, markers)
    sides = mesh.triangle_regions
    assert sides.shape == (24, 2)
    assert all(np.ma.is_masked(s[0]) and s[1] == 7 for s in sides[:12])
    assert [list(s) for s in sides[12:]] == [[7, 9]] * 12
    hollow = holdfast.mesh(points, triangles, holes=[(1.5, 1.5, 1.5)])
    assert volume_of(hollow) == pytest.approx(63)
    q = hollow.quality()
    assert len(q.q) == len(hollow) and (q.q >= 1).all() and (q.min_dihedral <= q.max_dihedral).all()


def test_sides_found_from_tetrahedra_alone():
    points, triangles, _ = two_boxes()
    mesh = holdfast.mesh(points, triangles)
    again = holdfast.TetMesh(mesh.points, mesh.tetrahedra, regions=mesh.regions, triangles=mesh.triangles)
    assert np.array_equal(np.ma.filled(again.triangle_regions, -1), np.ma.filled(mesh.triangle_regions, -1))


def test_segments_and_their_markers(cube):
    mesh = holdfast.mesh(*cube, segments=[(0, 7)], segment_markers=[5])
    assert [0, 7] in mesh.segments.tolist()
    at = mesh.segments.tolist().index([0, 7])
    assert mesh.segment_markers[at] == 5
    # The cut through the cube is an edge of the mesh.
    edges = {tuple(sorted(e)) for t in mesh.tetrahedra.tolist() for e in ((t[0], t[1]), (t[0], t[2]), (t[0], t[3]),
                                                                          (t[1], t[2]), (t[1], t[3]), (t[2], t[3]))}
    assert (0, 7) in edges


def test_keep_box(cube):
    mesh = holdfast.mesh(*cube, keep="box", box_margin=0.5)
    assert volume_of(mesh) == pytest.approx(8)
    assert holdfast.check(cube, mesh, box=True).holds


def test_orders_of_laying():
    # Every constraint of this prism is cut in without flips (Schönhardt).
    turn = lambda z, angle: [(np.cos(a + angle), np.sin(a + angle), z) for a in 2 * np.pi * np.arange(3) / 3]
    points = np.array(turn(0, 0) + turn(1, np.pi / 6))
    triangles = [(0, 2, 1), (3, 4, 5)] + [t for i in range(3) for t in ((i, (i + 1) % 3, 3 + i), ((i + 1) % 3, 3 + (i + 1) % 3, 3 + i))]
    for order in ("random", "given", "halving"):
        mesh = holdfast.mesh(points, triangles, fill=True, without=["flips"], order=order)
        assert holdfast.check((points, triangles), mesh)


def test_same_bits_for_seed_and_threads():
    surface = sphere(30)
    first = holdfast.mesh(*surface)
    for options in ({}, {"threads": 2}):
        again = holdfast.mesh(*surface, **options)
        assert np.array_equal(first.tetrahedra, again.tetrahedra) and np.array_equal(first.points, again.points)


def test_views_are_read_only_and_outlive_the_mesh(cube):
    mesh = holdfast.mesh(*cube)
    arrays = {name: getattr(mesh, name) for name in
              ("points", "tetrahedra", "regions", "triangles", "triangle_markers", "segments", "segment_markers",
               "input_points", "triangle_regions")}
    copies = {name: np.ma.copy(a) if isinstance(a, np.ma.MaskedArray) else a.copy() for name, a in arrays.items()}
    for array in arrays.values():
        if array.size:
            with pytest.raises(ValueError):
                array[0] = 1
    assert mesh.points.base is not None and not mesh.points.flags.owndata
    assert mesh.points is mesh.points
    del mesh
    trash = [holdfast.mesh(*cube) for _ in range(5)]
    for name, array in arrays.items():
        assert np.array_equal(np.ma.filled(array, -7), np.ma.filled(copies[name], -7)), name
    del trash


def test_what_save_would_not_write_cannot_be_set(cube, tmp_path):
    mesh = holdfast.mesh(*cube)
    for name in ("points", "tetrahedra", "regions", "triangles", "segments"):
        with pytest.raises(AttributeError, match=f"{name} of a mesh cannot be replaced"):
            setattr(mesh, name, 2 * getattr(mesh, name))
    with pytest.raises(TypeError, match="names of a mesh cannot be changed"):
        mesh.names.regions[1] = "core"
    with pytest.raises(TypeError, match="names of a mesh cannot be changed"):
        mesh.names.triangles.update({1: "skin"})
    assert mesh.names == ({}, {}, {}, {}) and not mesh.names
    mesh.save(tmp_path / "a.vtu", names={"regions": {1: "core"}})
    named = holdfast.read_volume(tmp_path / "a.vtu")
    assert named.names.regions == {1: "core"} == pickle.loads(pickle.dumps(named.names)).regions
    assert copy.deepcopy(named).names == named.names and {**named.names.regions, 2: "shell"} == {1: "core", 2: "shell"}


def test_pickle():
    points, triangles, markers = two_boxes()
    mesh = holdfast.mesh(points, triangles, triangle_markers=markers)
    again = pickle.loads(pickle.dumps(mesh))
    for name in ("points", "tetrahedra", "regions", "triangles", "triangle_markers", "segments", "input_points"):
        assert np.array_equal(getattr(mesh, name), getattr(again, name)), name
    assert again.n_input_points == mesh.n_input_points and again.report == mesh.report
    assert np.array_equal(again.triangle_regions.filled(-1), mesh.triangle_regions.filled(-1))
    assert not again.points.flags.writeable
    surface = pickle.loads(pickle.dumps(holdfast.Surface(points, triangles)))
    assert np.array_equal(surface.triangles, triangles)


def test_one_thing_is_no_many():
    points, triangles = np.eye(3), [(0, 1, 2)]
    assert repr(holdfast.Surface(points, triangles, segments=[(0, 1)])) == "Surface(3 points, 1 triangle, 1 segment)"
    assert repr(holdfast.repair(points, triangles)).startswith("Repair(3 points, 1 triangle, ")
    assert repr(holdfast.plane(points[:, :2])) == "PlaneMesh(3 points, 1 triangle)"


def test_merged_points_are_mapped():
    points, triangles = box()
    # Every corner of its own.
    split = points[triangles].reshape(-1, 3)
    mesh = holdfast.mesh(split, np.arange(36).reshape(12, 3))
    assert mesh.n_input_points == 8 and mesh.report["input"]["merged_vertices"] == 28
    assert (mesh.input_points[:8] >= 0).all() and (mesh.input_points[8:] == -1).all()
    assert np.array_equal(split[mesh.input_points[:8]], mesh.points[:8])


def test_repr_and_html(cube):
    mesh = holdfast.mesh(*cube, fill=True)
    assert repr(mesh).startswith("TetMesh(8 points, ") and "1 region" in repr(mesh)
    assert "least dihedral angle" in mesh._repr_html_() and mesh._repr_html_().startswith("<table>")
    assert len(mesh) == len(mesh.tetrahedra)


@pytest.mark.parametrize("ending", [".vtu", ".vtk", ".mesh", ".meshb", ".msh", ".node"])
def test_save_and_read(tmp_path, nested, ending):
    points, triangles, markers = nested
    mesh = holdfast.mesh(points, triangles, triangle_markers=markers)
    told = mesh.save(tmp_path / ("a" + ending))
    assert isinstance(told, list)
    again = holdfast.read_volume(tmp_path / ("a" + ending))
    assert np.array_equal(again.points, mesh.points)
    assert sorted(map(tuple, again.tetrahedra.tolist())) == sorted(map(tuple, mesh.tetrahedra.tolist()))
    assert sorted(again.triangle_markers) == sorted(markers)
    assert holdfast.check((points, triangles), again).rules[3].holds


def test_save_where_nothing_can_be_written(tmp_path, cube):
    mesh = holdfast.mesh(*cube, fill=True)
    with pytest.raises(holdfast.FileError):
        mesh.save(tmp_path / "no" / "folder.vtu")
    with pytest.raises(holdfast.FileError):
        mesh.save(tmp_path / "a.unknown")
    assert list(tmp_path.iterdir()) == []
    assert mesh.save(tmp_path / "old.msh", "msh2") is not None and "2.2" in (tmp_path / "old.msh").read_text()[:40]


def test_surface_of_a_mesh_can_be_meshed_again():
    mesh = holdfast.mesh(*sphere(12))
    again = holdfast.mesh(mesh.surface())
    assert volume_of(again) == pytest.approx(volume_of(mesh))


def test_neighbours(cube):
    mesh = holdfast.mesh(*cube)
    beside = mesh.neighbours()
    assert beside.shape == mesh.tetrahedra.shape and (beside == -1).sum() == 12
    t, k = np.argwhere(beside >= 0)[0]
    assert len(set(mesh.tetrahedra[t]) & set(mesh.tetrahedra[beside[t, k]])) == 3


@pytest.mark.parametrize("match, options", [
    ("gradation would do nothing", {"fill": True, "gradation": 0.2}),
    ("growth=False would do nothing", {"fill": True, "growth": False}),
    ("quality='best' would do nothing", {"fill": True, "quality": "best"}),
    ("size, layers would do nothing", {"fill": True, "size": 1, "layers": 2}),
    ("the size of a region would do nothing", {"fill": True, "regions": [(0.5, 0.4, 0.6, 7, 0.1)]}),
    ("without fill=True", {"without": "points"}),
    ("they are for the optimisation", {"without": "optimise", "quality": "fast"}),
    ("nothing with metric", {"metric": lambda p: np.tile(np.eye(3), (len(p), 1, 1)), "growth": False}),
])
def test_options_without_effect_are_refused(cube, match, options):
    with pytest.raises(ValueError, match=match):
        holdfast.mesh(*cube, **options)


def test_save_of_second_order_is_what_the_program_writes(cube, tmp_path):
    mesh = holdfast.mesh(*cube, size=0.5)
    assert mesh.save(tmp_path / "a.vtu", order=2) == mesh.second_order().save(tmp_path / "b.vtu")
    assert (tmp_path / "a.vtu").read_bytes() == (tmp_path / "b.vtu").read_bytes()
    assert b"input_vertex" in (tmp_path / "a.vtu").read_bytes()


@pytest.mark.parametrize("format", ["stl", ".off"])
def test_save_of_surfaces_by_format(cube, tmp_path, format):
    mesh = holdfast.mesh(*cube, size=0.5)
    mesh.save(tmp_path / "surface", format)
    assert len(holdfast.read_surface(tmp_path / "surface", format=format).triangles) == 12


def test_delaunay():
    points = np.random.default_rng(1).random((200, 3))
    tets = holdfast.delaunay(points)
    assert tets.dtype == np.int32 and tets.shape[1] == 4 and not tets.flags.writeable
    p = points[tets]
    assert np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]).min() > 0
    assert holdfast.delaunay(np.zeros((0, 3))).shape == (0, 4)
    with pytest.raises(ValueError, match="point 3 is not finite"):
        holdfast.delaunay([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, np.nan)])


def test_untangle():
    good = holdfast.mesh(*sphere(12))
    points = np.array(good.points)
    inner = np.arange(good.n_input_points, len(points))
    points[inner] = np.random.default_rng(2).permutation(points[inner])
    tangled = holdfast.TetMesh(points, good.tetrahedra, triangles=good.triangles)
    assert (tangled.quality().volume < 0).any()
    mesh = holdfast.untangle(tangled)
    assert (mesh.quality().volume > 0).all()
    assert np.array_equal(mesh.points[: good.n_input_points], good.points[: good.n_input_points])
    assert mesh.report["input"]["negative"] > 0


def test_untangle_improves():
    good = holdfast.mesh(*sphere(12), fill=True)
    mesh = holdfast.untangle(good, improve=True)
    improved = mesh.report["improved"]
    assert improved["after"]["mean_q"] < improved["before"]["mean_q"]
    assert np.array_equal(mesh.points[: good.n_input_points], good.points[: good.n_input_points])
    with pytest.raises(ValueError):
        holdfast.untangle(good, improve=True, refill=False)


def test_layers(cube):
    points, triangles = cube
    mesh = holdfast.mesh(np.asarray(points) * [1, 1, 0.05], triangles, layers=3)
    assert mesh.report["layers"]["at_rims"] == 8  # all of them
    for wrong in (0, 101, -1):
        with pytest.raises(ValueError):
            holdfast.mesh(points, triangles, layers=wrong)
    with pytest.raises(ValueError):
        holdfast.mesh(points, triangles, layers=2, fill=True)


def test_check_finds_what_is_wrong(cube):
    mesh = holdfast.mesh(*cube)
    result = holdfast.check(cube, holdfast.TetMesh(mesh.points, mesh.tetrahedra[1:], triangles=mesh.triangles))
    assert not result and result.broken and "BROKEN" in str(result)


def test_diagnose_tells_what_it_finds(cube):
    points, triangles = cube
    found = holdfast.diagnose(points, triangles)
    assert found == [] and found.valid and found.encloses == 1
    twice = holdfast.diagnose(points, np.concatenate([triangles, triangles[:1]]))
    assert [d.kind for d in twice] == ["repeated facet"] and twice[0].triangles == (0, 12)
    assert twice.summary["causes"][0]["count"] == 1
    opened = holdfast.diagnose(points, triangles[1:])
    assert opened.valid and opened.encloses == 0
    crossing = np.concatenate([points, points + 0.5])
    both = np.concatenate([triangles, triangles + 8])
    assert len(holdfast.diagnose(crossing, both, most=3)) == 3


def test_files(tmp_path, cube):
    path = write_off(tmp_path / "cube.off", *cube)
    surface = holdfast.read_surface(path)
    assert np.array_equal(surface.points, cube[0]) and np.array_equal(surface.triangles, cube[1])
    by_path = holdfast.mesh(path)
    by_surface = holdfast.mesh(surface)
    assert np.array_equal(by_path.tetrahedra, by_surface.tetrahedra)
    inner = write_off(tmp_path / "inner.off", *box((0.25,) * 3, (0.75,) * 3))
    both = holdfast.mesh(holdfast.read_surface([path, inner]))
    assert set(both.regions) == {1, 2}
    assert holdfast.diagnose(str(path)).valid
    assert holdfast.check(path, by_path).holds


def test_threads_on_a_larger_surface():
    surface = sphere(60)
    assert len(holdfast.mesh(*surface, threads=0)) == len(holdfast.mesh(*surface, threads=1))


def test_warnings_are_in_the_result(cube):
    points, triangles = cube
    turned = triangles.copy()
    turned[0] = turned[0][::-1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = holdfast.mesh(points, turned)
    assert any("turned" in w for w in mesh.warnings)


def test_max_volume_bounds_every_tetrahedron():
    points, triangles = box((0, 0, 0), (1, 1, 1))
    mesh = holdfast.mesh(points, triangles, max_volume=0.01, max_ratio=2)
    assert mesh.quality().volume.max() <= 0.01 * (1 + 1e-12)
    assert 0 < mesh.report["bounds"]["fullest"] <= 1
    points, triangles, _ = two_boxes()
    seeds = [(0.5, 0.5, 0.5, 10), (1.5, 1.5, 1.5, 20)]
    mesh = holdfast.mesh(points, triangles, keep="bounded", regions=seeds, max_volume={None: 1.0, 20: 0.02})
    volumes = mesh.quality().volume
    assert volumes[mesh.regions == 20].max() <= 0.02 * (1 + 1e-12) < volumes[mesh.regions == 10].max() <= 1.0
    for wrong in ({7: 1.0}, 0, -1.0, {20: 0}):
        with pytest.raises(ValueError):
            holdfast.mesh(points, triangles, keep="bounded", regions=seeds, max_volume=wrong)
    with pytest.raises(TypeError):
        holdfast.mesh(points, triangles, max_volume="small")
    with pytest.raises(ValueError):
        holdfast.mesh(points, triangles, fill=True, max_volume=1)


def test_second_order(tmp_path):
    points, triangles = sphere(8)
    mesh = holdfast.mesh(points, triangles).second_order()
    assert mesh.order == 2 and mesh.tetrahedra10.shape == (len(mesh), 10)
    for column, (a, b) in enumerate(((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))):
        middle = (mesh.points[mesh.tetrahedra[:, a]] + mesh.points[mesh.tetrahedra[:, b]]) / 2
        assert np.allclose(mesh.nodes[mesh.tetrahedra10[:, 4 + column]], middle, rtol=0, atol=1e-15)
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(again.nodes, mesh.nodes) and np.array_equal(again.triangles6, mesh.triangles6)
    fine, finer = sphere(64)
    curved = mesh.second_order(curved=holdfast.Surface(fine, finer))
    told = curved.curve_report
    assert told["moved"] > 0.8 * told["on_triangles"] > 0
    assert holdfast.check(holdfast.Surface(points, triangles), curved)
    with pytest.raises(ValueError):
        holdfast.mesh(points, triangles).tetrahedra10


def test_info(tmp_path, cube):
    mesh = holdfast.mesh(*cube, fill=True)
    mesh.save(tmp_path / "cube.vtu")
    told = holdfast.info(tmp_path / "cube.vtu")
    assert told["kind"] == "volume" and told["tetrahedra"] == len(mesh)
    assert told["volume"] == pytest.approx(1)
    assert mesh.info()["tetrahedra"] == len(mesh)
