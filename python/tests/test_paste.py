"""Parts that touch: `paste`, and `mesh` of what it gives."""

import copy
import gzip
import json
import pickle
import subprocess

import numpy as np
import pytest

import holdfast
from conftest import box as plain_box
from conftest import write_off
from holdfast._program import program


def box(x0, x1, n):
    """The triangles of a box from x0 to x1, with n cells a side."""
    t = np.linspace(0, 1, n + 1)
    points, index, triangles = [], {}, []

    def at(p):
        if p not in index:
            index[p] = len(points)
            points.append((x0 + (x1 - x0) * t[p[0]], t[p[1]], t[p[2]]))
        return index[p]

    for axis in range(3):
        for end in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = end, i + di, j + dj
                        corners.append(at(tuple(p)))
                    a, b, c, d = corners if end else corners[::-1]
                    triangles += [(a, b, c), (a, c, d)]
    return np.array(points), np.array(triangles)


def volumes(mesh):
    each = mesh.quality().volume
    return {int(r): float(each[mesh.regions == r].sum()) for r in np.unique(mesh.regions)}


def test_parts_that_are_cut_differently():
    a, b = box(0, 1, 2), box(1, 3, 3)
    pasted = holdfast.paste(a, b, names=["left", "right"])
    assert pasted.regions == [1, 2] and pasted.moved == {} and pasted.apart == []
    shared = [p for p in pasted.parents if len(p) == 2]
    assert shared and all(p[0] < len(a[1]) <= p[1] for p in shared)
    assert pasted.report["marker_sets"] == {"3": [1, 2]} and pasted.marker_sets == {3: [1, 2]}
    mesh = holdfast.mesh(pasted, fill=True)
    assert volumes(mesh) == pytest.approx({1: 1, 2: 2})
    assert mesh.marker_sets == {3: [1, 2]}
    assert mesh.names.regions == {1: "left", 2: "right"}
    area = np.linalg.norm(np.cross(*(mesh.points[mesh.triangles[:, k]] - mesh.points[mesh.triangles[:, 0]]
                                     for k in (1, 2))), axis=1) / 2
    assert area[mesh.triangle_markers == 3].sum() == pytest.approx(1)
    assert holdfast.check(pasted.surface, mesh)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda r: pickle.loads(pickle.dumps(r))])
def test_copies_and_pickling(again):
    one = holdfast.paste(box(0, 1, 2), box(1 + 1e-9, 3, 3), box(5, 6, 1), tolerance=1e-6, names=["left", "right", "far"])
    other = again(one)
    assert repr(other) == repr(one) and other.report == one.report and other.parents == one.parents
    for name in ("marker_sets", "moved", "regions", "apart", "max_displacement", "shared_triangles", "origin"):
        assert getattr(other, name) == getattr(one, name), name
    assert one.moved and one.apart and np.array_equal(other.surface.points, one.surface.points)
    meshes = [holdfast.mesh(p, fill=True) for p in (one, other)]
    assert np.array_equal(meshes[0].tetrahedra, meshes[1].tetrahedra) and meshes[0].names == meshes[1].names
    assert again(meshes[0]).pasted.report == one.report and meshes[0].report["parts"] == meshes[1].report["parts"]


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda r: pickle.loads(pickle.dumps(r))])
def test_copies_and_pickling_of_meshes(again):
    one = holdfast.paste(*(holdfast.mesh(*box(*b), fill=True) for b in ((0, 1, 2), (1, 3, 3))))
    other = again(one)
    assert repr(other) == repr(one) and other.report == one.report and other.parents == one.parents
    assert np.array_equal(other.mesh.tetrahedra, one.mesh.tetrahedra) and np.array_equal(other.origin, one.origin)
    assert other.mesh.report == one.mesh.report and other.mesh.names == one.mesh.names
    assert holdfast.check(other.surface, other.mesh)


