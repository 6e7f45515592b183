"""Tests the promises of docs/sizes.md on a fixed sample of the corpus: more effort, and field points, make no mesh worse.

    promises.py --build build/release --corpus DIR [--count 40] [--offset 0] [--largest 300] [--cad] [--options "--size 2"]

DIR holds the valid surfaces of the corpus as .off. For each surface of the sample, the meshes of `--fill` and of each quality are
compared by the least dihedral angle, the share of elements below 10 degrees and the mean Q: `fast` with `--fill`, `good` with `fast`,
`best` with `good`. Prints the figures that are worse, and in the end how often.
"""
import argparse
import json
import shlex
import subprocess
import tempfile
from pathlib import Path

import process

MODES = ["fill", "fast", "good", "best"]
FIGURES = {"least angle": lambda r: r["min_dihedral"], "below 10": lambda r: -r["below"][0], "mean Q": lambda r: -r["mean_q"]}
CAD = ("kicad_", "prusa", "mendel", "stepcode")


def measure(options, surface, mode):
    words = ["--fill"] if mode == "fill" else ["--quality", mode, *shlex.split(options.options)]
    volume = options.folder / "out.mesh"
    done = process.run([options.build / "holdfast", "mesh", surface, "-o", volume, "-q", "--threads", "1", *words], options.timeout)
    if done.code != 0 or not volume.exists():
        return None
    shape = subprocess.run([options.shape, volume], check=True, stdout=subprocess.PIPE, text=True).stdout
    volume.unlink()
    return json.loads(shape) | {"cpu": done.cpu}


def is_worse(figure, row, before):
    """Beyond the rounding of writing and measuring."""
    x, y = figure(row), figure(before)
    return x < y - 1e-6 * abs(y) - 1e-9


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--corpus", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--shape", type=lambda p: Path(p).resolve(), help="the program mesh_shape; that of the build by default")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--offset", type=int, default=0)
    parser.add_argument("--largest", type=int, default=300, help="kB")
    parser.add_argument("--cad", action="store_true")
    parser.add_argument("--modes", default=",".join(MODES))
    parser.add_argument("--options", default="", help="with field points")
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--times", action="store_true", help="beside tetgen -pYq1.4")
    options = parser.parse_args()
    options.shape = options.shape or options.build / "mesh_shape"
    modes = options.modes.split(",")
    surfaces = sorted(p for p in options.corpus.glob("*.off") if 3000 < p.stat().st_size < 1000 * options.largest
                      and (not options.cad or p.name.startswith(CAD)))
    chosen = surfaces[options.offset::max(1, len(surfaces) // options.count)][:options.count]
    worse = {}
    compared = 0
    with tempfile.TemporaryDirectory() as folder:
        options.folder = Path(folder)
        for surface in chosen:
            rows = {mode: measure(options, surface, mode) for mode in modes}
            found = []
            for mode, before in zip(modes[1:], modes):
                if rows[mode] is None or rows[before] is None:
                    continue
                compared += mode == modes[-1]
                for name, figure in FIGURES.items():
                    if is_worse(figure, rows[mode], rows[before]):
                        worse[mode, name] = worse.get((mode, name), 0) + 1
                        found.append(f"{mode}: {name} {abs(figure(rows[before])):.6g} -> {abs(figure(rows[mode])):.6g}")
            text = "; ".join(f"{m} {r['tetrahedra']} tets {r['min_dihedral']:.4g} deg {r['below'][0]:.3g} % {r['below'][1]:.3g} % "
                             f"{r['mean_q']:.4g} {r['cpu']:.2f} s" if (r := rows[m]) else f"{m} no mesh" for m in modes)
            print(f"{surface.stem}: {text}", *[f"  WORSE {line}" for line in found], sep="\n", flush=True)
    for (mode, name), count in sorted(worse.items()):
        print(f"{mode}: {name} worse on {count} of {compared}")
    if not worse:
        print(f"never worse, {compared} surfaces")


if __name__ == "__main__":
    main()
