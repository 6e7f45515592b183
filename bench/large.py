#!/usr/bin/env python3
"""The cube of scripts/scale.py in one process, by Holdfast, Gmsh HXT and TetGen, for comparison with parts.

    large.py PROGRAM FOLDER --elements 1e6 1e7 [--timeout 900] [--write docs/scaling.md]

All keep the surface and get sizes for about as many elements: Holdfast by --size, Gmsh by the largest size,
TetGen by the largest volume. Seconds are of the processor and of the clock, with reading and writing; the peak is that of
the process.
"""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

import process  # noqa: E402
from gmsh_files import read_off, write_msh  # noqa: E402
from scale import replace_block, size_of, write_cube_of  # noqa: E402

# Of TetGen's largest volume: the mean of its elements is below it.
TETGEN_MEAN = 0.62

GEO = """Merge "s.msh";
Surface Loop(1) = {{1}};
Volume(1) = {{1}};
Mesh.Algorithm3D = 10;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = {size!r};
Mesh.Binary = 1;
"""


def write_smesh(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"{len(points)} 3 0 0\n")
        out.writelines(f"{i} {' '.join(p[:3])}\n" for i, p in enumerate(points))
        out.write(f"{len(triangles)} 0\n")
        out.writelines(f"3 {' '.join(t)}\n" for t in triangles)
        out.write("0\n0\n")


def commands(program, folder, surface, elements):
    """name -> (command, pattern of the number of tetrahedra in its output)."""
    size = size_of(elements)
    points, triangles = read_off(surface)
    write_msh(folder / "s.msh", points, triangles)
    (folder / "s.geo").write_text(GEO.format(size=size), encoding="ascii")
    write_smesh(folder / "t.smesh", points, triangles)
    return {
        "Holdfast": ([program, "mesh", surface, "-o", folder / "h.vtu", "--size", repr(size)], r"([\d,]+) tetrahedra"),
        "Gmsh HXT": (["gmsh", "-nt", "1", "-3", "-o", folder / "g.msh", folder / "s.geo"], r"(\d+) tetrahedra created|(\d+) elements"),
        "TetGen": (["tetgen", f"-pYq1.4a{1 / elements / TETGEN_MEAN!r}", folder / "t.smesh"], r"Mesh tetrahedra: +(\d+)"),
    }


def measure(arguments):
    rows = []
    arguments.folder = arguments.folder.resolve()  # programs run in it
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for elements in arguments.elements:
        surface = write_cube_of(arguments.folder, elements)
        for name, (command, tells) in commands(arguments.program.resolve(), arguments.folder, surface, elements).items():
            run = process.run(command, arguments.timeout, arguments.folder)
            found = [next(filter(None, match)) if isinstance(match, tuple) else match for match in re.findall(tells, run.output)]
            count = int(found[-1].replace(",", "")) if run.code == 0 and found else None
            rows.append((elements, name, count, run))
            print(rows[-1][:3], f"{run.wall:.1f} s", flush=True)
    return rows


def table(rows, timeout):
    lines = ["| asked for | program | tetrahedra | seconds | CPU seconds a million | peak, MB |", "|---|---|---|---|---|---|"]
    for elements, name, count, run in rows:
        if count is None:
            told = f"more than {timeout:.0f}" if run.code is None else f"ended with {run.code}"
            lines.append(f"| {elements:.0e} | {name} | - | {told} | - | - |".replace("e+0", "e"))
        else:
            lines.append(f"| {elements:.0e} | {name} | {count:,} | {run.wall:.1f} | {run.cpu / count * 1e6:.2f} | {run.peak / 2**20:.0f} |"
                         .replace("e+0", "e"))
    return "\n".join(lines) + "\n"


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--elements", type=float, nargs="+", default=[1e6, 1e7])
    options.add_argument("--timeout", type=float, default=900)
    options.add_argument("--write", type=Path)
    arguments = options.parse_args()
    text = table(measure(arguments), arguments.timeout)
    print(text)
    if arguments.write:
        replace_block(arguments.write, "one process", text)


if __name__ == "__main__":
    sys.exit(main())
