"""The paper's Tables I and II for the generated cases and the corpus, compared with TetGen, in one run.

    tables.py --build build/release [--corpus DIR] [--surfaces 300] [--jobs 2] [--seed2 2]

Every surface is filled by `holdfast mesh --fill` and verified by `holdfast check` and, where there is one, by the
independent checker; then TetGen (-pYQz) and Gmsh's HXT fill it on the same machine. Columns, as the paper calls them: faini, arini
(facets and segments of the surface), faper, arper (those missing after the flips), npface, nparet (points that the
partition added), npste (Steiner points left), ne, np (tetrahedra, vertices), Target (the Q that the worst facet asks
for), Q (of the worst tetrahedron), cpu (seconds of the whole program). "fewest" is npste and Q of another run,
`--without points`, in which the optimisation adds none. Writes docs/results.md.
"""
import argparse
import concurrent.futures
import itertools
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import corpus  # noqa: E402  (finds the surfaces)
from gmsh_files import fill_by_hxt, read_off, told  # noqa: E402

PEER_LIMIT = 60  # seconds
ROUNDING = 1 + 1e-9  # equal Q is reported as equal

# The paper's surfaces (section), made here; those in brackets are the corpus's names.
GENERATED = [
    ("Schönhardt, 30 degrees (§3.1)", ["make_hard.py", "schonhardt", "{}"]),
    ("Schönhardt, 59.9 degrees (§3.1)", ["make_hard.py", "schonhardt", "{}", "--twist", "59.9"]),
    ("Chazelle, n = 3 (§3.2)", ["make_hard.py", "chazelle", "{}", "-n", "3"]),
    ("Chazelle, n = 6 (§3.2)", ["make_hard.py", "chazelle", "{}", "-n", "6"]),
    ("Fig. 13, n = 8, m = 4", ["make_paper.py", "worst", "{}", "-n", "8", "-m", "4"]),
    ("Fig. 13, n = 16, m = 8", ["make_paper.py", "worst", "{}", "-n", "16", "-m", "8"]),
    ("Fig. 14, 2,082 triangles", ["make_paper.py", "dangling", "{}"]),
    ("Fig. 15, 26,326 triangles", ["make_paper.py", "touching", "{}"]),
    ("Fig. 19, four materials", ["make_paper.py", "semiconductor", "{}"]),
    ("gap of 1e-12", ["make_paper.py", "gap", "{}", "--gap", "1e-12"]),
]


# ------------------------------------------------------------------------------------------------- quality


