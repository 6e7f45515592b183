"""A box in a box: two regions (10 core, 20 shell), six named sides and a named interface, meshed into every format."""
import itertools
import subprocess
from pathlib import Path

LOW, HIGH = (0.0, 0.0, 0.0), (3.0, 2.0, 1.0)
INNER_LOW, INNER_HIGH = (1.0, 0.5, 0.25), (2.0, 1.5, 0.75)
MARKERS = {1: "inlet", 2: "outlet", 3: "left", 4: "right", 5: "bottom", 6: "top", 7: "between"}
REGIONS = {10: "core", 20: "shell"}
VOLUMES = {10: 0.5, 20: 5.5}
AREAS = {1: 2.0, 2: 2.0, 3: 3.0, 4: 3.0, 5: 6.0, 6: 6.0, 7: 4.0}


def box(low, high, spacing):
    """The triangles of a box's six sides, as places, facing outwards, with their side's number; edges of `spacing`."""
    triangles = []
    for side in range(6):
        axis, top = divmod(side, 2)
        u, v = (axis + 1) % 3, (axis + 2) % 3
        counts = [max(1, round((high[k] - low[k]) / spacing)) for k in (u, v)]

        def place(i, j):
            point = [0.0, 0.0, 0.0]
            point[axis] = (low, high)[top][axis]
            for k, n, of in ((u, i, counts[0]), (v, j, counts[1])):
                point[k] = low[k] + (high[k] - low[k]) * n / of
            return tuple(point)

        for i in range(counts[0]):
            for j in range(counts[1]):
                a, b, c, d = place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)
                for corners in ((a, b, c), (a, c, d)):
                    triangles.append((corners if top else corners[::-1], side + 1))
    return triangles


def write_triangles(path, triangles):
    """Triangles of places, with markers, as a .mesh."""
    index = {}
    rows = []
    for corners, marker in triangles:
        rows.append(" ".join(str(index.setdefault(c, len(index)) + 1) for c in corners) + f" {marker}")
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(index))]
    lines += [" ".join(map(repr, p)) + " 0" for p in index] + ["Triangles", str(len(rows)), *rows]
    Path(path).write_text("\n".join(lines) + "\nEnd\n")


def write_surface(path, spacing):
    inner = [(corners, 7) for corners, _ in box(INNER_LOW, INNER_HIGH, spacing)]
    write_triangles(path, box(LOW, HIGH, spacing) + inner)


def mesh(program, folder, output, *options, size=0.5):
    """Meshes the assembly into `output`; returns the program's output."""
    surface = Path(folder) / f"assembly{size}.mesh"
    if not surface.exists():
        write_surface(surface, size)
    names = [f"{i}={n}" for i, n in MARKERS.items()] + [f"region:{i}={n}" for i, n in REGIONS.items()]
    command = [program, "mesh", surface, "-o", output, "--size", size, "--region", "1.5,1,0.5,10", "--region",
               "0.1,0.1,0.1,20", *itertools.chain.from_iterable(("--name", n) for n in names), *options]
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stderr
