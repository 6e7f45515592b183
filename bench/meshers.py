"""The meshers that field.py compares, on one surface: the same triangles for all, which they keep."""
import json
import re
import statistics
import signal
from pathlib import Path
from typing import NamedTuple

from gmsh_files import read_off, write_msh
import process

ROOT = Path(__file__).resolve().parent.parent

MEMORY = 1 << 30
WAITING = 20  # times the limit on processor time, for the wall clock: other jobs may run
GEO = """Merge "{surface}";
Surface Loop(1) = {{1}};
Volume(1) = {{1}};
Mesh.SaveAll = 1;
Mesh.Optimize = 1;
"""
LARGEST_SIZE = "Mesh.MeshSizeMax = {size!r};\n"


class TookTooLong(Exception):
    pass


class Made(NamedTuple):
    """A mesh in a file."""
    file: str
    seconds: float  # of meshing only, as the program itself reports it
    cpu: float  # of the whole process


class Meshers:
    """`memory` bytes are ready for each; `options` has build and timeout, in seconds of processor time."""

    def __init__(self, options, folder, memory=MEMORY):
        self.options, self.folder, self.memory = options, folder, memory
        self.late = set()

    def run(self, command):
        """A command, or None for one that fails."""
        limit = self.options.timeout
        done = process.run(["prlimit", f"--cpu={limit:.0f}", *command], WAITING * limit, self.folder, self.memory)
        if done.code is None or -done.code in (signal.SIGXCPU, signal.SIGKILL):
            raise TookTooLong
        return done if done.code == 0 else None

    def shape(self, volume):
        told = self.run([self.options.build / "mesh_shape", volume])
        return None if told is None else json.loads(told.output)

    def holdfast(self, surface, *extra):
        volume, report = "hf.mesh", self.folder / "hf.json"
        told = self.run([self.options.build / "holdfast", "mesh", surface, "-o", volume, "-q", "--threads", "1", "--report", report, *extra])
        if told is None:
            return None
        seconds = json.loads(report.read_text())["seconds"]
        return Made(volume, seconds["total"] - seconds["read"] - seconds["write"], told.cpu)

    def gmsh(self, surface, algorithm, size=None):
        """With a largest size, or none."""
        write_msh(self.folder / "s.msh", *read_off(surface))
        (self.folder / "s.geo").write_text(GEO.format(surface="s.msh") + (LARGEST_SIZE.format(size=size) if size else ""))
        told = self.run(["gmsh", "-nt", "1", "-3", "-format", "msh2", "-algo", algorithm, "-o", "g.msh", "s.geo"])
        if told is None or "Error" in told.output:
            return None
        return Made("g.msh", sum(map(float, re.findall(r"Done (?:meshing|optimizing) .*Wall ([0-9.e-]+)s", told.output))), told.cpu)

    def tetgen(self, surface, most_volume=None):
        """With a largest volume of elements, or none."""
        points, triangles = read_off(surface)
        with open(self.folder / "t.smesh", "w", encoding="ascii") as out:
            out.write(f"{len(points)} 3 0 0\n")
            out.writelines(f"{i} {' '.join(p[:3])}\n" for i, p in enumerate(points))
            out.write(f"{len(triangles)} 0\n")
            out.writelines(f"3 {' '.join(t)}\n" for t in triangles)
            out.write("0\n0\n")
        told = self.run(["tetgen", "-pYq1.4" + (f"a{most_volume:.15f}" if most_volume else ""), "t.smesh"])
        if told is None:
            return None
        total = re.search(r"Total running seconds:\s+([0-9.e-]+)", told.output)
        output = re.search(r"Output seconds:\s+([0-9.e-]+)", told.output)
        return Made("t.1.node", float(total.group(1)) - (float(output.group(1)) if output else 0), told.cpu) if total else None

    def netgen(self, surface):
        told = self.run(["/usr/bin/python3", ROOT / "bench" / "netgen_volume.py", surface, "n.mesh"])
        return None if told is None else Made("n.mesh", float(told.output.split()[-1]), told.cpu)

    def in_turns(self, meshers, surface, turns, seconds):
        """mesher -> its row; {"failed": why} without a mesh. `meshers` maps names to functions of the surface; `seconds` is which of a
        `Made` count."""
        self.late = set()
        rows = {}

        def turn(mesher):
            try:
                made = meshers[mesher](surface)
            except TookTooLong:
                self.late.add(mesher)
                return None
            if made is None:
                return None
            if mesher not in rows:
                rows[mesher] = self.shape(made.file)
            return seconds(made)

        told = process.take_turns({mesher: lambda m=mesher: turn(m) for mesher in meshers}, turns)
        for mesher, times in told.items():
            if times is None or not rows[mesher] or not rows[mesher]["tetrahedra"]:
                rows[mesher] = {"failed": f"exceeds {self.options.timeout:.0f} s" if mesher in self.late else "fails"}
            else:
                rows[mesher]["seconds"] = statistics.median(times)
        return rows

    def peers(self):
        return {"Gmsh HXT": lambda s: self.gmsh(s, "hxt"), "Gmsh Delaunay": lambda s: self.gmsh(s, "del3d"),
                "TetGen": self.tetgen, "Netgen": self.netgen}
