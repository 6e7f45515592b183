"""The paper's Fig. 15, 26,326 triangles, for which the paper's program took 311 s: Holdfast and TetGen."""
import json
import sys
from pathlib import Path
from statistics import median

from process import run, take_turns
from stages import medians, table

ROOT = Path(__file__).resolve().parent.parent
PAPER = 311  # seconds


def fill(options, folder):
    report = folder / "fig15.json"
    done = run([options.build / "holdfast", "mesh", folder / "fig15.off", "-o", folder / "fig15.meshb", "--fill", "-q", "--report", report],
               options.timeout)
    return {"wall": done.wall, "peak": done.peak, "report": json.loads(report.read_text(encoding="utf-8"))} if done.code == 0 else None


def tetgen(options, folder):
    done = run(["tetgen", "-pYQ", folder / "fig15.off"], options.timeout)
    return {"wall": done.wall, "peak": done.peak} if done.code == 0 and (folder / "fig15.1.ele").exists() else None


def measure(options, folder):
    run([sys.executable, ROOT / "examples" / "make_paper.py", "touching", folder / "fig15.off"])
    told = take_turns({"holdfast": lambda: fill(options, folder), "TetGen -pYQ": lambda: tetgen(options, folder)}, options.runs)
    row = {name: turns and {"wall": median(t["wall"] for t in turns), "peak": median(t["peak"] for t in turns)}
           for name, turns in told.items()}
    reports = [t["report"] for t in told["holdfast"] or []]
    return {"programs": row, "stages": medians(reports) if reports else None, "report": reports[0] if reports else None}


def bench(options, folder, rows):
    row = rows.get(f"{options.runs} turns of {options.timeout:.0f} s", measure, options, folder)
    lines = [f"`examples/make_paper.py touching`, 26,326 triangles; the paper's program took {PAPER} s. Whole process, wall clock, one "
             f"thread; median of {options.runs} turns.", "", "| program | seconds | peak memory, MB |", "|---|---:|---:|"]
    for name, told in row["programs"].items():
        lines.append(f"| {name} | {told['wall']:.2f} | {told['peak'] / 1e6:.0f} |" if told
                     else f"| {name} | failed, or over {options.timeout:.0f} s | |")
    ours, report = row["programs"]["holdfast"], row["report"]
    if not ours:
        return lines, None
    lines += ["", f"{report['mesh']['tetrahedra']} tetrahedra, {report['steiner']['count']} Steiner points. Where the time goes:", "",
              *table("triangles", {f"{report['input']['facets']:,}": row["stages"]})]
    return lines, {"seconds": ours["wall"], "tetgen": row["programs"]["TetGen -pYQ"] and row["programs"]["TetGen -pYQ"]["wall"]}
