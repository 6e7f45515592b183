"""The pieces that a .pvtu names, read as one mesh.

    pieces_test.py PROGRAM [unittest options]
"""
import json
import subprocess

from cli_case import CUBE_FACETS, CliTest, cube, main, off, shifted


def grid(points, cells, point_arrays=(), cell_arrays=()):
    """A .vtu in text; cells are tetrahedra."""
    def array(kind, name, values, columns=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{columns}" format="ascii">'
                f'{" ".join(map(str, values))}</DataArray>\n')
    return ('<VTKFile type="UnstructuredGrid" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n'
            + array("Float64", "Points", [x for p in points for x in p], 3) + "</Points>\n<Cells>\n"
            + array("Int64", "connectivity", [v for c in cells for v in c])
            + array("Int64", "offsets", [4 * i + 4 for i in range(len(cells))]) + array("UInt8", "types", [10] * len(cells))
            + "</Cells>\n<PointData>\n" + "".join(array(*a) for a in point_arrays) + "</PointData>\n<CellData>\n"
            + "".join(array(*a) for a in cell_arrays) + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def index(*names, kind="PUnstructuredGrid"):
    pieces = "".join(f'<Piece Source="{name}"/>\n' for name in names)
    return f'<VTKFile type="{kind}">\n<{kind} GhostLevel="1">\n{pieces}</{kind}>\n</VTKFile>\n'


CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]  # of two tetrahedra that share a face
FIRST, SECOND = (0, 1, 2, 3), (1, 4, 2, 3)


