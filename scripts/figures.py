"""Makes the figures of docs/concepts.md and docs/architecture.md, in docs/figures: each of them shows a run of the program
or the state of the source.

    figures.py path/to/holdfast [--out docs/figures]
"""
import argparse
import json
import math
import re
import subprocess
import sys
import tempfile
from itertools import combinations
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
INK, PALE, SKIN, INSIDE, POINT = "#222222", "#888888", "#7fa8d1", "#f2c879", "#c0392b"


def svg(width, height, parts):
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="sans-serif" font-size="13" fill="{INK}">\n<rect width="{width}" height="{height}" fill="white"/>\n')
    return head + "\n".join(parts) + "\n</svg>\n"


def text(x, y, words, anchor="start", fill=INK, size=13):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{fill}" font-size="{size}">{words}</text>'


def polygon(points, fill, stroke=INK, opacity=1.0):
    where = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
    return (f'<polygon points="{where}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" stroke-width="0.8" '
            f'stroke-linejoin="round"/>')


def read_gmf(path):
    """Vertices and the elements of each kind of a .mesh file, without their references."""
    words = path.read_text().split()
    found = {}
    for name, columns in (("Vertices", 4), ("Triangles", 4), ("Tetrahedra", 5)):
        if name not in words:
            found[name] = []
            continue
        at = words.index(name) + 2
        rows = [words[at + columns * k: at + columns * (k + 1) - 1] for k in range(int(words[at - 1]))]
        found[name] = ([tuple(map(float, row)) for row in rows] if name == "Vertices"
                       else [tuple(int(i) - 1 for i in row) for row in rows])
    return found["Vertices"], found["Triangles"], found["Tetrahedra"]


def sub(p, q):
    return tuple(x - y for x, y in zip(p, q))


def dot(p, q):
    return sum(x * y for x, y in zip(p, q))


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def mean(points):
    return tuple(sum(c) / len(points) for c in zip(*points))


