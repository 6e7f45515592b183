"""Sizes far from the surface's: the third group of field.py, compared with TetGen and Gmsh at the same sizes.

The demo part (examples/make_part.py) and COUNT surfaces of the corpus, each with `--size H`, where H is its mean edge times 1, 1/2, 1/4 and
1/8. The surfaces are fixed by a rule: the first ones in bench/cad.py's order for which the number of regular tetrahedra
with the least H as edge is at most MOST_ELEMENTS. By the same limit, the least size of the demo part is left out.

Gmsh has H as its largest size, TetGen the volume of the regular tetrahedron of that edge as its largest volume. A
peer's mesh counts as in bench/cad.py if it has at least LEAST_PEER times as many elements as there would be regular
ones: Gmsh's Delaunay ignores the size near large triangles. Each runs once, on one thread; seconds are CPU time of
whole processes. If HXT exceeds the time limit, it is not tried at smaller sizes.
"""
import statistics
import subprocess
import sys
from math import dist
from pathlib import Path

import cad
from gmsh_files import read_off
from meshers import Meshers
from target import Target, table

HEADING = "## Sizes far from the surface's"
DEMO = "demo_part"
COUNT = 10
PARTS = {"1": 1, "1/2": 1 / 2, "1/4": 1 / 4, "1/8": 1 / 8}
COARSE, FINE = ("1", "1/2"), ("1/4", "1/8")
MOST_ELEMENTS = 1_000_000
REGULAR = 6 * 2 ** 0.5  # regular tetrahedra of edge 1 in a unit of volume
OURS, FAST, HXT = cad.OURS, cad.FAST, "Gmsh HXT"
PEERS = ("TetGen", HXT, "Gmsh Delaunay")
LEAST_PEER = 1 / 5
MOST_BAD = 3  # % below 10 degrees
WITHIN = 1.3  # times HXT's number
WITHOUT_HXT = 0.5, 1  # times that of regular ones
BELOW_10 = cad.SHARES[0]


def mean_edge(surface):
    points, triangles = read_off(surface)
    points = [tuple(map(float, p[:3])) for p in points]
    edges = {tuple(sorted((int(t[k - 1]), int(t[k])))) for t in triangles for k in range(3)}
    return statistics.fmean(dist(points[a], points[b]) for a, b in edges)


def volume_inside(surface):
    points, triangles = read_off(surface)
    points = [tuple(map(float, p[:3])) for p in points]

    def determinant(a, b, c):
        return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])

    return abs(sum(determinant(*(points[int(v)] for v in t)) for t in triangles)) / 6


def regular_elements(volume, size):
    return REGULAR * volume / size ** 3


def parts_of(surface):
    """name -> size, of those that are measured."""
    edge, volume = mean_edge(surface), volume_inside(surface)
    return {name: part * edge for name, part in PARTS.items() if regular_elements(volume, part * edge) <= MOST_ELEMENTS}


def surfaces(folder, scratch, count):
    demo = scratch / f"{DEMO}.off"
    subprocess.run([sys.executable, Path(__file__).resolve().parent.parent / "examples" / "make_part.py", demo], check=True, stdout=subprocess.DEVNULL)
    chosen = [demo]
    for surface in cad.surfaces(folder, None):
        if len(chosen) > count:
            break
        if len(parts_of(surface)) == len(PARTS):
            chosen.append(surface)
    return chosen


class SizesBench(Meshers):
    """Processor seconds, on whatever memory there is."""

    def __init__(self, options, folder):
        super().__init__(options, folder, memory=0)

    def once(self, programs, surface, part):
        size = PARTS[part] * mean_edge(surface)
        return self.in_turns({name: lambda s, p=program: p(s, size) for name, program in programs.items()}, surface, 1, lambda made: made.cpu)

    def ours(self, surface, part):
        return self.once({OURS: lambda s, size: self.holdfast(s, "--size", repr(size)),
                          FAST: lambda s, size: self.holdfast(s, "--size", repr(size), "--quality", "fast")}, surface, part)

    def theirs(self, surface, part):
        return self.once({"TetGen": lambda s, size: self.tetgen(s, size ** 3 / REGULAR),
                          "Gmsh Delaunay": lambda s, size: self.gmsh(s, "del3d", size)}, surface, part)

    def hxt(self, surface, part):
        return self.once({HXT: lambda s, size: self.gmsh(s, "hxt", size)}, surface, part)


OF_HXT = "sizes of HXT"
MEASURED = {"sizes": SizesBench.ours, "sizes of peers": SizesBench.theirs, OF_HXT: SizesBench.hxt}


def group_of(what, part):
    return f"{what} {part}"


GROUPS = {group_of(what, part): lambda bench, surface, act=act, part=part: act(bench, surface, part) for what, act in MEASURED.items()
          for part in PARTS}
OF_HOLDFAST = tuple(group_of("sizes", part) for part in PARTS)


def regular(rows):
    return regular_elements(rows[OURS]["volume"], rows["size"])


def peers_of(rows):
    """Those that bench/cad.py accepts and that respect the size."""
    if not cad.is_mesh(rows[OURS]):
        return {}
    return {peer: row for peer, row in cad.peers_of(rows).items() if row["tetrahedra"] >= LEAST_PEER * regular(rows)}


def share_below(row):
    return BELOW_10.of(row)


def no_worse_than_peers(rows):
    return cad.is_mesh(rows[OURS]) and not any(cad.is_worse(BELOW_10, rows[OURS], row) for row in peers_of(rows).values())


