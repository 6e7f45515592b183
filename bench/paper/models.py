"""The models of §8, each made by a command, with the paper's numbers of it.

    models.py NAME FILE.off

The models of Fig. 14 and 15 are described in the paper, so that they can be made again. Those of Tables I and II (mohne,
thru-mazewheel, cami1, try5.2) cannot be had any more: each is replaced by a part of the same kind with the same number
of triangles and edges where such a surface exists, and about the same Target.
"""
import subprocess
import sys
from math import cos, pi, sin
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples"))
from polygons import GRID, Surface, triangulate  # noqa: E402

FINE = 1024 * GRID  # grid points a unit of length


class Model(NamedTuple):
    name: str
    what: str  # what ours is
    figure: int
    make: tuple  # a script of examples/ with its arguments, or () for a part made here
    paper: dict  # the paper's numbers by its own names


def _table(faini, arini, faper, arper, npface, nparet, npste, ne, np, target, q, cpu):
    return {"faini": faini, "arini": arini, "faper": faper, "arper": arper, "npface": npface, "nparet": nparet, "npste": npste,
            "ne": ne, "np": np, "Target": target, "Q": q, "cpu": cpu}


MODELS = (
    Model("Fig. 14", "a box with two large triangles inside that touch nothing", 14,
          ("make_paper.py", "dangling", "{}", "--height", "0.15"),
          _table(2082, None, 2, 5, 1063, 44, 37, 3937, 1273, 1.2, 808, 25.33)),
    Model("Fig. 15", "two large triangles across a box, so that its sides are pencils of edges", 15,
          ("make_paper.py", "touching", "{}"),
          _table(26326, 39487, None, 12, 8000, 57, 57, 110329, 25407, None, 41430, 311.16)),
    Model("mohne", "a plate with bores of many sizes", 16, (), _table(5560, 8340, 12, 9, 80, 30, 42, 16839, 4208, 627, 737, 27.90)),
    Model("thru-mazewheel", "a gear with curved slots", 17, (), _table(5622, 8433, 1, 0, 3, 0, 16, 8377, 3160, 73, 253, 7.46)),
    Model("cami1", "a lever with bores", 18, (), _table(932, 1398, 7, 7, 27, 13, 14, 1720, 546, 734, 755, 6.43)),
    Model("try5.2", "a transistor of four materials", 19, ("make_paper.py", "semiconductor", "{}", "-n", "13", "--thickness", "2e-5"),
          _table(13482, 20119, 6, 3, 120, 11, 10, 56460, 10767, 530, 1230, 29.06)),
)


# ---------------------------------------------------------------------------------------------- extruded parts


def circle(n, radius, at=(0.0, 0.0), phase=0.0):
    return [(at[0] + radius * cos(2 * pi * i / n + phase), at[1] + radius * sin(2 * pi * i / n + phase)) for i in range(n)]


def slot(n, radius, width, begin, end):
    """A curved slot round the origin: n points along each side."""
    def side(r, angles):
        return [(r * cos(a), r * sin(a)) for a in angles]

    angles = [begin + (end - begin) * i / (n - 1) for i in range(n)]
    return side(radius + width / 2, angles) + side(radius - width / 2, angles[::-1])


def in_circle(a, b, c, d):
    """Positive where d lies inside the circle round the triangle abc, whose corners turn left."""
    rows = [(p[0] - d[0], p[1] - d[1], (p[0] - d[0]) ** 2 + (p[1] - d[1]) ** 2) for p in (a, b, c)]
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = rows
    return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)


def swapped_to_delaunay(triangles, loops):
    """Constrained Delaunay triangles by swaps of edges (Lawson), exactly: a CAD system does not give slivers away for nothing."""
    kept = {frozenset((loop[i - 1], loop[i])) for loop in loops for i in range(len(loop))}
    apex = {(t[i - 1], t[i]): t[i - 2] for t in triangles for i in range(3)}
    waiting = list(apex)
    while waiting:
        a, b = waiting.pop()
        if (a, b) not in apex or (b, a) not in apex or frozenset((a, b)) in kept:
            continue
        c, d = apex[a, b], apex[b, a]
        if in_circle(a, b, c, d) <= 0:
            continue
        del apex[a, b], apex[b, a]
        for t in ((c, a, d), (d, b, c)):
            for i in range(3):
                apex[t[i - 1], t[i]] = t[i - 2]
        waiting += [(c, a), (a, d), (d, b), (b, c)]
    return {frozenset((a, b, c)): (a, b, c) for (a, b), c in apex.items()}.values()


