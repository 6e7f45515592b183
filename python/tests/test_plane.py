"""Triangles in the plane: arrays and files in, read-only arrays out, and what is refused."""

import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import holdfast

SQUARE = np.array([(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2)], float)
SIDES = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)])
HOLE = [(1.5, 1.5)]
PROGRAM = Path(holdfast.__file__).parent / "bin" / "holdfast"


def areas(mesh):
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2 if u.shape[1] == 2 else np.linalg.norm(np.cross(u, v), axis=1) / 2


def edges(mesh):
    t = mesh.triangles
    return {tuple(sorted((int(r[i]), int(r[(i + 1) % 3])))) for r in t for i in range(3)}


@pytest.mark.parametrize("options", [{"method": m} for m in ("ears", "swaps", "partition")] + [
    {"method": "ears", "ears": "best"}, {"method": "ears", "ears": "join"}, {"delaunay": True}, {"order": "halving"},
    {"method": "partition", "partition_first": True, "order": "random", "seed": 7}])
def test_every_method(options):
    mesh = holdfast.plane(SQUARE, SIDES, holes=HOLE, **options)
    assert isinstance(mesh, holdfast.PlaneMesh) and repr(mesh) == "PlaneMesh(8 points, 8 triangles)"
    assert np.array_equal(mesh.points, SQUARE) and mesh.n_input_points == 8
    assert areas(mesh).min() > 0 and areas(mesh).sum() == 8
    assert {tuple(sorted(map(int, s))) for s in SIDES} <= edges(mesh)
    assert np.array_equal(mesh.segments, SIDES) and mesh.regions.tolist() == [1] * 8
    for array in (mesh.points, mesh.triangles, mesh.regions, mesh.segments):
        assert not array.flags.writeable
    assert mesh.point_markers is None and mesh.segment_markers is None
    assert mesh.report["mesh"]["triangles"] == 8


def test_without_segments_it_is_the_hull():
    mesh = holdfast.plane(SQUARE.astype(np.float32))
    again = holdfast.plane(SQUARE.astype(int).tolist(), hull=True)
    assert areas(mesh).sum() == 9 and len(mesh.triangles) == 10 and np.array_equal(mesh.triangles, again.triangles)


def test_refined():
    mesh = holdfast.plane(SQUARE, SIDES, holes=HOLE, size=0.4, angle=26, segment_markers=np.arange(8), point_markers=[5] * 8,
                          regions=[(0.5, 0.5, 9)])
    assert np.array_equal(mesh.points[:8], SQUARE) and areas(mesh).sum() == pytest.approx(8)
    ends = mesh.points[np.array(sorted(edges(mesh)))]
    assert np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).max() <= 0.4
    assert mesh.report["mesh"]["least_angle"] >= 26 and set(mesh.regions.tolist()) == {9}
    assert len(mesh.segments) > 8 and set(mesh.segment_markers.tolist()) == set(range(8))
    assert len(mesh.point_markers) == len(mesh.points)
    kept = holdfast.plane(SQUARE, SIDES, holes=HOLE, size=0.4, keep_boundary=True)
    assert len(kept.segments) == 8 and len(kept.points) > 8
    few = holdfast.plane(SQUARE, SIDES, size=0.1, max_points=5)
    assert len(few.points) == 13 and few.report["capped"]
    small = holdfast.plane(SQUARE, SIDES, holes=HOLE, angle=20, regions=[(0.5, 0.5, 1, 0.05)])
    assert areas(small).max() <= 0.05


def test_in_space():
    turned = SQUARE @ np.array([(1, 0, 2), (0, 1, -1)])
    mesh = holdfast.plane(turned, SIDES, holes=[np.array(HOLE[0]) @ np.array([(1, 0, 2), (0, 1, -1)])])
    assert mesh.points.shape == (8, 3) and np.array_equal(mesh.points, turned) and len(mesh.triangles) == 8
    bent = turned + np.array([(0, 0, 0.01 * (i == 5)) for i in range(8)])
    with pytest.raises(ValueError, match="lies in no plane"):
        holdfast.plane(bent, SIDES)
    assert len(holdfast.plane(bent, SIDES, tolerance=0.1).triangles) == 10
    with pytest.raises(ValueError, match="names point 8"):
        holdfast.plane(turned, [(0, 8)])
    marked = holdfast.plane(turned, SIDES, point_markers=range(8), segment_markers=np.arange(8) + 10, size=0.7)
    assert marked.point_markers[:8].tolist() == list(range(8)) and set(marked.segment_markers.tolist()) == set(range(10, 18))
    assert len(marked.segments) > 8
    with pytest.raises(ValueError, match="as many markers"):
        holdfast.plane(turned, SIDES, segment_markers=[1, 2])
    with pytest.raises(ValueError, match="no regions here"):
        holdfast.plane(turned, SIDES, regions=[(0, 0, 1)])


