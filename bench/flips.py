"""The cost of the stress test: `--without flips`, so that partition and elimination do all the work, compared with the
run with flips, on parts that people made (surfaces of the corpus that no program generated). CPU time of the whole process."""
import shutil
from statistics import median, quantiles

import sample
from mesh import QUICK, holdfast, medians
from process import take_turns

LIMIT = 20_000  # triangles
WITHIN = 5  # the promised ratio


def turns(first):
    return 3 if max((r.cpu for r in first), default=0) < QUICK else 1


def measure(options, folder, surface):
    shutil.copyfile(surface.path, folder / "surface.off")
    told = take_turns({"with": lambda: holdfast(options, folder),
                       "without": lambda: holdfast(options, folder, "--without", "flips")}, turns)
    return {"name": surface.name, "triangles": surface.triangles, **{name: medians(t)["cpu"] for name, t in told.items()}}


def bench(options, folder, rows):
    if not options.surfaces_in:
        return sample.ABSENT, None
    real = [s for s in sample.closed_surfaces(options.surfaces_in) if s.triangles <= LIMIT and not s.generated]
    chosen = sample.evenly(real, options.real)
    told = [rows.get(f"{s.name}, limit of {options.timeout:.0f} s", measure, options, folder, s) for s in chosen]
    failed = [r["name"] for r in told if not r["with"] or not r["without"]]
    both = sorted((r for r in told if r["with"] and r["without"]), key=lambda r: r["with"] / r["without"])
    lines = [f"{len(told)} of the corpus's {len(real)} valid closed surfaces of up to {LIMIT:,} triangles that no program generated, "
             f"evenly over all sizes; CPU time of the whole process, median of three turns, one where a turn takes over {QUICK} s.", ""]
    if not both:
        return [*lines, "None was meshed both ways."], None
    ratios = [r["without"] / r["with"] for r in both]
    low, _, high = quantiles(ratios, n=4) if len(ratios) > 1 else 3 * ratios
    above = sum(x > WITHIN for x in ratios)
    lines += [f"Without flips over with flips: median **{median(ratios):.2f}**, quartiles {low:.2f} and {high:.2f}; above {WITHIN} on "
              f"{above} of {len(both)}. Not meshed within {options.timeout:.0f} s: {', '.join(failed) or 'none'}.", "",
              "| the ten worst | triangles | with flips, s | without, s | ratio |", "|---|---:|---:|---:|---:|",
              *(f"| {r['name']} | {r['triangles']:,} | {r['with']:.3f} | {r['without']:.3f} | {r['without'] / r['with']:.2f} |"
                for r in both[:10])]
    return lines, {"surfaces": len(told), "in_corpus": len(real), "median": median(ratios), "worst": max(ratios), "above": above,
                   "failed": len(failed)}
