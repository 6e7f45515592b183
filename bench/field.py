"""Meshes to compute with, side by side: Holdfast, Gmsh (HXT, and Delaunay with optimisation), TetGen and Netgen.

    field.py --build build/release --corpus DIR [--only NAME] [--output docs/field.md]

Every mesher gets the same triangles and keeps them: `holdfast mesh --no-growth --gradation 0.6` (sizes inside lie
between those of the surface round, as Gmsh has them), `gmsh -3 -algo hxt`, `gmsh -3 -algo del3d` with Mesh.Optimize, `tetgen -pYq1.4`,
and Netgen's GenerateVolumeMesh through bench/netgen_volume.py. One thread each. Seconds are CPU time of meshing as far
as a program tells it: reading and writing files is left out. Angles are measured by one program, mesh_shape.
"""
import argparse
import json
import platform
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import corpus  # noqa: E402  (the folder of surfaces)

SURFACES = ["iglt_3holes", "aj_fandisk", "iglt_arm", "aj_rocker-arm", "irmb_cactus25k", "tgt_armadillo",
            "irmb_fertility", "tcsg_golf-out", "igl_armadillo", "irmb_armadillo"]
GEO = """Merge "{surface}";
Surface Loop(1) = {{1}};
Volume(1) = {{1}};
Mesh.SaveAll = 1;
Mesh.Optimize = 1;
"""


def read_off(path):
    with open(path, encoding="ascii") as file:
        rows = [line.split("#")[0].split() for line in file]
    rows = [row for row in rows if row and row != ["OFF"]]
    vertices, faces = int(rows[0][0]), int(rows[0][1])
    return rows[1:1 + vertices], [row[1:4] for row in rows[1 + vertices:1 + vertices + faces]]


