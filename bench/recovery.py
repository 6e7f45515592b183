"""How the time of recovery grows: surfaces of any size with the same share missing in the Delaunay mesh.

* A plate of k x k round holes, one piece. The circles above and below are rotated relative to each other, and the
  diagonals between them are the longer ones; the plane faces are fans from the corners of the cells, as CAD systems export them.
* Copies of the housing of examples/make_part.py, k x k x k, close to each other. An inner copy has neighbours all
  round, a single one has none: so the time per tetrahedron must grow somewhat until most are inside.

Recovery is flips and partition; tetrahedra are those of the final mesh.
"""
import itertools
import json
import random
import struct
import sys
from math import cos, hypot, pi, sin
from pathlib import Path

from growth import exponent
from process import apart, run
from stages import medians, table

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "examples"))
from make_part import housing  # noqa: E402
from polygons import GRID  # noqa: E402

SIDES, TURN = 16, 0.3  # of a hole; part of a side by which the circles are rotated
GAP = 1.1  # ratio of the distance of copies to their size
LONG = 10  # seconds above which there is one turn only
TRIANGLE_BYTES = 400  # memory made ready per triangle
RECORD = struct.Struct("<12fH")


def write_stl(path, triangles):
    """A binary STL file of triangles from an iterator: ten million are never in memory together."""
    with open(path, "wb") as file:
        file.write(bytes(84))
        count = 0
        for count, (a, b, c) in enumerate(triangles, 1):
            file.write(RECORD.pack(0, 0, 0, *a, *b, *c, 0))
        file.seek(80)
        file.write(struct.pack("<I", count))


# ---------------------------------------------------------------------------------------------------- plate


def circle(x, y, z, radius, phase):
    angles = (2 * pi * (side + phase) / SIDES for side in range(SIDES))
    return [(x + radius * cos(a), y + radius * sin(a), z) for a in angles]


def face_of_cell(x, y, z, ring, phase):
    """The square round a hole, counterclockwise: a fan from each corner to its quarter of the circle."""
    corners = [(x + a, y + b, z) for a, b in ((1.0, 1.0), (0.0, 1.0), (0.0, 0.0), (1.0, 0.0))]
    quarter = [int((side + 0.5 + phase) % SIDES * 4 / SIDES) for side in range(SIDES)]
    for side in range(SIDES):
        after = (side + 1) % SIDES
        here, there = corners[quarter[side]], corners[quarter[after]]
        yield ring[side], here, ring[after]
        if here != there:
            yield ring[after], here, there


def cell(x, y, draw):
    """Its hole and its two faces; holes differ in size and phase, so that only their circles are cospherical."""
    phase, radius = draw(), 0.35 * (0.8 + 0.4 * draw())
    low = circle(x + 0.5, y + 0.5, 0.0, radius, phase)
    high = circle(x + 0.5, y + 0.5, 1.0, radius, phase + TURN)
    for side in range(SIDES):
        after = (side + 1) % SIDES
        yield low[after], low[side], high[after]
        yield low[side], high[side], high[after]
    for a, b, c in face_of_cell(x, y, 0.0, low, phase):
        yield c, b, a
    yield from face_of_cell(x, y, 1.0, high, phase + TURN)


def plate(k):
    draw = random.Random(1).random
    for x, y in itertools.product(range(k), repeat=2):
        yield from cell(x, y, draw)
    for i in range(k):
        for (a, b), (c, d) in (((i, 0), (i + 1, 0)), ((k, i), (k, i + 1)), ((i + 1, k), (i, k)), ((0, i + 1), (0, i))):
            yield (a, b, 0.0), (c, d, 0.0), (c, d, 1.0)
            yield (a, b, 0.0), (c, d, 1.0), (a, b, 1.0)


# ---------------------------------------------------------------------------------------------------- parts


def parts(k):
    triangles = [[tuple(x / GRID for x in p) for p in t] for t in housing().triangles]
    extent = [max(p[axis] for t in triangles for p in t) - min(p[axis] for t in triangles for p in t) for axis in range(3)]
    step = (GAP * hypot(*extent[:2]), GAP * hypot(*extent[:2]), GAP * extent[2])
    for copy in itertools.product(range(k), repeat=3):
        shift = [i * s for i, s in zip(copy, step)]
        for t in triangles:
            yield [[x + d for x, d in zip(p, shift)] for p in t]


# ------------------------------------------------------------------------------------------------- measuring


