#!/usr/bin/env python3
"""A large mesh in parts, made, checked, joined, and measured: through Dask with two workers of which one is killed, or
through an array of Slurm tasks.

    scale.py PROGRAM FOLDER --elements 1e7 [--parts 0] [--workers 2] [--no-kill] [--slurm] [--write docs/scaling.md]

The unit cube with triangles of twice the wanted size. FOLDER keeps what is done: the same call goes on. Needs
the Python package (PYTHONPATH) and Debian's python3-distributed; or a Slurm cluster that sbatch knows (python/tests/slurm_cluster.sh).
Prints and writes the peak of each process and the
seconds, of CPU and of the clock, for each million elements.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

ELEMENTS_IN_A_PART = 1e6
PER_VOLUME = 7.3  # tetrahedra of size h in a volume h^3, measured
ARRAY = Path(__file__).resolve().parent.parent / "examples" / "batch" / "slurm.sh"


def size_of(elements):
    """Of so many in the unit cube."""
    return (PER_VOLUME / elements) ** (1 / 3)


def write_cube_of(folder, elements):
    """The cube's surface for that size, unless it is there."""
    surface = folder / f"cube-{elements:.0e}.off"
    if not surface.exists():
        write_cube(surface, max(2, round(0.5 / size_of(elements))))
    return surface


def write_cube(path, n):
    numbers, triangles = {}, []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    def corner(a, b):
                        p = [0, 0, 0]
                        p[axis], p[u], p[v] = side, a, b
                        return numbers.setdefault(tuple(p), len(numbers))
                    a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
                    triangles += [(a, b, c), (a, c, d)] if side else [(a, c, b), (a, d, c)]
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(numbers)} {len(triangles)} 0\n")
        out.writelines("%r %r %r\n" % tuple(x / n for x in p) for p in numbers)
        out.writelines("3 %d %d %d\n" % t for t in triangles)


class Peaks(threading.Thread):
    """The largest memory of the program's processes, by command."""

    def __init__(self, program):
        super().__init__(daemon=True)
        self._program = os.path.realpath(program)
        self.of = {}

    def run(self):
        while True:
            for name in filter(str.isdigit, os.listdir("/proc")):
                try:
                    if os.readlink(f"/proc/{name}/exe") != self._program:
                        continue
                    command = Path(f"/proc/{name}/cmdline").read_bytes().split(b"\0")[1].decode()
                    status = Path(f"/proc/{name}/status").read_text()
                except (OSError, IndexError):
                    continue
                peak = next((int(line.split()[1]) / 1024 for line in status.splitlines() if line.startswith("VmHWM")), 0)
                self.of[command] = max(self.of.get(command, 0), peak)
            time.sleep(0.05)


def kill_one_worker(client, killed):
    """As soon as the first part is done."""
    def after(row, done, count):
        if killed or row["status"] != "done" or done == count:
            return
        pid = client.run(os.getpid)
        victim = sorted(pid.values())[0]
        os.kill(victim, signal.SIGKILL)
        killed.append(victim)
    return after


def mesh_by_dask(division, arguments, timed):
    """How many workers were killed."""
    import holdfast.distributed as parts_of
    from distributed import Client, LocalCluster

    killed = []
    with LocalCluster(n_workers=arguments.workers, threads_per_worker=1, processes=True, memory_limit="8GiB",
                      dashboard_address=None) as cluster, Client(cluster) as client:
        progress = None if arguments.no_kill else kill_one_worker(client, killed)
        rows = timed("mesh", lambda: parts_of.mesh_parts(division, client=client, progress=progress))
    bad = [row for row in rows if row["status"] not in ("done", "skipped")]
    if bad:
        raise RuntimeError(str(bad[0]))
    return len(killed)