def write_msh(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        out.writelines(f"{i} {' '.join(p[:3])}\n" for i, p in enumerate(points, 1))
        out.write(f"$EndNodes\n$Elements\n{len(triangles)}\n")
        out.writelines(f"{i} 2 2 1 1 {' '.join(str(int(v) + 1) for v in t)}\n" for i, t in enumerate(triangles, 1))
        out.write("$EndElements\n")


class Bench:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def run(self, command):
        """(output, CPU seconds) of a command, or None for one that fails or takes too long."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            ended = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   cwd=self.folder, timeout=self.options.timeout, check=False)
        except subprocess.TimeoutExpired:
            return None
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if ended.returncode != 0:
            return None
        return (ended.stdout.decode(errors="replace"),
                after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)

    def shape(self, volume, seconds):
        told = self.run([self.options.build / "mesh_shape", volume])
        if told is None:
            return None
        row = json.loads(told[0])
        row["seconds"] = seconds
        return row if row["tetrahedra"] else None

    def holdfast(self, surface, *extra):
        volume, report = self.folder / "hf.mesh", self.folder / "hf.json"
        told = self.run([self.options.build / "holdfast", "mesh", surface, "-o", volume, "-q", "--no-growth",
                         "--gradation", "0.6", "--report", report, *extra])
        if told is None:
            return None
        seconds = json.loads(report.read_text())["seconds"]
        files = seconds["read"] + seconds["write"]
        return self.shape(volume, told[1] * (1 - files / seconds["total"]))

    def gmsh(self, surface, algorithm):
        write_msh(self.folder / "s.msh", *read_off(surface))
        (self.folder / "s.geo").write_text(GEO.format(surface="s.msh"))
        told = self.run(["gmsh", "-nt", "1", "-3", "-format", "msh2", "-algo", algorithm, "-o", "g.msh", "s.geo"])
        if told is None or "Error" in told[0]:
            return None
        times = re.findall(r"Done (?:meshing|optimizing) .*CPU ([0-9.]+)s", told[0])
        return self.shape(self.folder / "g.msh", sum(map(float, times)))

    def tetgen(self, surface):
        points, triangles = read_off(surface)
        with open(self.folder / "t.smesh", "w", encoding="ascii") as out:
            out.write(f"{len(points)} 3 0 0\n")
            out.writelines(f"{i} {' '.join(p[:3])}\n" for i, p in enumerate(points))
            out.write(f"{len(triangles)} 0\n")
            out.writelines(f"3 {' '.join(t)}\n" for t in triangles)
            out.write("0\n0\n")
        told = self.run(["tetgen", "-pYq1.4", "t.smesh"])
        if told is None:
            return None
        total = re.search(r"Total running seconds:\s+([0-9.e-]+)", told[0])
        output = re.search(r"Output seconds:\s+([0-9.e-]+)", told[0])
        return self.shape(self.folder / "t.1.node",
                          float(total.group(1)) - (float(output.group(1)) if output else 0)) if total else None

    def netgen(self, surface):
        told = self.run(["/usr/bin/python3", ROOT / "bench" / "netgen_volume.py", surface, "n.mesh"])
        return None if told is None else self.shape(self.folder / "n.mesh", float(told[0].split()[-1]))

    def all(self, surface):
        return {"Holdfast": self.holdfast(surface), "Holdfast fast": self.holdfast(surface, "--quality", "fast"),
                "Gmsh HXT": self.gmsh(surface, "hxt"), "Gmsh Delaunay": self.gmsh(surface, "del3d"),
                "TetGen": self.tetgen(surface), "Netgen": self.netgen(surface)}


def line(name, mesher, row):
    if row is None:
        return f"| {name} | {mesher} | fails or exceeds the time | | | | | |"
    below = " / ".join(f"{x:.2g}" if x else "0" for x in row["below"][:3])
    return (f"| {name} | {mesher} | {row['tetrahedra']} | {row['seconds']:.2f} | "
            f"{row['tetrahedra'] / max(row['seconds'], 1e-9) / 1000:.0f}k | {row['min_dihedral']:.1f} | "
            f"{row['max_dihedral']:.1f} | {below} |")


def summary(results):
    lines = ["| mesher | surfaces | tetrahedra a second, median | least angle, median | below 10 / 20 / 30 degrees, mean % "
             "| tetrahedra over Holdfast's, median |", "|---|---|---|---|---|---|"]
    for mesher in next(iter(results.values())):
        rows = [(r[mesher], r["Holdfast"]) for r in results.values() if r[mesher] and r["Holdfast"]]
        if not rows:
            continue
        mean = [statistics.mean(r["below"][k] for r, _ in rows) for k in range(3)]
        lines.append(f"| {mesher} | {len(rows)} of {len(results)} | "
                     f"{statistics.median(r['tetrahedra'] / r['seconds'] for r, _ in rows) / 1000:.0f}k | "
                     f"{statistics.median(r['min_dihedral'] for r, _ in rows):.1f} | "
                     f"{' / '.join(f'{x:.2g}' for x in mean)} | "
                     f"{statistics.median(r['tetrahedra'] / h['tetrahedra'] for r, h in rows):.2f} |")
    return lines


def processor():
    for text in Path("/proc/cpuinfo").read_text().splitlines():
        if text.startswith("model name"):
            return text.split(":")[1].strip()
    return platform.processor()


def write(results, path):
    versions = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}, ", "gmsh", "tetgen", "netgen"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False).stdout.decode()
    text = ["# Meshes to compute with", "", "Written by `make field`; how it was measured stands in `bench/field.py`.", "",
            f"{processor()}; one thread; {versions.strip(', ')}.", "", *summary(results), "",
            "| surface | mesher | tetrahedra | seconds | a second | least angle | largest | % below 10 / 20 / 30 |",
            "|---|---|---|---|---|---|---|---|"]
    text += [line(name, mesher, row) for name, rows in results.items() for mesher, row in rows.items()]
    path.write_text("\n".join(text) + "\n", encoding="utf-8")



def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--corpus", default="")
    parser.add_argument("--only", action="append")
    parser.add_argument("--timeout", type=float, default=600)
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "field.md")
    options = parser.parse_args()
    folder = corpus.locate(options.corpus, False)
    if folder is None:
        sys.exit("field.py: no corpus of surfaces")
    results = {}
    with tempfile.TemporaryDirectory(prefix="holdfast-field-") as scratch:
        for name in options.only or SURFACES:
            surface = next(folder.rglob(name + ".off"), None)
            if surface is None:
                continue
            results[name] = Bench(options, Path(scratch)).all(surface.resolve())
            for mesher, row in results[name].items():
                print(line(name, mesher, row), flush=True)
            write(results, options.output)


if __name__ == "__main__":
    main()
