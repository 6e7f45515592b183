"""The plane: constrained Delaunay compared with CGAL's Constrained_Delaunay_triangulation_2, and ears compared with
npm's earcut, cdt2d and poly2tri: speed, and inputs on which they fail.

A package fails on a polygon if it throws, if its triangles do not cover exactly the polygon, if one is flat or inverted,
or if some corner is in none. Areas are compared as fractions, so rounding is not a failure.
"""
import json
import random
import re
import subprocess
from fractions import Fraction
from statistics import median

from plane_inputs import comb, plate, scaled, spiral, star, straight, touching, write_poly, write_random
from process import apart, run, take_turns

OURS, CGAL = "holdfast", "CGAL"
PACKAGES = ("earcut", "cdt2d", "poly2tri")
POINTS, SEGMENTS = 1_000_000, 100_000
HARD = {"holes that touch": touching, "straight sides of many corners": straight, "1e-300 to 1e300": scaled}
EACH = 100  # hard polygons of a kind
SLOW = 30_000  # corners beyond which only earcut takes part
WARM, LONG = 40, 3  # turns of ours and of earcut, the median of which is of code that is compiled; of polygons beyond SLOW


def holdfast(options, folder, path, *more):
    report, mesh = folder / "plane.json", folder / "plane.off"
    done = run([options.build / "holdfast", "plane", path, "-o", mesh, "-q", "--report", report, *more])
    if done.code != 0:
        return None
    told = json.loads(report.read_text(encoding="utf-8"))
    return {"seconds": told["seconds"]["total"], "triangles": told["mesh"]["triangles"]}


def cgal(options, path):
    told = run([options.build / "cgal_plane", path]).output
    return {"seconds": float(re.search(r"seconds (\S+)", told)[1]), "triangles": int(re.search(r"triangles (\d+)", told)[1])}


def timed(options, path, turns, *more):
    """Processor time, whatever else the machine does."""
    done = run([options.build / "plane_times", path, turns, *more])
    if done.code != 0:
        return None
    return {"seconds": float(re.search(r"seconds (\S+)", done.output)[1]), "triangles": int(re.search(r"triangles (\d+)", done.output)[1])}


def measure_delaunay(options, folder):
    path = folder / "plane.poly"
    apart(write_random, path, POINTS, SEGMENTS)
    told = take_turns({OURS: lambda: timed(options, path, 1, "delaunay"), CGAL: lambda: cgal(options, path)},
                      options.runs)
    return {name: {"seconds": median(t["seconds"] for t in turns), "triangles": turns[0]["triangles"]} for name, turns in told.items()}


def packages_in(options):
    """A folder with the packages, which npm installs once."""
    folder = options.build / "bench" / "npm"
    if not all((folder / "node_modules" / name).is_dir() for name in PACKAGES):
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "install", "--silent", *PACKAGES], cwd=folder, check=True)
    return folder


def version_of(folder, package):
    return json.loads((folder / "node_modules" / package / "package.json").read_text(encoding="utf-8"))["version"]


def package_on(options, folder, package, polygons, turns):
    path = folder / "polygons.json"
    path.write_text(json.dumps(polygons), encoding="utf-8")
    done = subprocess.run(["node", "--stack-size=60000", __file__.replace("plane.py", "ears.mjs"), package, path, str(turns)],
                          cwd=packages_in(options), capture_output=True, text=True, timeout=options.timeout, check=False)
    told = [json.loads(line) for line in done.stdout.splitlines()]
    return told + [{"error": "the process died"}] * (len(polygons) - len(told))


def as_poly(path, outlines):
    """Each place once, as .poly requires; holes by a point inside, from a small triangle at a corner."""
    number, points, segments, holes = {}, [], [], []
    for outline in outlines:
        for p in outline:
            if p not in number:
                number[p] = len(points)
                points.append(p)
        segments += [(number[a], number[b]) for a, b in zip(outline, outline[1:] + outline[:1])]
    for hole in outlines[1:]:
        a, b, c = hole[-1], hole[0], hole[1]
        holes.append(tuple((a[k] + b[k] + c[k]) / 3 for k in range(2)) if len(hole) == 3 else
                     tuple(sum(p[k] for p in hole) / len(hole) for k in range(2)))
    write_poly(path, points, list(dict.fromkeys(segments)), holes)
    return points


def double_area(outline):
    points = [tuple(map(Fraction, p)) for p in outline]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))