def test_a_surface_with_seeds_is_meshed_by_them(tmp_path):
    outer, hole = box(0, 3, 3), box(1, 2, 2)
    outer[0][:, 1:] *= 3
    hole[0][:, 1:] += 1
    hollow = np.vstack([outer[0], hole[0]]), np.vstack([outer[1], hole[1][:, ::-1] + len(outer[0])])
    plug = box(1, 2, 3)
    plug[0][:, 1:] += 1
    plug[0][:, 2] = 1 + (plug[0][:, 2] - 1) / 2  # fills half of the hollow
    pasted = holdfast.paste(hollow, plug, names=["body", "plug"])
    seeded = pasted.with_seeds(threads=2)
    assert sorted(id for *_, id, _ in seeded.regions) == [1, 2] and len(seeded.holes) == 1
    assert 1.5 < seeded.holes[0][2] < 2
    assert np.array_equal(seeded.points, pasted.surface.points) and np.array_equal(seeded.triangles, pasted.surface.triangles)
    assert pasted.surface.regions == [] and pasted.surface.holes == []
    assert volumes(holdfast.mesh(seeded, fill=True)) == pytest.approx({1: 26, 2: 0.5})
    for name, (points, triangles) in (("body", hollow), ("plug", plug)):
        write_off(tmp_path / f"{name}.off", points, triangles)
    subprocess.run([program(), "paste", "body.off", "plug.off", "-o", "both.poly", "-q"], cwd=tmp_path, check=True)
    of_program = holdfast.read_surface(tmp_path / "both.poly")
    assert of_program.regions == seeded.regions and of_program.holes == seeded.holes
    with pytest.raises(holdfast.TimeLimit):
        pasted.with_seeds(time_limit=1e-9)
    with pytest.raises(holdfast.Cancelled):
        pasted.with_seeds(progress=lambda stage, fraction: False)
    mesh = holdfast.mesh(*plain_box(), fill=True)
    other = holdfast.mesh(plain_box()[0] + [1, 0, 0], plain_box()[1], fill=True)
    with pytest.raises(ValueError, match="the parts are meshes"):
        holdfast.paste(mesh, other).with_seeds()


def test_parts_may_be_in_a_list():
    a, b = box(0, 1, 2), box(1, 3, 3)
    listed, apart = holdfast.paste([a, b], names=["left", "right"]), holdfast.paste(a, b, names=["left", "right"])
    assert np.array_equal(listed.surface.points, apart.surface.points)
    assert np.array_equal(listed.surface.triangles, apart.surface.triangles)
    assert len(holdfast.paste([holdfast.mesh(*a), holdfast.mesh(*b)]).mesh.tetrahedra) > 0


def test_overlap_and_tolerance():
    a, b = box(0, 1, 2), box(0.98, 2, 3)
    with pytest.raises(holdfast.InvalidSurface, match="left and right overlap by 0.02 at"):
        holdfast.paste(a, b, names=["left", "right"])
    assert volumes(holdfast.mesh(holdfast.paste(a, b, overlap="new"), fill=True)) == pytest.approx(
        {1: 0.98, 2: 1, 3: 0.02})
    pasted = holdfast.paste(a, b, tolerance=0.03)
    assert list(pasted.moved.values()) == pytest.approx([0.02] * len(pasted.moved)) and pasted.moved
    assert volumes(holdfast.mesh(pasted, fill=True)) == pytest.approx({1: 1, 2: 1})


def test_parts_are_pasted_and_meshed_at_once(tmp_path):
    a, b = box(0, 1, 2), box(1, 3, 3)
    mesh = holdfast.mesh([a, b], paste=True, fill=True)
    want = holdfast.mesh(holdfast.paste(a, b), fill=True)
    assert mesh.points.tobytes() == want.points.tobytes() and mesh.tetrahedra.tobytes() == want.tetrahedra.tobytes()
    assert mesh.marker_sets == {3: [1, 2]} and mesh.names.regions == {1: "part 1", 2: "part 2"}
    assert mesh.report["shared_facets"] == mesh.pasted.shared_triangles > 0
    assert [p["region"] for p in mesh.report["parts"]] == [1, 2]
    assert mesh.second_order().report["shared_facets"] == mesh.report["shared_facets"]
    assert holdfast.check(mesh.pasted.surface, mesh)


