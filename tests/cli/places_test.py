"""Vertices at one place are one vertex, in every format: files from programs that split vertices at seams."""
import json
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

PROGRAM = ""

POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
NORMALS = [(0, 0, -1), (0, 0, 1), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0)]


def cracked(low=(0, 0, 0)):
    """A cube whose sides have four vertices each, with a normal, and two triangles."""
    points, normals, facets = [], [], []
    for quad, normal in zip(QUADS, NORMALS):
        n = len(points)
        points += [tuple(a + b for a, b in zip(POINTS[v], low)) for v in quad]
        normals += [normal] * 4
        facets += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    return points, normals, facets


def numbers(values):
    return " ".join(str(x) for x in values)


def obj_with_repeated_v():
    """One `v` per corner, with texture coordinates and normals, as exporters of rendering programs write."""
    points, normals, facets = cracked()
    lines = [f"v {numbers(p)}" for p in points] + [f"vn {numbers(n)}" for n in normals]
    lines += ["vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"]
    lines += ["f " + " ".join(f"{v + 1}/{v % 4 + 1}/{v + 1}" for v in f) for f in facets]
    return "\n".join(lines) + "\n"


def ply():
    points, normals, facets = cracked()
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    head += [f"element face {len(facets)}", "property list uchar int vertex_indices", "end_header"]
    body = [numbers(p + n) for p, n in zip(points, normals)] + [f"3 {numbers(f)}" for f in facets]
    return "\n".join(head + body) + "\n"


def binary_ply():
    points, normals, facets = cracked()
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    head += [f"element face {len(facets)}", "property list uchar int vertex_indices", "end_header"]
    data = b"".join(struct.pack("<6f", *p, *n) for p, n in zip(points, normals))
    return ("\n".join(head) + "\n").encode() + data + b"".join(struct.pack("<B3i", 3, *f) for f in facets)


def vtp():
    points, normals, facets = cracked()

    def array(kind, name, components, rows):
        text = "\n".join(numbers(row) for row in rows)
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                f'{text}</DataArray>')
    ends = [(3 * (k + 1),) for k in range(len(facets))]
    return (f'<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
            f'NumberOfPolys="{len(facets)}"><PointData Normals="n">{array("Float32", "n", 3, normals)}</PointData>'
            f'<Points>{array("Float32", "Points", 3, points)}</Points><Polys>'
            f'{array("Int64", "connectivity", 1, facets)}{array("Int64", "offsets", 1, ends)}</Polys>'
            f'</Piece></PolyData></VTKFile>')


def off(low=(0, 0, 0)):
    points, _, facets = cracked(low)
    return "\n".join(["OFF", f"{len(points)} {len(facets)} 0"] + [numbers(p) for p in points] +
                     [f"3 {numbers(f)}" for f in facets]) + "\n"


