"""§5 and §6 run literally (bench/literal): figures 10 and 12, the paper's models, and random complexes."""
import json

import numpy as np

import models
import raster
import space
import svg
from process import run
from raster import CUT, LARGE, SKIN, View

RANDOM = 200
# Seconds of the clock for untangling, and in all: so many that a machine that does other work, too, changes nothing.
OF_A_CASE, OF_A_COMPLEX = 600, 100
IN_ALL = 3600
CASES = (("Schönhardt's prism", ("make_hard.py", "schonhardt", "{}")), ("Chazelle, n = 2", ("make_hard.py", "chazelle", "{}", "-n", "2")),
         ("Fig. 13, n = m = 3", ("make_paper.py", "worst", "{}", "-n", "3", "-m", "3")),
         ("Fig. 14, after flips", next(m for m in models.MODELS if m.figure == 14).make, "--flips"))
CORNERS = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


def literal(options, *arguments):
    done = run([options.build / "literal", *arguments], IN_ALL)
    line = next((text for text in reversed(done.output.split("\n")) if text.startswith("{")), None)
    return None if line is None else json.loads(line) | {"seconds": done.wall}


def made(folder, script, *arguments):
    path = folder / "literal.off"
    run(["python3", models.ROOT / "examples" / script, *(a.format(path) for a in arguments)])
    return path


def figure_10(options, folder, path):
    """The cavity of the insertion into Fig. 13's box that takes in most tetrahedra besides the two or the shell."""
    told = literal(options, made(folder, "make_paper.py", "worst", "{}", "-n", "4", "-m", "3"), "--time-limit", "1")["picture"]
    kinds = {key: np.array(told[key]).reshape(-1, 4, 3) for key in ("split", "delaunay", "visible", "star")}
    # Before the insertion the point lies in a face or on an edge: the local split has put it there.
    points = np.concatenate([k.reshape(-1, 3) for k in kinds.values()])
    where = np.array(told["point"])
    views = []
    for shown in ((("split", SKIN),), (("split", SKIN), ("delaunay", CUT), ("visible", LARGE)), (("star", SKIN),)):
        view = View(points)
        for name, colour in shown:
            tets = kinds[name]
            if not len(tets):
                continue
            view.flat = raster.frame(points, (0.55, -0.75, 0.5))
            first = sum(len(kinds[k]) for k in list(kinds)[: list(kinds).index(name)])
            faces = (4 * (first + np.arange(len(tets)))[:, None, None] + CORNERS[None]).reshape(-1, 3)
            view.faces(faces, colour)
        at = int(np.argmin(np.abs(points - where).sum(axis=1)))
        views.append(view.dots(view.flat[[at]], through=True))
    raster.write(path, views, 3)
    return {key: len(kinds[key]) for key in kinds}


def area(points, t):
    (ax, ay), (bx, by), (cx, cy) = (points[v] for v in t)
    return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2


def figure_12(_options, _folder, path):
    """The paper's example: edge 43 goes, edge 12 comes, and triangle 123 stands already, whatever the signs."""
    panels, told = [], {}
    for name, third in (("3 above 1, 2", (2.0, 1.4)), ("3 below 4", (2.0, 0.35))):
        points = {1: (0.0, 0.0), 2: (4.0, 0.0), 3: third, 4: (2.0, 0.7), 5: (2.0, -1.6)}
        before = [(1, 4, 3), (4, 2, 3), (1, 3, 2)]
        new = [(1, 4, 2), (1, 2, 3)]
        stands = {frozenset(t) for t in before}
        repeated = [t for t in new if frozenset(t) in stands]
        told[name] = {"negative before": sum(area(points, t) < 0 for t in before), "repeated by the swap": len(repeated)}
        panel = svg.Panel(f"{name}: {len(repeated)} triangle would stand twice", 1.0)
        panel.triangles(points, [(1, 3, 2)], "#f3e3dc").triangles(points, before[:2], "none")
        panel.lines([(points[3], points[4])], svg.MISSING, True, 2)
        panel.dots([(4.25, 0.0)], "white", 0.1)  # room for a number
        for number in (1, 2, 3, 4):
            panel.text(points[number], str(number))
        panels.append(panel)
    svg.write(path, panels, 180)
    return told


def cases(options, folder, rows):
    return {name: rows.get(f"{name} by {' '.join(make)}",
                           lambda make=make, extra=extra: literal(options, made(folder, *make), "--time-limit", OF_A_CASE, *extra))
            for name, make, *extra in CASES}


def torture(options, rows):
    return rows.get(f"{RANDOM} random complexes", literal, options, "--random", RANDOM, "--most-points", 500, "--time-limit", OF_A_COMPLEX)


def lines(options, folder, rows):
    text = ["| surface | missing: segments, facets | points: on segments, in facets | taken off segments of 0, 1, 2, 3 ... facets | copies | "
            "null or negative then | in the end | seconds of the clock |", "|---|---:|---:|---:|---:|---:|---|---:|"]
    for name, row in cases(options, folder, rows).items():
        if row is None:
            text.append(f"| {name} | over the time limit |" + " |" * 6)
            continue
        end = (f"{row['tetrahedra']:,} tetrahedra, {row['vertices']:,} vertices" if row["ended"] == "done"
               else f"{row['ended']}: {row['message']}")
        text.append(f"| {name} | {row['missing_segments']}, {row['missing_facets']} | {row['segment_points']:,}, {row['facet_points']:,} | "
                    f"{', '.join(map(str, row['eliminated']['on_segments'])) or 'none'} | {row['eliminated']['copies']:,} | "
                    f"{row['after']['null']:,} and {row['after']['negative']:,} | {end} | {row['seconds']:.1f} |")
    told = torture(options, rows)
    if told is None:
        return text + ["", "The random complexes went beyond the time limit."]
    ended = ", ".join(f"{key} {count:,}" for key, count in sorted(told["ended"].items()))
    text += ["", f"`literal --random {RANDOM}`, the complexes of `make random`: {told['complexes']:,} valid ones, points in {told['with_points']:,} of them; "
             f"{told['in_facets']:,} points taken off facets, off segments of 0, 1, 2, 3 ... facets "
             f"{', '.join(f'{n:,}' for n in told['on_segments'])}; {told['copies']:,} copies, {told['emulated']:,} emulated polygons (§6.3.2); "
             f"{told['null']:,} null and {told['negative']:,} negative tetrahedra; {told['visible']:,} tetrahedra added to cavities since they are seen. "
             f"How they ended: {ended}. Given up is a partition of more than 500 points, and untangling ends after {OF_A_COMPLEX} s of the clock. What failed:", ""]
    for case in told["failed"][:8]:
        text.append(f"* number {case['number']}: {case['ended']}: {case['message']}")
    return text
