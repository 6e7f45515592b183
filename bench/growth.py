"""How time grows: Delaunay from 10^4 to 10^7 tetrahedra, and the paper's worst case (Fig. 13), whose mesh must have
about n^2 m points more than the surface."""
import json
import sys
from math import log
from pathlib import Path
from statistics import median

from process import run

ROOT = Path(__file__).resolve().parent.parent


def exponent(sizes, times):
    """Slope of log(time) over log(size), by least squares."""
    x, y = [log(s) for s in sizes], [log(t) for t in times]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def bench_delaunay_growth(options, folder, write_points):
    """`write_points(path, count)` writes a .node file of random points."""
    lines = ["| points | tetrahedra | seconds | ns a tetrahedron | bytes a tetrahedron, whole process |", "|---|---|---|---|---|"]
    sizes, times = [], []
    node, report = folder / "growth.node", folder / "growth.json"
    for count in options.growth:
        write_points(node, count)
        told = []
        for _ in range(options.runs):
            code, text, _, _ = run([options.build / "holdfast", "delaunay", node, "-o", folder / "growth.meshb", "-q", "--report", report],
                                    memory=(1 << 28) + 1500 * count)
            if code != 0:
                sys.exit(f"holdfast delaunay ended with {code}: {text}")
            told.append(json.loads(report.read_text(encoding="utf-8")))
        tets = told[0]["mesh"]["tetrahedra"]
        seconds = median(t["seconds"]["delaunay"] for t in told)
        peak = max(t["peak_memory_bytes"] for t in told)
        sizes.append(tets)
        times.append(seconds)
        lines.append(f"| {count} | {tets} | {seconds:.4f} | {1e9 * seconds / tets:.0f} | {peak / tets:.0f} |")
        print(lines[-1], flush=True)
    lines += ["", f"Time grows as tetrahedra to the power of **{exponent(sizes, times):.2f}**."]
    return lines


def bench_fig13(options, folder):
    lines = ["| n | triangles | Steiner points | tetrahedra | seconds |", "|---|---|---|---|---|"]
    surface, report = folder / "fig13.smesh", folder / "fig13.json"
    sizes, times, steiner = [], [], []
    for n in options.fig13:
        run([sys.executable, ROOT / "examples" / "make_paper.py", "worst", surface, "-n", n, "-m", max(1, n // 2)])
        told = []
        for _ in range(options.runs):
            code, _, _, _ = run([options.build / "holdfast", "mesh", surface, "-o", folder / "fig13.meshb", "--fill", "-q", "--report", report],
                                options.timeout)
            if code != 0:
                break
            told.append(json.loads(report.read_text(encoding="utf-8")))
        if not told:
            lines.append(f"| {n} | not meshed within {options.timeout:.0f} s | | | |")
            continue
        seconds = median(t["seconds"]["total"] for t in told)
        sizes.append(n)
        times.append(seconds)
        steiner.append(max(1, told[0]["steiner"]["count"]))
        lines.append(f"| {n} | {told[0]['input']['facets']} | {told[0]['steiner']['count']} | {told[0]['mesh']['tetrahedra']} | {seconds:.3f} |")
        print(lines[-1], flush=True)
    if len(sizes) > 1:
        lines += ["", f"Time grows as n to the power of **{exponent(sizes, times):.2f}**, Steiner points as n to the power of "
                  f"{exponent(sizes, steiner):.2f} (m = n / 2)."]
    return lines
