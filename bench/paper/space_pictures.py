"""Figures 6 to 9, 11 and 13 to 19: runs of `holdfast mesh`, drawn."""
import numpy as np

import models
import raster
import space
from raster import CUT, LARGE, SKIN, View


def spread(points, tets, by):
    """Tetrahedra moved apart: points and faces of their own."""
    middle = points.mean(axis=0)
    moved = points[tets] + by * (points[tets].mean(axis=1, keepdims=True) - middle)
    corners = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
    faces = (4 * np.arange(len(tets))[:, None, None] + corners[None]).reshape(-1, 3)
    return moved.reshape(-1, 3), faces


def prism(turned, cyclic):
    """Two triangles, one above the other; the diagonals of the sides run all the same way, or not."""
    from math import cos, pi, sin
    low = [(cos(2 * pi * k / 3), sin(2 * pi * k / 3), 0.0) for k in range(3)]
    high = [(cos(2 * pi * k / 3 + turned), sin(2 * pi * k / 3 + turned), 1.2) for k in range(3)]
    triangles = [(0, 2, 1), (3, 4, 5)]
    for k in range(3):
        j = (k + 1) % 3
        if cyclic or k != 2:
            triangles += [(k, j, 3 + j), (k, 3 + j, 3 + k)]
        else:
            triangles += [(k, j, 3 + k), (j, 3 + j, 3 + k)]
    return low + high, triangles


def figure_6(options, folder, path):
    views, told = [], {}
    for name, turned, cyclic in (("straight, diagonals not all one way", 0.0, False), ("straight, diagonals all one way", 0.0, True),
                                 ("turned by 30 degrees (Schönhardt)", np.pi / 6, True)):
        points, triangles = prism(turned, cyclic)
        got, facets, tets, _, report = space.mesh(options, space.write_off(folder / "prism.off", points, triangles), "--fill")
        views.append(View(got).faces(facets, SKIN))
        moved, faces = spread(got, tets, 0.9)
        views.append(View(moved).faces(faces, CUT))
        told[name] = {"tetrahedra": len(tets), "points": report["steiner"]["count"]}
    raster.write(path, views)
    return told


def figure_7(options, folder, path):
    surface = space.made(folder, "make_hard.py", "chazelle", "-n", "2")
    points, triangles = space.read_off(surface)
    flat = points * (1, 1, 3 / np.ptp(points[:, 2]) * np.ptp(points[:, 0]) / 2)
    got, _, tets, _, report = space.mesh(options, surface, "--fill")
    stretched = got * (flat.max(axis=0) / np.where(points.max(axis=0) == 0, 1, points.max(axis=0)))
    old, new = raster.cut(stretched, tets, 1, np.median(stretched[:, 1]))
    raster.write(path, [View(flat).faces(triangles, SKIN), View(flat, (0.55, -0.75, -0.5)).faces(triangles, SKIN),
                        View(stretched, (0.3, 0.9, 0.35)).faces(old, SKIN, True).faces(new, CUT, True)])
    return {"triangles": len(triangles), "tetrahedra": len(tets), "points": report["steiner"]["count"]}


