#!/usr/bin/env python3
"""The gain of threads, by stage: the work and its serial part, measured on two threads; times predicted for more.

    scaling.py PROGRAM FOLDER [--triangles 100000 1000000] [--write docs/scaling.md]

In each stage both threads share the parallel work, and the caller's thread does the rest alone. So its CPU time minus
that of the other is serial, and the rest is shared. If the other has more, the caller has waited for it, or for a core:
CPU times do not show which, and it is counted as shared. The CPU times are those of the kernel, for each
thread, at the moments when the program reports that a stage begins. That needs Linux.
"""
import argparse
import os
import subprocess
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

from scale import replace_block  # noqa: E402
from surfaces import write_surface  # noqa: E402

CORES = (2, 16, 64)
PARTS = 16  # into which field points and their improvement are cut at most (src/refine/tuning.h, kMostLevels)
IN_PARTS = ("field_points", "optimise")


def cpu_of_threads(pid):
    """thread -> CPU seconds, the caller's first."""
    folder = Path(f"/proc/{pid}/task")
    try:
        return {int(t): int((folder / t / "schedstat").read_text().split()[0]) / 1e9 for t in sorted(os.listdir(folder), key=int)}
    except (OSError, IndexError):  # a thread or the process has just ended
        return {}


class Threads(threading.Thread):
    """The CPU seconds of each thread of a process, also of those that have ended, nearly."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.pid, self.seconds, self.lock, self.over = pid, {}, threading.Lock(), threading.Event()
        self.start()

    def look(self):
        with self.lock:
            self.seconds.update(cpu_of_threads(self.pid))
            return dict(self.seconds)

    def run(self):
        while not self.over.wait(0.005):
            self.look()


def stages_of(program, surface, output, options):
    """stage -> (serial, shared) CPU seconds."""
    process = subprocess.Popen([program, "mesh", surface, "-o", output, "--threads", "2", "--verbose", *options],
                               stderr=subprocess.PIPE, text=True)
    of_threads = Threads(process.pid)
    marks = [("read", {})]
    for line in process.stderr:
        if line.startswith("["):
            marks.append((line.split("]")[1].strip(), of_threads.look()))
        elif line.startswith("input"):  # the mesh is there
            marks.append(("write", of_threads.look()))
    marks.append(("end", of_threads.look()))
    of_threads.over.set()
    if process.wait():
        raise SystemExit(f"{surface.name}: exit {process.returncode}")
    stages = {}
    for (name, begin), (_, end) in zip(marks, marks[1:]):
        own = [end[t] - begin.get(t, 0) for t in sorted(end)]
        other = sum(own[1:])
        serial, shared = stages.get(name, (0, 0))
        alone = max(0, own[0] - other)
        stages[name] = (serial + alone, shared + sum(own) - alone)
    return stages


def seconds_on(cores, stages):
    return sum(serial + shared / (min(cores, PARTS) if name in IN_PARTS else cores) for name, (serial, shared) in stages.items())


def row(what, stages):
    work = sum(map(sum, stages.values()))
    alone = sorted(((serial, name) for name, (serial, _) in stages.items()), reverse=True)[:3]
    return (f"| {what} | {work:.2f} | {sum(serial for serial, _ in stages.values()):.2f} | "
            + ", ".join(f"{name} {serial:.2f}" for serial, name in alone) + " | "
            + " | ".join(f"{work / seconds_on(cores, stages):.2f}" for cores in CORES) + " |")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--triangles", type=int, nargs="+", default=[100_000, 1_000_000])
    options.add_argument("--write", type=Path)
    arguments = options.parse_args()
    program, folder = arguments.program.resolve(), arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    surfaces = [folder / "part.stl"]
    subprocess.run([sys.executable, ROOT / "examples" / "make_part.py", surfaces[0]], check=True, stdout=subprocess.DEVNULL)
    runs = [("demo part, `--size 2`", surfaces[0], ["--size", "2"])]
    for count in arguments.triangles:
        made = folder / str(count)
        made.mkdir(exist_ok=True)
        write_surface(made, count)
        runs += [(f"torus of {count:,} triangles", next(made.glob("*.stl")), []),
                 (f"torus of {count:,} triangles, `--fill`", next(made.glob("*.stl")), ["--fill"])]
    lines = ["| surface | CPU s | of these one thread's alone | in stage | " + " | ".join(f"times on {c} cores" for c in CORES) + " |",
             "|---" * (4 + len(CORES)) + "|"]
    lines += [row(what, stages_of(program, surface, folder / "out.vtu", words)) for what, surface, words in runs]
    text = "\n".join(lines) + "\n"
    print(text)
    if arguments.write:
        replace_block(arguments.write, "model", text)


if __name__ == "__main__":
    sys.exit(main())
