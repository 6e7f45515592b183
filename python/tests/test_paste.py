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


def test_what_makes_no_sense():
    with pytest.raises(ValueError, match="two parts"):
        holdfast.paste(box(0, 1, 2))
    with pytest.raises(ValueError, match="overlap='both'"):
        holdfast.paste(box(0, 1, 2), box(1, 2, 2), overlap="both")
    with pytest.raises(ValueError, match="as it is"):
        holdfast.mesh(holdfast.paste(box(0, 1, 2), box(1, 2, 2)), segments=[(0, 1)])
