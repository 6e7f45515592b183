"""Surfaces that the tests share."""

from __future__ import annotations

import numpy as np
import pytest

QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def box(low=(0, 0, 0), high=(1, 1, 1)):
    """A box as (8, 3) points and (12, 3) triangles that look outwards."""
    points = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    points = np.array(low) + points * (np.array(high) - np.array(low))
    triangles = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))], np.int32)
    return points, triangles


def sphere(n=24, radius=1.0, centre=(0, 0, 0)):
    """A sphere of about 2 n^2 triangles."""
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, n):
        t = np.pi * i / n
        points += [(np.sin(t) * np.cos(f), np.sin(t) * np.sin(f), np.cos(t)) for f in 2 * np.pi * np.arange(n) / n]
    points.append((0.0, 0.0, -1.0))
    ring = lambda i, j: 1 + (i - 1) * n + j % n
    triangles = []
    for j in range(n):
        triangles.append((0, ring(1, j), ring(1, j + 1)))
        triangles.append((len(points) - 1, ring(n - 1, j + 1), ring(n - 1, j)))
        for i in range(1, n - 1):
            triangles.append((ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)))
            triangles.append((ring(i, j), ring(i + 1, j + 1), ring(i, j + 1)))
    return radius * np.array(points) + np.array(centre), np.array(triangles, np.int32)


def two_boxes():
    """A box in a box: two regions, markers 1 outside and 2 inside."""
    outer, triangles = box((0, 0, 0), (4, 4, 4))
    inner, _ = box((1, 1, 1), (2, 2, 2))
    points = np.concatenate([outer, inner])
    return points, np.concatenate([triangles, triangles + 8]), np.repeat([1, 2], 12)


def write_off(path, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [" ".join(repr(float(x)) for x in p) for p in points]
    lines += ["3 " + " ".join(str(int(i)) for i in t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture
def cube():
    return box()


@pytest.fixture
def nested():
    return two_boxes()
