"""Whether other random orders do better without field points: the fourth group of field.py.

The sample is fixed by a rule: the first of the valid, closed surfaces of the corpus of at most MOST_TRIANGLES
triangles, in the order of the SHA-256 of their names. `holdfast mesh --fill` meshes each with its default seed and with
OTHERS more. An element that is flat by chance in one mesh is not flat in another. So seeds agree if no element is flat
unnecessarily: if none of the others has a worst Q (the paper's, 1 is regular; as mesh_shape has it) below 1 / TIMES of
the default's.
"""
import hashlib
import json
import statistics

import sample
from meshers import Meshers, TookTooLong
from target import Target, table

HEADING = "## Other seeds without field points"
MOST_TRIANGLES = 6000
SEED, OTHERS = 1, 10  # the default seed; others follow it
TIMES = 2
SHARE = 0.95  # of the surfaces, for the target


def surfaces(folder, count):
    """The first `count` of the rule's order, so that a smaller sample is part of a larger one."""
    chosen = [s.path for s in sample.closed_surfaces(folder) if s.triangles <= MOST_TRIANGLES]
    return sorted(chosen, key=lambda path: hashlib.sha256(path.stem.encode()).digest())[:count]


class SeedBench(Meshers):
    """Processor seconds, on whatever memory there is."""

    def __init__(self, options, folder):
        super().__init__(options, folder, memory=0)

    def filled(self, surface, seed):
        """The row of one mesh; {"failed": why} without one."""
        try:
            made = self.holdfast(surface, "--fill", "--seed", seed)
        except TookTooLong:
            return {"failed": f"exceeds {self.options.timeout:.0f} s"}
        if made is None:
            return {"failed": "fails"}
        shape = self.shape(made.file)
        target = json.loads((self.folder / "hf.json").read_text())["quality"]["target"]
        return {key: shape[key] for key in ("tetrahedra", "worst_q", "min_dihedral")} | {"target": target, "seconds": made.cpu}

    def all_seeds(self, surface):
        """The default seed's row first."""
        return [self.filled(surface, SEED + k) for k in range(1 + OTHERS)]


GROUPS = {"seeds": SeedBench.all_seeds}
OF_HOLDFAST = ("seeds",)


def best_other(rows):
    """The least worst Q of the other seeds; None if none has a mesh."""
    return min((row["worst_q"] for row in rows[1:] if "failed" not in row), default=None)


def ratio(rows):
    """The factor by which another seed is better; None without meshes."""
    best = best_other(rows)
    return None if "failed" in rows[0] or best is None else rows[0]["worst_q"] / best


def in_targets(rows):
    """The worst Q as a multiple of the triangles' target."""
    return rows[0]["worst_q"] / rows[0]["target"]


def targets(results):
    text = f"`--fill`: none of {OTHERS} other seeds has a worst Q below 1/{TIMES} of the default's, on 19 of 20"
    held = sum(r is not None and r <= TIMES for r in map(ratio, results.values()))
    return table([Target(text, f"on {held} of {len(results)}" if results else "not measured", held >= SHARE * len(results) if results else None)])


def summary(results):
    whole = [rows for rows in results.values() if ratio(rows) is not None]
    if not whole:
        return []
    flat = sum(in_targets(rows) > 10 for rows in whole)
    return [f"The worst Q is {statistics.median(map(in_targets, whole)):.2f} times what the triangles ask for on the median, and more than ten times "
            f"on {flat} surfaces. CPU time of the default seed: median {statistics.median(rows[0]['seconds'] for rows in whole):.2f} s, "
            f"all {sum(rows[0]['seconds'] for rows in whole):.0f} s."]


def line(name, rows):
    if ratio(rows) is None:
        return f"| {name} | {rows[0].get('failed', 'no other mesh')} | | | | |"
    row = rows[0]
    return (f"| {name} | {row['tetrahedra']} | {row['target']:.4g} | {row['worst_q']:.4g} | {best_other(rows):.4g} | {ratio(rows):.2f} |")


def section(results):
    """Lines of docs/field.md: the surfaces on which another seed is better by more than a tenth."""
    told = sorted(((name, rows) for name, rows in results.items() if (ratio(rows) or TIMES) > 1.1), key=lambda item: -(ratio(item[1]) or TIMES))
    return [HEADING, "", f"{len(results)} surfaces of the corpus by the rule in `bench/seeds.py`.", "", *targets(results), "", *summary(results), "",
            "Where another seed is better by more than a tenth:", "",
            "| surface | tetrahedra | target Q | worst Q | least worst Q of another seed | times |", "|---|---|---|---|---|---|",
            *(line(name, rows) for name, rows in told)]


def run(options, rows, folder, scratch, write):
    """Measures, and hands the section to `write` after each surface. `rows` keeps what is measured."""
    results = {}
    bench = SeedBench(options, scratch)
    for surface in surfaces(folder, options.seeds_count):
        results[surface.stem] = rows.get("seeds", surface.resolve(), bench)
        print(line(surface.stem, results[surface.stem]), flush=True)
        write(section(results))
