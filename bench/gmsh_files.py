"""Gmsh on a surface that it keeps: its input and output files, and the test that it keeps the surface."""
import subprocess

# Without any sizes, so that it adds as few points as possible.
FILL_BY_HXT = """Merge "s.msh";
Surface Loop(1) = {1};
Volume(1) = {1};
Mesh.Algorithm3D = 10;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = 1e22;
Mesh.Optimize = 0;
Mesh.SaveAll = 1;
"""
TRIANGLE, TETRAHEDRON = "2", "4"  # types of elements in .msh


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


def read_msh(path):
    """(points by number, triangles, tetrahedra), all as the words of the file."""
    with open(path, encoding="ascii") as file:
        lines = [line.split() for line in file]

    def section(name):
        first = lines.index([name]) + 1
        return lines[first + 1:first + 1 + int(lines[first][0])]

    elements = section("$Elements")
    return ({row[0]: tuple(map(float, row[1:4])) for row in section("$Nodes")},
            [row[-3:] for row in elements if row[1] == TRIANGLE], [row[-4:] for row in elements if row[1] == TETRAHEDRON])


def told(corners):
    """A face by its corners' positions: programs write one or two digits fewer than a double needs."""
    return tuple(sorted(tuple(float(f"{x:.12g}") for x in p) for p in corners))


def fill_by_hxt(surface, folder, limit):
    """(number of points added, tetrahedra by their corners' positions), or None if HXT fails, takes longer than `limit`
    seconds or changes the surface."""
    points, triangles = read_off(surface)
    write_msh(folder / "s.msh", points, triangles)
    (folder / "hxt.geo").write_text(FILL_BY_HXT, encoding="ascii")
    try:
        done = subprocess.run(["gmsh", "-3", "-nt", "1", "-format", "msh2", "-o", "hxt.msh", "hxt.geo"], cwd=folder,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0 or b"Error" in done.stdout or not (folder / "hxt.msh").exists():
        return None
    position, kept, tetrahedra = read_msh(folder / "hxt.msh")
    if not all(v in position for t in kept + tetrahedra for v in t):  # it has written elements of a node 0
        return None
    given = [tuple(map(float, p[:3])) for p in points]
    if not tetrahedra or sorted(told(position[v] for v in t) for t in kept) != sorted(
            told(given[int(v)] for v in t) for t in triangles):
        return None
    on_surface = {v for t in kept for v in t}
    added = {v for t in tetrahedra for v in t} - on_surface
    return len(added), [tuple(position[v] for v in t) for t in tetrahedra]
