"""Tessellated CAD parts, which are full of needles: the second group of field.py, compared with TetGen, Gmsh and Netgen.

The sample is fixed by a rule: the first of the valid, closed surfaces of the corpus of more than 1,000 triangles whose
names indicate CAD (CAD_NAMES), in the order of the SHA-256 of their names. Holdfast runs with its default options. Seconds are CPU
time of whole processes, files and all; Holdfast and TetGen take turns, and medians count. The others run once; each has --timeout seconds
of processor time per surface. A peer's mesh counts if all of its elements are positive and its volume is Holdfast's to SAME_VOLUME.
"""
import hashlib
import statistics
from typing import NamedTuple

import sample
from meshers import Meshers
from target import Target, table

HEADING = "## Tessellated CAD parts"
CAD_NAMES = ("kicad_", "prusa_", "mendel_", "stepcode_", "pyocc_", "netgen_")
LEAST_TRIANGLES = 1000
TURNS = 3
OURS, FAST = "Holdfast", "Holdfast fast"
PEERS = ("TetGen", "Gmsh HXT", "Gmsh Delaunay", "Netgen")
EFFORTS = ("Holdfast fill", FAST, OURS, "Holdfast best")  # each no worse than the one before
OPTIONS = {"Holdfast fill": ["--fill"], FAST: ["--quality", "fast"], OURS: [], "Holdfast best": ["--quality", "best"]}
SAME_VOLUME = 1e-6  # of the volume
SHARE = 0.9  # of the surfaces, for the targets
MOST_ELEMENTS = 1.3
MOST_CPU = {OURS: 1.0, FAST: 0.5}


def surfaces(folder, count):
    """The first `count` of the rule's order, so that a smaller sample is part of a larger one."""
    chosen = [s.path for s in sample.closed_surfaces(folder) if s.name.startswith(CAD_NAMES) and s.triangles > LEAST_TRIANGLES]
    return sorted(chosen, key=lambda path: hashlib.sha256(path.stem.encode()).digest())[:count]


class CadBench(Meshers):
    """Processor seconds, on whatever memory there is."""

    def __init__(self, options, folder):
        super().__init__(options, folder, memory=0)
        self.programs = self.peers() | {name: lambda s, words=words: self.holdfast(s, *words) for name, words in OPTIONS.items()}

    def turns(self, meshers, surface, turns):
        return self.in_turns({mesher: self.programs[mesher] for mesher in meshers}, surface, turns, lambda made: made.cpu)


# What is measured together.
GROUPS = {"cad": lambda bench, surface: bench.turns((OURS, FAST, "TetGen"), surface, TURNS),
          "cad peers": lambda bench, surface: bench.turns(PEERS[1:], surface, 1),
          "cad efforts": lambda bench, surface: bench.turns((EFFORTS[0], EFFORTS[-1]), surface, 1)}
OF_HOLDFAST = ("cad", "cad efforts")


class Figure(NamedTuple):
    """The figures that are compared with peers; less is better."""
    text: str
    of: object


SHARES = [Figure(f"below {10 * (k + 1)} degrees", lambda row, k=k: row["below"][k]) for k in range(3)]
VOLUME_SHARES = [Figure(f"below {10 * (k + 1)} degrees by volume", lambda row, k=k: row["volume_below"][k]) for k in range(3)]
LEAST_ANGLE = Figure("least angle", lambda row: -row["min_dihedral"])
MEAN_Q = Figure("mean Q", lambda row: row["mean_q"])


def is_mesh(row):
    return row is not None and "failed" not in row


def peers_of(rows):
    """Verified meshes of the same volume by others."""
    ours = rows[OURS]
    return {peer: row for peer in PEERS if is_mesh(row := rows.get(peer)) and row["not_positive"] == 0 and
            (not is_mesh(ours) or abs(row["volume"] - ours["volume"]) <= SAME_VOLUME * abs(ours["volume"]))}


def is_worse(figure, row, other):
    """Beyond the rounding of writing and measuring."""
    x, y = figure.of(row), figure.of(other)
    return x > y + 1e-6 * abs(y) + 1e-9


def holds(figure, rows):
    """Whether no peer is better."""
    return is_mesh(rows[OURS]) and not any(is_worse(figure, rows[OURS], row) for row in peers_of(rows).values())


def elements_ratio(rows):
    """Ratio of our number to the largest of those peers that have the least of some share; None without peers."""
    peers = peers_of(rows).values()
    if not peers or not is_mesh(rows[OURS]):
        return None
    best = [row for row in peers if any(figure.of(row) == min(map(figure.of, peers)) for figure in SHARES)]
    return rows[OURS]["tetrahedra"] / max(row["tetrahedra"] for row in best)


def shares_target(figure, results, least):
    held = sum(holds(figure, rows) for rows in results.values())
    return Target(f"{figure.text[0].upper()}{figure.text[1:]} no larger than the best peer's on {10 * least:.0f} of 10",
                  f"on {held} of {len(results)}", held >= least * len(results))


def elements_target(results):
    ratios = [ratio for rows in results.values() if (ratio := elements_ratio(rows)) is not None]
    within = sum(ratio <= MOST_ELEMENTS for ratio in ratios)
    return Target(f"Number of tetrahedra at most {MOST_ELEMENTS} times the largest of those peers that hold one of the three shares, on 9 of 10",
                  f"on {within} of {len(ratios)}; median {statistics.median(ratios):.2f}, most {max(ratios):.2f}" if ratios else "no peers",
                  within >= SHARE * len(ratios) if ratios else None)