def extruded(outline, holes, height):
    part = Surface()
    flat = [[(round(x * FINE), round(y * FINE)) for x, y in loop] for loop in (outline, *holes)]
    loops = [[[(*p, z) for p in loop] for z in (0, round(height * FINE))] for loop in flat]
    for a, b, c in swapped_to_delaunay(triangulate(flat[0], flat[1:]), flat):
        for z, corners in ((loops[0][0][0][2], (a, c, b)), (loops[0][1][0][2], (a, b, c))):
            part.triangles.append(tuple((*p, z) for p in corners))
    part.strip(*loops[0])
    for low, high in loops[1:]:
        part.strip(high, low)
    part.check()
    return part


def with_a_point_on_a_side(part):
    """One more vertex, in the middle of an upright edge: two more triangles."""
    at = next(t for t in part.triangles if t[0][:2] == t[1][:2] or t[1][:2] == t[2][:2])
    a, b = (at[0], at[1]) if at[0][:2] == at[1][:2] else (at[1], at[2])
    middle = tuple((p + q) // 2 for p, q in zip(a, b))
    split = []
    for t in part.triangles:
        for k in range(3):
            if {t[k], t[k - 1]} == {a, b}:
                split += [(t[k - 1], middle, t[k - 2]), (middle, t[k], t[k - 2])]
                break
        else:
            split.append(t)
    part.triangles = split
    part.check()
    return part


def plate():
    """1,382 points on the outline and 9 bores: 5,560 triangles."""
    outline = [(x + 60 * sx, y + 40 * sy) for (sx, sy), phase in zip(((1, 1), (-1, 1), (-1, -1), (1, -1)), range(4))
               for x, y in [(10 * cos(phase * pi / 2 + i * pi / 64), 10 * sin(phase * pi / 2 + i * pi / 64)) for i in range(33)]]
    sizes = (290, 260, 200, 160, 120, 90, 60, 40, 30)
    places = ((-35, 0, 24), (25, 12, 18), (25, -24, 10), (55, -24, 8), (55, 20, 7), (-60, 38, 6), (-60, -38, 5), (0, 40, 4), (0, -40, 1.3))
    holes = [circle(n, r, (x, y)) for n, (x, y, r) in zip(sizes, places)]
    return extruded(outline, holes, 6)


def gear():
    """1,400 points on the outline and 6 holes, and one more on a side: 5,622 triangles."""
    teeth, outline = 40, []
    for t in range(teeth):
        flank = [0.06, 0.1, 0.14, 0.18, 0.22, 0.26]  # of a tooth's angle, up its flank
        for part, radii in ((flank, (46, 46.6, 47.5, 48.6, 49.5, 50)), ([0.74, 0.78, 0.82, 0.86, 0.9, 0.94], (50, 49.5, 48.6, 47.5, 46.6, 46))):
            outline += [(r * cos(2 * pi * (t + a) / teeth), r * sin(2 * pi * (t + a) / teeth)) for a, r in zip(part, radii)]
    holes = [circle(100, 1.937)] + [slot(82, 28, 9, 2 * pi * k / 5 + 0.12, 2 * pi * (k + 1) / 5 - 0.12) for k in range(5)]
    return with_a_point_on_a_side(extruded(outline, holes, 12))


def lever():
    """231 points on the outline and 3 bores: 932 triangles."""
    outline = [(x, y) for x, y in circle(40, 14, (0, 0), pi / 2)[:21]] + [(60 + x, y) for x, y in circle(40, 8, (0, 0), -pi / 2)[:20]]
    holes = [circle(90, 9), circle(60, 4, (60, 0)), circle(40, 0.3287, (32, 0))]
    return extruded(outline, holes, 10)


PARTS = {"mohne": plate, "thru-mazewheel": gear, "cami1": lever}


def make(model, path):
    if model.make:
        script, *arguments = model.make
        subprocess.run([sys.executable, ROOT / "examples" / script, *(a.format(path) for a in arguments)], check=True,
                       capture_output=True)
    else:
        PARTS[model.name]().write_off(str(path))


def command(model):
    """How the model is made, as a user would type it."""
    if model.make:
        return "python3 examples/" + " ".join(model.make).format("model.off")
    return f"python3 bench/paper/models.py {model.name} model.off"


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in [m.name for m in MODELS]:
        sys.exit(__doc__)
    make(next(m for m in MODELS if m.name == sys.argv[1]), sys.argv[2])
