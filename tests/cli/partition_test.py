"""--partition of `mesh`, `convert` and `join`, and the pieces of `join`, from outside.

    partition_test.py PROGRAM [unittest options]
"""
import json
import re
import struct
import zlib

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted

FORMATS = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt32": "I", "UInt8": "B"}


def read_vtu(path):
    """Arrays of a .vtu by name, points and corners included."""
    data = path.read_bytes()
    head, _, raw = data.partition(b'<AppendedData encoding="raw">\n_')
    arrays = {}
    for tag in re.findall(r"<DataArray ([^>]*)/>", head.decode()):
        attributes = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        at = int(attributes["offset"])
        blocks, _, _ = struct.unpack_from("<3Q", raw, at)
        sizes = struct.unpack_from(f"<{blocks}Q", raw, at + 24)
        at += 24 + 8 * blocks
        values = b""
        for size in sizes:
            values += zlib.decompress(raw[at:at + size])
            at += size
        kind = FORMATS[attributes["type"]]
        flat = struct.unpack(f"<{len(values) // struct.calcsize(kind)}{kind}", values)
        columns = int(attributes.get("NumberOfComponents", 1))
        name = attributes["Name"]
        arrays[name if name not in arrays else "point " + name] = (
            [flat[i:i + columns] for i in range(0, len(flat), columns)] if columns > 1 else list(flat))
    tables = {}
    for name, columns, text in re.findall(r'Name="([^"]*)" NumberOfComponents="(\d+)"[^>]*format="ascii">([^<]*)<',
                                          head.decode()):
        numbers = list(map(int, text.split()))
        tables[name] = [tuple(numbers[i:i + int(columns)]) for i in range(0, len(numbers), int(columns))]
    return arrays, tables