def difference(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def quality(a, b, c, d):
    """The paper's Q; exactly computed where terms cancel, infinite for a flat tetrahedron."""
    u, v, w = difference(b, a), difference(c, a), difference(d, a)
    x, y, z = difference(c, b), difference(d, b), difference(d, c)
    longest = math.sqrt(max(dot(e, e) for e in (u, v, w, x, y, z)))
    if not longest > 0:
        return math.inf
    volume = abs(dot(cross(u, v), w))
    areas = [cross(u, v), cross(v, w), cross(w, u), cross(x, y)]
    if volume < 1e-5 * longest ** 3:
        a, b, c, d = ([Fraction(t) for t in p] for p in (a, b, c, d))
        u, v, w, x, y = (difference(b, a), difference(c, a), difference(d, a), difference(c, b), difference(d, b))
        volume = float(abs(dot(cross(u, v), w)))
        areas = [[float(t) for t in n] for n in (cross(u, v), cross(v, w), cross(w, u), cross(x, y))]
    if volume == 0:
        return math.inf
    return math.sqrt(6) / 12 * longest * sum(math.sqrt(dot(n, n)) for n in areas) / volume


def read_numbers(path):
    with open(path, encoding="ascii") as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    return rows[1: 1 + int(rows[0][0])]


def tetgen_worst(folder):
    """(vertices, tetrahedra, worst Q) of TetGen's files, or None if a triangle of the surface is not a face of them: it
    merges vertices that are near each other."""
    points = [tuple(map(float, row[1:4])) for row in read_numbers(folder / "s.1.node")]
    tetrahedra = [tuple(map(int, row[1:5])) for row in read_numbers(folder / "s.1.ele")]
    given, triangles = read_off(folder / "s.off")
    given = [tuple(map(float, p[:3])) for p in given]
    faces = {told(points[v] for v in face) for t in tetrahedra for face in itertools.combinations(t, 3)}
    if any(told(given[int(v)] for v in t) not in faces for t in triangles):
        return None
    return len(points), len(tetrahedra), max((quality(*(points[v] for v in t)) for t in tetrahedra), default=0.0)


# -------------------------------------------------------------------------------------------------- programs


def timed(command, limit):
    """(exit code or None after a timeout, seconds)."""
    started = time.monotonic()
    try:
        done = subprocess.run([str(w) for w in command], capture_output=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None, time.monotonic() - started
    return done.returncode, time.monotonic() - started


def vertices_of_off(path):
    with open(path, encoding="ascii", errors="replace") as file:
        words = [line for line in file if line.strip() and not line.startswith("#")][1]
    return int(words.split()[0])


class Filler:
    def __init__(self, options, checker):
        self.options, self.checker = options, checker

    def fill(self, name, surface):
        with tempfile.TemporaryDirectory(prefix="holdfast-tables-") as folder:
            folder = Path(folder)
            local = folder / "s.off"
            shutil.copy(surface, local)
            row = {"name": name, **self.holdfast(local, folder)}
            row["tetgen"] = self.tetgen(local, folder)
            row["hxt"] = self.hxt(local, folder)
            return row

    def holdfast(self, surface, folder):
        report, volume = folder / "report.json", folder / "out.mesh"
        program = self.options.build / "holdfast"
        mesh = [program, "mesh", surface, "-o", volume, "--fill", "-q", "--report", report, "--time-limit", "600"]
        code, seconds = timed(mesh, 700)
        told = json.loads(report.read_text()) if report.exists() else {}
        row = {"code": code, "seconds": seconds, "report": told}
        if code == 0:
            row["checked"] = timed([program, "check", surface, volume], 600)[0] == 0
            if self.checker:
                readable = corpus.readable_by_checker(surface, folder)
                row["checked"] = row["checked"] and timed([self.checker, readable, volume], 600)[0] == 0
            code, _ = timed([*mesh, "--seed", str(self.options.seed2)], 700)
            row["other_seed"] = json.loads(report.read_text())["steiner"]["count"] if code == 0 else None
            code, _ = timed([*mesh, "--without", "points"], 700)
            row["fewest"] = json.loads(report.read_text()) if code == 0 else None
        return row

    def tetgen(self, surface, folder):
        code, seconds = timed(["tetgen", "-pYQz", surface], PEER_LIMIT)
        if code != 0 or not (folder / "s.1.ele").exists():
            return None
        volume = tetgen_worst(folder)
        if volume is None:
            return None
        points, tetrahedra, worst = volume
        return {"added": points - vertices_of_off(surface), "tetrahedra": tetrahedra, "worst": worst, "seconds": seconds}

    @staticmethod
    def hxt(surface, folder):
        filled = fill_by_hxt(surface, folder, PEER_LIMIT)
        if filled is None:
            return None
        added, tetrahedra = filled
        return {"added": added, "worst": max(quality(*t) for t in tetrahedra)}


# --------------------------------------------------------------------------------------------------- tables


def number(x):
    return "inf" if math.isinf(x) else f"{x:.0f}" if 100 <= x < 1e6 else f"{x:.3g}"


def table(rows):
    lines = ["| surface | faini | arini | faper | arper | npface | nparet | npste | ne | np | Target | Q | cpu | verified | "
             "fewest: npste | Q | TetGen: added | Q | cpu | HXT: added | Q |", "|---|" + "---:|" * 12 + "---|" + "---:|" * 7]
    for row in rows:
        if row["code"] != 0:
            lines.append(f"| {row['name']} | ended with exit code {row['code']} |" + " |" * 19)
            continue
        r, t, h = row["report"], row["tetgen"], row["hxt"]
        cells = [row["name"], r["input"]["facets"], r["input"]["segments"], r["flips"]["missing_facets"],
                 r["flips"]["missing_segments"], r["partition"]["facet_points"], r["partition"]["segment_points"],
                 r["steiner"]["count"], r["mesh"]["tetrahedra"], r["mesh"]["vertices"], number(r["quality"]["target"]),
                 number(r["quality"]["worst"]), f"{row['seconds']:.2f}", "yes" if row["checked"] else "NO"]
        fewest = row["fewest"]
        cells += [fewest["steiner"]["count"], number(fewest["quality"]["worst"])] if fewest else ["failed", ""]
        cells += [t["added"], number(t["worst"]), f"{t['seconds']:.2f}"] if t else ["failed", "", ""]
        cells += [h["added"], number(h["worst"])] if h else ["failed", ""]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return lines


def beside(rows, peer, name):
    """Points and worst Q of ours, with and without the points that the optimisation adds, compared with a peer's."""
    lines = []
    for key, how in (("report", ""), ("fewest", ", `--without points`")):
        both = [r for r in rows if r[peer] and r[key]]
        excess = [r[key]["steiner"]["count"] - r[peer]["added"] for r in both]
        more = sorted(((e, f"{r['name']} {r[key]['steiner']['count']}/{r[peer]['added']}") for e, r in zip(excess, both) if e > 0),
                      reverse=True)
        named = ": " + ", ".join(text for _, text in more) if more else ""
        better = sum(r[key]["quality"]["worst"] <= ROUNDING * r[peer]["worst"] for r in both)
        lines.append(
            f"* Beside {name} ({len(both)} surfaces){how}: added points **{sum(r[key]['steiner']['count'] for r in both)}**, {name} "
            f"**{sum(r[peer]['added'] for r in both)}**, more on {len(more)}, by {sum(e for e, _ in more)} in all{named}. "
            f"Worst Q at most {name}'s on **{better}**; median of the ratio "
            f"{median(r[key]['quality']['worst'] / r[peer]['worst'] for r in both):.2g}; above 1e6 on "
            f"{sum(r[key]['quality']['worst'] > 1e6 for r in both)} ({name} {sum(r[peer]['worst'] > 1e6 for r in both)}).")
    return lines


def summary(rows):
    done = [r for r in rows if r["code"] == 0]
    near = sorted(r["report"]["quality"]["worst"] / r["report"]["quality"]["target"] for r in done)
    seeded = [r for r in done if r["other_seed"] is not None]
    lines = [f"* {len(done)} of {len(rows)} filled, {sum(r['checked'] for r in done)} of them accepted by every checker. TetGen filled "
             f"{sum(1 for r in rows if r['tetgen'])} and kept the surface, Gmsh's HXT {sum(1 for r in rows if r['hxt'])} (their meshes were "
             "not checked further). Negative counts of theirs, vertices that they dropped, are included below."]
    for peer, name in (("tetgen", "TetGen"), ("hxt", "HXT")):
        if any(r[peer] for r in done):
            lines += beside(done, peer, name)
    lines.append(f"* With another random seed: {sum(r['other_seed'] for r in seeded)} points instead of "
                 f"{sum(r['report']['steiner']['count'] for r in seeded)}, on all {len(seeded)} that were filled.")
    both = [r for r in done if r["tetgen"]]
    if both:
        lines.append(f"* Seconds of the whole program: median ratio to TetGen {median(r['seconds'] / r['tetgen']['seconds'] for r in both):.2f} "
                     "(several programs at once; `make bench` measures speed).")
    if near:
        lines.append(f"* Q / Target: median {median(near):.2f}, nine of ten below {near[len(near) * 9 // 10]:.2f}.")
    return lines


def generated(folder):
    surfaces = []
    for k, (name, (script, *arguments)) in enumerate(GENERATED):
        path = folder / f"generated{k}.off"
        subprocess.run([sys.executable, ROOT / "examples" / script, *(a.format(path) for a in arguments)], check=True,
                       capture_output=True)
        surfaces.append((name, path))
    return surfaces


def sampled(folder, count):
    manifest = corpus.manifest_of(folder)
    paths = sorted((folder / "valid").glob("*.off"), key=lambda p: (p.stat().st_size, p.name))
    closed = [p for p in paths if corpus.describe(p, manifest.get(p.stem))[1] == "closed"]
    chosen = closed[:: max(1, len(closed) // count)]
    boeing = [p for p in closed if p.stem == "cdt_boeing_part" and p not in chosen]
    return [(p.stem, p) for p in boeing + chosen]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--corpus", default=os.environ.get("HOLDFAST_CORPUS", ""))
    parser.add_argument("--surfaces", type=int, default=300, help="about so many surfaces of the corpus")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seed2", type=int, default=2, help="the other seed")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "results.md")
    options = parser.parse_args()
    surfaces = corpus.locate(options.corpus, core_only=False)
    version = subprocess.run([options.build / "holdfast", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    lines = ["# Results", "", f"Written by `make tables` on {time.strftime('%Y-%m-%d')} with {version}. The columns are those of the "
             "paper's Tables I and II (`bench/tables.py` explains them); TetGen is Debian's, with -pYQz, and so is Gmsh, whose HXT runs "
             "without its optimisation, which moves no count."]
    with tempfile.TemporaryDirectory(prefix="holdfast-tables-") as name:
        folder = Path(name)
        filler = Filler(options, corpus.build_checker(folder))
        groups = [("The paper's cases, made by `examples/`", generated(folder))]
        if surfaces:
            groups.append(("Closed surfaces of the corpus, evenly over all sizes", sampled(surfaces, options.surfaces)))
        for title, members in groups:
            with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
                rows = list(pool.map(lambda m: filler.fill(*m), members))
            lines += ["", f"## {title}", "", *summary(rows), "", *table(rows)]
            print("\n".join([title, *summary(rows)]), flush=True)
    options.output.parent.mkdir(exist_ok=True)
    options.output.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"written: {options.output}")


if __name__ == "__main__":
    main()