def fill(options, folder, make, k):
    """None if it fails or takes too long."""
    surface, report = folder / "recovery.stl", folder / "recovery.json"
    apart(lambda: write_stl(surface, make(k)))
    memory = (1 << 28) + TRIANGLE_BYTES * (surface.stat().st_size // RECORD.size)
    reports = []
    while not reports or len(reports) < options.runs and reports[0]["seconds"]["total"] < LONG:
        command = [options.build / "holdfast", "mesh", surface, "-o", folder / "recovery.meshb", "--fill", "-q", "--report", report]
        if run(command, options.long_timeout, memory=memory).code != 0:
            return None
        reports.append(json.loads(report.read_text(encoding="utf-8")))
    told = reports[0]
    return {"turns": len(reports), "triangles": told["input"]["facets"], "tetrahedra": told["mesh"]["tetrahedra"],
            "stages": medians(reports), "peak": max(r["peak_memory_bytes"] for r in reports), "steiner": told["steiner"]["count"],
            "missing": told["delaunay"]["missing_segments"] + told["delaunay"]["missing_facets"],
            "left": told["flips"]["missing_segments"] + told["flips"]["missing_facets"]}


def line(k, row):
    tetrahedra = row["tetrahedra"]
    flips, partition, delaunay = (1e9 * row["stages"][stage] / tetrahedra for stage in ("flips", "partition", "delaunay"))
    return (f"| {k} | {row['turns']} | {row['triangles']:,} | {tetrahedra:,} | {row['missing']:,} | {row['left']:,} | {row['steiner']:,} "
            f"| {flips:,.0f} | {partition:,.0f} | {flips + partition:,.0f} | {delaunay:,.0f} | {row['stages']['total']:.2f} "
            f"| {row['peak'] / 1e6:,.0f} |")


def growth_of(rows):
    """Powers of the number of tetrahedra, and what makes that of recovery, "exponent"."""
    tetrahedra = [row["tetrahedra"] for row in rows]
    recovery = [row["stages"]["flips"] + row["stages"]["partition"] for row in rows]
    powers = {stage: exponent(tetrahedra, [row["stages"][stage] for row in rows]) for stage in ("flips", "partition", "delaunay")}
    powers |= {count: exponent(tetrahedra, [max(1, row[count]) for row in rows]) for count in ("missing", "left")}
    return {"tetrahedra": tetrahedra, "recovery": recovery, "exponent": exponent(tetrahedra, recovery), **powers}


def family(options, folder, rows, title, make, sizes):
    """Lines and figures of one family of surfaces."""
    told = {k: rows.get(f"{title}, k = {k}, {options.runs} turns of {options.long_timeout:.0f} s", fill, options, folder, make, k)
            for k in sizes}
    done = {k: row for k, row in told.items() if row}
    lines = ["| k | turns | triangles | tetrahedra | missing in the Delaunay mesh | left by flips | Steiner points "
             "| flips, ns a tetrahedron | partition, ns | both, ns | Delaunay, ns | whole, s | peak memory, MB |", "|---:" * 13 + "|",
             *(line(k, row) if row else f"| {k} | failed, or over {options.long_timeout:.0f} s |" + " |" * 11 for k, row in told.items())]
    if len(done) < 2:
        return lines, {}
    figures = growth_of(list(done.values()))
    lines += ["", f"As powers of tetrahedra grow: recovery **{figures['exponent']:.2f}** (flips {figures['flips']:.2f}, partition "
              f"{figures['partition']:.2f}), Delaunay {figures['delaunay']:.2f}, constraints missing in its mesh {figures['missing']:.2f}, "
              f"those that flips leave {figures['left']:.2f}.", "",
              *table("k", {k: row["stages"] for k, row in done.items()})]
    return lines, figures


def bench(options, folder, rows):
    plates, of_plates = family(options, folder, rows, "plates", plate, options.plates)
    copies, of_parts = family(options, folder, rows, "parts", parts, options.copies)
    lines = [f"Surfaces of which a constant share is missing in the Delaunay mesh, one thread; median of {options.runs} turns, one where "
             f"a turn takes over {LONG} s. Recovery is flips and partition.", "",
             "Plates of k x k round holes, one piece each:", "", *plates, "",
             "k x k x k copies of the housing that `examples/make_part.py` makes, side by side. Those inside have neighbours all round, so "
             "that a little more is left by flips of each where there are many:", "", *copies]
    return lines, {"plates": of_plates, "parts": of_parts}
