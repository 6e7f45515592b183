"""Meshes for computation, compared: Holdfast, Gmsh (HXT, and Delaunay with optimisation), TetGen and Netgen.

    field.py --build build/release --corpus DIR [--part good|cad|sizes|seeds] [--only NAME] [--cad-count N] [--sizes-count N]
             [--seeds-count N] [--again GROUP] [--output docs/field.md]

There are four parts: surfaces of good triangles (below), tessellated CAD parts (bench/cad.py), sizes far from the
surface's (bench/sizes.py), and other seeds without field points (bench/seeds.py). Each writes its part of the document
and does not change the others.

Every mesher gets the same triangles and keeps them: `holdfast mesh --no-growth --gradation 0.6` (sizes inside lie
between those of the surrounding surface, as in Gmsh), `gmsh -3 -algo hxt`, `gmsh -3 -algo del3d` with Mesh.Optimize,
`tetgen -pYq1.4`, and Netgen's GenerateVolumeMesh through bench/netgen_volume.py. One thread each. Seconds are
wall-clock time of meshing as the program itself reports it, without reading and writing files (CPU time of TetGen and
Netgen; Gmsh's excludes system time). The faster ones take turns, with memory made ready, and their medians count; the
others run once. Angles are measured by one program, mesh_shape. A mesher may take --timeout seconds of processor time
per surface, which the table states. RING, of half a million triangles, is made here; only the faster meshers get it.

Then the whole of `holdfast mesh`, files and all, with its default options on one and on two threads: the least wall-clock
seconds of some turns. (Memory is not made ready for these: the system keeps working on that for a while, on the second
thread's core.) Both must write the same file.

Rows are kept in field.json in the build folder as soon as they are measured, so that an interrupted run can be continued.
Those of another Holdfast, other surfaces or another time limit are measured again; --again does that for a group. The table of
targets goes to field_targets.json there, for docs/benchmarks.md.
"""
import argparse
import json
import platform
import statistics
import subprocess
import sys
import tempfile
from math import cos, dist, pi, sin
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import cad  # noqa: E402
import corpus  # noqa: E402  (the folder of surfaces)
import field_targets  # noqa: E402
from gmsh_files import read_off  # noqa: E402
from kept import digest  # noqa: E402
from meshers import Meshers, TookTooLong  # noqa: E402
import process  # noqa: E402
import sections  # noqa: E402
import seeds  # noqa: E402
import sizes  # noqa: E402

SURFACES = ["iglt_3holes", "aj_fandisk", "iglt_arm", "aj_rocker-arm", "irmb_cactus25k", "tgt_armadillo",
            "irmb_fertility", "tcsg_golf-out", "igl_armadillo", "irmb_armadillo"]
RING = "ring_500k"
TURNS = 5
TURNS_OF_RING = 3
TURNS_ON_THREADS = 9  # the least counts


def write_ring(path, rows=8334, columns=30):
    """A thin torus whose triangles are nearly regular."""
    minor = 1.0
    major = rows * minor * sin(pi / columns) * 3 ** 0.5 / (2 * pi)
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{rows * columns} {2 * rows * columns} 0\n")
        for i in range(rows):
            for j in range(columns):
                u, v = 2 * pi * i / rows, 2 * pi * (j + 0.5 * (i % 2)) / columns
                r = major + minor * cos(v)
                out.write(f"{r * cos(u)!r} {r * sin(u)!r} {minor * sin(v)!r}\n")
        for i in range(rows):
            here, there, odd = i * columns, (i + 1) % rows * columns, i % 2
            for j in range(columns):
                a, b = here + j, here + (j + 1) % columns
                c, d = there + (j + odd) % columns, there + (j - 1 + odd) % columns
                out.write(f"3 {a} {c} {b}\n3 {a} {d} {c}\n")


def spread_of_edges(surface):
    """How much the sizes of a surface differ: the ratio of the 95th percentile of its triangles' sides to the 5th."""
    points, triangles = read_off(surface)
    points = [tuple(map(float, p[:3])) for p in points]
    corners = [[points[int(v)] for v in t] for t in triangles]
    lengths = sorted(dist(t[k - 1], t[k]) for t in corners for k in range(3))
    return lengths[int(0.95 * len(lengths))] / lengths[int(0.05 * len(lengths))]