class Partitioned(CliTest):
    def setUp(self):
        super().setUp()
        if "without METIS" in self.run_program_any("mesh", "cube.off", "--fill", "-o", "x.pvtu", "--partition", 1):
            self.skipTest("built without METIS")

    def run_program_any(self, *arguments):
        import subprocess
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              check=False).stderr

    def write_two(self):
        """Two adjacent boxes, with a marker each and one between them."""
        facets = [(f, 1) for f in CUBE_FACETS]
        points = CUBE_POINTS + [(2, 0, 0), (2, 1, 0), (2, 0, 1), (2, 1, 1)]
        number = {p: i for i, p in enumerate(points)}
        for f in CUBE_FACETS:
            moved = tuple(number[(CUBE_POINTS[v][0] + 1, *CUBE_POINTS[v][1:])] for v in f)
            if any(points[v][0] == 2 for v in moved) or not all(points[v][0] == 1 for v in moved):
                facets.append((moved, 2))
        facets = [(f, 3) if all(points[v][0] == 1 for v in f) else (f, m) for f, m in facets]
        self.write("two.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points)
                   + "".join("%r %r %r 0\n" % p for p in points) + "Triangles\n%d\n" % len(facets)
                   + "".join("%d %d %d %d\n" % (*[v + 1 for v in f], m) for f, m in facets) + "End\n")

    def test_pieces_of_vtk_are_the_mesh(self):
        self.run_program("mesh", "cube.off", "-o", "whole.mesh", "--size", 0.2)
        self.run_program("convert", "whole.mesh", "p.pvtu", "--partition", 3)
        whole = (self.folder / "whole.mesh").read_text().split()
        count = int(whole[whole.index("Tetrahedra") + 1])
        index = (self.folder / "p.pvtu").read_text()
        self.assertEqual(re.findall(r'Piece Source="([^"]*)"', index), ["p_0.vtu", "p_1.vtu", "p_2.vtu"])
        owned, points, between = [], {}, {}
        for k in range(3):
            arrays, tables = read_vtu(self.folder / f"p_{k}.vtu")
            self.assertEqual([g for g in arrays["vtkGhostType"]], [int(p != k) for p in arrays["part"]])
            owned += [t for t, g in zip(arrays["tetrahedron"], arrays["vtkGhostType"]) if not g]
            self.assertIn(1, arrays["vtkGhostType"])
            for v, p in zip(arrays["vertex"], arrays["Points"]):
                self.assertEqual(points.setdefault(v, p), p)
            for other, *face in tables["holdfast:interfaces"]:
                between.setdefault(frozenset((k, other)), []).append(
                    (k, [arrays["vertex"][v] for v in face]))
        self.assertEqual(sorted(owned), list(range(count)))
        self.assertTrue(between)
        for pair, faces in between.items():
            low, high = min(pair), max(pair)
            self.assertEqual([f for k, f in faces if k == low], [[a, c, b] for k, (a, b, c) in faces if k == high])

    def test_the_same_each_time_and_from_mesh(self):
        self.run_program("mesh", "cube.off", "-o", "a.pvtu", "--size", 0.2, "--partition", 9)
        self.run_program("mesh", "cube.off", "-o", "b.pvtu", "--size", 0.2, "--partition", 9, "--threads", 2)
        for k in range(9):
            for end in ("", "_surface"):
                self.assertEqual((self.folder / f"a_{k}{end}.vtu").read_bytes(),
                                 (self.folder / f"b_{k}{end}.vtu").read_bytes())

    def test_pieces_appear_together_or_not_at_all(self):
        """The disk is full for a file of the last piece, when the others are complete."""
        self.run_program("mesh", "cube.off", "-o", "whole.mesh", "--size", 0.2)
        self.run_program("convert", "whole.mesh", "p.pvtu", "--partition", 2)
        before = {path.name: path.read_bytes() for path in self.folder.glob("p*")}
        full = self.folder / "p_2.vtu"
        full.symlink_to("/dev/full")
        self.run_program("convert", "whole.mesh", "p.pvtu", "--partition", 3, expect=3)
        full.unlink()
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.glob("p*")}, before)
        full = self.folder / "case/processor2/constant/polyMesh/faceZones"
        full.parent.mkdir(parents=True)
        full.symlink_to("/dev/full")
        self.run_program("convert", "whole.mesh", "case", "--format", "openfoam", "--partition", 3, expect=3)
        self.assertEqual([path.name for path in (self.folder / "case").iterdir()], ["processor2"])
        self.assertEqual(list(full.parent.iterdir()), [full])

    def test_processors_of_openfoam_have_the_same_patches(self):
        self.write_two()
        self.run_program("mesh", "two.mesh", "-o", "case", "--format", "openfoam", "--size", 0.3, "--partition", 4,
                         "--name", "3=wall")
        names, faces = [], {}
        for k in range(4):
            boundary = (self.folder / f"case/processor{k}/constant/polyMesh/boundary").read_text()
            patches = re.findall(r"\n    ([^\s{}]+)\n    \{([^}]*)\}", boundary)
            names.append([n for n, _ in patches if not n.startswith("procBoundary")])
            for name, body in patches:
                if name.startswith("procBoundary"):
                    mine, other = map(int, re.findall(r"\d+", name))
                    self.assertEqual(mine, k)
                    faces[mine, other] = int(re.search(r"nFaces\s+(\d+)", body).group(1))
        self.assertTrue(all(n == names[0] for n in names), names)
        self.assertEqual(sorted(names[0]), ["surface_1", "surface_2"])
        self.assertTrue(faces)
        for (mine, other), count in faces.items():
            self.assertEqual(faces[other, mine], count)
        zones = (self.folder / "case/processor0/constant/polyMesh/faceZones").read_text()
        self.assertIn("wall", zones)
        # OpenFOAM counts the folders.
        self.assertIn("processor3", self.run_program("mesh", "two.mesh", "-o", "case", "--format", "openfoam", "--size",
                                                     0.3, "--partition", 3, expect=3).stderr)
        self.run_program("info", "case/processor1")
        for command in ("info", "case"), ("check", "two.mesh", "case"), ("mesh", "case", "-o", "a.vtu"):
            said = self.run_program(*command, expect=3).stderr
            self.assertIn("a case that is only decomposed (`reconstructParMesh -constant` makes its mesh", said)
        self.assertIn("give case/processor0/constant/polyMesh itself", self.run_program("info", "case/processor0/constant", expect=3).stderr)

    def test_gmsh_has_entities_by_part_and_reads_back(self):
        self.write_two()
        self.run_program("mesh", "two.mesh", "-o", "whole.vtu", "--size", 0.3)
        for more in ([], ["--binary"]):
            self.run_program("convert", "whole.vtu", "p.msh", "--partition", 3, *more)
            text = (self.folder / "p.msh").read_bytes()
            for section in (b"$PartitionedEntities", b"$GhostElements"):
                self.assertIn(section, text)
            self.run_program("check", "two.mesh", "p.msh")

    def test_xdmf_has_its_arrays(self):
        self.run_program("mesh", "cube.off", "-o", "p.xdmf", "--size", 0.3, "--partition", 2)
        self.assertIn('Attribute Name="part"', (self.folder / "p.xdmf").read_text())
        names = (self.folder / "p.h5").read_bytes()
        for name in (b"ghosts", b"ghost_offsets", b"interfaces", b"part"):
            self.assertTrue(name in names, name)

    def test_parts_of_a_split_surface_stay_as_they_are(self):
        self.run_program("split", "cube.off", "--parts", 3, "--size", 0.25, "-o", "d")
        parts = json.loads((self.folder / "d/manifest.json").read_text())["parts"]
        for part in parts:
            self.run_program("mesh", f"d/{part['surface']}", "-o", f"d/{part['volume']}", "-q")
        self.run_program("join", "d", "-o", "j.pvtu")
        self.run_program("join", "d", "-o", "whole.mesh")
        whole = (self.folder / "whole.mesh").read_text().split()
        owned = []
        for k in range(len(parts)):
            arrays, _ = read_vtu(self.folder / f"j_{k}.vtu")
            owned += [t for t, g in zip(arrays["tetrahedron"], arrays["vtkGhostType"]) if not g]
        self.assertEqual(owned, list(range(int(whole[whole.index("Tetrahedra") + 1]))))
        self.run_program("join", "d", "-o", "j.msh", "--as-parts")
        self.run_program("check", "cube.off", "j.msh")
        self.run_program("join", "d", "-o", "case", "--format", "openfoam", "--as-parts")
        self.assertTrue((self.folder / f"case/processor{len(parts) - 1}/constant/polyMesh/points").exists())
        self.run_program("join", "d", "-o", "k.pvtu", "--partition", 5)
        self.assertTrue((self.folder / "k_4.vtu").exists())

    def test_what_pieces_of_a_split_surface_do_not_hold_is_told(self):
        self.write("wire.off", off(CUBE_POINTS + [(0.4, 0.4, 0.4), (0.6, 0.6, 0.5)], [*CUBE_FACETS, (8, 9)]))
        self.run_program("split", "wire.off", "--parts", 2, "--size", 0.4, "-o", "d")
        for k in (1, 2):
            self.run_program("mesh", f"d/part_{k}.poly", "-o", f"d/part_{k}.vtu")
        self.assertIn("1 segment", self.run_program("join", "d", "-o", "j.xdmf", "--as-parts").stderr)
        self.assertNotIn("segment", self.run_program("join", "d", "-o", "j.pvtu").stderr)

    def test_what_makes_no_sense_is_refused(self):
        for options in (["-o", "x.vtu", "--partition", 2], ["-o", "x.pvtu"], ["-o", "x.pvtu", "--partition", 0],
                        ["-o", "x.pvtu", "--partition", 100000], ["-o", "-", "--format", "pvtu", "--partition", 2],
                        ["-o", "x.xdmf", "--partition", 2, "--one-file"], ["-o", "x.pvtu", "--partition", 2, "--order", 2]):
            before = self.files()
            self.assertTrue(self.run_program("mesh", "cube.off", "--fill", *options, expect=2).stderr)
            self.assertEqual(self.files(), before)
        for command in (["mesh", "missing.off", "-o"], ["convert", "missing.vtu"]):  # before the file is read
            said = self.run_program(*command, "x.pvtu", "--partition", 2, "--order", 2, expect=2).stderr
            self.assertIn("second order", said)


if __name__ == "__main__":
    main()