def mesh_by_slurm(division, arguments, timed):
    surfaces = [str(division.surface(p)) for p in division.parts]
    command = ["sbatch", "--wait", f"--array=0-{arguments.workers - 1}", "--cpus-per-task=1",
               f"--output={arguments.folder.resolve()}/slurm-%a.log", str(ARRAY), str(division.folder), *surfaces]
    environment = {**os.environ, "HOLDFAST": os.environ["HOLDFAST_PROGRAM"]}
    timed("mesh", lambda: subprocess.run(command, env=environment, check=True))


def measure(arguments):
    import holdfast.distributed as parts_of

    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    parts = arguments.parts or max(4, round(arguments.elements / ELEMENTS_IN_A_PART))
    surface = write_cube_of(folder, arguments.elements)
    peaks = Peaks(os.environ["HOLDFAST_PROGRAM"])
    peaks.start()
    times = {}

    def timed(what, call):
        start = time.monotonic()
        result = call()
        times[what] = time.monotonic() - start
        print(f"{what}: {times[what]:.1f} s", flush=True)
        return result

    division = timed("split", lambda: parts_of._division_of(surface, folder / "parts", parts, {"size": size_of(arguments.elements)}))
    killed = (mesh_by_slurm if arguments.slurm else mesh_by_dask)(division, arguments, timed)
    if not timed("check", lambda: parts_of.check(division.folder)):
        raise RuntimeError("the parts are no mesh of the surface")
    timed("join", lambda: parts_of.join(division.folder, folder / "joined.vtu"))
    head = (folder / "joined.vtu").open("rb").read(4000).decode("latin-1")
    cells = int(head.split('NumberOfCells="')[1].split('"')[0]) - division.manifest["surface"]["triangles"]
    if arguments.check_whole:
        timed("check of the joined file", lambda: subprocess.run(
            [os.environ["HOLDFAST_PROGRAM"], "check", str(surface), str(folder / "joined.vtu")], check=True))
    through = f"an array of {arguments.workers} Slurm tasks" if arguments.slurm else \
        f"Dask with {arguments.workers} workers of 8 GiB, {'one' if killed else 'none'} killed"
    return {"elements": cells, "parts": len(division.parts), "through": through, "times": times, "peaks": peaks.of,
            "load": os.getloadavg()[0]}


BEGIN, END = "<!-- scale {} -->\n", "<!-- end of scale {} -->\n"


def table(found):
    millions = found["elements"] / 1e6
    lines = ["| step | seconds | a million elements | peak of a process, MB |", "|---|---|---|---|"]
    for step, clock in found["times"].items():
        lines.append(f"| {step} | {clock:.1f} | {clock / millions:.2f} | {found['peaks'].get(step.split()[0], 0):.0f} |")
    return (f"{found['elements']:,} tetrahedra in {found['parts']} parts, {found['through']}, "
            f"load of the machine {found['load']:.0f}:\n\n" + "\n".join(lines) + "\n")


def replace_block(path, name, block):
    """Writes what stands between the marks of a name, at the end of the file where there are none."""
    begin, end = BEGIN.format(name), END.format(name)
    text = path.read_text()
    block = begin + "\n" + block + "\n" + end
    if begin in text:
        before, _, rest = text.partition(begin)
        text = before + block + rest.partition(end)[2]
    else:
        text = text.rstrip("\n") + "\n\n" + block
    path.write_text(text)


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--elements", type=float, default=1e6)
    options.add_argument("--parts", type=int, default=0)
    options.add_argument("--workers", type=int, default=2)
    options.add_argument("--no-kill", action="store_true")
    options.add_argument("--slurm", action="store_true")
    options.add_argument("--check-whole", action="store_true", help="check the joined file, too: in memory as a whole")
    options.add_argument("--write", type=Path)
    arguments = options.parse_args()
    os.environ["HOLDFAST_PROGRAM"] = str(arguments.program.resolve())
    found = measure(arguments)
    (arguments.folder / "found.json").write_text(json.dumps(found, indent=1))
    print(table(found))
    if arguments.write:
        name = f"{arguments.elements:.0e}".replace("+0", "") + (" by Slurm" if arguments.slurm else "")
        replace_block(arguments.write, name, table(found))


if __name__ == "__main__":
    sys.exit(main())
