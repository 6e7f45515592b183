"""Parts that touch: `paste`, and `mesh` of what it gives."""

import numpy as np
import pytest

import holdfast


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


def test_overlap_and_tolerance():
    a, b = box(0, 1, 2), box(0.98, 2, 3)
    with pytest.raises(holdfast.InvalidSurface, match="left and right overlap by 0.02 at"):
        holdfast.paste(a, b, names=["left", "right"])
    assert volumes(holdfast.mesh(holdfast.paste(a, b, overlap="new"), fill=True)) == pytest.approx(
        {1: 0.98, 2: 1, 3: 0.02})
    pasted = holdfast.paste(a, b, tolerance=0.03)
    assert list(pasted.moved.values()) == pytest.approx([0.02] * len(pasted.moved)) and pasted.moved
    assert volumes(holdfast.mesh(pasted, fill=True)) == pytest.approx({1: 1, 2: 1})


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
    with pytest.raises(TypeError, match="a surface is expected"):
        holdfast.paste([a, b])
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