class Runs:
    def __init__(self, holdfast, folder):
        self.holdfast, self.folder = holdfast, Path(folder)

    def surface(self, script, *arguments):
        path = self.folder / ("_".join([script, *arguments]).replace(".", "_").replace("-", "") + ".off")
        if not path.exists():
            subprocess.run([sys.executable, ROOT / "examples" / f"make_{script}.py", arguments[0], path, *arguments[1:]],
                           check=True, stdout=subprocess.DEVNULL)
        return path

    def mesh(self, surface, *options):
        volume, report = self.folder / "volume.mesh", self.folder / "report.json"
        subprocess.run([self.holdfast, "mesh", surface, "-o", volume, "--report", report, "-q", *options], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return read_gmf(volume), json.loads(report.read_text())


def prism(runs):
    """Schönhardt's prism, and its tetrahedra moved apart."""
    (vertices, triangles, tets), _ = runs.mesh(runs.surface("hard", "schonhardt"), "--fill")
    skin = {frozenset(t) for t in triangles}
    eye = (0.62, -0.70, 0.35)
    right = (0.749, 0.663, 0.0)
    up = cross(right, eye)
    up = tuple(-x for x in up) if up[2] < 0 else up

    def draw(x0, spread):
        centre = mean(vertices)
        faces = []
        for tet in tets:
            shift = tuple(spread * x for x in sub(mean([vertices[i] for i in tet]), centre))
            for face in combinations(tet, 3):
                if spread == 0 and frozenset(face) not in skin:
                    continue
                corners = [tuple(a + b for a, b in zip(vertices[i], shift)) for i in face]
                faces.append((dot(mean(corners), eye), frozenset(face) in skin, corners))
        parts = []
        for _, outer, corners in sorted(faces):
            flat = [(x0 + 95 * dot(p, right), 190 - 95 * dot(p, up)) for p in corners]
            parts.append(polygon(flat, SKIN if outer else INSIDE, opacity=0.92))
        return parts

    added = len(vertices) - 6
    return svg(640, 330, [*draw(130, 0), *draw(440, 1.3), text(130, 315, "8 triangles", "middle"),
                          text(440, 315, f"{len(tets)} tetrahedra, {added} point added inside", "middle")])


def partition(runs):
    """A triangle with many partition points, as a union of mesh faces and as one face."""
    most = 60  # points that can be told apart in the figure
    surface = runs.surface("hard", "chazelle", "-n", "3")
    (vertices, _, tets), _ = runs.mesh(surface, "--stop-after", "partition", "--without", "flips")
    lines = surface.read_text().split("\n")
    count, facet_count = map(int, lines[1].split()[:2])
    facets = [tuple(map(int, line.split()[1:4])) for line in lines[2 + count: 2 + count + facet_count]]

    def place(facet):
        """Coordinates of all vertices with respect to the facet: u, v along two sides, and the distance."""
        a, b, c = (vertices[i] for i in facet)
        e, f = sub(b, a), sub(c, a)
        n = cross(e, f)
        size = dot(n, n)
        return [(dot(cross(sub(p, a), f), n) / size, dot(cross(e, sub(p, a)), n) / size,
                 dot(sub(p, a), n) / math.sqrt(size)) for p in vertices]

    def inside(facet):
        a, b, c = (vertices[i] for i in facet)
        near = 1e-9 * max(math.dist(a, b), math.dist(b, c), math.dist(c, a))
        return {i for i, (u, v, d) in enumerate(place(facet))
                if abs(d) < near and u > -1e-9 and v > -1e-9 and u + v < 1 + 1e-9}

    best = max((f for f in facets if len(inside(f)) < most), key=lambda f: len(inside(f)))
    on, uv = inside(best), place(best)
    faces = {frozenset(face) for tet in tets for face in combinations(tet, 3) if on.issuperset(face)}

    def at(p, x0):
        return x0 + 260 * (p[0] + 0.5 * p[1]), 270 - 225 * p[1]

    parts = [polygon([at(uv[i], 20) for i in face], SKIN, opacity=0.6) for face in faces]
    parts += [f'<circle cx="{at(uv[i], 20)[0]:.2f}" cy="{at(uv[i], 20)[1]:.2f}" r="1.8" fill="{POINT}"/>'
              for i in on if i not in best]
    parts.append(polygon([at(p, 350) for p in ((0, 0), (1, 0), (0, 1))], SKIN, opacity=0.6))
    parts += [text(150, 300, f"after partition: {len(faces)} faces", "middle"),
              text(480, 300, "after elimination: 1 face", "middle")]
    return svg(640, 320, parts)


def stages(runs):
    """What is missing, and how many points there are, from stage to stage."""
    surfaces = [("Schönhardt's prism, 30°", ("hard", "schonhardt")),
                ("Chazelle, n = 3", ("hard", "chazelle", "-n", "3")),
                ("Chazelle, n = 6", ("hard", "chazelle", "-n", "6")),
                ("the paper's Fig. 15", ("paper", "touching"))]
    columns = ["triangles", "missing: Delaunay", "after flips", "partition points", "points left"]
    rows = []
    for name, made in surfaces:
        _, report = runs.mesh(runs.surface(*made), "--fill", "--without", "points")
        rows.append((name, [report["input"]["facets"], sum(report["delaunay"].values()), sum(report["flips"].values()),
                            sum(report["partition"].values()), report["steiner"]["count"]]))
    parts = [text(232 + 108 * k, 22, column, "middle", PALE, 11) for k, column in enumerate(columns)]
    top = math.log10(1 + max(max(numbers) for _, numbers in rows))
    for r, (name, numbers) in enumerate(rows):
        y = 62 + 46 * r
        parts.append(text(10, y, name))
        for k, number in enumerate(numbers):
            height = 26 * math.log10(1 + number) / top
            colour = (SKIN, INSIDE, INSIDE, POINT, POINT)[k]
            parts.append(f'<rect x="{202 + 108 * k}" y="{y + 4 - height:.1f}" width="18" height="{height:.1f}" fill="{colour}"/>')
            parts.append(text(226 + 108 * k, y, f"{number:,}"))
    return svg(740, 62 + 46 * len(rows), parts)


LAYER_ROWS = [("c", "C interface"), ("api", "the stages in their order"), ("io", "formats and files"),
              ("check", "the judge, independent"), ("untangle", "tangled meshes"), ("optimise", "shape of elements"),
              ("refine", "field points"), ("size", "sizes"), ("plane", "two-dimensional methods"),
              ("classify", "regions"), ("enforce", "partition, elimination"),
              ("suppress", "points go, or get doubles"), ("recover", "flips"), ("delaunay", "Delaunay"),
              ("surface", "the input and its validity"), ("mesh", "the mesh and its editor"), ("exact", "signs"),
              ("metric", "metrics"), ("numbers", "random orders, functions"), ("text", "numbers in messages")]


def layers(_):
    """The layers of the library and which of them include which, as the source has it."""
    words = re.search(r"set\(HOLDFAST_LAYERS ([\w ]+)\)", (ROOT / "CMakeLists.txt").read_text()).group(1).split()
    notes = dict(LAYER_ROWS)
    order = words[::-1]
    height = 26
    row = {layer: 30 + height * k for k, layer in enumerate(order)}
    parts = [text(14, 18, "each line is a folder of src; a dot: it includes that layer", "start", PALE, 11)]
    left = 330
    for k, layer in enumerate(order):
        parts.append(text(left + 20 * k + 4, 18, layer[:2], "middle", PALE, 10))
    for layer in order:
        y = row[layer]
        parts.append(f'<rect x="8" y="{y}" width="304" height="{height - 4}" fill="{SKIN}" fill-opacity="0.35"/>')
        parts.append(text(14, y + 15, f'<tspan font-weight="bold">{layer}</tspan>  {notes.get(layer, "")}'))
        used = set()
        for path in [*(ROOT / "src" / layer).glob("*.h"), *(ROOT / "src" / layer).glob("*.cpp")]:
            used |= set(re.findall(r'#include "(\w+)/', path.read_text()))
        for k, other in enumerate(order):
            x = left + 20 * k + 4
            if other == layer:
                parts.append(f'<rect x="{x - 4}" y="{y + 7}" width="8" height="8" fill="{PALE}"/>')
            elif other in used:
                parts.append(f'<circle cx="{x}" cy="{y + 11}" r="4" fill="{POINT}"/>')
    return svg(left + 20 * len(order) + 12, 36 + height * len(order), parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("holdfast", type=Path)
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "figures")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(arguments.holdfast.resolve(), folder)
        for name, figure in (("prism", prism), ("partition", partition), ("stages", stages), ("layers", layers)):
            path = arguments.out / f"{name}.svg"
            path.write_text(figure(runs))
            print(path)


if __name__ == "__main__":
    main()
