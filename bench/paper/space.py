"""Runs of `holdfast mesh` for the pictures: volumes as arrays, and reports."""
import json
import subprocess
import sys

import numpy as np

from models import ROOT
from process import run


def read_off(path):
    words = path.read_text(encoding="ascii").split()
    count, faces = int(words[1]), int(words[2])
    points = np.array(words[4: 4 + 3 * count], float).reshape(-1, 3)
    triangles = np.array(words[4 + 3 * count: 4 + 3 * count + 4 * faces], int).reshape(-1, 4)[:, 1:]
    return points, triangles


def read_volume(path):
    """Points, triangles and tetrahedra of a .mesh file, and the regions of the latter."""
    words = path.read_text(encoding="ascii").split()
    found = {}
    for name, columns, kind in (("Vertices", 4, float), ("Triangles", 4, int), ("Tetrahedra", 5, int)):
        if name not in words:
            found[name] = np.zeros((0, columns), kind)
            continue
        at = words.index(name) + 2
        found[name] = np.array(words[at: at + columns * int(words[at - 1])], kind).reshape(-1, columns)
    return found["Vertices"][:, :3], found["Triangles"][:, :3] - 1, found["Tetrahedra"][:, :4] - 1, found["Tetrahedra"][:, 4]


def made(folder, script, *arguments):
    path = folder / "surface.off"
    subprocess.run([sys.executable, ROOT / "examples" / script, arguments[0], path, *arguments[1:]], check=True, stdout=subprocess.DEVNULL)
    return path


def write_off(path, points, triangles):
    lines = [f"OFF\n{len(points)} {len(triangles)} 0", *(" ".join(repr(float(x)) for x in p) for p in points),
             *("3 " + " ".join(map(str, t)) for t in triangles)]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path


def mesh(options, surface, *extra):
    """The volume that a run writes, and its report."""
    out, report = surface.with_name("out.mesh"), surface.with_name("out.json")
    done = run([options.build / "holdfast", "mesh", surface, "-o", out, "-q", "--report", report, *extra])
    if done.code != 0:
        raise RuntimeError(done.output)
    return *read_volume(out), json.loads(report.read_text(encoding="utf-8"))
