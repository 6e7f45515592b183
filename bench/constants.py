"""The effect of constants of a stage (src/*/*tuning.h): meshes a sample of a corpus with other values.

    constants.py CONSTANT=VALUE ... [--mode fill|field|noflips|untangle] [--corpus DIR] [--count N] [--build DIR]

One row per value, and one for the current values: seconds of CPU, points added, ratio of the worst Q (geometric
mean; how many surfaces are better and worse), elements below 10 degrees, surfaces without a mesh. With `untangle`, the
inner vertices of half of each mesh are displaced first, and the row has refilled cavities instead of points.
The header is changed in place for each build and restored at the end, so it must be committed.
"""
import argparse
import json
import math
import random
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MODES = {"fill": ["--fill"], "field": [], "noflips": ["--fill", "--without", "flips"]}
FORMATS = {".off", ".stl", ".obj", ".ply", ".mesh"}
MOST_BYTES, MOST_SECONDS = 300_000, 60


def sample(corpus, count):
    files = sorted(f for f in corpus.rglob("*") if f.suffix in FORMATS and f.stat().st_size < MOST_BYTES)
    random.Random(27).shuffle(files)
    return files[:count]


def run(command):
    """Seconds of CPU."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        subprocess.run(command, capture_output=True, timeout=MOST_SECONDS)
    except subprocess.TimeoutExpired:
        pass
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before.ru_utime


def displace(path, seed):
    """Displaces half of the free vertices of a .mesh file by a tenth of its size."""
    lines = path.read_text().split("\n")
    first = next(i for i, line in enumerate(lines) if line.strip() == "Vertices") + 2
    points = [[float(x) for x in line.split()[:3]] for line in lines[first:first + int(lines[first - 1])]]
    held = set()
    at = next(i for i, line in enumerate(lines) if line.strip() == "Triangles") + 2
    for line in lines[at:at + int(lines[at - 1])]:
        held.update(int(v) - 1 for v in line.split()[:3])
    size = max(max(p[k] for p in points) - min(p[k] for p in points) for k in range(3))
    rng = random.Random(seed)
    for v, p in enumerate(points):
        if v not in held and rng.random() < 0.5:
            lines[first + v] = " ".join(repr(x + rng.uniform(-0.1, 0.1) * size) for x in p) + " 0"
    path.write_text("\n".join(lines))


def measured(program, surface, mode, work):
    """A row of figures of one mesh; empty without a mesh."""
    out, report = work / "out.mesh", work / "report.json"
    for path in (out, report):
        path.unlink(missing_ok=True)
    if mode == "untangle":
        tangled = work / (surface.stem + "-tangled.mesh")
        if not tangled.exists():
            run([program, "mesh", surface, "-o", tangled, "--keep", "auto"])
            if not tangled.exists():
                return None
            displace(tangled, 1)
        seconds = run([program, "untangle", tangled, "-o", out, "--report", report])
    else:
        seconds = run([program, "mesh", surface, "-o", out, "--keep", "auto", "--report", report, *MODES[mode]])
    if not out.exists():
        return {"seconds": seconds}
    found = json.loads(report.read_text())
    if mode == "untangle":
        return {"seconds": seconds, "points": found["cavities"], "q": 1.0, "below": 0}
    return {"seconds": seconds, "points": found["steiner"]["count"], "q": found["quality"]["worst"],
            "below": found["quality"]["below_10_deg"]}


def row(name, rows, base):
    pairs = [(r, b) for r, b in zip(rows, base) if r and b and "q" in r and "q" in b]
    logs = [math.log(r["q"] / b["q"]) for r, b in pairs if 0 < r["q"] < math.inf and 0 < b["q"] < math.inf]
    better, worse = sum(x < -1e-9 for x in logs), sum(x > 1e-9 for x in logs)
    total = lambda key: sum(r[key] for r, _ in pairs)
    ratio = math.exp(sum(logs) / max(1, len(logs)))
    seconds = sum(r["seconds"] for r in rows if r)
    print(f"| {name} | {seconds:.1f} s | {total('points')} | {ratio:.3f} ({better} better, {worse} worse) "
          f"| {total('below')} | {sum('q' not in r for r in rows if r)} |", flush=True)


def header_of(constant):
    """The header that defines it."""
    pattern = re.compile(rf"\b{constant}(\s*=\s*|\{{)")
    for path in sorted(ROOT.glob("src/*/*tuning.h")):
        if pattern.search(path.read_text()):
            return path
    sys.exit(f"no src/*/*tuning.h defines {constant}")


def with_value(text, constant, value):
    """The header with another value of a constant: `name = value` up to the next comma or semicolon, or `name{...}`."""
    changed, count = re.subn(rf"\b{constant}(\s*=\s*)(\{{[^}}]*\}}|[^,;]+)", rf"{constant}\g<1>{value}", text, count=1)
    if not count:
        changed, count = re.subn(rf"\b{constant}\{{[^}}]*\}}", f"{constant}{{{value}}}", text, count=1)
    return changed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("settings", nargs="+", metavar="CONSTANT=VALUE")
    parser.add_argument("--mode", choices=[*MODES, "untangle"], default="fill")
    parser.add_argument("--corpus", type=Path, default=ROOT / "../shared/corpus")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    args = parser.parse_args()
    program = args.build / "holdfast"
    surfaces = sample(args.corpus, args.count)
    if not surfaces:
        sys.exit(f"no surfaces in {args.corpus}")

    def build():
        subprocess.run(["cmake", "--build", args.build, "--target", "holdfast_cli"], check=True, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as folder:
        measure = lambda: [measured(program, s, args.mode, Path(folder)) for s in surfaces]
        build()
        base = measure()
        print(f"{len(surfaces)} surfaces, {args.mode}\n"
              f"| value | CPU | {'cavities' if args.mode == 'untangle' else 'points'} | worst Q | below 10 degrees | no mesh |\n"
              "|---|---|---|---|---|---|")
        row("as it stands", base, base)
        for setting in args.settings:
            constant, value = setting.split("=", 1)
            header = header_of(constant)
            text = header.read_text()
            if subprocess.run(["git", "diff", "--quiet", "HEAD", "--", header], cwd=ROOT).returncode != 0:
                sys.exit(f"{header} has changes that are not committed")
            try:
                header.write_text(with_value(text, constant, value))
                build()
                row(setting, measure(), base)
            finally:
                header.write_text(text)
        build()


if __name__ == "__main__":
    main()