class Bench(Meshers):
    """Sizes inside lie between those of the surrounding surface, as in Gmsh."""

    def lying_between(self, surface, *extra):
        return self.holdfast(surface, "--no-growth", "--gradation", "0.6", *extra)

    def of_names(self, names):
        programs = self.peers() | {"Holdfast": self.lying_between, "Holdfast fast": lambda s: self.lying_between(s, "--quality", "fast")}
        return {name: programs[name] for name in names}

    def side_by_side(self, names, surface, turns):
        return self.in_turns(self.of_names(names), surface, turns, lambda made: made.seconds)

    def faster(self, surface):
        return self.side_by_side(FASTER, surface, TURNS_OF_RING if surface.stem == RING else TURNS)

    def slower(self, surface):
        return self.side_by_side(SLOWER, surface, 1)

    def edges(self, surface):
        return spread_of_edges(surface)

    def threads(self, surface):
        """Seconds on one and on two threads, and whether the files are the same."""
        try:
            return self.on_two_threads(surface) or {"failed": "fails"}
        except TookTooLong:
            return {"failed": f"exceeds {self.options.timeout:.0f} s"}

    def on_two_threads(self, surface):
        seconds, files = {1: [], 2: []}, {}
        for _ in range(TURNS_ON_THREADS):
            for count in seconds:
                volume = self.folder / f"hf{count}.vtu"
                told = process.run([self.options.build / "holdfast", "mesh", surface, "-o", volume, "-q", "--threads", count,
                                    "--report", self.folder / "hf.json"], self.options.timeout, self.folder)
                if told.code is None:
                    raise TookTooLong
                if told.code != 0:
                    return None
                seconds[count].append(told.wall)
                files[count] = digest(volume)
        tetrahedra = json.loads((self.folder / "hf.json").read_text())["mesh"]["tetrahedra"]
        return {"one": min(seconds[1]), "two": min(seconds[2]), "same": files[1] == files[2], "tetrahedra": tetrahedra}


GROUPS = {"side by side": Bench.faster, "once": Bench.slower, "on two threads": Bench.threads, "edges": Bench.edges} | cad.GROUPS | sizes.GROUPS | seeds.GROUPS
OF_HOLDFAST = ("side by side", "on two threads", *cad.OF_HOLDFAST, *sizes.OF_HOLDFAST, *seeds.OF_HOLDFAST)  # measured again for another one
FASTER = ["Holdfast", "Holdfast fast", "Gmsh HXT", "TetGen"]
SLOWER = ["Gmsh Delaunay", "Netgen"]
HEADINGS = (cad.HEADING, sizes.HEADING, seeds.HEADING)  # of the other parts, in the document's order
MESHERS = ["Holdfast", "Holdfast fast", "Gmsh HXT", "Gmsh Delaunay", "TetGen", "Netgen"]


class Rows:
    """What was measured before, by surface, group, and all that the rows depend on."""

    def __init__(self, options):
        self.path = options.build / "field.json"
        self.rows = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.timeout = options.timeout
        self.program = digest(options.build / "holdfast")

    def key(self, group, surface):
        program = self.program if group in OF_HOLDFAST else ""
        return f"{surface.stem} {digest(surface)} {group} {program} {self.timeout:.0f}"

    def drop(self, groups):
        self.rows = {key: row for key, row in self.rows.items() if not any(f" {group} " in key for group in groups)}

    def get(self, group, surface, bench):
        key = self.key(group, surface)
        if key not in self.rows:
            self.rows[key] = GROUPS[group](bench, surface)
            self.path.write_text(json.dumps(self.rows, indent=1))
        return self.rows[key]


def line(name, mesher, row):
    if "failed" in row:
        return f"| {name} | {mesher} | {row['failed']} | | | | | |"
    below = " / ".join(f"{x:.2g}" if x else "0" for x in row["below"][:3])
    return (f"| {name} | {mesher} | {row['tetrahedra']} | {row['seconds']:.2f} | "
            f"{row['tetrahedra'] / max(row['seconds'], 1e-9) / 1000:.0f}k | {row['min_dihedral']:.1f} | "
            f"{row['max_dihedral']:.1f} | {below} |")


def threads_table(threads):
    lines = ["| surface | tetrahedra | one thread, s | two threads, s | one over two | same file |", "|---|---|---|---|---|---|"]
    for name, row in threads.items():
        if "failed" in row:
            lines.append(f"| {name} | {row['failed']} | | | | |")
        else:
            lines.append(f"| {name} | {row['tetrahedra']} | {row['one']:.2f} | {row['two']:.2f} | {row['one'] / row['two']:.2f} | "
                         f"{'yes' if row['same'] else 'NO'} |")
    return lines


