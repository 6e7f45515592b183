"""§2.4 and §7 measured: points that partition makes alone and with elimination, in three orders; swaps; ears; equation (1)."""
import json
import resource
import sys
from math import log

import plane_inputs
from models import ROOT
from process import run

ORDERS = ("given", "random", "halving")
SIZES = (8, 16, 32, 64, 128, 256, 512, 1024)
SPACE = (2, 3, 4, 5, 6, 8, 12, 16, 24, 32)
CHAZELLE = (2, 3, 4, 6, 8, 12, 16)
LIMIT = 3600  # seconds of the clock: a run beyond it has no result


def power(sizes, counts):
    """Slope of log(count) over log(size) by least squares, from the larger half of the sizes."""
    pairs = [(log(n), log(c)) for n, c in zip(sizes, counts) if c]
    pairs = pairs[len(pairs) // 2 if len(pairs) > 3 else 0:]
    if len(pairs) < 2:
        return None
    mx, my = (sum(v) / len(pairs) for v in zip(*pairs))
    return sum((x - mx) * (y - my) for x, y in pairs) / sum((x - mx) ** 2 for x, _ in pairs)


def processor_time():
    """Seconds of all programs run so far, whatever else the machine does."""
    told = resource.getrusage(resource.RUSAGE_CHILDREN)
    return told.ru_utime + told.ru_stime


def grow(name, sizes, rows, measure, most_seconds):
    """Rows of growing cases, up to the first that takes longer than that, or fails."""
    told = []
    for n in sizes:
        def timed(n=n):
            started = processor_time()
            return {"value": measure(n), "seconds": processor_time() - started}

        row = rows.get(f"{name}, n = {n}", timed)
        if row["value"] is None:
            break
        told.append((n, row["value"]))
        if row["seconds"] > most_seconds:
            break
    return told


# -------------------------------------------------------------------------------------------------- plane


def seconds_of(options, alone):
    """Partition alone grows so fast that its series would end at small sizes."""
    return options.most_seconds_alone if alone else options.most_seconds


def plane_points(options, folder, rows, order, alone):
    def measure(n):
        extra = ["--stop-after", "partition"] if alone else []
        told = run_plane(options, folder, plane_inputs.quadrilateral(n, n), "--hull", "--method", "partition", "--order", order, *extra)
        return told and told["partition_points"]

    return grow(f"Fig. 4, partition{' alone' if alone else ''}, {order}", SIZES, rows, measure, seconds_of(options, alone))


def run_plane(options, folder, given, *extra):
    poly, out, report = folder / "in.poly", folder / "out.off", folder / "report.json"
    given.write(poly)
    done = run([options.build / "holdfast", "plane", poly, "-o", out, "--report", report, "-q", *extra], LIMIT)
    return json.loads(report.read_text(encoding="utf-8")) if done.code == 0 else None


def plane_swaps(options, folder, rows, order):
    def measure(n):
        told = run_plane(options, folder, plane_inputs.quadrilateral(n, n), "--hull", "--method", "swaps", "--order", order)
        return told and told["swaps"]

    return grow(f"Fig. 4, swaps, {order}", SIZES, rows, measure, options.most_seconds)


def ears(options, folder, rows, kind):
    def measure(n):
        told = run_plane(options, folder, getattr(plane_inputs, kind)(n), "--method", "ears")
        return told and told["ears"]

    name = f"ears, {kind}"
    told = grow(name, [2 ** k for k in range(10, 18)], rows, measure, options.most_seconds)
    return [(n, rows.rows[f"{name}, n = {n}"]["seconds"]) for n, _ in told]  # of the processor, whole program


def equation_1(options, folder, rows, n, m):
    """Points on each segment in the order that equation (1) assumes, from the top."""
    def measure():
        told = run_plane(options, folder, plane_inputs.pencil(n, m), "--hull", "--method", "partition", "--order", "given",
                         "--stop-after", "partition")
        return [len(chain["vertices"]) - 2 for chain in told["intermediate"]["chains"]]

    return rows.get(f"equation (1), n = {n}, m = {m}", measure)


# --------------------------------------------------------------------------------------------------- space


def run_space(options, folder, script, arguments, *extra):
    surface, report = folder / "in.off", folder / "report.json"
    run([sys.executable, ROOT / "examples" / script, arguments[0], surface, *arguments[1:]])
    done = run([options.build / "holdfast", "mesh", surface, "-o", folder / "out.meshb", "--fill", "-q", "--report", report, *extra],
               LIMIT)
    return json.loads(report.read_text(encoding="utf-8")) if done.code == 0 else None


def space_points(options, folder, rows, order, stage, key):
    def measure(n):
        told = run_space(options, folder, "make_paper.py", ["worst", "-n", str(n), "-m", str(n), "--height", "0.05"], "--without",
                         "flips", "--order", order, "--stop-after", stage)
        return told and {k: told["partition"][k] for k in ("segment_points", "facet_points")}

    told = grow(f"Fig. 13, {stage}, {order}", SPACE, rows, measure, seconds_of(options, stage == "partition"))
    return [(n, value[key] if key else sum(value.values())) for n, value in told]


def chazelle(options, folder, rows):
    def measure(n):
        told = run_space(options, folder, "make_hard.py", ["chazelle", "-n", str(n), "--gap", repr(0.5 / n**2)])
        return told and told["mesh"]["tetrahedra"]

    return grow("Chazelle", CHAZELLE, rows, measure, options.most_seconds)


# ---------------------------------------------------------------------------------------------------- text


def table(series, paper):
    """One row a series of (n, count): its counts, the power that fits the larger half, and the paper's."""
    sizes = sorted({n for told in series.values() for n, _ in told})
    lines = ["| what | " + " | ".join(f"{n:,}" for n in sizes) + " | power | paper |", "|---|" + "---:|" * (len(sizes) + 2)]
    for name, told in series.items():
        counts = dict(told)
        fitted = power(*zip(*told)) if told else None
        shown = [f"{counts[n]:,}" if isinstance(counts.get(n), int) else f"{counts[n]:.2g}" if n in counts else "" for n in sizes]
        lines.append(f"| {name} | " + " | ".join(shown) + f" | {'' if fitted is None else f'{fitted:.2f}'} | {paper.get(name, '')} |")
    return lines


def plane_lines(options, folder, rows):
    series = {}
    for order in ORDERS:
        series[f"partition alone, {order}"] = plane_points(options, folder, rows, order, True)
    for order in ORDERS:
        series[f"with elimination, {order}"] = plane_points(options, folder, rows, order, False)
    for order in ("given", "random"):
        series[f"swaps, {order}"] = plane_swaps(options, folder, rows, order)
    paper = {f"partition alone, {o}": "n^3" for o in ORDERS} | {f"with elimination, {o}": "n^2" for o in ORDERS}
    paper |= {f"swaps, {o}": "at most n^2" for o in ORDERS}
    paper["partition alone, halving"] = "the same order, lower constant"
    return table(series, paper), series


def ears_lines(options, folder, rows):
    series = {"ears, convex: seconds": ears(options, folder, rows, "convex"), "ears, r = n / 2: seconds": ears(options, folder, rows, "comb")}
    return table(series, {"ears, convex: seconds": "n", "ears, r = n / 2: seconds": "n (1 + r), here n^2"})


def equation_lines(options, folder, rows):
    n, m = 1024, 16
    counts = equation_1(options, folder, rows, n, m)
    lines = ["| segment k | " + " | ".join(str(k) for k in range(m)) + " | sum |", "|---|" + "---:|" * (m + 1),
             "| equation (1): (k + 1) n | " + " | ".join(f"{(k + 1) * n:,}" for k in range(m)) + f" | {n * m * (m + 1) // 2:,} |",
             "| measured | " + " | ".join(f"{c:,}" for c in counts) + f" | {sum(counts):,} |",
             "| difference | " + " | ".join(str(c - (k + 1) * n) for k, c in enumerate(counts)) + f" | {sum(counts) - n * m * (m + 1) // 2} |"]
    return lines, counts


def space_lines(options, folder, rows):
    series, paper = {}, {}
    for order in ORDERS:
        name = f"partition of edges alone, {order}"
        series[name], paper[name] = space_points(options, folder, rows, order, "partition", "segment_points"), "n^4"
    for order in ORDERS:
        name = f"partition of edges and facets, {order}"
        series[name], paper[name] = space_points(options, folder, rows, order, "partition", None), "n^4 and worse"
    for order in ORDERS:
        name = f"with elimination, {order}"
        series[name], paper[name] = space_points(options, folder, rows, order, "eliminate", None), "less"
    return table(series, paper), series


def chazelle_lines(options, folder, rows):
    told = chazelle(options, folder, rows)
    return table({"tetrahedra": told}, {"tetrahedra": "at least n^2"})
