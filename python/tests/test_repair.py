"""Surfaces that are not valid: `repair`, and `mesh(..., repair=True)`."""

import copy
import pickle
import random

import numpy as np
import pytest

import holdfast

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
FACES = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                  (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])


def two_cubes(by=(0.3, 0.41, 0.37)):
    return np.vstack([CUBE, CUBE @ np.array([(0.9, 0.2, 0), (-0.1, 0.95, 0.1), (0, 0.1, 1)]) + by]), np.vstack([FACES, FACES + 8])


def test_cubes_that_cross():
    points, triangles = two_cubes()
    repaired = holdfast.repair(points, triangles)
    assert np.array_equal(repaired.surface.points[:16], points) and repaired.moved == {} and repaired.dropped == {}
    assert 0 < repaired.max_displacement < 1e-15
    assert holdfast.diagnose(repaired.surface).valid and repaired.check()["holds"]
    first, all_ = repaired.parents
    assert set(all_) == set(range(24)) and len(first) == len(repaired.surface.triangles) + 1
    assert "Repair(" in repr(repaired)


def test_valid_surfaces_come_out_as_they_were():
    repaired = holdfast.repair(CUBE, FACES)
    assert np.array_equal(repaired.surface.points, CUBE) and np.array_equal(repaired.surface.triangles, FACES)
    assert repaired.max_displacement == 0


def test_options():
    near = np.vstack([CUBE, CUBE + (1, 0, 0) + np.array([1e-9, 0, 0])])
    welded = holdfast.repair(near, np.vstack([FACES, FACES + 8]), weld=1e-8)
    assert sorted(welded.moved) == [8, 10, 12, 14] and max(welded.moved.values()) == pytest.approx(1e-9, rel=1e-3)
    filled = holdfast.repair(CUBE, FACES[1:], fill_holes=True)
    assert len(filled.report["filled"]) == 1
    assert holdfast.mesh(filled.surface, fill=True).quality().volume.sum() == pytest.approx(1)
    united = holdfast.repair(*two_cubes(), union=True)
    assert set(united.dropped.values()) <= {"inner"} and len(united.surface.triangles) < len(holdfast.repair(*two_cubes()).surface.triangles)


def test_repair_and_mesh_at_once():
    points, triangles = two_cubes()
    mesh = holdfast.mesh(points, triangles, repair=True, fill=True)
    assert mesh.repair.moved == {} and holdfast.check(mesh.repair.surface, mesh)
    assert np.array_equal(mesh.points[:16], points)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda r: pickle.loads(pickle.dumps(r))])
def test_copies_and_pickling(again):
    points, triangles = two_cubes()
    near = np.vstack([points, CUBE + (3, 0, 0), CUBE + (4 + 1e-9, 0, 0)])
    surface = holdfast.Surface(near, np.vstack([triangles, FACES + 16, FACES[1:] + 24, [(0, 0, 1)]]), segments=[(0, 7)],
                               triangle_markers=np.arange(48) % 5, regions=[(0.1, 0.1, 0.1, 7, 0.5)], holes=[(3.5, 0.5, 0.5)],
                               names={"triangles": {3: "Wäscheleine"}})
    one = holdfast.repair(surface, weld=1e-8, fill_holes=True)
    other = again(one)
    assert repr(other) == repr(one) and other.report == one.report and other.moved == one.moved and len(one.moved) == 4
    assert other.dropped == one.dropped and len(one.dropped) == 1 and other.marker_sets == one.marker_sets
    for mine, its in zip(one.parents, other.parents):
        assert np.array_equal(mine, its)
    for name in ("points", "triangles", "segments", "triangle_markers"):
        assert np.array_equal(getattr(other.surface, name), getattr(one.surface, name)), name
    assert (other.surface.names, other.surface.regions, other.surface.holes) == (one.surface.names, one.surface.regions, one.surface.holes)
    assert other.check() == one.check() and one.check()["holds"]
    mesh = holdfast.mesh(*two_cubes(), repair=True, fill=True)
    assert again(mesh).repair.check()["holds"] and again(mesh).repair.report == mesh.repair.report


def test_what_another_version_has_pickled_is_told():
    result = holdfast.repair(CUBE, FACES)._result
    with pytest.raises(ValueError, match="another version"):
        type(result).__new__(type(result)).__setstate__(result.__getstate__()[:-1])


