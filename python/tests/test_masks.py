"""Masked arrays: an entry without a value is an error wherever an array is taken."""

import numpy as np
import numpy.ma as ma
import pytest

import holdfast
from conftest import box

POINTS, TRIANGLES = box()
TETRAHEDRON = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]), np.array([(0, 1, 2, 3)])


def masked(values, *at):
    found = ma.array(values, copy=True)
    found[at] = ma.masked
    return found


def mesh(points=POINTS, triangles=TRIANGLES, **options):
    return holdfast.mesh(points, triangles, **options)


@pytest.mark.parametrize("call, place", [
    (lambda: mesh(masked(POINTS, 3, 1)), r"points\[3, 1\]"),
    (lambda: mesh(POINTS, masked(TRIANGLES, 2, 0)), r"triangles\[2, 0\]"),
    (lambda: mesh(triangle_markers=masked(np.ones(12, int), 5)), r"triangle_markers\[5\]"),
    (lambda: mesh(segments=masked(np.array([(0, 1)]), 0, 1)), r"segments\[0, 1\]"),
    (lambda: mesh(segments=[(0, 1)], segment_markers=masked(np.array([1]), 0)), r"segment_markers\[0\]"),
    (lambda: mesh(size=masked(np.ones(8), 7)), r"size\[7\]"),
    (lambda: mesh(size=(*TETRAHEDRON, masked(np.ones(4), 2))), r"sizes\[2\]"),
    (lambda: mesh(size=(masked(TETRAHEDRON[0], 0, 0), TETRAHEDRON[1], np.ones(4))), r"points\[0, 0\]"),
    (lambda: mesh(size=lambda p: masked(np.ones(len(p)), 0)), "size gave an array with a masked entry"),
    (lambda: mesh(metric=lambda p: masked(np.ones((len(p), 6)), 0, 0)), r"metric\[0, 0\]"),
    (lambda: mesh(holes=masked(np.array([(0.5, 0.5, 0.5)]), 0, 2)), r"a hole\[2\]"),
    (lambda: mesh(regions=masked(np.array([(0.5, 0.5, 0.5, 1)]), 0, 2)), r"a region\[2\]"),
    (lambda: holdfast.mesh([(masked(POINTS, 3, 1), TRIANGLES), (POINTS + 3, TRIANGLES)]), r"points\[3, 1\]"),
    (lambda: mesh(list(masked(POINTS, 3, 1))), r"points\[3, 1\]"),
    (lambda: holdfast.repair(masked(POINTS, 0, 0), TRIANGLES), r"points\[0, 0\]"),
    (lambda: holdfast.diagnose((masked(POINTS, 0, 0), TRIANGLES)), r"points\[0, 0\]"),
    (lambda: holdfast.paste((masked(POINTS, 0, 0), TRIANGLES), (POINTS + 3, TRIANGLES)), r"points\[0, 0\]"),
    (lambda: holdfast.delaunay(masked(POINTS, 0, 0)), r"points\[0, 0\]"),
    (lambda: holdfast.Surface(POINTS, TRIANGLES, point_markers=masked(np.ones(8, int), 1)), r"point_markers\[1\]"),
    (lambda: holdfast.TetMesh(TETRAHEDRON[0], masked(TETRAHEDRON[1], 0, 3)), r"tetrahedra\[0, 3\]"),
    (lambda: holdfast.TetMesh(*TETRAHEDRON, regions=masked(np.array([1]), 0)), r"regions\[0\]"),
    (lambda: holdfast.check((POINTS, TRIANGLES), (masked(TETRAHEDRON[0], 0, 0), TETRAHEDRON[1])), r"points\[0, 0\]"),
    (lambda: holdfast.untangle(TETRAHEDRON, fixed=masked(np.array([0, 1]), 1)), r"fixed\[1\]"),
    (lambda: holdfast.plane(masked(POINTS[:4, 1:], 1, 1), [(0, 1)]), r"points\[1, 1\]"),
    (lambda: holdfast.plane(POINTS[:4, 1:], masked(np.array([(0, 1)]), 0, 0)), r"segments\[0, 0\]"),
    (lambda: holdfast.plane(POINTS[:4, 1:], holes=masked(np.array([(0.5, 0.5)]), 0, 0)), r"hole\[0\]"),
])
def test_an_entry_without_a_value_is_an_error(call, place):
    with pytest.raises(ValueError, match=place):
        call()


def test_arrays_without_a_masked_entry_are_arrays():
    want = mesh(fill=True)
    found = mesh(ma.array(POINTS), ma.array(TRIANGLES), fill=True, triangle_markers=ma.array(np.arange(12)))
    assert found.points.tobytes() == want.points.tobytes() and sorted(found.triangle_markers) == list(range(12))
    assert len(mesh(size=lambda p: ma.array(np.full(len(p), 0.4))).points) > len(want.points)
    assert len(mesh(ma.array(POINTS, mask=np.zeros((8, 3), bool)), TRIANGLES, holes=ma.array(np.empty((0, 3)))).points) >= 8