def test_files_that_are_meshed_at_once_give_the_programs_mesh(tmp_path):
    files = [write_off(tmp_path / "left.off", *box(0, 1, 2)), write_off(tmp_path / "right.off", *box(0.98, 3, 3))]
    for arguments, options in ((["--paste=0.03"], {"paste": 0.03}),
                               (["--paste", "--overlap", "new"], {"paste": True, "overlap": "new"}),
                               (["--paste", "--overlap", "last"], {"paste": np.bool_(True), "overlap": "last"})):
        out, report = tmp_path / "p.vtu", tmp_path / "r.json"
        subprocess.run([program(), "mesh", *files, "-o", out, "--report", report, "--fill", *arguments], check=True)
        want, told = holdfast.read_volume(out), json.loads(report.read_text())
        mesh = holdfast.mesh(files, fill=True, **options)
        assert mesh.points.tobytes() == want.points.tobytes() and mesh.tetrahedra.tobytes() == want.tetrahedra.tobytes()
        assert mesh.regions.tobytes() == want.regions.tobytes() and mesh.names.regions == want.names.regions
        assert np.array_equal(mesh.triangle_markers, want.triangle_markers) and mesh.names.triangles == want.names.triangles
        assert {str(k): v for k, v in mesh.marker_sets.items()} == told["marker_sets"]
        assert mesh.report["shared_facets"] == told["shared_facets"]
        assert [p["region"] for p in mesh.report["parts"]] == [p["region"] for p in told["parts"]]
    with pytest.raises(holdfast.InvalidSurface, match="left and right overlap by 0.02"):
        holdfast.mesh(files, paste=True, fill=True)


def test_several_surfaces_without_paste(tmp_path):
    """Those that have triangles in common are parts, others one surface; with repair they are one in any case."""
    common = holdfast.mesh([plain_box(), plain_box((1, 0, 0), (2, 1, 1))], fill=True)
    assert volumes(common) == pytest.approx({1: 1, 2: 1}) and common.pasted.shared_triangles == 2
    apart = holdfast.mesh([box(0, 1, 1), box(2, 3, 1)], fill=True)
    assert apart.pasted is None and len(apart.points) == 16 and sorted(set(apart.triangle_markers)) == [1, 2]
    crossing = volumes(holdfast.mesh([box(0, 1, 1), box(0.5, 2, 1)], repair=True, fill=True))
    assert sorted(crossing.values()) == pytest.approx([0.5, 0.5, 1])
    with pytest.raises(holdfast.InvalidSurface):
        holdfast.mesh([box(0, 1, 1), box(0.5, 2, 1)], fill=True)
    assert len(holdfast.mesh([box(0, 1, 1)], fill=True).points) == 8
    (p, t), (q, u) = box(0, 1, 2), box(1, 3, 3)
    components = holdfast.mesh(np.vstack([p, q]), np.vstack([t, u + len(p)]), paste=True, fill=True)
    assert volumes(components) == pytest.approx({1: 1, 2: 2})


@pytest.mark.parametrize("surface, options, message", [
    ("ab", {"paste": True, "repair": True}, "with repair all parts are one surface"),
    ("ab", {"overlap": "first", "repair": True}, "with repair all parts are one surface"),
    ("a", {"overlap": "first"}, "does nothing for one surface"),
    ("ab", {"paste": 0.0}, "^paste=0.0"), ("ab", {"paste": -1}, "^paste=-1"), ("ab", {"overlap": "all"}, "^overlap='all'"),
    ("ab", {"segments": [(0, 1)]}, "those of each part"), ("pasted", {"paste": True}, "pasted already"),
    ("pasted", {"overlap": "new"}, "pasted already"), ("none", {"paste": True}, "no surface"), ("none", {}, "no surface"),
    ("a", {"paste": True}, "one part"),
])
def test_what_makes_no_sense_in_mesh(surface, options, message):
    a, b = box(0, 1, 2), box(1, 2, 2)
    what = {"a": a, "ab": [a, b], "none": [], "pasted": None}[surface] if surface != "pasted" else holdfast.paste(a, b)
    with pytest.raises(ValueError, match=message):
        holdfast.mesh(what, **options)
    for wrong in {"paste": "near"}, {"paste": None}, {"overlap": None}:
        with pytest.raises(TypeError, match=f"^{next(iter(wrong))}="):
            holdfast.mesh([a, b], **wrong)


