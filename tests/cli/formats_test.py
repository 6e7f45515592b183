"""Messages about files: data that is left out, data that a format cannot hold, coordinates that are not finite, compressed files."""
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
        for name in ("a.vtu", "a.vtm", "a.vtk", "a.mesh", "a.meshb", "a.msh", "a.node"):
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
        self.assertIn("region -7 is 1 in the file, since .msh takes positive numbers alone", ended.stderr)
        self.assertIn("marker 0 is 1 in the file, since .msh takes 0 for none", ended.stderr)
        ended = self.run_program("mesh", "a.poly", "-o", "a.vtu", "--fill")
        self.assertNotIn("in the file", ended.stderr)

    def test_names_go_from_the_command_line_into_the_files_and_the_report(self):
        self.run_program("mesh", "cube.off", "-o", "a.msh", "--markers-by-angle", "30", "--name", "1=inlet", "--name",
                         "region:1=solid part", "--report", "r.json", "--fill")
        text = (self.folder / "a.msh").read_text()
        self.assertIn('2 1 "inlet"', text)
        self.assertIn('2 6 "surface_6"', text)
        self.assertIn('3 1 "solid part"', text)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["names"]["facets"], {"1": "inlet"})
        ended = self.run_program("mesh", "a.msh", "-o", "b.vtu", "--markers-by-angle", "30", "--fill", expect=2)
        self.assertIn("every triangle of the surface has a marker", ended.stderr)
        for name in ("b.inp", "b.unv", "b.vol", "b.mfem", "b.bdf", "b.vtu", "b.vtm"):
            ended = self.run_program("mesh", "a.msh", "-o", name, "--fill", "--surface-of")
            self.run_program("check", "a.msh", name)
        ended = self.run_program("mesh", "a.msh", "-o", "b.inp", "--name", "2=o \xfcber", "--fill", "--surface-of")
        self.assertIn("1 name of a marker is changed to what .inp allows", ended.stderr)
        self.assertIn("ELSET=region_1", (self.folder / "b.inp").read_text())

    def test_names_stand_behind_the_cells_in_vtk(self):
        self.run_program("mesh", "cube.off", "-o", "a.vtk", "--name", "region:1=body", "--fill")
        lines = (self.folder / "a.vtk").read_text().splitlines()
        heads = [line.split()[0] for line in lines if line.split()[0] in ("POINTS", "CELLS", "CELL_TYPES", "FIELD", "CELL_DATA")]
        self.assertEqual(heads, ["POINTS", "CELLS", "CELL_TYPES", "FIELD", "CELL_DATA"])
        regions = json.loads(self.run_program("info", "a.vtk", "--json").stdout)["regions"]
        self.assertEqual([region["name"] for region in regions], ["body"])

    def test_markers_by_angle_of_a_surface_with_some_markers(self):
        triangles = "".join("%d %d %d %d\n" % (*(v + 1 for v in f), 7 * (i < 2)) for i, f in enumerate(CUBE_FACETS))
        points = "".join("%s %s %s 0\n" % p for p in CUBE_POINTS)
        self.write("a.mesh", f"MeshVersionFormatted 2\nDimension 3\nVertices 8\n{points}Triangles 12\n{triangles}End\n")
        self.run_program("mesh", "a.mesh", "-o", "a.vtu", "--fill", "--markers-by-angle", "30")
        self.run_program("check", "a.mesh", "a.vtu", "--markers-by-angle", "30")
        self.run_program("check", "a.mesh", "a.vtu", "--markers-by-angle", "100", expect=6)
        self.run_program("check", "a.mesh", "a.vtu", expect=6)
        self.run_program("mesh", "a.mesh", "-o", "b.vtu", "--fill")
        self.run_program("check", "a.mesh", "b.vtu", "--markers-by-angle", "30", expect=6)

    def test_options_on_how_a_file_is_written(self):
        self.run_program("mesh", "cube.off", "-o", "a.msh", "--fill", "--binary")
        self.assertIn(b"4.1 1 8", (self.folder / "a.msh").read_bytes()[:40])
        self.run_program("check", "cube.off", "a.msh")
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--fill", "--one-file")
        self.assertNotIn("a_surface.vtu", self.files())
        self.run_program("check", "cube.off", "a.vtu")
        self.run_program("mesh", "cube.off", "-o", "a.inp", "--fill", "--shells")
        self.assertIn("TYPE=S3", (self.folder / "a.inp").read_text())
        self.run_program("check", "cube.off", "a.inp")
        markers = json.loads(self.run_program("info", "a.inp", "--json").stdout)["markers"]
        self.assertEqual([(m["id"], m["name"]) for m in markers], [(0, None)])
        for option in ("--binary", "--one-file", "--gzip", "--shells"):
            ended = self.run_program("mesh", "cube.off", "-o", "a.vtk", "--fill", option, expect=2)
            self.assertIn(f"{option} does nothing for .vtk", ended.stderr)

    def test_openfoam(self):
        for arguments in (["case/constant/polyMesh"], ["other", "--format", "openfoam", "--gzip"]):
            self.run_program("mesh", "cube.off", "-o", *arguments, "--fill", "--name", "0=walls")
        plain, packed = self.folder / "case/constant/polyMesh", self.folder / "other/constant/polyMesh"
        names = ["boundary", "cellZones", "faceZones", "faces", "neighbour", "owner", "points"]
        self.assertEqual(sorted(p.name for p in plain.iterdir()), names)
        self.assertEqual(sorted(p.name for p in packed.iterdir()), [name + ".gz" for name in names])
        for name in names:
            self.assertEqual(gzip.decompress((packed / f"{name}.gz").read_bytes()), (plain / name).read_bytes())
        self.assertIn("    walls\n    {\n        type            patch;\n        nFaces          12;", (plain / "boundary").read_text())
        owner, neighbour = ([int(n) for n in (plain / name).read_text().split("(")[1].split(")")[0].split()]
                            for name in ("owner", "neighbour"))
        pairs = list(zip(owner, neighbour))
        self.assertEqual(pairs, sorted(pairs))
        self.assertTrue(all(a < b for a, b in pairs))
        # Written uncompressed into a folder with compressed files.
        self.run_program("mesh", "cube.off", "-o", "other", "--format", "openfoam", "--fill")
        self.assertEqual(sorted(p.name for p in packed.iterdir()), names)

    def test_packed_files(self):
        (self.folder / "p.off.gz").write_bytes(gzip.compress(off(CUBE_POINTS, CUBE_FACETS).encode()))
        self.run_program("mesh", "p.off.gz", "-o", "p.vtu", "--fill")
        self.run_program("check", "p.off.gz", "p.vtu")
        ended = self.run_program("mesh", "p.off.gz", "-o", "p.vtu.gz", "--fill", expect=2)
        self.assertIn("no format to write", ended.stderr)

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