def test_formats_and_names(tmp_path):
    mesh = holdfast.plane(SQUARE, SIDES, segment_markers=[1] * 4 + [2] * 4, regions=[(0.5, 0.5, 7), (*HOLE[0], 8)])
    told = mesh.save(tmp_path / "a.msh", names={"regions": {7: "plate"}, "segments": {1: "rim"}})
    assert any("order" in line for line in told)
    read = holdfast.read_surface(tmp_path / "a.msh")
    assert read.names == holdfast.Names({7: "plate"}, {}, {1: "rim"}, {})
    assert sorted(read.triangle_markers.tolist()) == [7] * 8 + [8] * 2
    again = holdfast.plane(tmp_path / "a.msh")
    assert again.names.segments == {1: "rim"} and pickle.loads(pickle.dumps(again)).names == again.names
    assert again.save(tmp_path / "b.off")[1:] == ["8 segments' markers have no place in .off", "1 name has no place in .off"]
    mesh.save(tmp_path / "c.msh", "msh2")
    assert "$MeshFormat\n2.2" in (tmp_path / "c.msh").read_text()
    with pytest.raises(holdfast.FileError, match="cannot be written"):
        mesh.save(tmp_path / "a.step")


def test_repair():
    # A cross in a square, as lines of a drawing; one end is 1e-7 short of a side.
    points = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (1, 2), (0, 1), (2 - 1e-7, 1)], float)
    segments = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (6, 7)]
    with pytest.raises(holdfast.InvalidSurface):
        holdfast.plane(points, segments)
    mesh = holdfast.plane(points, segments, segment_markers=[1, 1, 1, 1, 2, 3], repair=True)
    assert mesh.n_input_points == 8 and len(mesh.points) == 9 and (mesh.points[:8] == points).all()
    assert set(mesh.regions) == {1, 2, 3}
    assert mesh.report["repair"]["cut_segments"] == 5 and sorted(set(mesh.segment_markers)) == [1, 2, 3]
    joined = holdfast.plane(points, segments, repair=1e-6)
    assert set(joined.regions) == {1, 2, 3, 4} and joined.report["repair"]["max_displacement"] <= 1e-6
    space = holdfast.plane(np.c_[points, points.sum(axis=1)], segments, repair=True)
    assert space.points.shape == (9, 3) and tuple(space.points[8]) == (1, 1, 2)
    assert "repair" not in holdfast.plane(points[:4], segments[:4]).report
    with pytest.raises(ValueError, match="repair"):
        holdfast.plane(points, segments, repair=-1.0)
    with pytest.raises(TypeError, match="repair"):
        holdfast.plane(points, segments, repair="yes")


def test_drawings(tmp_path):
    corners = [word for x, y in ((0, 0), (2, 0)) for word in (10, x, 20, y, 42, 1)]
    words = [0, "SECTION", 2, "ENTITIES", 0, "LWPOLYLINE", 8, "disc", 70, 1, *corners, 0, "ENDSEC", 0, "EOF"]
    (tmp_path / "a.dxf").write_text("".join(f"{word}\n" for word in words))
    with pytest.raises(holdfast.FileError, match="arc"):
        holdfast.plane(tmp_path / "a.dxf")
    mesh = holdfast.plane(tmp_path / "a.dxf", arcs=10)
    assert len(mesh.points) == 36 and areas(mesh).sum() == pytest.approx(np.pi, rel=0.01)
    assert mesh.names.segments == {0: "disc"}
    with pytest.raises(ValueError, match="only files"):
        holdfast.plane(SQUARE, SIDES, arcs=10)