def test_the_time_limit_is_one_for_all():
    with pytest.raises(holdfast.TimeLimit):
        holdfast.mesh([box(0, 1, 2), box(1, 3, 3)], paste=True, time_limit=1e-9)


def test_an_index_of_a_part_that_is_joined_names_no_point_of_another():
    (p, t), b = box(0, 1, 1), box(2, 3, 1)
    for options in {"repair": True}, {}, {"paste": True}:
        with pytest.raises(ValueError, match="triangle 12 of part 1 names (point|vertex) 11, of 8"):
            holdfast.mesh([(p, np.vstack([t, (0, 1, len(p) + 3)])), b], **options)


def test_meshes(tmp_path):
    left = holdfast.mesh(box(0, 1, 2), fill=True)
    right = holdfast.mesh(box(1, 3, 3), regions=[(2, 0.5, 0.5, 2)], fill=True)
    files = [tmp_path / "left.vtu", tmp_path / "right.vtu"]
    left.save(files[0])
    right.save(files[1], names={"regions": {2: "beam"}})
    out, report = tmp_path / "p.vtu", tmp_path / "r.json"
    subprocess.run([program(), "paste", *files, "-o", out, "--report", report], check=True)
    want, told = holdfast.read_volume(out), json.loads(report.read_text())
    for given in (files, [left, right], [files[0], right.to_meshio()]):
        pasted = holdfast.paste(*given, names=["left", "right"])
        mesh = pasted.mesh
        assert mesh.points.tobytes() == want.points.tobytes() and mesh.tetrahedra.tobytes() == want.tetrahedra.tobytes()
        assert mesh.regions.tobytes() == want.regions.tobytes()
        assert mesh.names.regions == (want.names.regions if given is files else {})
        if given is files:
            assert np.array_equal(mesh.triangle_markers, want.triangle_markers) and mesh.names.triangles == want.names.triangles
            assert {str(k): v for k, v in mesh.marker_sets.items()} == told["marker_sets"] and mesh.marker_sets
        assert pasted.report["tetrahedra"] == told["tetrahedra"]
        assert len(pasted.origin) == len(mesh.tetrahedra) and (pasted.origin == -1).any()
        kept = pasted.origin[(0 <= pasted.origin) & (pasted.origin < len(left.tetrahedra))]
        assert np.array_equal(mesh.points[mesh.tetrahedra[np.isin(pasted.origin, kept)]], left.points[left.tetrahedra[kept]])
    assert volumes(mesh) == pytest.approx({1: 1, 2: 2}) and want.names.regions == {2: "beam"}
    right.save(tmp_path / "right.msh")
    (tmp_path / "right.msh.gz").write_bytes(gzip.compress((tmp_path / "right.msh").read_bytes()))
    pasted.mesh.save(tmp_path / "again.vtu")
    packed = holdfast.paste(tmp_path / "left.vtu", tmp_path / "right.msh.gz")
    assert packed.mesh.points.tobytes() == mesh.points.tobytes() == holdfast.read_volume(tmp_path / "again.vtu").points.tobytes()


def test_meshes_that_cannot_be_pasted():
    left, right = holdfast.mesh(box(0, 1, 1), fill=True), holdfast.mesh(box(0.5, 2, 1), fill=True)
    for overlap in "refuse", "first":
        with pytest.raises(holdfast.InvalidSurface, match="overlap by 0.5"):
            holdfast.paste(left, right, overlap=overlap)
    with pytest.raises(TypeError, match="meshes are pasted to meshes"):
        holdfast.paste(left, box(1, 2, 1))
    with pytest.raises(TypeError, match="meshes are pasted to meshes"):
        holdfast.paste(box(1, 2, 1), left)
    with pytest.raises(ValueError, match="two meshes"):
        holdfast.paste(left)
    with pytest.raises(ValueError, match="Pasted.mesh"):
        holdfast.mesh(holdfast.paste(left, holdfast.mesh(box(1, 2, 1), fill=True)))


def test_parts_apart():
    pasted = holdfast.paste(box(0, 1, 2), box(1.5, 2, 2))
    assert pasted.apart == [(0, 1, pytest.approx(0.5))]
    assert any("0.5 apart" in w for w in holdfast.mesh(pasted, fill=True).warnings)