def all_target(results):
    """All conditions on the same surface, for nine of ten."""
    held = sum(all(holds(figure, rows) for figure in (*SHARES, LEAST_ANGLE)) and (elements_ratio(rows) or 0) <= MOST_ELEMENTS
               for rows in results.values())
    return Target("All of these (by number) on one and the same surface, on 9 of 10", f"on {held} of {len(results)}",
                  held >= SHARE * len(results))


def cpu_target(mesher, results):
    ratios = [rows[mesher]["seconds"] / rows["TetGen"]["seconds"] for rows in results.values()
              if is_mesh(rows[mesher]) and is_mesh(rows["TetGen"])]
    most = MOST_CPU[mesher]
    text = f"CPU time of {mesher} at most {most} of TetGen's on the median"
    if not ratios:
        return Target(text, "not measured", None)
    middle = statistics.median(ratios)
    return Target(text, f"{middle:.2f}; {min(ratios):.2f} to {max(ratios):.2f}", middle <= most)


def effort_targets(results):
    """More effort, and field points, make no figure worse."""
    for less, more in zip(EFFORTS, EFFORTS[1:]):
        pairs = {name: (rows[more], rows[less]) for name, rows in results.items() if is_mesh(rows.get(more)) and is_mesh(rows.get(less))}
        worse = [name for name, (row, other) in pairs.items()
                 if any(is_worse(figure, row, other) for figure in (LEAST_ANGLE, SHARES[0], MEAN_Q))]
        yield Target(f"{more} no worse than {less} in least angle, share below 10 degrees and mean Q",
                     f"on {len(pairs) - len(worse)} of {len(pairs)}" + "".join(f"; not {name}" for name in worse), not worse if pairs else None)


def targets(results):
    return table([*(shares_target(figure, results, SHARE) for figure in SHARES),
                  *(shares_target(figure, results, SHARE - 0.1) for figure in VOLUME_SHARES),
                  shares_target(LEAST_ANGLE, results, SHARE)._replace(text="Least angle no smaller than the best peer's on 9 of 10"),
                  elements_target(results), all_target(results), *(cpu_target(mesher, results) for mesher in MOST_CPU),
                  *effort_targets(results)])


def percent(row, key):
    return " / ".join(f"{x:.3g}" for x in row[key][:3])


def means(results):
    lines = ["| mesher | surfaces | tetrahedra, mean | below 10 / 20 / 30 degrees, mean % | by volume | least angle, median | CPU s, mean |",
             "|---|---|---|---|---|---|---|"]
    whole = {name: rows for name, rows in results.items() if is_mesh(rows[OURS])}
    for mesher in (*reversed(EFFORTS), *PEERS):
        peer = mesher in PEERS
        rows = [r[mesher] for r in whole.values() if (mesher in peers_of(r) if peer else is_mesh(r.get(mesher)))]
        if not rows:
            continue
        mean = {key: [statistics.mean(r[key][k] for r in rows) for k in range(3)] for key in ("below", "volume_below")}
        lines.append(f"| {mesher} | {len(rows)} of {len(results)} | {statistics.mean(r['tetrahedra'] for r in rows):.0f} | {percent(mean, 'below')} "
                     f"| {percent(mean, 'volume_below')} | {statistics.median(r['min_dihedral'] for r in rows):.2g} "
                     f"| {statistics.mean(r['seconds'] for r in rows):.2f} |")
    return lines


def line(name, mesher, rows):
    row = rows[mesher]
    if not is_mesh(row):
        return f"| {name} | {mesher} | {row['failed']} | | | | |"
    other = "" if mesher not in PEERS or mesher in peers_of(rows) else " (other volume)"
    return (f"| {name} | {mesher}{other} | {row['tetrahedra']} | {percent(row, 'below')} | {percent(row, 'volume_below')} | "
            f"{row['min_dihedral']:.3g} | {row['seconds']:.2f} |")


def section(results, timeout):
    """Lines of docs/field.md."""
    text = [HEADING, "", f"{len(results)} surfaces of the corpus by the rule in `bench/cad.py`; Holdfast with its default options; one thread; at most "
            f"{timeout:.0f} s a surface. Seconds are CPU time with files read and written.", "", *targets(results), "", *means(results), "",
            "| surface | mesher | tetrahedra | % below 10 / 20 / 30 degrees | by volume | least angle | CPU s |", "|---|---|---|---|---|---|---|"]
    text += [line(name, mesher, rows) for name, rows in results.items() for mesher in (*reversed(EFFORTS), *PEERS) if mesher in rows]
    return text


def run(options, rows, folder, scratch, write):
    """Measures, and hands the section to `write` after each surface. `rows` keeps what is measured."""
    results = {}
    bench = CadBench(options, scratch)
    for surface in surfaces(folder, options.cad_count):
        told = {}
        for group in GROUPS:
            told |= rows.get(group, surface.resolve(), bench)
        results[surface.stem] = told
        print("\n".join(line(surface.stem, mesher, told) for mesher in told), flush=True)
        write(section(results, options.timeout))