def test_files(tmp_path):
    mesh = holdfast.plane(SQUARE, SIDES, holes=HOLE, point_markers=range(8))
    for name in ("a.off", "a.vtu", "a.node"):
        mesh.save(tmp_path / name)
    assert (tmp_path / "a.ele").exists()
    again = holdfast.plane(tmp_path / "a.off")
    assert again.points.shape == (8, 3) and areas(again).sum() == 9  # sides enclose the hole, too
    poly = tmp_path / "b.poly"
    poly.write_text("# square\n8 2 0 1\n" + "".join(f"{i + 1} {x} {y} {i}\n" for i, (x, y) in enumerate(SQUARE)) +
                    "8 1\n" + "".join(f"{i + 1} {a + 1} {b + 1} {10 + i}\n" for i, (a, b) in enumerate(SIDES)) + "1\n1 1.5 1.5\n")
    read = holdfast.plane(str(poly), method="ears", delaunay=True)
    assert np.array_equal(read.points, SQUARE) and read.segment_markers.tolist() == list(range(10, 18))
    subprocess.run([PROGRAM, "plane", poly, "-o", tmp_path / "c.off", "-q", "--method", "ears", "--delaunay", "--report",
                    tmp_path / "c.json"], check=True)
    read.save(tmp_path / "d.off")
    assert (tmp_path / "c.off").read_bytes() == (tmp_path / "d.off").read_bytes()
    theirs = json.loads((tmp_path / "c.json").read_text())
    assert set(read.report) == set(theirs) and read.report["mesh"] == theirs["mesh"]
    with pytest.raises(holdfast.FileError):
        holdfast.plane(tmp_path / "none.poly")
    with pytest.raises(holdfast.FileError):
        mesh.save(tmp_path / "no" / "folder.off")
    with pytest.raises(ValueError, match="leave them out"):
        holdfast.plane(poly, holes=HOLE)
    (tmp_path / "bad.poly").write_text("3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 7\n0\n")
    with pytest.raises(holdfast.FileError, match="7"):
        holdfast.plane(tmp_path / "bad.poly")


@pytest.mark.parametrize("points, segments, kind, which", [
    (np.vstack([SQUARE, SQUARE[2]]), SIDES, "repeated vertex", (2, 8)),
    ([(0, 0), (2, 0), (1, 0), (1, 1)], [(0, 1)], "vertex in segment", (2,)),
    ([(0, 0), (2, 2), (2, 0), (0, 2)], [(0, 1), (2, 3)], "segments cross", ()),
    ([(0, 0), (2, 0), (1, 1)], [(0, 1), (1, 0)], "segments overlap", ()),
    ([(0, 0), (2, 0), (1, 1)], [(0, 0)], "degenerate segment", (0, 0)),
    ([(0, 0), (2, 0), (1, 1)], [(0, 9)], "index out of range", ()),
    ([(0, 0), (2, 0), (np.nan, 1)], [(0, 1)], "non-finite coordinate", (2,)),
])
def test_what_is_invalid(points, segments, kind, which):
    for method in ("ears", "swaps", "partition"):
        with pytest.raises(holdfast.InvalidSurface) as caught:
            holdfast.plane(points, segments, method=method)
        kinds = [d.kind for d in caught.value.defects]
        assert kind in kinds
        assert caught.value.defects[kinds.index(kind)].vertices == which and caught.value.report["outcome"] == "invalid_input"


@pytest.mark.parametrize("error, match, options", [
    (ValueError, "there is ears, swaps, partition", {"method": "magic"}),
    (ValueError, "without method='ears'", {"ears": "best"}),
    (ValueError, "lays no segments", {"method": "ears", "order": "random"}),
    (ValueError, "without method='partition'", {"partition_first": True}),
    (ValueError, "no such stage", {"stop_after": "partition"}),
    (ValueError, "no such stage", {"stop_after": "swap=3", "method": "ears"}),
    (ValueError, "swap=K", {"stop_after": "swap"}),
    (ValueError, "come after it", {"stop_after": "delaunay", "angle": 20}),
    (ValueError, "come after it", {"stop_after": "delaunay", "holes": [(1.5, 1.5)]}),
    (ValueError, "come after it", {"stop_after": "delaunay", "delaunay": True}),
    (ValueError, "no point is added", {"keep_boundary": True}),
    (ValueError, "no point is added", {"max_points": 3}),
    (ValueError, "size=0.0: a positive", {"size": 0}),
    (TypeError, "size='x'", {"size": "x"}),
    (ValueError, "angle=40.0: .* 34 degrees", {"angle": 40}),
    (TypeError, "angle=\\[\\]", {"angle": []}),
    (TypeError, "holes=3: a list", {"holes": 3}),
    (TypeError, "regions=None: a list", {"regions": None}),
    (ValueError, "lie in the plane", {"tolerance": 1}),
    (ValueError, "no file", {"format": ".poly"}),
    (ValueError, "2 numbers", {"holes": [(1, 2, 3)]}),
    (ValueError, "hole 1 is not finite", {"holes": [(1, np.nan)]}),
    (holdfast.InvalidSurface, "hole 0 .* lies on segment 0", {"holes": [(1, 0)]}),
    (ValueError, "region is given", {"regions": [(1, 1)]}),
    (ValueError, "markers", {"segment_markers": [1]}),
    (TypeError, "integers", {"segment_markers": ["a"] * 8}),
    (ValueError, "seconds", {"time_limit": -1}),
])
def test_what_makes_no_sense(error, match, options):
    with pytest.raises(error, match=match):
        holdfast.plane(SQUARE, SIDES, **options)


