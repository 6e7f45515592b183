"""Shapes of tetrahedra, and the regions beside triangles."""

from __future__ import annotations

import typing
from typing import Any

import numpy as np
import numpy.ma as ma

from ._surface import Array


class Quality(typing.NamedTuple):
    """Shape of each tetrahedron, arrays of length m."""

    volume: Array
    """In the cube of the surface's unit, positive."""
    min_dihedral: Array
    """Least angle between two faces, degrees; 70.5 is regular."""
    max_dihedral: Array
    """Largest angle between two faces, degrees."""
    q: Array
    """The paper's Q = sqrt(6)/12 h_max / inradius; 1 is regular, larger is worse."""


def frozen(ids: Array, none: Array) -> "ma.MaskedArray[Any, Any]":
    ids.setflags(write=False)
    masked: "ma.MaskedArray[Any, Any]" = ma.MaskedArray(ids, none)  # type: ignore[no-untyped-call]
    return masked


def regions_beside(tetrahedra: Array, regions: Array, triangles: Array) -> "ma.MaskedArray[Any, Any]":
    """In front of and behind each triangle, by the tetrahedra that have it as a face."""
    faces = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])  # opposite each corner, seen from outside
    corners = tetrahedra[:, faces].reshape(-1, 3).astype(np.int64)
    owners = np.repeat(regions if len(regions) else np.zeros(len(tetrahedra), np.int32), 4)

    def keys(rows: Array) -> tuple[Array, Array]:
        """Sorted corners as bytes, and whether the permutation is even."""
        order = np.argsort(rows, axis=1)
        even = (order[:, 1] - order[:, 0]) % 3 == 1
        found = np.ascontiguousarray(np.take_along_axis(rows, order, axis=1))
        return found.view([("", found.dtype)] * 3).ravel(), even

    key, even = keys(corners)
    sides: dict[Any, list[tuple[bool, int]]] = {}
    wanted, turned = keys(triangles.astype(np.int64))
    is_wanted = np.isin(key, wanted)
    for k, e, r in zip(key[is_wanted].tolist(), even[is_wanted].tolist(), owners[is_wanted].tolist()):
        sides.setdefault(k, []).append((e, r))
    ids = np.zeros((len(triangles), 2), np.int32)
    none = np.ones((len(triangles), 2), bool)
    for i, (k, e) in enumerate(zip(wanted.tolist(), turned.tolist())):
        for side, region in sides.get(k, []):
            behind = side == e  # oriented as the face seen from outside the tetrahedron, which is then behind
            ids[i, int(behind)], none[i, int(behind)] = region, False
    return frozen(ids, none)


def quality_of(points: Array, tetrahedra: Array) -> Quality:
    p = np.asarray(points)[tetrahedra]
    edges = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
    longest = np.sqrt(np.max([((p[:, a] - p[:, b]) ** 2).sum(axis=1) for a, b in edges], axis=0)) if len(p) else np.empty(0)
    faces = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
    normals = np.stack([np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a]) for a, b, c in faces], axis=1)
    lengths = np.linalg.norm(normals, axis=2)
    volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
    with np.errstate(divide="ignore", invalid="ignore"):
        unit = normals / lengths[..., None]
        cosines = np.stack([-(unit[:, a] * unit[:, b]).sum(axis=1) for a, b in edges], axis=1)
        angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
        inradius = 3 * volume / (lengths.sum(axis=1) / 2)
        q = np.sqrt(6) / 12 * longest / inradius
    if not len(p):
        return Quality(volume, np.empty(0), np.empty(0), q)
    return Quality(volume, angles.min(axis=1), angles.max(axis=1), q)