def pages(k):
    """k triangles round one edge, which threads of small triangles cross: a segment of degree k that is missing."""
    from math import cos, pi, sin
    points, triangles = [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)], []
    for i in range(k):
        angle = 2 * pi * i / k + 0.2
        triangles.append((0, 1, len(points)))
        points.append((1.2 * cos(angle), 1.2 * sin(angle), 0.1))
    for level in (-0.45, 0.0, 0.45):  # points close to the edge, so that Delaunay joins them through it
        for i in range(2 * k):  # two in each gap
            angle = 2 * pi * (i // 2 + (1 + i % 2) / 3) / k + 0.2
            triangles.append((len(points), len(points) + 1, len(points) + 2))
            c, s = 0.12 * cos(angle), 0.12 * sin(angle)
            points += [(c, s, level), (1.4 * c, 1.4 * s, level + 0.02), (1.4 * c, 1.4 * s, level - 0.02)]
    return points, triangles


def partitioned(options, folder, k):
    """The state after partition of that surface, and its end, around the one edge."""
    surface = space.write_off(folder / f"pages{k}.off", *pages(k))
    extra = ("--fill", "--keep", "box", "--without", "flips")
    points, _, tets, _, report = space.mesh(options, surface, *extra[:1], *extra[3:], "--stop-after", "partition")
    done = space.mesh(options, surface, *extra)
    return points, report["intermediate"], done


def sheet(points, state, facets):
    faces = [face for pieces in state["sub_facets"] if pieces["facet"] in facets for face in pieces["faces"]]
    return np.array(faces, int).reshape(-1, 3)


def views_of_edge(options, folder, k):
    points, state, done = partitioned(options, folder, k)
    facets = set(range(k))
    added = [p["vertex"] for p in state["added"] if p.get("segment") == [0, 1] or p.get("facet") in facets]
    eye = (0.6, -0.7, 0.25)
    corners = np.array([0, 1, *range(2, 2 + k)])

    def view(of, triangles, dots):
        used = np.unique(np.concatenate([triangles.ravel(), corners]))
        number = np.full(len(of), -1)
        number[used] = np.arange(len(used))
        shown = View(of[used], eye).faces(number[triangles], SKIN)
        return shown.dots(shown.flat[number[dots]] if len(dots) else [], through=True)

    before = sheet(points, state, facets)
    if not len(before):
        raise RuntimeError(f"the edge of {k} facets is not missing")
    after = np.array([(0, 1, 2 + i) for i in range(k)])
    told = {"on the edge": len([p for p in state["added"] if p.get("segment") == [0, 1]]), "sub-facets": len(before),
            "points in the end": done[-1]["steiner"]["count"]}
    return [view(points, before, np.array(added, int)), view(done[0], after, np.array([], int))], told


def figure_8(options, folder, path):
    views, told = views_of_edge(options, folder, 2)
    raster.write(path, views)
    return told


def figure_11(options, folder, path):
    views, told = [], {}
    for k in (2, 3):
        more, counts = views_of_edge(options, folder, k)
        views += more
        told[k] = counts
    raster.write(path, views)
    return told


def figure_9(options, folder, path):
    """The facet that most edges pierce: before, its plane with the mesh's section; after partition, its sub-facets."""
    surface = space.made(folder, "make_paper.py", "worst", "-n", "6", "-m", "1", "--height", "0.35")
    _, triangles = space.read_off(surface)
    points, _, _, _, report = space.mesh(options, surface, "--without", "flips", "--stop-after", "partition")
    state = report["intermediate"]
    pierced = [p.get("facet") for p in state["added"]]
    pieces = max(state["sub_facets"], key=lambda p: pierced.count(p["facet"]))
    faces = np.array(pieces["faces"])
    a, b, c = points[triangles[pieces["facet"]]]
    u = (b - a) / np.linalg.norm(b - a)
    n = np.cross(u, c - a)
    n /= np.linalg.norm(n)
    v = np.cross(n, u)
    from svg import Panel, write
    used = np.unique(faces)
    flat = {int(i): (float((points[i] - a) @ u), float((points[i] - a) @ v)) for i in used}
    width, height = (max(p[k] for p in flat.values()) - min(p[k] for p in flat.values()) for k in (0, 1))
    inner = [p["vertex"] for p in state["added"] if p.get("facet") == pieces["facet"]]
    sides = [p["vertex"] for p in state["added"] if "segment" in p and p["vertex"] in flat]
    corners = [flat[int(i)] for i in triangles[pieces["facet"]]]
    missing = Panel("missing: edges pierce it at these points", width / height)
    missing.lines([(corners[k], corners[k - 1]) for k in range(3)]).dots([flat[i] for i in inner]).dots([flat[i] for i in sides], "#2c6fad")
    parted = Panel(f"partition: {len(faces)} sub-facets", width / height)
    parted.triangles(flat, [tuple(map(int, f)) for f in faces]).dots([flat[i] for i in inner]).dots([flat[i] for i in sides], "#2c6fad")
    whole = Panel("in the end: one face", width / height).triangles(corners, [(0, 1, 2)])
    write(path, [missing, parted, whole], 260)
    return {"inside": len(inner), "on its sides": len(sides), "sub-facets": len(faces)}


def figure_13(options, folder, path):
    surface = space.made(folder, "make_paper.py", "worst", "-n", "10", "-m", "4", "--height", "0.35")
    points, triangles = space.read_off(surface)
    inside = np.abs(points[triangles][:, :, 2].mean(axis=1) - points[:, 2].mean()) < 0.45 * np.ptp(points[:, 2])
    flat = (np.ptp(points[triangles][:, :, 2], axis=1) == 0)
    low = points[triangles][:, :, 2].max(axis=1) == points[:, 2].min()
    _, _, tets, _, report = space.mesh(options, surface, "--fill")
    raster.write(path, [View(points).faces(triangles, SKIN),
                        View(points).faces(triangles[low], SKIN).faces(triangles[inside & flat], LARGE)])
    return {"triangles": len(triangles), "tetrahedra": len(tets), "points": report["steiner"]["count"]}


def model_views(options, folder, model, axis, eye=(0.55, -0.75, 0.5), large=False):
    """The surface, its large triangles or its edges, and two cuts through the tetrahedra of the default options."""
    surface = folder / "model.off"
    models.make(model, str(surface))
    points, triangles = space.read_off(surface)
    got, _, tets, regions, report = space.mesh(options, surface)
    level = points[:, axis].min() + 0.5 * np.ptp(points[:, axis])
    views = [View(points, eye).faces(triangles, SKIN)]
    if large:
        areas = np.linalg.norm(np.cross(points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]), axis=1)
        big = np.argsort(areas)[-2:]
        below = points[triangles][:, :, 2].max(axis=1) <= points[:, 2].min()
        views.append(View(points, eye).faces(triangles[below], SKIN).faces(triangles[big], LARGE))
    else:
        views.append(View(points, eye).faces(triangles, (255, 255, 255)))
    for k in (1, 0) if large else (axis, 0):
        middle = points[:, k].min() + (0.5 if not large or k == 0 else 0.4) * np.ptp(points[:, k])
        old, new = raster.cut(got, tets, k, middle)
        way = np.array(eye)
        way[k] = 1.3 * abs(way[k])
        views.append(View(got, way).faces(old, SKIN, True).faces(new, CUT, True))
    raster.write(path_of(folder, model), views)
    return {"level": float(level), "tetrahedra": len(tets), "regions": int(len(np.unique(regions))), "points": report["steiner"]["forced"]}


def path_of(folder, model):
    return folder / f"figure-{model.figure}.png"


def figure_of_model(model):
    def figure(options, folder, path):
        told = model_views(options, folder, model, 2, large=model.figure in (14, 15))
        path.write_bytes(path_of(folder, model).read_bytes())
        return told

    return figure