def summary(results):
    lines = ["| mesher | surfaces | tetrahedra a second, median | least angle, median | below 10 / 20 / 30 degrees, mean % "
             "| tetrahedra over Holdfast's, median |", "|---|---|---|---|---|---|"]
    for mesher in next(iter(results.values())):
        rows = [(r[mesher], r["Holdfast"]) for r in results.values()
                if "failed" not in r[mesher] and "failed" not in r["Holdfast"]]
        if not rows:
            continue
        mean = [statistics.mean(r["below"][k] for r, _ in rows) for k in range(3)]
        lines.append(f"| {mesher} | {len(rows)} of {len(results)} | "
                     f"{statistics.median(r['tetrahedra'] / r['seconds'] for r, _ in rows) / 1000:.0f}k | "
                     f"{statistics.median(r['min_dihedral'] for r, _ in rows):.1f} | "
                     f"{' / '.join(f'{x:.2g}' for x in mean)} | "
                     f"{statistics.median(r['tetrahedra'] / h['tetrahedra'] for r, h in rows):.2f} |")
    return lines


def processor():
    for text in Path("/proc/cpuinfo").read_text().splitlines():
        if text.startswith("model name"):
            return text.split(":")[1].strip()
    return platform.processor()


def write(results, threads, targets, path, timeout):
    versions = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}, ", "gmsh", "tetgen", "python3-netgen"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False).stdout.decode()
    text = ["# Meshes to compute with", "", "Written by `make field`; how it was measured stands in `bench/field.py`.", "",
            f"{processor()}; one thread; at most {timeout:.0f} s a surface; {versions.strip(', ')}.", "", *targets, "",
            *summary({name: rows for name, rows in results.items() if name != RING}), "",
            "The whole of `holdfast mesh` with its default options, least of "
            f"{TURNS_ON_THREADS} turns, wall-clock:", "", *threads_table(threads), "",
            f"`{RING}`, a thin torus, is not in the summary.", "",
            "| surface | mesher | tetrahedra | seconds | a second | least angle | largest | % below 10 / 20 / 30 |",
            "|---|---|---|---|---|---|---|---|"]
    text += [line(name, mesher, row) for name, rows in results.items() for mesher, row in rows.items()]
    sections.replace(path, HEADINGS, None, text)


def measure_good(options, folder, rows, scratch):
    """Surfaces of good triangles, large enough to time."""
    results, threads, spreads, targets = {}, {}, {}, []
    ring = scratch / (RING + ".off")
    write_ring(ring)
    bench = Bench(options, scratch)
    for name in options.only or SURFACES + [RING]:
        surface = ring if name == RING else next(folder.rglob(name + ".off"), None)
        if surface is None:
            continue
        told = rows.get("side by side", surface.resolve(), bench)
        if name != RING:
            told = told | rows.get("once", surface.resolve(), bench)
            spreads[name] = rows.get("edges", surface.resolve(), bench)
        results[name] = {mesher: told[mesher] for mesher in MESHERS if mesher in told}
        threads[name] = rows.get("on two threads", surface.resolve(), bench)
        print("\n".join(line(name, mesher, row) for mesher, row in results[name].items()), flush=True)
        print(threads_table({name: threads[name]})[-1], flush=True)
        targets = field_targets.lines(results, threads, spreads, extra=[RING])
        write(results, threads, targets, options.output, options.timeout)
    if not options.only:
        field_targets.keep(options.build / "field_targets.json", rows.program, targets)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--corpus", default="")
    parser.add_argument("--part", choices=["good", "cad", "sizes", "seeds", "all"], default="all")
    parser.add_argument("--only", action="append", help="surfaces of the first part")
    parser.add_argument("--cad-count", type=int, default=60)
    parser.add_argument("--sizes-count", type=int, default=sizes.COUNT)
    parser.add_argument("--seeds-count", type=int, default=200)
    parser.add_argument("--again", action="append", choices=GROUPS, default=[])
    parser.add_argument("--timeout", type=float, default=300)
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "field.md")
    options = parser.parse_args()
    folder = corpus.locate(options.corpus, False)
    if folder is None:
        sys.exit("field.py: no corpus of surfaces")
    rows = Rows(options)
    rows.drop(options.again)
    with tempfile.TemporaryDirectory(prefix="holdfast-field-") as scratch:
        if options.part in ("good", "all"):
            measure_good(options, folder, rows, Path(scratch))
        for part in (cad, sizes, seeds):
            if options.part in (part.__name__, "all"):
                part.run(options, rows, folder, Path(scratch), lambda text, part=part: sections.replace(options.output, HEADINGS, part.HEADING, text))


if __name__ == "__main__":
    main()