def has_few_bad(rows):
    return cad.is_mesh(rows[OURS]) and share_below(rows[OURS]) <= MOST_BAD


def has_as_many(rows):
    """HXT's, or if it fails, that of regular tetrahedra."""
    if not cad.is_mesh(rows[OURS]):
        return False
    ours, hxt = rows[OURS]["tetrahedra"], peers_of(rows).get(HXT)
    if hxt:
        return 1 / WITHIN <= ours / hxt["tetrahedra"] <= WITHIN
    return WITHOUT_HXT[0] * regular(rows) <= ours <= WITHOUT_HXT[1] * regular(rows)


def is_no_worse_than_fast(rows):
    return cad.is_mesh(rows[OURS]) and not any(cad.is_worse(figure, rows[OURS], rows[FAST]) for figure in (cad.LEAST_ANGLE, BELOW_10, cad.MEAN_Q))


def target(text, holds, results, parts):
    """`results` maps surfaces to sizes to rows."""
    told = {part: [holds(sizes[part]) for sizes in results.values() if part in sizes] for part in parts}
    return Target(text, ", ".join(f"{sum(held)} of {len(held)} at {part}" for part, held in told.items()), all(all(held) for held in told.values()))


def targets(results):
    return table([target("Below 10 degrees no more than the best peer's at 1 and 1/2", no_worse_than_peers, results, COARSE),
                  target(f"Below 10 degrees at most {MOST_BAD} % at 1/4 and 1/8", has_few_bad, results, FINE),
                  target(f"Number of tetrahedra within {WITHIN} of Gmsh HXT's or, where it has no mesh that counts, half to all of regular ones'",
                         has_as_many, results, PARTS),
                  target("Holdfast no worse than Holdfast fast in least angle, share below 10 degrees and mean Q", is_no_worse_than_fast, results, PARTS),
                  target("Below 10 degrees no more than the best peer's at 1/4 and 1/8 (no target)", no_worse_than_peers, results,
                         FINE)._replace(met=None)])


def means(results):
    lines = ["| size | mesher | surfaces | tetrahedra over regular ones', median | below 10 / 20 / 30 degrees, mean % | by volume | CPU s, mean |",
             "|---|---|---|---|---|---|---|"]
    for part in PARTS:
        whole = [sizes[part] for sizes in results.values() if part in sizes and cad.is_mesh(sizes[part][OURS])]
        for mesher in (OURS, FAST, *PEERS):
            told = [(rows, rows[mesher]) for rows in whole if (mesher in peers_of(rows) if mesher in PEERS else cad.is_mesh(rows[mesher]))]
            if told:
                mean = {key: [statistics.fmean(row[key][k] for _, row in told) for k in range(3)] for key in ("below", "volume_below")}
                lines.append(f"| {part} | {mesher} | {len(told)} of {len(whole)} | "
                             f"{statistics.median(row['tetrahedra'] / regular(rows) for rows, row in told):.2f} | {cad.percent(mean, 'below')} | "
                             f"{cad.percent(mean, 'volume_below')} | {statistics.fmean(row['seconds'] for _, row in told):.2f} |")
    return lines


def line(name, part, mesher, rows):
    row = rows[mesher]
    if not cad.is_mesh(row):
        return f"| {name} | {part} | {mesher} | {row['failed']} | | | | |"
    why = "" if mesher not in PEERS or mesher in peers_of(rows) else " (other size)" if mesher in cad.peers_of(rows) else " (other volume)"
    return (f"| {name} | {part} | {mesher}{why} | {row['tetrahedra']} | {cad.percent(row, 'below')} | {cad.percent(row, 'volume_below')} | "
            f"{row['min_dihedral']:.3g} | {row['seconds']:.2f} |")


def section(results, timeout):
    """Lines of docs/field.md."""
    text = [HEADING, "", f"The demo part and {len(results) - 1} surfaces of the corpus by the rule in `bench/sizes.py`, with `--size` 1, 1/2, 1/4 and 1/8 of "
            f"their mean edge; no mesh for which regular tetrahedra of that edge would be more than {MOST_ELEMENTS:,}. TetGen (`-pYq1.4a...`) and Gmsh have the "
            f"same size. One thread; at most {timeout:.0f} s a mesh; HXT is not tried at sizes below one at which it exceeds "
            "that. Seconds are CPU time with files read and written.", "", *targets(results), "",
            *means(results), "",
            "| surface | size | mesher | tetrahedra | % below 10 / 20 / 30 degrees | by volume | least angle | CPU s |", "|---|---|---|---|---|---|---|---|"]
    return text + [line(name, part, mesher, rows) for name, sizes in results.items() for part, rows in sizes.items()
                   for mesher in (OURS, FAST, *PEERS) if mesher in rows]


def run(options, rows, folder, scratch, write):
    """Measures, and hands the section to `write` after each surface. `rows` keeps what is measured."""
    results = {}
    bench = SizesBench(options, scratch)
    for surface in surfaces(folder, scratch, options.sizes_count):
        sizes, late = {}, {}
        for part, size in parts_of(surface).items():
            sizes[part] = {"size": size}
            for what in MEASURED:
                sizes[part] |= late if what == OF_HXT and late else rows.get(group_of(what, part), surface.resolve(), bench)
            if sizes[part][HXT].get("failed", "").startswith("exceeds"):
                late = {HXT: sizes[part][HXT]}
            print("\n".join(line(surface.stem, part, mesher, sizes[part]) for mesher in (OURS, FAST, *PEERS)), flush=True)
        results[surface.stem] = sizes
        write(section(results, options.timeout))