def test_holes_are_filled_and_parts_united_before_the_mesh():
    filled = holdfast.mesh(CUBE, FACES[1:], repair=True, fill_holes=True, fill=True)
    assert filled.quality().volume.sum() == pytest.approx(1) and len(filled.repair.report["filled"]) == 1
    assert filled.repair.check()["holds"] and filled.repair.report["options"]["fill_holes"] > 3
    cut, united = (holdfast.mesh(*two_cubes(), repair=True, fill=True, union=u) for u in (False, True))
    assert len(set(cut.regions)) == 3 and set(united.regions) == {1}
    assert united.quality().volume.sum() == pytest.approx(cut.quality().volume.sum())
    blade = np.array([(0.2, 0.2, 0.5), (2, 0.2, 0.5), (2, 2, 0.5)])
    assert holdfast.mesh(np.vstack([CUBE, blade]), np.vstack([FACES, [[8, 9, 10]]]), repair=True, union=True, fill=True).quality().volume.sum() == pytest.approx(1)
    with pytest.raises(holdfast.InvalidSurface):
        holdfast.mesh(CUBE, FACES[3:], repair=True, fill_holes=3, fill=True)
    for options in {"fill_holes": True}, {"fill_holes": 4}, {"union": True}:
        with pytest.raises(ValueError, match="do nothing without repair"):
            holdfast.mesh(CUBE, FACES, fill=True, **options)
    with pytest.raises(ValueError, match="three sides"):
        holdfast.mesh(CUBE, FACES, fill=True, repair=True, fill_holes=2)


def stacked_boxes():
    """Half in each other: sums of 0.05 make sheets that differ in their last bits, and no mesh in doubles."""
    rng, points, low = random.Random(1), [], 0.0
    for _ in range(8):
        x, y = rng.uniform(0, 0.5), rng.uniform(0, 0.5)
        points += [(x + a, y + b, low + 0.1 if c else low) for a, b, c in CUBE]
        low += 0.05
    return points, np.vstack([FACES + 8 * i for i in range(8)])


def test_sheets_a_last_bit_apart_are_joined():
    mesh = holdfast.mesh(*stacked_boxes(), repair=True, fill=True)
    assert holdfast.check(mesh.repair.surface, mesh) and mesh.repair.check()["holds"]
    assert mesh.repair.report["options"]["join"] > 0 and mesh.repair.moved == {} and mesh.repair.max_displacement < 1e-14


def test_a_cancel_while_sheets_are_joined_is_told():
    stages = []

    def cancel_the_second_repair(stage, _):
        stages.append(stage)
        return stage != "repair" or set(stages) == {"repair"}

    with pytest.raises(holdfast.Cancelled):
        holdfast.mesh(*stacked_boxes(), repair=True, fill=True, progress=cancel_the_second_repair)


def test_what_is_refused():
    with pytest.raises(ValueError, match="three sides"):
        holdfast.repair(CUBE, FACES, fill_holes=2)
    with pytest.raises(ValueError, match="negative"):
        holdfast.repair(CUBE, FACES, weld=-1)
    with pytest.raises(holdfast.TimeLimit):
        holdfast.repair(*two_cubes(), time_limit=1e-9)


@pytest.mark.parametrize("option, value, error", [
    ("weld", None, TypeError), ("weld", "near", TypeError), ("weld", -1, ValueError), ("join", float("inf"), ValueError),
    ("fill_holes", 1.5, TypeError), ("fill_holes", 1e300, TypeError), ("fill_holes", None, TypeError), ("fill_holes", -3, ValueError),
    ("threads", -1, ValueError), ("threads", 2.0, TypeError), ("cancel", "now", TypeError),
])
def test_options_of_a_wrong_kind(option, value, error):
    with pytest.raises(error, match=f"^{option}="):
        holdfast.repair(CUBE, FACES, **{option: value})


def test_values_of_numpy():
    filled = holdfast.repair(CUBE, FACES[1:], fill_holes=np.bool_(True))
    assert len(filled.surface.triangles) > len(FACES) - 1
    assert len(holdfast.repair(CUBE, FACES[1:], fill_holes=2**70).surface.triangles) == len(filled.surface.triangles)
    # True is no distance of 1 within which points are joined
    mesh = holdfast.mesh(CUBE, FACES, fill=True, repair=np.bool_(True))
    assert len(mesh.repair.surface.points) == len(CUBE) and mesh.repair.moved == {}
    assert holdfast.mesh(CUBE, FACES, fill=True, repair=np.bool_(False)).repair is None


def test_keep_and_quality_of_a_wrong_kind():
    for option in {"keep": None}, {"quality": 3}, {"order": ["random"]}:
        with pytest.raises(TypeError, match="is of a wrong type"):
            holdfast.mesh(CUBE, FACES, **option)