class Pieces(CliTest):
    def mesh(self, name):
        """Points, tetrahedra with regions, and triangles with markers as a set."""
        self.run_program("convert", name, "out.mesh", "-q")
        words = (self.folder / "out.mesh").read_text().split()

        def rows(section, width):
            if section not in words:
                return []
            at = words.index(section)
            values = words[at + 2:at + 2 + width * int(words[at + 1])]
            return [tuple(values[i:i + width]) for i in range(0, len(values), width)]
        triangles = {(frozenset(t[:3]), t[3]) for t in rows("Triangles", 4)}
        self.assertEqual(len(triangles), len(rows("Triangles", 4)))
        return rows("Vertices", 4), rows("Tetrahedra", 5), triangles

    def test_what_partition_wrote_is_the_mesh_again(self):
        self.write("boxes.off", off(cube(size=4) + cube((1, 1, 1)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        written = subprocess.run([self.program, "mesh", "boxes.off", "-o", "p.pvtu", "--partition", "3", "--keep", "bounded"],
                                 cwd=self.folder, capture_output=True, text=True, check=False)
        if "without METIS" in written.stderr:
            self.skipTest("built without METIS")
        self.run_program("mesh", "boxes.off", "-o", "whole.vtu", "--keep", "bounded", "--region", "0.5,0.5,0.5,10", "--region",
                         "1.5,1.5,1.5,20", "--name", "region:20=core", "--markers-by-angle", "30", "--size", "1")
        self.run_program("convert", "whole.vtu", "p.pvtu", "--partition", "4")
        self.assertEqual(self.mesh("p.pvtu"), self.mesh("whole.vtu"))
        self.run_program("check", "boxes.off", "p.pvtu")
        self.run_program("view", "p.pvtu", "-o", "page.html")
        told = json.loads(self.run_program("info", "p.pvtu", "--json").stdout)
        self.assertEqual({r["id"]: r["name"] for r in told["regions"]}, {10: None, 20: "core"})
        self.assertEqual(told["remarks"], [])
        self.run_program("mesh", "p.pvtu", "--surface-of", "-o", "again.vtu")
        self.run_program("check", "p.pvtu", "--surface-of", "again.vtu")
        self.assertNotEqual(self.run_program("convert", "p.pvtu", "p_1.vtu", expect=2).stderr, "")  # what it reads

    def test_pieces_of_a_split_surface(self):
        self.run_program("split", "cube.off", "-o", "d", "--parts", "2", "--size", "0.3")
        for part in json.loads((self.folder / "d/manifest.json").read_text())["parts"]:
            surface = part["surface"]
            self.run_program("mesh", f"d/{surface}", "-o", f"d/{part['volume']}", "--size", "0.3", "-q")
        self.run_program("join", "d", "-o", "whole.vtu")
        self.run_program("join", "d", "-o", "p.pvtu")
        self.assertEqual(self.mesh("p.pvtu"), self.mesh("whole.vtu"))

    def test_ghosts_and_ids(self):
        for ids in "vertex", "GlobalPointIds", "GlobalNodeIds":
            self.write("a.vtu", grid(CORNERS, [FIRST, SECOND], [("Int64", ids, (10, 11, 12, 13, 14))],
                                     [("UInt8", "vtkGhostType", (0, 1)), ("Int32", "region", (1, 9))]))
            self.write("b.vtu", grid(CORNERS[::-1], [(3, 0, 2, 1)], [("Int64", ids, (14, 13, 12, 11, 10))],
                                     [("UInt8", "vtkGhostType", (0,)), ("Int32", "region", (2,))]))
            self.write("p.pvtu", index("a.vtu", "b.vtu"))
            points, tetrahedra, _ = self.mesh("p.pvtu")
            self.assertEqual([tuple(map(float, p[:3])) for p in points], CORNERS)
            self.assertEqual(tetrahedra, [("1", "2", "3", "4", "1"), ("2", "5", "3", "4", "2")])

    def test_points_without_ids_are_joined_by_their_places(self):
        self.write("a.vtu", grid(CORNERS[:4], [(0, 1, 2, 3)]))
        self.write("b.vtu", grid(CORNERS[1:], [(0, 3, 1, 2)]))
        self.write("p.pvtu", index("a.vtu", "b.vtu"))
        points, tetrahedra, _ = self.mesh("p.pvtu")
        self.assertEqual((len(points), tetrahedra), (5, [("1", "2", "3", "4", "0"), ("2", "5", "3", "4", "0")]))
        said = self.run_program("convert", "p.pvtu", "w.vtu").stderr
        self.assertIn("3 points at the places of others, of pieces that have no ids of points, are left out", said)

    def test_pieces_in_one_file(self):
        def in_one(*grids):
            pieces = "".join(g[g.index("<Piece"):g.index("</UnstructuredGrid>")] for g in grids)
            head, tail = grids[0][:grids[0].index("<Piece")], "</UnstructuredGrid>\n</VTKFile>\n"
            names = ('<FieldData><DataArray type="Int64" Name="core" NumberOfComponents="2" NumberOfTuples="1" '
                     'format="ascii">2 3</DataArray></FieldData>\n')
            return head + names + pieces + tail
        empty = '<Piece NumberOfPoints="0" NumberOfCells="0"></Piece>'
        self.write("p.vtu", in_one(
            grid(CORNERS[:4], [(0, 1, 2, 3)], [("Int32", "marker", (5, 0, 0, 0))], [("Int32", "region", (1,))]),
            empty + "</UnstructuredGrid>",
            grid(CORNERS[1:], [(0, 3, 1, 2)], [("Int32", "marker", (0, 0, 0, 6))], [("Int32", "region", (2,))])))
        points, tetrahedra, _ = self.mesh("p.vtu")
        self.assertEqual([tuple(map(float, p[:3])) for p in points], CORNERS)
        self.assertEqual([p[3] for p in points], ["5", "0", "0", "0", "6"])
        self.assertEqual(tetrahedra, [("1", "2", "3", "4", "1"), ("2", "5", "3", "4", "2")])
        told = json.loads(self.run_program("info", "p.vtu", "--json").stdout)
        self.assertEqual({r["id"]: r["name"] for r in told["regions"]}, {1: None, 2: "core"})
        # Ghosts are copies of cells of other pieces; ids say which points are one.
        self.write("g.vtu", in_one(
            grid(CORNERS, [FIRST, SECOND], [("Int64", "GlobalPointIds", (10, 11, 12, 13, 14))],
                 [("UInt8", "vtkGhostType", (0, 1)), ("Int32", "region", (1, 9))]),
            grid(CORNERS[::-1], [(3, 0, 2, 1)], [("Int64", "GlobalPointIds", (14, 13, 12, 11, 10))],
                 [("UInt8", "vtkGhostType", (0,)), ("Int32", "region", (2,))])))
        self.assertEqual(self.mesh("g.vtu")[1:], self.mesh("p.vtu")[1:])
        # The pieces of a .pvtu may consist of pieces.
        self.write("q.pvtu", index("g.vtu"))
        self.assertEqual(self.mesh("q.pvtu")[1], self.mesh("p.vtu")[1])

    def test_triangles_and_sizes_in_pieces_of_one_file(self):
        def piece(points, triangles, size):
            return (f'<Piece NumberOfPoints="{len(points)}" NumberOfPolys="{len(triangles)}">\n<Points>\n<DataArray type="Float64" '
                    f'NumberOfComponents="3" format="ascii">{" ".join(str(x) for p in points for x in p)}</DataArray></Points>\n'
                    f'<Polys><DataArray type="Int64" Name="connectivity" format="ascii">{" ".join(str(v) for t in triangles for v in t)}'
                    '</DataArray><DataArray type="Int64" Name="offsets" format="ascii">'
                    f'{" ".join(str(3 * i + 3) for i in range(len(triangles)))}</DataArray></Polys></Piece>\n')
        points = cube()
        self.write("s.vtp", '<VTKFile type="PolyData" byte_order="LittleEndian">\n<PolyData>\n' + piece(points, CUBE_FACETS[:5], 1)
                   + piece(points[::-1], [tuple(7 - v for v in f) for f in CUBE_FACETS[5:]], 1) + "</PolyData></VTKFile>\n")
        self.run_program("mesh", "s.vtp", "-o", "v.vtu", "--fill")
        self.run_program("check", "cube.off", "v.vtu")
        self.run_program("mesh", "cube.off", "-o", "w.mesh", "--size", "0.5")
        counts = []
        for size in 0.4, 0.1:
            background = grid([(x * 4 - 1, y * 4 - 1, z * 4 - 1) for x, y, z in CORNERS[:4]], [FIRST], [("Float64", "size", [size] * 4)])
            other = grid([(x * 4 - 1, y * 4 - 1, z * 4 - 1) for x, y, z in CORNERS[1:]], [(0, 3, 1, 2)], [("Float64", "size", [size] * 4)])
            self.write("b.vtu", background.replace("</UnstructuredGrid>", other[other.index("<Piece"):other.index("</UnstructuredGrid>")]
                                                   + "</UnstructuredGrid>"))
            self.run_program("mesh", "cube.off", "-o", "v.vtu", "--size-field", "b.vtu", "--report", "r.json")
            counts.append(json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"])
        self.assertGreater(counts[1], 10 * counts[0])

    def test_a_surface_beside_that_does_not_tell_its_points_is_refused(self):
        self.run_program("mesh", "cube.off", "-o", "v.vtu")
        self.write("v_surface.vtu", grid(CORNERS[:4], [FIRST]))
        self.assertIn("v_surface.vtu: its points do not tell", self.run_program("info", "v.vtu", expect=3).stderr)

    def test_errors_name_the_line_or_the_point(self):
        self.write("a.vtu", grid(CORNERS[:4], [(0, 1, 2, 3)], [("Int64", "vertex", (0, 1, 2, 3))]))
        (self.folder / "folder.vtu").mkdir()
        for pieces, message in ((("a.vtu", "none.vtu"), "line 4: the piece"), (("a.vtu", "a.vtu"), "line 4: the piece 'a.vtu' is named twice"),
                                (("a.vtu", "./a.vtu"), "line 4: the piece './a.vtu' is named twice"),
                                (("a.vtp",), "line 3: a piece in the format '.vtp' is not read"), (("",), "line 3: the piece names no file"),
                                (("folder.vtu",), "line 3: the piece"), ((), "the file names no pieces"),
                                (("p.pvtu",), "line 3: a piece in the format '.pvtu'")):
            self.write("p.pvtu", index(*pieces))
            for command in (["convert", "p.pvtu", "w.vtu"], ["mesh", "p.pvtu", "-o", "w.vtu"], ["check", "cube.off", "p.pvtu"],
                            ["view", "p.pvtu", "-o", "page.html"]):
                said = self.run_program(*command, expect=3).stderr
                self.assertIn(message, said)
                self.assertIn("p.pvtu", said)
        self.write("p.pvtu", index("a.vtu", kind="PImageData"))
        self.assertIn("line 1: the type 'PImageData' is not read", self.run_program("info", "p.pvtu", expect=3).stderr)
        self.write("p.pvtu", index("a.vtu", "b.vtu"))
        for ids, message in (((0, 1, 2, 3), "point 0: it has the id 0 in the whole, as a point at another place has in"),
                             ((-1, 5, 6, 7), "point 0: its id in the whole, -1, is negative")):
            self.write("b.vtu", grid(CORNERS[1:], [(0, 3, 1, 2)], [("Int64", "vertex", ids)]))
            said = self.run_program("convert", "p.pvtu", "w.vtu", expect=3).stderr
            self.assertIn("b.vtu", said)
            self.assertIn(message, said)
        self.write("b.vtu", grid(CORNERS[1:], [(0, 3, 1, 2)]))
        self.assertIn("line 4: some pieces have ids", self.run_program("convert", "p.pvtu", "w.vtu", expect=3).stderr)
        self.write("b.vtu", grid(CORNERS[1:], [(0, 3, 1, 9)], [("Int64", "vertex", (1, 2, 3, 4))]))
        self.assertIn("b.vtu", self.run_program("convert", "p.pvtu", "w.vtu", expect=3).stderr)
        self.assertNotIn("w.vtu", self.files())


if __name__ == "__main__":
    main()
