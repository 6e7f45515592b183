"""What the program says of files: what is left out, what a format does not hold, what is not finite, packed files."""
import gzip
import json

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, main, off


def poly(volume):
    nodes = "".join(f"{i} {x} {y} {z} {10 + i}\n" for i, (x, y, z) in enumerate(CUBE_POINTS))
    facets = "".join("1\n3 %d %d %d\n" % f for f in CUBE_FACETS)
    return f"8 3 0 1\n{nodes}12 0\n{facets}0\n1\n0 0.5 0.5 0.5 7 {volume}\n"


TETRAHEDRON = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n%s\nTetrahedra 1\n1 2 3 4 0\nEnd\n"
SIZES = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 1\n%s\nEnd\n"


class Formats(CliTest):
    def test_what_is_left_out_is_told_in_a_line_and_in_the_report(self):
        self.write("a.poly", poly(-1).replace("8 3 0 1", "8 3 1 0"))
        ended = self.run_program("mesh", "a.poly", "-o", "a.vtu", "--fill", "--report", "a.json")
        self.assertIn("holdfast: a.poly: 8 attributes of vertices are left out\n", ended.stderr)
        remarks = json.loads((self.folder / "a.json").read_text())["remarks"]
        self.assertEqual([(r["kind"], r["count"]) for r in remarks], [(1, 8)])
        ended = self.run_program("mesh", "a.poly", "-o", "a.vtu", "--fill", "-q")
        self.assertEqual(ended.stderr, "")

    def test_markers_of_points_go_through_meshing(self):
        self.write("a.poly", poly(-1))
        for name in ("a.vtu", "a.vtk", "a.mesh", "a.meshb", "a.msh", "a.node"):
            self.run_program("mesh", "a.poly", "-o", name, "-q")
            self.run_program("check", "a.poly", name)
        lines = (self.folder / "a.node").read_text().splitlines()
        self.assertEqual([line.split()[4] for line in lines[1:9]], [str(10 + i) for i in range(8)])

    def test_limits_on_volumes_become_sizes(self):
        self.write("coarse.poly", poly(-1))
        self.write("fine.poly", poly(0.0005))
        counts = []
        for name in ("coarse", "fine"):
            ended = self.run_program("mesh", name + ".poly", "-o", "a.vtu", "--report", "a.json")
            self.assertEqual("taken as a size" in ended.stderr, name == "fine")
            counts.append(json.loads((self.folder / "a.json").read_text())["mesh"]["tetrahedra"])
        self.assertGreater(counts[1], 5 * counts[0])
        ended = self.run_program("mesh", "fine.poly", "-o", "a.vtu", "--fill")
        self.assertIn("with --fill the sizes of 1 region in the file are unused", ended.stderr)

    def test_what_msh_does_not_hold_is_told(self):
        self.write("a.poly", poly(-1).replace(" 7 -1", " -7 -1"))
        ended = self.run_program("mesh", "a.poly", "-o", "a.msh", "--fill")
        self.assertIn("a.msh: ", ended.stderr)
        self.assertIn("negative", ended.stderr)
        ended = self.run_program("mesh", "a.poly", "-o", "a.vtu", "--fill")
        self.assertNotIn("negative", ended.stderr)

    def test_packed_files(self):
        (self.folder / "p.off.gz").write_bytes(gzip.compress(off(CUBE_POINTS, CUBE_FACETS).encode()))
        self.run_program("mesh", "p.off.gz", "-o", "p.vtu", "--fill")
        self.run_program("check", "p.off.gz", "p.vtu")
        ended = self.run_program("mesh", "p.off.gz", "-o", "p.vtu.gz", "--fill", expect=2)
        self.assertIn("no volume format", ended.stderr)

    def test_a_size_field_that_is_not_finite_is_refused(self):
        self.write("s.pos", 'View "s" {\nSS(0,0,0,inf,0,0,0,1,0,0,0,1){1,1,1,1};\n};\n')
        ended = self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "s.pos", expect=3)
        self.assertIn("s.pos: line 2: a coordinate is not finite", ended.stderr)
        self.write("s.mesh", TETRAHEDRON % "-1e308 0 0 0\n1e308 0 0 0\n0 1e3 0 0\n0 0 1e3 0")
        self.write("s.sol", SIZES % "0.5\n0.5\n0.5\n0.5")
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "s.mesh")

    def test_as_many_sizes_as_vertices(self):
        self.write("s.mtr", "5 1\n1\n1\n1\n1\n1\n")
        ended = self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "s.mtr", expect=3)
        self.assertIn("s.mtr: there are 5 sizes for 8 vertices of the surface", ended.stderr)


if __name__ == "__main__":
    main()
