"""Figures 1 to 5: runs of `holdfast plane`, drawn."""
from math import cos, pi, sin

import plane_inputs as inputs
import svg
from plane_inputs import Input, ring, triangulate


def counts(report):
    return {key: report[key] for key in ("missing_segments", "swaps", "partition_points", "ears", "links")}


def figure_1(options, folder, path):
    convex = Input([(cos(2 * pi * i / 9), 0.7 * sin(2 * pi * i / 9)) for i in range(9)], ring(range(9)))
    star = [(0, 0), (4, 0.6), (6, 0), (5.2, 2.4), (6, 4), (3.2, 3), (1, 4), (1.6, 2.2)]
    simple = Input([(float(x), float(y)) for x, y in star], ring(star))
    square = [(0.0, 0.0), (6.0, 0.0), (6.0, 4.0), (0.0, 4.0)]
    hole, other = [(1.0, 1.0), (1.5, 3.0), (2.5, 2.0)], [(3.5, 1.0), (3.2, 2.6), (5.0, 3.0), (4.4, 1.6)]
    holed = Input(square + hole + other, ring(square) + ring(hole, 4) + ring(other, 7), [(1.6, 2.0), (4.0, 2.0)])
    panels = []
    for words, given in (("convex", convex), ("not convex", simple), ("with holes", holed)):
        points, triangles, report = triangulate(options, folder, given, "--method", "ears")
        panel = svg.Panel(f"{words}: {report['ears']} ears, {report['links']} links")
        panel.triangles(points, triangles).lines([[points[v] for v in s] for s in given.segments], svg.INK, False, 2)
        panels.append(panel)
    svg.write(path, panels)
    return {}


def strip(n):
    """Two rows of points and a segment along them (Fig. 2, Fig. 3)."""
    low, high = [(float(i), 0.0) for i in range(n)], [(i + 0.5, 1.6) for i in range(n)]
    points = [(-1.6, 0.8), (n + 1.1, 0.8)] + low + high
    return Input(points, [(0, 1)])


def stages(options, folder, given, method, words):
    panels, told = [], {}
    for stage, title in words:
        extra = ["--stop-after", stage] if stage else []
        points, triangles, report = triangulate(options, folder, given, "--hull", "--method", method, *extra)
        told[stage or "done"] = counts(report)
        panel = svg.Panel(title.format(**counts(report)), 1.3).triangles(points, triangles)
        state = report.get("intermediate", {"missing_segments": [], "added": []})
        sought = state["missing_segments"] if stage else []
        panel.lines([[points[v] for v in s] for s in sought])
        panel.dots([points[p["vertex"]] for p in state["added"]])
        if not stage:
            panel.lines([[points[v] for v in s] for s in given.segments], svg.INK, False, 2.2)
        panels.append(panel)
    return panels, told


def figure_2(options, folder, path):
    panels, told = stages(options, folder, strip(7), "swaps",
                          (("delaunay", "Delaunay: {missing_segments} segment missing"), *((f"swap={k}", "after {swaps} swap" + "s" * (k > 1)) for k in (1, 5, 15)),
                           (None, "after {swaps} swaps it stands")))
    svg.write(path, panels)
    return told["done"]


def figure_3(options, folder, path):
    panels, told = stages(options, folder, strip(7), "partition",
                          (("delaunay", "Delaunay: {missing_segments} segment missing"), ("partition", "partition: {partition_points} points"),
                           (None, "all removed by {swaps} swaps")))
    svg.write(path, panels)
    return told["done"]


def figure_4(options, folder, path):
    panels = []
    for n, m in ((14, 4), (24, 8)):
        given = inputs.quadrilateral(n, m)
        points, triangles, report = triangulate(options, folder, given, "--hull", "--stop-after", "delaunay")
        missing = report["intermediate"]["missing_segments"]
        panel = svg.Panel(f"n = {n}, m = {m}: {len(missing)} segments missing", 0.62 * n).triangles(points, triangles)
        panels.append(panel.lines([[points[v] for v in s] for s in missing]))
    svg.write(path, panels, 240)
    return {}


def figure_5(options, folder, path):
    panels, told = [], []
    whole = inputs.pencil(5, 3)
    whole.points = [(max(-9.0, min(9.0, x)), y) for x, y in whole.points]
    for laid in range(4):
        given = Input(whole.points, whole.segments[:laid] or whole.segments)
        stage = "partition" if laid else "delaunay"
        points, triangles, report = triangulate(options, folder, given, "--hull", "--method", "partition", "--stop-after", stage)
        state = report["intermediate"]
        panel = svg.Panel(f"{report['partition_points']} points on {laid} of 3 segments", 8.0).triangles(points, triangles)
        panel.lines([[points[v] for v in s] for s in whole.segments[laid:]])
        panel.dots([points[p["vertex"]] for p in state["added"]])
        panels.append(panel)
        told.append([len(c["vertices"]) - 2 for c in state["chains"]])
    svg.write(path, panels)
    return {"chains": told[-1]}
