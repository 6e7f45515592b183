"""§2.4 and §7 measured: points that partition makes alone and with elimination, in three orders; swaps; ears; equation (1)."""
import json
import os
import resource
import sys
from math import ceil, log

import plane_inputs
from models import ROOT
from process import run

ORDERS = ("given", "random", "halving")
SIZES = (8, 16, 32, 64, 128, 256, 512, 1024)
SPACE = (2, 3, 4, 5, 6, 8, 12, 16, 24, 32)
CHAZELLE = (2, 3, 4, 6, 8, 12, 16)
# A run that reaches one of these has no number but says so, and ends its series.
LIMIT = 3600  # seconds of the clock
PATIENCE = 2  # times the seconds of the processor after which a series ends
MEMORY = min(12 << 30, os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") * 3 // 4)


class Beyond(Exception):
    """A run reached a limit, which the text names."""


def power(sizes, counts):
    """Slope of log(count) over log(size) by least squares, from the larger half of the sizes."""
    pairs = [(log(n), log(c)) for n, c in zip(sizes, counts) if c and not isinstance(c, str)]
    pairs = pairs[len(pairs) // 2 if len(pairs) > 3 else 0:]
    if len(pairs) < 2:
        return None
    mx, my = (sum(v) / len(pairs) for v in zip(*pairs))
    return sum((x - mx) * (y - my) for x, y in pairs) / sum((x - mx) ** 2 for x, _ in pairs)


def processor_time():
    """Seconds of all programs run so far, whatever else the machine does."""
    told = resource.getrusage(resource.RUSAGE_CHILDREN)
    return told.ru_utime + told.ru_stime


def limited(command, seconds):
    """Runs a program that may take so many seconds of the processor."""
    done = run(["prlimit", f"--cpu={ceil(seconds)}", f"--as={MEMORY}", *command], LIMIT)
    if done.code == 0:
        return
    if "out of memory" in done.output:
        raise Beyond(f"over {MEMORY / 2**30:.0f} GiB")
    if done.code in (None, -9, -24):  # by the clock; SIGKILL, SIGXCPU
        raise Beyond(f"over {LIMIT if done.code is None else ceil(seconds):,} s")
    raise RuntimeError(f"{' '.join(map(str, command))} ended with {done.code}: {done.output}")


def grow(name, sizes, rows, measure, most_seconds):
    """Rows of growing cases, up to the first that takes longer than that, or reaches a limit, which then stands for its number."""
    told = []
    for n in sizes:
        def timed(n=n):
            started = processor_time()
            try:
                value = measure(n, PATIENCE * most_seconds)
            except Beyond as beyond:
                value = str(beyond)
            return {"value": value, "seconds": processor_time() - started}

        row = rows.get(f"{name}, n = {n}, at most {most_seconds:g} s", timed)
        told.append((n, row["value"]))
        if row["seconds"] > most_seconds or isinstance(row["value"], str):
            break
    return told


# -------------------------------------------------------------------------------------------------- plane


def plane_points(options, folder, rows, order, alone):
    def measure(n, seconds):
        given = plane_inputs.quadrilateral(n, n)
        call = ("--hull", "--method", "partition", "--order", order)
        if not alone:
            return run_plane(options, folder, given, seconds, *call)["partition_points"]
        # All of them are in the output, and a report of each would take most of the memory.
        with plane_output(options, folder, given, seconds, *call, "--stop-after", "partition").open(encoding="ascii") as file:
            next(file)  # OFF
            return int(next(file).split()[0]) - len(given.points)

    return grow(f"Fig. 4, partition{' alone' if alone else ''}, {order}", SIZES, rows, measure,
                options.most_seconds_alone if alone else options.most_seconds)


def plane_output(options, folder, given, seconds, *extra):
    poly, out = folder / "in.poly", folder / "out.off"
    given.write(poly)
    limited([options.build / "holdfast", "plane", poly, "-o", out, "-q", *extra], seconds)
    return out


def run_plane(options, folder, given, seconds, *extra):
    report = folder / "report.json"
    plane_output(options, folder, given, seconds, "--report", report, *extra)
    return json.loads(report.read_text(encoding="utf-8"))


def plane_swaps(options, folder, rows, order):
    def measure(n, seconds):
        return run_plane(options, folder, plane_inputs.quadrilateral(n, n), seconds, "--hull", "--method", "swaps", "--order", order)["swaps"]

    return grow(f"Fig. 4, swaps, {order}", SIZES, rows, measure, options.most_seconds)


def ears(options, folder, rows, kind):
    """Seconds of the processor, of the whole program."""
    def measure(n, seconds):
        given, started = getattr(plane_inputs, kind)(n), processor_time()
        run_plane(options, folder, given, seconds, "--method", "ears")
        return processor_time() - started

    return grow(f"ears, {kind}", [2 ** k for k in range(10, 18)], rows, measure, options.most_seconds)


def equation_1(options, folder, rows, n, m):
    """Points on each segment in the order that equation (1) assumes, from the top."""
    def measure():
        told = run_plane(options, folder, plane_inputs.pencil(n, m), options.most_seconds_alone, "--hull", "--method", "partition", "--order",
                         "given", "--stop-after", "partition")
        return [len(chain["vertices"]) - 2 for chain in told["intermediate"]["chains"]]

    return rows.get(f"equation (1), n = {n}, m = {m}", measure)


# --------------------------------------------------------------------------------------------------- space


def run_space(options, folder, seconds, script, arguments, *extra):
    surface, report = folder / "in.off", folder / "report.json"
    run([sys.executable, ROOT / "examples" / script, arguments[0], surface, *arguments[1:]])
    limited([options.build / "holdfast", "mesh", surface, "-o", folder / "out.meshb", "--fill", "-q", "--report", report, *extra], seconds)
    return counts_in(report)


def counts_in(report):
    """A report without its list of what each added point lies on, which may be as long as the mesh; the report is indented by two."""
    lines, within = [], False
    with report.open(encoding="utf-8") as file:
        for line in file:
            within = within or line.startswith('  "intermediate": {')
            if not within:
                lines.append(line)
            elif line.startswith("  }"):
                within = False
    return json.loads("".join(lines))


def space_points(options, folder, rows, order, stage, key):
    def measure(n, seconds):
        told = run_space(options, folder, seconds, "make_paper.py", ["worst", "-n", str(n), "-m", str(n), "--height", "0.05"], "--without",
                         "flips", "--order", order, "--stop-after", stage)
        return {k: told["partition"][k] for k in ("segment_points", "facet_points")}

    told = grow(f"Fig. 13, {stage}, {order}", SPACE, rows, measure,
                options.most_seconds_space if stage == "partition" else options.most_seconds)
    return [(n, value if isinstance(value, str) else value[key] if key else sum(value.values())) for n, value in told]


def chazelle(options, folder, rows):
    def measure(n, seconds):
        told = run_space(options, folder, seconds, "make_hard.py", ["chazelle", "-n", str(n), "--gap", repr(0.5 / n**2)])
        return told["mesh"]["tetrahedra"]

    return grow("Chazelle", CHAZELLE, rows, measure, options.most_seconds)


# ---------------------------------------------------------------------------------------------------- text


def in_a_cell(value):
    return "" if value is None else f"{value:,}" if isinstance(value, int) else f"{value:.2g}" if isinstance(value, float) else value


def table(series, paper):
    """One row a series of (n, count): its counts, the power that fits the larger half, and the paper's."""
    sizes = sorted({n for told in series.values() for n, _ in told})
    lines = ["| what | " + " | ".join(f"{n:,}" for n in sizes) + " | power | paper |", "|---|" + "---:|" * (len(sizes) + 2)]
    for name, told in series.items():
        counts = dict(told)
        fitted = power(*zip(*told)) if told else None
        shown = [in_a_cell(counts.get(n)) for n in sizes]
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