def medit():
    points, _, facets = cracked()
    return "\n".join(["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(points))] +
                     [numbers(p) + " 0" for p in points] + ["Triangles", str(len(facets))] +
                     [numbers(v + 1 for v in f) + " 0" for f in facets] + ["End"]) + "\n"


class Places(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)

    def run_program(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def report(self):
        return json.loads((self.folder / "r.json").read_text())

    def test_split_vertices_in_every_format(self):
        for name, content in [("a.obj", obj_with_repeated_v()), ("a.ply", ply()), ("b.ply", binary_ply()),
                              ("a.vtp", vtp()), ("a.off", off()), ("a.mesh", medit())]:
            with self.subTest(name):
                self.write(name, content)
                done = self.run_program("mesh", name, "-o", "out.vtu", "--fill", "--report", "r.json")
                self.assertIn("24 vertices at 8 places: 16 merged", done.stderr)
                report = self.report()
                self.assertEqual(report["input"]["vertices"], 8)
                self.assertEqual(report["input"]["merged_vertices"], 16)
                self.assertEqual(report["input"]["left_out_vertices"], 0)
                self.assertTrue(report["input"]["closed"])
                points, _, _ = cracked()
                places = list(dict.fromkeys(points))
                self.assertEqual(report["vertex_map"], [places.index(p) for p in points])
                self.run_program("check", name, "out.vtu")
                done = self.run_program("diagnose", name)
                self.assertIn("valid: 8 vertices", done.stdout)
                self.assertIn("24 vertices at 8 places: 16 merged", done.stderr)

    def test_nothing_is_said_where_nothing_is_merged(self):
        facets = [(q[0], q[1], q[2]) for q in QUADS] + [(q[0], q[2], q[3]) for q in QUADS]
        self.write("a.off", f"OFF\n8 12 0\n" + "\n".join(numbers(p) for p in POINTS) + "\n" +
                   "\n".join(f"3 {numbers(f)}" for f in facets) + "\n")
        done = self.run_program("mesh", "a.off", "-o", "out.vtu", "--fill", "--report", "r.json")
        self.assertNotIn("places", done.stderr)
        self.assertEqual(self.report()["vertex_map"], [])
        self.assertEqual(self.run_program("diagnose", "a.off").stderr, "")

    def test_quiet_says_nothing(self):
        self.write("a.off", off())
        self.assertEqual(self.run_program("mesh", "a.off", "-o", "out.vtu", "--fill", "-q").stderr, "")
        self.assertEqual(self.run_program("diagnose", "a.off", "-q").stderr, "")

    def test_unused_vertices_that_are_repeated_or_not_finite_are_left_out(self):
        lines = obj_with_repeated_v().splitlines()
        self.write("a.obj", "\n".join(lines + ["v 0 0 0", "v nan 0 0", "v 0.5 0.5 0.5", "v 0.5 0.5 0.5"]) + "\n")
        done = self.run_program("mesh", "a.obj", "-o", "out.vtu", "--fill", "--report", "r.json")
        self.assertIn("28 vertices at 9 places: 16 merged, 3 unused left out", done.stderr)
        self.assertEqual(self.report()["vertex_map"][24:], [-1, -1, 8, -1])
        self.run_program("check", "a.obj", "out.vtu")

    def test_the_volume_names_the_input_vertex_of_each_vertex(self):
        points, _, facets = cracked()
        self.write("a.off", "OFF\n25 12 0\n9 9 nan\n" + "\n".join(numbers(p) for p in points) + "\n" +
                   "\n".join(f"3 {numbers(v + 1 for v in f)}" for f in facets) + "\n")
        self.run_program("mesh", "a.off", "-o", "out.vtu", "--size", "0.4", "--report", "r.json")
        vertex_map, added = self.report()["vertex_map"], self.report()["steiner"]["count"]
        self.assertGreater(added, 0)
        first = [vertex_map.index(k) for k in range(8)]
        self.assertEqual(self.array("out.vtu", "input_vertex"), first + [-1] * added)

    def array(self, name, array):
        """An array of 64-bit integers from a .vtu as the program writes them."""
        data = (self.folder / name).read_bytes()
        head, _, body = data.partition(b'<AppendedData encoding="raw">\n_')
        tag = re.search(rb'<DataArray type="Int64" Name="%s"[^>]*offset="(\d+)"' % array.encode(), head)
        self.assertIsNotNone(tag, f"no array {array}")
        at = int(tag.group(1))
        blocks, = struct.unpack_from("<Q", body, at)
        sizes = struct.unpack_from(f"<{blocks}Q", body, at + 24)
        at += 24 + 8 * blocks
        raw = b""
        for size in sizes:
            raw += zlib.decompress(body[at:at + size])
            at += size
        return list(struct.unpack(f"<{len(raw) // 8}q", raw))

    def test_several_files_count_on(self):
        # The second cube lacks the side that it shares with the first.
        self.write("left.off", off())
        right = off((1, 0, 0)).splitlines()
        right[1] = "24 10 0"
        right = [line for line in right if not line.startswith("3 16 17") and not line.startswith("3 16 18")]
        self.write("right.off", "\n".join(right) + "\n")
        self.run_program("mesh", "left.off", "right.off", "-o", "two.vtu", "--fill", "--report", "r.json")
        report = self.report()
        self.assertEqual(report["input"]["vertices"], 12)
        self.assertEqual(len(report["vertex_map"]), 48)
        self.assertEqual(report["vertex_map"][40:44], [-1] * 4)
        self.assertEqual(report["mesh"]["regions"], 2)
        self.run_program("check", "left.off", "right.off", "two.vtu")
        # A vertex of the second file in a triangle of the first.
        self.write("point.off", "OFF\n3 1 0\n0.5 0.5 0.5\n0.25 0.75 0.5\n0.7 0.6 0\n3 0 1 2\n")
        done = self.run_program("diagnose", "left.off", "point.off", code=4)
        self.assertIn("vertex 26 (0.7, 0.6, 0) lies inside triangle", done.stdout)

    def test_defects_name_the_vertices_of_the_file(self):
        lines = off().splitlines()
        lines[1] = "24 13 0"
        self.write("twice.off", "\n".join(lines + ["3 0 2 1"]) + "\n")
        done = self.run_program("mesh", "twice.off", "-o", "a.vtu", code=4)
        self.assertIn("triangles 0 and 12 have the same vertices 0, 1, 2", done.stderr)
        self.assertFalse((self.folder / "a.vtu").exists())
        # Two corners of the last triangle are one place.
        self.write("flat.off", "\n".join(lines + ["3 0 8 5"]) + "\n")
        done = self.run_program("diagnose", "flat.off", "--report", "r.json", "--marks", "m.vtu", code=4)
        self.assertIn("triangle 12 (0, 8, 5) has zero area: vertices 0 and 8 are one", done.stdout)
        defect, = self.report()["defects"]
        self.assertEqual((defect["rule"], defect["vertices"], defect["facets"]), (4, [0, 8, 5], [12]))
        # Not finite, and in use.
        self.write("nan.off", "\n".join(lines[:1] + ["24 12 0", "0 0 nan"] + lines[3:]) + "\n")
        done = self.run_program("mesh", "nan.off", "-o", "a.vtu", code=4)
        self.assertIn("vertex 0 (0, 0, nan) has a coordinate that is not finite", done.stderr)

    def test_sizes_of_vertices_are_those_of_the_file(self):
        self.write("a.off", off())
        self.write("a.mtr", "24 1\n" + "0.9\n" * 23 + "0.1\n")
        self.run_program("mesh", "a.off", "-o", "fine.vtu", "--size-field", "a.mtr", "--report", "r.json")
        fine = self.report()["field_points"]
        self.write("a.mtr", "24 1\n" + "0.9\n" * 24)
        self.run_program("mesh", "a.off", "-o", "coarse.vtu", "--size-field", "a.mtr", "--report", "r.json")
        self.assertGreater(fine, self.report()["field_points"])


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
