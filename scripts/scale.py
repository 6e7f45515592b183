#!/usr/bin/env python3
"""A large mesh in parts, through Dask with two workers of which one is killed: made, checked, joined, and measured.

    scale.py PROGRAM FOLDER --elements 1e7 [--parts 0] [--workers 2] [--no-kill] [--write docs/scaling.md]

The unit cube with triangles of twice the wanted size. FOLDER keeps what is done: the same call goes on. Needs
the Python package (PYTHONPATH) and Debian's python3-distributed. Prints and writes the peak of each process and the
seconds, of CPU and of the clock, for each million elements.
"""
import argparse
import json
import os
import resource
import signal
import sys
import threading
import time
from pathlib import Path

ELEMENTS_IN_A_PART = 1e6
PER_VOLUME = 7.3  # tetrahedra of size h in a volume h^3, measured


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


def cpu():
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def measure(arguments):
    import holdfast.distributed as parts_of
    from distributed import Client, LocalCluster

    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    size = (PER_VOLUME / arguments.elements) ** (1 / 3)
    parts = arguments.parts or max(4, round(arguments.elements / ELEMENTS_IN_A_PART))
    surface = folder / "cube.off"
    if not surface.exists():
        write_cube(surface, max(2, round(0.5 / size)))
    peaks = Peaks(os.environ["HOLDFAST_PROGRAM"])
    peaks.start()
    times = {}

    def timed(what, call):
        start, used = time.monotonic(), cpu()
        result = call()
        times[what] = (time.monotonic() - start, cpu() - used)
        print(f"{what}: {times[what][0]:.1f} s", flush=True)
        return result

    division = timed("split", lambda: parts_of._division_of(surface, folder / "parts", parts, {"size": size}))
    killed = []
    with LocalCluster(n_workers=arguments.workers, threads_per_worker=1, processes=True, memory_limit="8GiB",
                      dashboard_address=None) as cluster, Client(cluster) as client:
        progress = None if arguments.no_kill else kill_one_worker(client, killed)
        rows = timed("mesh", lambda: parts_of.mesh_parts(division, client=client, progress=progress))
    bad = [row for row in rows if row["status"] not in ("done", "skipped")]
    if bad:
        raise RuntimeError(str(bad[0]))
    if not timed("check", lambda: parts_of.check(division.folder)):
        raise RuntimeError("the parts are no mesh of the surface")
    timed("join", lambda: parts_of.join(division.folder, folder / "joined.vtu"))
    head = (folder / "joined.vtu").open("rb").read(4000).decode("latin-1")
    cells = int(head.split('NumberOfCells="')[1].split('"')[0]) - division.manifest["surface"]["triangles"]
    seconds = sum(row["seconds"] for row in rows)
    return {"elements": cells, "parts": len(division.parts), "killed": len(killed), "skipped": sum(r["status"] == "skipped" for r in rows),
            "times": times, "peaks": peaks.of, "mesh_seconds": seconds, "load": os.getloadavg()[0]}


BEGIN, END = "<!-- scale {} -->\n", "<!-- end of scale {} -->\n"


def table(found):
    millions = found["elements"] / 1e6
    lines = ["| step | seconds | a million elements | peak of a process, MB |", "|---|---|---|---|"]
    for step in ("split", "mesh", "check", "join"):
        clock = found["times"][step][0]
        lines.append(f"| {step} | {clock:.1f} | {clock / millions:.2f} | {found['peaks'].get(step, 0):.0f} |")
    killed = "one worker killed" if found["killed"] else "no worker killed"
    return (f"{found['elements']:,} tetrahedra in {found['parts']} parts, Dask with two workers, {killed}, "
            f"load of the machine {found['load']:.0f}:\n\n" + "\n".join(lines) + "\n")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--elements", type=float, default=1e6)
    options.add_argument("--parts", type=int, default=0)
    options.add_argument("--workers", type=int, default=2)
    options.add_argument("--no-kill", action="store_true")
    options.add_argument("--write", type=Path)
    arguments = options.parse_args()
    os.environ["HOLDFAST_PROGRAM"] = str(arguments.program.resolve())
    found = measure(arguments)
    (arguments.folder / "found.json").write_text(json.dumps(found, indent=1))
    print(table(found))
    if arguments.write:
        name = f"{arguments.elements:.0e}".replace("+0", "")
        begin, end = BEGIN.format(name), END.format(name)
        text = arguments.write.read_text()
        block = begin + "\n" + table(found) + "\n" + end
        if begin in text:
            before, _, rest = text.partition(begin)
            text = before + block + rest.partition(end)[2]
        else:
            text = text.rstrip("\n") + "\n\n" + block
        arguments.write.write_text(text)


if __name__ == "__main__":
    sys.exit(main())