def test_arrays_that_are_none():
    for points, segments, error in [(np.zeros((3, 4)), None, ValueError), (np.zeros(6), None, ValueError), ([["a", "b"]], None, TypeError),
                                    (SQUARE, [(0.5, 1)], TypeError), (SQUARE, [(0, 1, 2)], ValueError), (SQUARE, [(-1, 2)], ValueError),
                                    ([(2**53 + 1, 0), (0, 1), (1, 1)], None, ValueError)]:
        with pytest.raises(error):
            holdfast.plane(points, segments)


def test_limits():
    rng = np.random.default_rng(1)
    many = rng.random((200_000, 2))
    with pytest.raises(holdfast.TimeLimit):
        holdfast.plane(many, delaunay=True, time_limit=1e-3)
    token = holdfast.CancelToken()
    token.cancel()
    with pytest.raises(holdfast.Cancelled):
        holdfast.plane(many, cancel=token)
    told = []
    holdfast.plane(many, progress=lambda stage, share: told.append((stage, share)))
    assert told and told[-1][1] == 1 and {s for s, _ in told} == {"plane"}


def test_stages():
    crossed = [(0, 0), (4, 0), (2, 1), (2, -1), (1, 0.5), (3, -0.5)]
    mesh = holdfast.plane(crossed, [(0, 1)], method="partition", stop_after="delaunay", hull=True)
    assert mesh.report["intermediate"]["missing_segments"] == [[0, 1]]
    for count, missing in ((0, [[0, 1]]), (100, [])):
        mesh = holdfast.plane(crossed, [(0, 1)], stop_after=f"swap={count}", hull=True)
        assert mesh.report["intermediate"]["missing_segments"] == missing


def test_planes_are_read_with_a_tolerance(tmp_path):
    corners = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 1, 0.01), (0, 4, 0)]
    path = tmp_path / "bent.off"
    path.write_text("OFF\n5 1 0\n" + "".join("%r %r %r\n" % c for c in corners) + "5 0 1 2 3 4\n")
    with pytest.raises(holdfast.FileError, match="lies in no plane"):
        holdfast.plane(path)
    assert len(holdfast.plane(path, tolerance=0.02).triangles) == 3
    assert len(holdfast.read_surface(path).triangles) == 3
    for wrong in (-1, np.inf, np.nan):
        with pytest.raises(ValueError, match="tolerance"):
            holdfast.read_surface(path, tolerance=wrong)


@pytest.mark.parametrize("points", [SQUARE, np.c_[SQUARE, SQUARE.sum(axis=1)]])
def test_pickling(points, tmp_path):
    mesh = holdfast.plane(points, SIDES, holes=[(1.5, 1.5, 3.0)[:points.shape[1]]])
    again = pickle.loads(pickle.dumps(mesh))
    for name in ("points", "triangles", "regions", "segments"):
        assert np.array_equal(getattr(again, name), getattr(mesh, name))
    assert again.report == mesh.report and again.n_input_points == mesh.n_input_points
    assert again.point_markers is None and again.remarks == mesh.remarks
    for which, name in ((mesh, "a.off"), (again, "b.off")):
        which.save(tmp_path / name)
    assert (tmp_path / "a.off").read_bytes() == (tmp_path / "b.off").read_bytes()
