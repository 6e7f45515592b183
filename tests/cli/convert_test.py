"""`holdfast convert` and `holdfast info`: any format to any, parts of a mesh, and what a file holds.

    convert_test.py PROGRAM [unittest options]
"""
import json
import subprocess

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted

VOLUMES = ["vtu", "vtk", "mesh", "meshb", "msh", "node"]
SURFACES = ["off", "obj", "stl", "ply", "poly", "mesh", "meshb", "msh", "vtk", "vtu", "node"]


class Convert(CliTest):
    def info(self, *arguments):
        return json.loads(self.run_program("info", "--json", *arguments).stdout)

    def boxes(self):
        """A box in a box, regions 10 (63 of volume) and 20 (1), as boxes.vtu."""
        self.write("boxes.off", off(cube(size=4) + cube((1, 1, 1)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.run_program("mesh", "boxes.off", "-o", "boxes.vtu", "--region", "0.5,0.5,0.5,10", "--region",
                         "1.5,1.5,1.5,20", "--keep", "bounded", "-q")

    def test_volumes_from_any_format_to_any(self):
        self.boxes()
        said = self.info("boxes.vtu")
        for ending in VOLUMES:
            for other in VOLUMES:
                with self.subTest(f"{ending} to {other}"):
                    self.run_program("convert", "boxes.vtu", f"a.{ending}", "-q")
                    self.run_program("convert", f"a.{ending}", f"b.{other}", "-q")
                    found = self.info(f"b.{other}")
                    self.assertEqual(found["kind"], "volume")
                    for key in ("vertices", "tetrahedra", "triangles", "box"):
                        self.assertEqual(found[key], said[key])
                    self.assertEqual([(r["id"], r["tetrahedra"]) for r in found["regions"]],
                                     [(r["id"], r["tetrahedra"]) for r in said["regions"]])
                    self.run_program("check", "boxes.off", f"b.{other}")

    def test_surfaces_from_any_format_to_any(self):
        for ending in SURFACES:
            for other in SURFACES:
                with self.subTest(f"{ending} to {other}"):
                    self.run_program("convert", "cube.off", f"a.{ending}", "-q")
                    self.run_program("convert", f"a.{ending}", f"b.{other}", "-q")
                    found = self.info(f"b.{other}")
                    self.assertEqual((found["kind"], found["vertices"], found["triangles"]), ("surface", 8, 12))
                    self.assertTrue(found["closed"])
                    self.assertAlmostEqual(found["area"], 6)
                    self.assertAlmostEqual(found["volume"], 1)

    def test_a_surface_whose_corners_are_split_is_closed_all_the_same(self):
        sides = "0 2 3 1  4 5 7 6  0 1 5 4  2 6 7 3  0 4 6 2  1 3 7 5".split()
        corners = "".join(f"v {int(v) & 1} {int(v) >> 1 & 1} {int(v) >> 2}\n" for v in sides)
        (self.folder / "split.obj").write_text(corners + "".join(f"f {4 * i + 1} {4 * i + 2} {4 * i + 3} {4 * i + 4}\n"
                                                                 for i in range(6)))
        found = self.info("split.obj")
        self.assertEqual((found["vertices"], found["closed"]), (24, True))
        self.assertAlmostEqual(found["volume"], 1)

    def test_a_volume_in_a_format_of_surfaces_is_its_surface_and_told(self):
        self.boxes()
        said = self.run_program("convert", "boxes.vtu", "boxes.stl").stderr
        self.assertIn("tetrahedra", said)
        self.assertEqual(self.info("boxes.stl")["triangles"], 24)
        self.assertEqual(self.run_program("convert", "boxes.vtu", "boxes.stl", "-q").stderr, "")
        self.run_program("convert", "boxes.vtu", "boxes2.stl", "--only", "volume", expect=2)

    def test_mesh_writes_its_boundary_in_a_format_of_surfaces(self):
        self.write("boxes.off", off(cube(size=4) + cube((1, 1, 1)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        for name in ("out.stl", "out.ply", "out.obj", "out.off", "out.poly"):
            said = self.run_program("mesh", "boxes.off", "-o", name, "--keep", "bounded").stderr
            self.assertIn("tetrahedra and the ids of 2 regions are left out", said)
            self.assertEqual(self.info(name)["triangles"], 24)
            self.run_program("diagnose", name)
        self.run_program("mesh", "boxes.off", "-o", "out2.stl", "--order", "2", expect=2)
        self.run_program("mesh", "boxes.off", "-o", "out2.stl", "--binary", expect=2)
        self.assertNotIn("out2.stl", self.files())

    def test_each_region_has_a_closed_surface_seen_from_outside(self):
        self.write("boxes.off", off(cube(size=4) + cube((1, 1, 1)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        names = ["--region", "0.5,0.5,0.5,10", "--region", "1.5,1.5,1.5,20", "--name", "region:20=inner / part"]
        self.run_program("mesh", "boxes.off", "-o", "out.stl", "--keep", "bounded", "--each-region", *names)
        self.run_program("mesh", "boxes.off", "-o", "out.vtu", "--keep", "bounded", *names)
        self.run_program("convert", "out.vtu", "two.ply", "--each-region")
        self.assertNotIn("out.stl", self.files())
        for name in ("out_%s.stl", "two_%s.ply"):
            for region, volume in (("inner___part", 1), ("region_10", 63)):
                found = self.info(name % region)
                self.assertTrue(found["closed"])
                self.assertAlmostEqual(found["volume"], volume)
        self.run_program("convert", "cube.off", "no.stl", "--each-region", expect=2)

    def test_each_region_has_a_file_whatever_the_names(self):
        vertices = "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n1 1 -1 0\n"
        tetrahedra = "1 2 3 4 1\n2 5 3 4 2\n1 3 2 6 3\n"
        (self.folder / "three.mesh").write_text(f"MeshVersionFormatted 2\nDimension 3\nVertices 6\n{vertices}"
                                                f"Tetrahedra 3\n{tetrahedra}End\n")
        names = ["--name", "region:1=a", "--name", "region:2=A", "--name", "region:3=A_2"]
        said = self.run_program("convert", "three.mesh", "out.vtk", "--each-region", *names).stderr
        for region, name in ((1, "out_a.vtk"), (2, "out_A_2.vtk"), (3, "out_A_2_3.vtk")):
            self.assertIn(f"{name}: region {region}", said)
            self.assertEqual(self.info(name)["tetrahedra"], 1)

    def test_only(self):
        self.boxes()
        self.run_program("convert", "boxes.vtu", "v.vtu", "--only", "volume")
        found = self.info("v.vtu")
        self.assertEqual(found["triangles"], 0)
        self.assertAlmostEqual(found["volume"], 64)
        self.run_program("convert", "boxes.vtu", "s.vtu", "--only", "surface")
        found = self.info("s.vtu")
        self.assertEqual((found["kind"], found["triangles"]), ("surface", 24))
        for region, volume, triangles in (("20", 1, 12), ("10", 63, 24)):
            self.run_program("convert", "boxes.vtu", "r.mesh", "--only", f"region={region}")
            found = self.info("r.mesh")
            self.assertEqual([r["id"] for r in found["regions"]], [int(region)])
            self.assertAlmostEqual(found["volume"], volume)
            self.assertEqual((found["triangles"], found["unused_vertices"]), (triangles, 0))
            self.run_program("convert", "boxes.vtu", "r.stl", "--only", f"region={region}", "-q")
            self.run_program("diagnose", "r.stl")
            self.assertAlmostEqual(self.info("r.stl")["volume"], volume)
            self.assertEqual(self.info("r.stl")["triangles"], triangles)
        self.run_program("convert", "boxes.vtu", "core.stl", "--name", "region:20=core", "--only", "region=core")
        both = ["--only", "region=10", "--only", "region=20"]
        self.run_program("convert", "boxes.vtu", "both.vtu", *both)
        self.assertAlmostEqual(self.info("both.vtu")["volume"], 64)
        for bad in (["region=7"], ["region=lid"], ["part"], ["volume", "--only", "surface"], ["region="]):
            self.run_program("convert", "boxes.vtu", "bad.vtu", "--only", *bad, expect=2)
            self.assertNotIn("bad.vtu", self.files())
        found = self.run_program("convert", "boxes.vtu", "bad.vtu", "--name", "region:20=core", "--only", "region=7", expect=2)
        self.assertIn("its regions are 10, 20 (core)", found.stderr)
        self.run_program("convert", "cube.off", "bad.vtu", "--only", "volume", expect=2)

    def test_names_of_what_is_left_out_do_nothing(self):
        self.boxes()
        for only, name, there in (("volume", "0=inlet", "no triangle has the marker 0; there is none at all"),
                                  ("surface", "region:20=core", "there is no such region; there is none at all"),
                                  ("region=10", "region:20=core", "there is no such region; the only id is 10")):
            with self.subTest(only):
                said = self.run_program("convert", "boxes.vtu", "a.vtu", "--only", only, "--name", name).stderr
                self.assertIn(f"--name {name} does nothing: {there}", said)
        said = self.run_program("convert", "boxes.vtu", "a.vtu", "--only", "region=core", "--name", "region:20=core").stderr
        self.assertNotIn("does nothing", said)

    def test_scale(self):
        self.boxes()
        self.run_program("convert", "boxes.vtu", "half.vtu", "--scale", "0.5")
        found = self.info("half.vtu")
        self.assertEqual(found["box"], [[0, 0, 0], [2, 2, 2]])
        self.assertAlmostEqual(found["volume"], 8)
        self.run_program("convert", "cube.off", "mm.off", "--scale", "1000")
        self.assertAlmostEqual(self.info("mm.off")["volume"], 1e9, delta=1)
        for factor in ("0", "-1", "nan", "inf"):
            self.run_program("convert", "cube.off", "bad.off", "--scale", factor, expect=2)
        for name, factor in (("mm.off", "1e306"), ("boxes.vtu", "1e308")):
            told = self.run_program("convert", name, "bad.vtu", "--scale", factor, expect=2).stderr
            self.assertIn("too large for a double", told)
            self.assertNotIn("bad.vtu", self.files())
        told = self.run_program("convert", "half.vtu", "bad.vtu", "--scale", "5e-324").stderr  # a power of two
        self.assertIn("rounding turns or flattens", told)

    def test_pipes(self):
        self.boxes()
        for name, kind, pipe in (("cube.off", "off", "stl"), ("boxes.vtu", "vtu", "mesh"), ("boxes.vtu", "vtu", "vtk")):
            with open(self.folder / name, "rb") as file:
                ended = subprocess.run([self.program, "convert", "-", "-", "--input-format", kind, "--format", pipe],
                                       stdin=file, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, timeout=60)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            told = subprocess.run([self.program, "info", "-", "--input-format", pipe, "--json"], input=ended.stdout,
                                  stdout=subprocess.PIPE, check=True, timeout=60)
            found = json.loads(told.stdout)
            self.assertAlmostEqual(found["volume"], 1 if name == "cube.off" else 64)
        # A surface through a format that may hold either.
        self.run_program("convert", "cube.off", "cube.mesh", "-q")
        told = subprocess.run([self.program, "info", "-", "--input-format", "mesh", "--json"],
                              input=(self.folder / "cube.mesh").read_bytes(), stdout=subprocess.PIPE, check=True, timeout=60)
        self.assertEqual((json.loads(told.stdout)["kind"], json.loads(told.stdout)["triangles"]), ("surface", 12))

    def test_bad_files_and_names_leave_nothing(self):
        self.write("bad.vtu", "<VTKFile")
        self.write("empty.stl", "")
        for source in ("bad.vtu", "empty.stl", "missing.msh"):
            self.run_program("convert", source, "out.mesh", expect=3)
            self.run_program("info", source, expect=3)
        for command in ["convert"], ["mesh", "-o"]:  # it also names options for surfaces only, and each once
            said = self.run_program(command[0], "cube.off", *command[1:], "out.docx", expect=2).stderr
            self.assertIn("'.docx' is no format to write", said)
            self.assertEqual([said.count(f" {ending} ") for ending in (".off", ".stl", ".vtu")], [1, 1, 1])
        self.assertNotIn(".stl", self.run_program("delaunay", "cube.off", "-o", "out.docx", expect=2).stderr)
        self.run_program("convert", "cube.off", "cube.off", expect=2)
        self.assertEqual(self.files(), ["bad.vtu", "cube.off", "empty.stl"])

    def test_info_as_text(self):
        self.boxes()
        said = self.run_program("info", "boxes.vtu").stdout
        for word in ("regions", "10", "20", "63", "quality", "#", "tetrahedra", "box"):
            self.assertIn(word, said)
        self.assertIn("surface", self.run_program("info", "cube.off").stdout)
        self.run_program("info", "cube.off", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["edges"], 18)

    def test_info_counts_by_region_marker_and_shape(self):
        self.write("marked.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 4\n0 1 0 0\n0 0 1 0\n9 9 9 0\n"
                   "Edges\n1\n1 2 8\nTriangles\n4\n1 3 2 5\n1 2 4 5\n2 3 4 6\n3 1 4 6\nTetrahedra\n1\n1 2 3 4 7\nEnd\n")
        found = self.info("marked.mesh")
        self.assertEqual(found["unused_vertices"], 1)
        self.assertEqual(found["markers"], [{"id": 5, "triangles": 2, "name": None, "area": 1.0},
                                            {"id": 6, "triangles": 2, "name": None, "area": found["markers"][1]["area"]}])
        self.assertEqual(found["segment_markers"], [{"id": 8, "segments": 1, "name": None, "length": 1.0}])
        self.assertEqual(found["vertex_markers"], [{"id": 4, "vertices": 1, "name": None}])
        self.assertAlmostEqual(found["regions"][0]["area"], 1.5 + 3 ** 0.5 / 2)
        self.assertAlmostEqual(found["volume"], 1 / 6)
        self.assertEqual(sum(found["quality"]["least_dihedral_histogram"]), 1)
        self.write("turned.mesh", (self.folder / "marked.mesh").read_text().replace("1 2 3 4 7", "1 3 2 4 7"))
        self.assertEqual(self.info("turned.mesh")["quality"]["negative"], 1)


if __name__ == "__main__":
    main()
