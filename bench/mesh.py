"""Surfaces of the corpus, evenly over all sizes: `holdfast mesh --fill` and `tetgen -pYQ`.

CPU time counts, user and system, of the whole process with reading and writing: a wall-clock time of some milliseconds
is mostly the start of the process and other work of the machine. It is reported, too.
"""
import shutil
from statistics import median, quantiles

import sample
from process import run, take_turns

QUICK = 0.2  # seconds of CPU below which a program gets all turns; above it, three of five
LARGE = 1000  # triangles from which on the speed is promised
VAST = 100_000  # triangles from which on a multiple is promised
PROMISED = 3
NOTHING = {"wall": None, "cpu": None}


def turns_of(runs):
    return lambda first: runs if min((r.cpu for r in first), default=0) < QUICK else max(1, (3 * runs + 4) // 5)


def holdfast(options, folder, *extra):
    """No memory is made ready: few need more than some MB, and touching it empties the processor's caches. Old files of both
    programs are removed first: replacing four takes half a millisecond."""
    for old in folder.glob("out.*"):
        old.unlink()
    done = run([options.build / "holdfast", "mesh", folder / "surface.off", "-o", folder / "out.node", "--fill", "-q", *extra],
               options.timeout)
    return done if done.code == 0 else None


def tetgen(options, folder):
    for old in folder.glob("surface.1.*"):
        old.unlink()
    done = run(["tetgen", "-pYQ", folder / "surface.off"], options.timeout)
    return done if done.code == 0 and (folder / "surface.1.ele").exists() else None


def medians(turns):
    return {"wall": median(t.wall for t in turns), "cpu": median(t.cpu for t in turns)} if turns else NOTHING


def measure(options, folder, surface):
    shutil.copyfile(surface.path, folder / "surface.off")
    told = take_turns({"holdfast": lambda: holdfast(options, folder), "TetGen": lambda: tetgen(options, folder)}, turns_of(options.runs))
    return {"name": surface.name, "triangles": surface.triangles, **{name: medians(turns) for name, turns in told.items()}}


def ratio(row, clock="cpu"):
    return row["holdfast"][clock] / row["TetGen"][clock]


def spread(rows):
    """A line of the table: how the ratio is distributed over surfaces."""
    cells = []
    for clock in ("cpu", "wall"):
        ratios = [ratio(r, clock) for r in rows]
        low, middle, high = quantiles(ratios, n=4) if len(ratios) > 1 else 3 * ratios
        cells.append(f"{middle:.2f} | {low:.2f} to {high:.2f}")
    ours, theirs = (sum(r[name]["cpu"] for r in rows) for name in ("holdfast", "TetGen"))
    slower = sum(ratio(r) > 1 for r in rows)
    return f"{len(rows)} | {' | '.join(cells)} | {slower} | {ours:.1f} | {theirs:.1f}"


def overview(both):
    lines = ["| triangles | surfaces | CPU, median | quartiles | wall clock, median | quartiles | TetGen takes less CPU on "
             "| holdfast, sum of CPU s | TetGen |", "|---|---:|---:|---|---:|---|---:|---:|---:|"]
    any_size = float("inf")
    for title, low, high in ((f"up to {LARGE:,}", 0, LARGE + 1), (f"{LARGE:,} to {VAST:,}", LARGE + 1, VAST),
                             (f"from {VAST:,} on", VAST, any_size), ("all", 0, any_size)):
        rows = [r for r in both if low <= r["triangles"] < high]
        if rows:
            lines.append(f"| {title} | {spread(rows)} |")
    return lines


def list_of(rows):
    return ["| surface | triangles | holdfast, CPU s | TetGen, CPU s | ratio |", "|---|---:|---:|---:|---:|",
            *(f"| {r['name']} | {r['triangles']:,} | {r['holdfast']['cpu']:.3f} | {r['TetGen']['cpu']:.3f} | {ratio(r):.2f} |"
              for r in sorted(rows, key=ratio, reverse=True))]


def figures_of(both, closed):
    large = [r for r in both if r["triangles"] > LARGE]
    vast = [1 / ratio(r) for r in both if r["triangles"] >= VAST]
    return {"large": len(large), "large_in_corpus": sum(s.triangles > LARGE for s in closed), "slower": sum(ratio(r) > 1 for r in large),
            "median": median(map(ratio, large)) if large else None, "worst": max(map(ratio, large), default=None),
            "vast": len(vast), "vast_in_corpus": sum(s.triangles >= VAST for s in closed), "vast_least": min(vast, default=None),
            "vast_median": median(vast) if vast else None, "vast_below": sum(x < PROMISED for x in vast)}


def bench(options, folder, rows):
    if not options.surfaces_in:
        return sample.ABSENT, None
    closed = sample.closed_surfaces(options.surfaces_in)
    # All of the few largest are used: a sample may miss them.
    chosen = sorted({*sample.evenly(closed, options.surfaces), *(s for s in closed if s.triangles >= VAST)}, key=lambda s: s.triangles)
    told = [rows.get(f"{s.name}, {options.runs} turns of {options.timeout:.0f} s", measure, options, folder, s) for s in chosen]
    both = [r for r in told if r["holdfast"]["cpu"] and r["TetGen"]["cpu"]]
    missing = {name: [r["name"] for r in told if not r[name]["cpu"]] for name in ("holdfast", "TetGen")}
    lines = [f"{len(told)} of the corpus's {len(closed)} valid closed surfaces, evenly over all sizes, with all from "
             f"{VAST:,} triangles on. Whole process with reading and writing, one thread; median of {options.runs} turns where a program "
             f"takes under {QUICK} s, else of three in five. Ratios are holdfast over TetGen. CPU time (user and system) counts: "
             "wall-clock time of some milliseconds is mostly the making of a process.", ""]
    lines += overview(both) if both else ["No surface was meshed by both."]
    lines += ["", f"Not meshed, or over {options.timeout:.0f} s: holdfast {len(missing['holdfast'])}, TetGen {len(missing['TetGen'])} "
              "(its results were not checked further)."]
    if missing["holdfast"]:
        lines += ["", "holdfast failed on: " + ", ".join(missing["holdfast"])]
    slower = [r for r in both if r["triangles"] > LARGE and ratio(r) > 1]
    lines += ["", f"All surfaces above {LARGE:,} triangles on which TetGen takes less CPU: {len(slower)}.", ""]
    lines += list_of(slower) if slower else []
    return lines, figures_of(both, closed)
