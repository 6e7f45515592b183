"""How time grows: Delaunay from 10^4 to 10^7 tetrahedra and of 10^7 points, and the paper's worst case (Fig. 13), whose
mesh must have about n^2 m points more than the surface."""
import json
import sys
from math import log
from pathlib import Path
from statistics import median

from delaunay import holdfast
from points import write_random
from process import apart, run

ROOT = Path(__file__).resolve().parent.parent
POINT_BYTES = 1500  # memory made ready per point


def exponent(sizes, times):
    """Slope of log(time) against log(size), by least squares."""
    x, y = [log(s) for s in sizes], [log(t) for t in times]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


# ------------------------------------------------------------------------------------------------- Delaunay


def triangulate(options, folder, count, turns):
    node = folder / "growth.node"
    apart(write_random, node, count)
    told = [holdfast(options.build / "holdfast", node, folder, memory=(1 << 28) + POINT_BYTES * count) for _ in range(turns)]
    node.unlink()  # of ten million points it has half a gigabyte
    return {"seconds": median(t["seconds"] for t in told), "tetrahedra": told[0]["tetrahedra"], "peak": max(t["peak"] for t in told)}


def delaunay_line(count, turns, row):
    return (f"| {count:,} | {turns} | {row['tetrahedra']:,} | {row['seconds']:.4f} | {1e9 * row['seconds'] / row['tetrahedra']:.0f} "
            f"| {row['peak'] / row['tetrahedra']:.0f} | {row['peak'] / 2**30:.2f} |")


def bench_delaunay(options, folder, rows):
    lines = ["| points | turns | tetrahedra | seconds | ns a tetrahedron | bytes a tetrahedron, whole process | peak memory, GiB |",
             "|---:|---:|---:|---:|---:|---:|---:|"]
    told = []
    for count in options.growth:
        told.append(rows.get(f"{count} points, {options.runs} turns", triangulate, options, folder, count, options.runs))
        lines.append(delaunay_line(count, options.runs, told[-1]))
    many = rows.get(f"{options.many} points, once", triangulate, options, folder, options.many, 1)
    lines.append(delaunay_line(options.many, 1, many))
    figures = {"tetrahedra": [t["tetrahedra"] for t in told], "seconds": [t["seconds"] for t in told],
               "many": {"points": options.many, **many}}
    if len(told) > 1:
        figures["exponent"] = exponent(figures["tetrahedra"], figures["seconds"])
        lines += ["", f"Time grows as tetrahedra to the power of **{figures['exponent']:.2f}** (without the last line, of one turn)."]
    return lines, figures


# -------------------------------------------------------------------------------------------------- Fig. 13


def fill_worst_case(options, folder, n):
    """None if it takes too long."""
    surface, report = folder / "fig13.smesh", folder / "fig13.json"
    run([sys.executable, ROOT / "examples" / "make_paper.py", "worst", surface, "-n", n, "-m", max(1, n // 2)])
    told = []
    for _ in range(options.runs):
        command = [options.build / "holdfast", "mesh", surface, "-o", folder / "fig13.meshb", "--fill", "-q", "--report", report]
        if run(command, options.timeout).code != 0:
            return None
        told.append(json.loads(report.read_text(encoding="utf-8")))
    return {"seconds": median(t["seconds"]["total"] for t in told), "steiner": told[0]["steiner"]["count"],
            "triangles": told[0]["input"]["facets"], "tetrahedra": told[0]["mesh"]["tetrahedra"]}


def bench_fig13(options, folder, rows):
    lines = ["| n | triangles | Steiner points | tetrahedra | seconds |", "|---:|---:|---:|---:|---:|"]
    told = {}
    for n in options.fig13:
        row = rows.get(f"Fig. 13, n = {n}, {options.runs} turns of {options.timeout:.0f} s", fill_worst_case, options, folder, n)
        if row:
            told[n] = row
            lines.append(f"| {n} | {row['triangles']} | {row['steiner']} | {row['tetrahedra']} | {row['seconds']:.3f} |")
        else:
            lines.append(f"| {n} | not meshed within {options.timeout:.0f} s | | | |")
    if len(told) < 2:
        return lines, None
    grows = exponent(told, [r["seconds"] for r in told.values()])
    points = exponent(told, [max(1, r["steiner"]) for r in told.values()])
    lines += ["", f"Time grows as n to the power of **{grows:.2f}**, Steiner points as n to the power of {points:.2f} (m = n / 2)."]
    return lines, {"exponent": grows, "steiner_exponent": points}


def bench(options, folder, rows):
    lines, delaunay = bench_delaunay(options, folder, rows)
    more, fig13 = bench_fig13(options, folder, rows)
    return ["Delaunay of random points, one thread:", "", *lines, "",
            "The paper's worst case (Fig. 13, m = n / 2), `holdfast mesh --fill`:", "", *more], {"delaunay": delaunay, "fig13": fig13}