def fails(outlines, points, triangles):
    if triangles is None:
        return True
    areas = [double_area([points[v] for v in t]) for t in triangles]
    turned = [a < 0 for a in areas]
    whole = abs(double_area(outlines[0])) - sum(abs(double_area(h)) for h in outlines[1:])
    used = {points[v] for t in triangles for v in t}
    return (any(a == 0 for a in areas) or len(set(turned)) > 1 or abs(sum(areas)) != whole
            or any(p not in used for outline in outlines for p in outline))


def ours_on(options, folder, outlines):
    points = as_poly(folder / "hard.poly", outlines)
    if holdfast(options, folder, folder / "hard.poly", "--method", "ears") is None:
        return points, None
    lines = (folder / "plane.off").read_text(encoding="ascii").splitlines()
    count, triangles, _ = map(int, lines[1].split())
    return points, [tuple(map(int, line.split()[1:])) for line in lines[2 + count:2 + count + triangles]]


def measure_hard(options, folder, kind):
    rng = random.Random(1)
    polygons = [HARD[kind](rng) for _ in range(EACH)]
    failed = {OURS: sum(fails(o, *ours_on(options, folder, o)) for o in polygons)}
    for package in PACKAGES:
        told = package_on(options, folder, package, polygons, 1)
        failed[package] = sum(fails(o, [p for outline in o for p in outline], t.get("triangles")) for o, t in zip(polygons, told))
    return failed


def polygons_to_time():
    for count in (1_000, 10_000, 100_000):
        yield f"a star of {count:,} corners", [star(count)]
    for count in (10_000, 100_000):
        yield f"a spiral of {count:,} corners", [spiral(count)]
    for count in (10_000, 100_000):
        yield f"a comb of {count:,} corners", [comb(count)]
    yield "a plate with 900 holes of 8 corners", plate(30)


def measure_ears(options, folder, outlines):
    as_poly(folder / "ears.poly", outlines)
    few = sum(map(len, outlines)) <= SLOW
    turns = WARM if few else LONG
    told = timed(options, folder / "ears.poly", turns, "ears")
    seconds = {OURS: told and told["seconds"]}
    for package in PACKAGES:
        wanted = turns if package == "earcut" else options.runs
        try:
            (found,) = package_on(options, folder, package, [outlines], wanted) if few or package == "earcut" else ({},)
        except subprocess.TimeoutExpired:
            found = {}
        seconds[package] = found["ms"] / 1000 if "ms" in found else None
    return seconds


def bench(options, folder, rows):
    title = f"{POINTS:,} random points, {SEGMENTS:,} segments"
    row = rows.get(f"{title}, {options.runs} turns", measure_delaunay, options, folder)
    ratio = row[CGAL]["seconds"] / row[OURS]["seconds"]
    lines = ["Constrained Delaunay triangles, one thread, points and segments in memory, triangles out; seconds of the processor, median of "
             f"{options.runs} turns.", "", "| input | program | seconds | triangles | time against holdfast |", "|---|---|---:|---:|---:|",
             *(f"| {title} | {name} | {told['seconds']:.3f} | {told['triangles']:,} | {told['seconds'] / row[OURS]['seconds']:.2f} |"
               for name, told in row.items()), ""]
    names = (OURS, *PACKAGES)
    lines += ["Ears (`--method ears`), milliseconds of the processor; holdfast's time is that of the whole call: it copies the input, validates it, "
              "and gives regions and the least angle, too; a package gets its data as it wants them and gives triangles. Packages other than earcut take part up to "
              f"{SLOW:,} corners; - stands for a failure or none. Medians in one process: of {WARM} turns for holdfast and earcut, "
              f"so that node has compiled it, of {LONG} beyond {SLOW:,} corners, of {options.runs} for the others.", "", f"| polygon | {' | '.join(names)} |", "|---|" + "---:|" * len(names)]
    figures = {"cgal": ratio, "ears": [], "failed": {name: 0 for name in names}}
    for what, outlines in polygons_to_time():
        seconds = rows.get(f"{what}, {WARM}, {LONG} and {options.runs} turns", measure_ears, options, folder, outlines)
        lines.append(f"| {what} | " + " | ".join("-" if seconds[n] is None else f"{1000 * seconds[n]:.2f}" for n in names) + " |")
        if seconds["earcut"] and seconds[OURS]:
            figures["ears"].append({"what": what, "ratio": seconds["earcut"] / seconds[OURS]})
    lines += ["", f"Failures on {EACH} polygons of each kind:", "", f"| polygons | {' | '.join(names)} |", "|---|" + "---:|" * len(names)]
    for kind in HARD:
        failed = rows.get(f"{EACH} polygons, {kind}", measure_hard, options, folder, kind)
        lines.append(f"| {kind} | " + " | ".join(str(failed[n]) for n in names) + " |")
        for name in names:
            figures["failed"][name] += failed[name]
    return lines, figures
