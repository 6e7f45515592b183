"""The whole paper (George, Borouchaki, Saltel 2003) by one command: writes docs/paper.md and docs/paper/*.

    run.py --build build/release [--again PART]... [--most-seconds 8] [--most-seconds-alone 60] [--most-seconds-space 10] [--out docs]

Parts, each told in its module: results (figures 14 to 19, tables), pictures, complexity (§2.4, §7), literal (§5, §6). What is
measured is kept in <build>/paper/<part>.json, so that a run goes on where the last one ended; --again measures a part anew.
"""
import argparse
import os
import re
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(1, str(ROOT / "bench"))
import document  # noqa: E402
from kept import Rows, digest  # noqa: E402
from process import run  # noqa: E402


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release")
    parser.add_argument("--again", action="append", default=[], choices=[*document.PARTS, "all"])
    parser.add_argument("--most-seconds", type=float, default=8,
                        help="of the processor: a series of growing cases ends with the first that takes longer")
    parser.add_argument("--most-seconds-alone", type=float, default=60, help="the same of partition alone, without elimination")
    parser.add_argument("--most-seconds-space", type=float, default=10, help="the same in space, where it grows faster still")
    parser.add_argument("--out", type=Path, default=ROOT / "docs")
    return parser.parse_args()


def key_of(part, options):
    """The programs that rows of a part depend on."""
    return {name: digest(options.build / name) for name in document.PROGRAMS.get(part, ("holdfast",)) if (options.build / name).exists()}


def machine():
    names = re.findall(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return f"{names[0] if names else 'an unknown processor'}, {os.cpu_count()} cores seen"


def main():
    options = parse_arguments()
    rows = {part: Rows(options.build / "paper" / f"{part}.json", key_of(part, options), True, bool({part, "all"} & set(options.again)))
            for part in document.PARTS}
    (options.out / "paper").mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="holdfast-paper-") as folder:
        version = run([options.build / "holdfast", "--version"]).output.strip()
        head = (f"Written by `make paper` on {time.strftime('%Y-%m-%d')}: {version} (the program's SHA-256 begins with "
                f"{digest(options.build / 'holdfast')}), on {machine()}")
        lines = document.write(options, Path(folder), rows, head)
    path = options.out / "paper.md"
    path.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print(path)


if __name__ == "__main__":
    main()