def test_components_of_one_surface():
    (p, t), (q, u) = box(0, 1, 2), box(1, 3, 3)
    pasted = holdfast.paste((np.vstack([p, q]), np.vstack([t, u + len(p)])))
    assert pasted.regions == [1, 2]
    assert volumes(holdfast.mesh(pasted, fill=True)) == pytest.approx({1: 1, 2: 2})


def test_an_index_out_of_range_names_no_vertex_of_another_part():
    (p, t), b = box(0, 1, 1), box(1, 2, 1)
    for parts in ((p, np.vstack([t, (0, 1, len(p) + 3)])), b), (b, (p, np.vstack([t, (0, 1, len(p) + 3)]))):
        with pytest.raises(ValueError, match=r"triangle 12 of part [12] names vertex 11, of 8"):
            holdfast.paste(*parts)
    with pytest.raises(ValueError, match="negative or beyond 32 bits"):
        holdfast.paste((p, t.astype(np.int64) - 1), b)


def test_triangles_that_are_not_finite_are_no_part_of_a_closed_one():
    (p, t), b = box(0, 1, 1), box(1, 2, 1)
    p[0, 0] = np.nan
    pasted = holdfast.paste(b, (p, t), tolerance=0.01)
    assert {dropped["reason"] for dropped in pasted.report["dropped"]} == {"not finite"}


@pytest.mark.parametrize("points", [np.float16, np.float32, ">f8", np.int64, np.uint8])
@pytest.mark.parametrize("indices", [np.int8, np.int16, np.int32, np.int64, np.uint32, np.uint64, ">i4"])
def test_types_of_arrays(points, indices):
    a, (p, t) = box(0, 1, 1), box(1, 2, 1)
    want = holdfast.paste(a, (p, t)).surface
    for order in "CF":
        q, u = p.astype(points, order=order), t.astype(indices, order=order)
        q.flags.writeable = u.flags.writeable = False
        for given in (q, u), (np.repeat(q, 2, 0)[::2], np.repeat(u, 2, 1)[:, ::2]), (q.tolist(), u.tolist()):
            found = holdfast.paste(a, given).surface
            assert found.points.tobytes() == want.points.tobytes()
            assert found.triangles.tobytes() == want.triangles.tobytes()


def test_what_makes_no_sense():
    a, b = box(0, 1, 2), box(1, 2, 2)
    with pytest.raises(ValueError, match="two parts"):
        holdfast.paste()
    with pytest.raises(ValueError, match="one part"):
        holdfast.paste(a)
    with pytest.raises(ValueError, match="two parts"):
        holdfast.paste([])
    with pytest.raises(TypeError, match="a surface is expected"):
        holdfast.paste([a, 3])
    with pytest.raises(ValueError, match="overlap='both'"):
        holdfast.paste(a, b, overlap="both")
    with pytest.raises(ValueError, match="as it is"):
        holdfast.mesh(holdfast.paste(a, b), segments=[(0, 1)])
    with pytest.raises(ValueError, match="as it is"):
        holdfast.mesh(holdfast.paste(a, b), a[1])


@pytest.mark.parametrize("option, value, error", [
    ("overlap", None, TypeError), ("overlap", 3, TypeError), ("overlap", ["first"], TypeError),
    ("tolerance", None, TypeError), ("tolerance", "near", TypeError), ("tolerance", float("nan"), ValueError),
    ("tolerance", -1, ValueError), ("tolerance", 10**400, ValueError),
    ("threads", -1, ValueError), ("threads", 2**40, ValueError), ("threads", 1.5, TypeError), ("threads", "2", TypeError),
    ("names", ["left"], ValueError), ("names", "ab", TypeError), ("names", [1, 2], TypeError), ("names", [None, "b"], TypeError),
    ("time_limit", "3", TypeError), ("time_limit", 0, ValueError), ("cancel", 3, TypeError),
])
def test_options_of_a_wrong_kind(option, value, error):
    with pytest.raises(error, match=f"^{option}="):
        holdfast.paste(box(0, 1, 1), box(1, 2, 1), **{option: value})
