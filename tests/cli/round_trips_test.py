"""Every format into every other: counts, volumes, regions, markers and names come back, as far as a format holds them;
and bad files of the formats with several files or HDF5.

    round_trips_test.py PROGRAM [unittest options]
"""
import gzip
import json
import random
import shutil
import struct
import subprocess

from cli_case import CUBE_FACETS, CliTest, cube, main, off, shifted

# For each format: whether it holds names, and regions with markers of their interface.
FORMATS = {"a.vtu": (True, True), "a.vtm": (True, True), "a.vtk": (True, True), "a.mesh": (False, True),
           "a.meshb": (False, True), "a.msh": (True, True), "a.inp": (True, True), "a.unv": (True, True),
           "a.bdf": (True, True), "a.su2": (True, False), "a.mfem": (True, True), "a.vol": (True, True),
           "a.xdmf": (True, True), "a.med": (True, True), "a.exo": (True, True), "a.cgns": (True, True), "a.fluent": (True, True), "a.k": (True, True), "a.cdb": (True, True), "a.feb": (True, True), "a.xml": (False, True),
           "a.xmf": (True, True), "polyMesh": (True, True), "a.node": (False, True)}
MARKERS = {1: "inlet", 2: "outlet", 3: "wall_3", 4: "wall_4", 5: "wall_5", 6: "wall_6", 7: "between"}
REGIONS = {10: "core", 20: "shell"}
HARD_NAMES = ["two words", "it's \"quoted\"", "Zufluß ↦ 流入", "x" * 300, "ü" * 200, "<&>;{}()*,=|#%!", "3", "surface_9"]


class RoundTrips(CliTest):
    def info(self, path):
        return json.loads(self.run_program("info", path, "--json").stdout)

    def mesh(self, output, *options, names=True):
        """A box in a box, sides 1 to 6 and the interface 7, regions 10 and 20."""
        lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", "16"]
        lines += ["%r %r %r 0" % p for p in cube(size=4) + cube((1, 1, 1))] + ["Triangles", "24"]
        for i, f in enumerate(CUBE_FACETS + shifted(CUBE_FACETS, 8)):
            lines.append("%d %d %d" % tuple(v + 1 for v in f) + f" {i // 2 + 1 if i < 12 else 7}")
        self.write("boxes.mesh", "\n".join(lines) + "\nEnd\n")
        named = [x for i, n in MARKERS.items() for x in ("--name", f"{i}={n}")]
        named += [x for i, n in REGIONS.items() for x in ("--name", f"region:{i}={n}")]
        return self.run_program("mesh", "boxes.mesh", "-o", output, "--fill", "--keep", "bounded", "--region",
                                "0.5,0.5,0.5,20", "--region", "1.5,1.5,1.5,10", *(named if names else []), *options)

    def require_same(self, found, said, with_names, with_interface):
        self.assertEqual(found["kind"], "volume")
        self.assertEqual(found["tetrahedra"], said["tetrahedra"])
        self.assertEqual(found["vertices"], said["vertices"])
        self.assertAlmostEqual(found["volume"], said["volume"])
        if with_interface:
            self.assertEqual([(r["id"], r["tetrahedra"]) for r in found["regions"]],
                             [(r["id"], r["tetrahedra"]) for r in said["regions"]])
        markers = [m for m in said["markers"] if with_interface or m["id"] != 7]
        self.assertEqual([(m["id"], m["triangles"], round(m["area"], 9)) for m in found["markers"]],
                         [(m["id"], m["triangles"], round(m["area"], 9)) for m in markers])
        if with_names:
            for kind in ("regions", "markers") if with_interface else ("markers",):
                expected = {e["id"]: e["name"] for e in said[kind]}
                self.assertEqual({e["id"]: e["name"] for e in found[kind]},
                                 {e["id"]: expected[e["id"]] for e in found[kind]})

    def test_any_to_any(self):
        self.mesh("said.vtu")
        said = self.info("said.vtu")
        for first, (names, interface) in FORMATS.items():
            (self.folder / first.replace(".", "")).mkdir()
            here = f"{first.replace('.', '')}/{first}"
            self.run_program("convert", "said.vtu", here, "-q")
            self.require_same(self.info(here), said, names, interface)
            for second, (names_there, interface_there) in FORMATS.items():
                with self.subTest(f"{first} to {second}"):
                    there = "there/" + second.replace("a.", "b.")
                    shutil.rmtree(self.folder / "there", ignore_errors=True)
                    (self.folder / "there").mkdir()
                    self.run_program("convert", here, there, "-q")
                    self.require_same(self.info(there), said, names and names_there, interface and interface_there)

    def test_second_order_to_those_that_hold_it(self):
        self.mesh("said.vtu", "--order", "2")
        self.assertEqual(self.info("said.vtu")["order"], 2)
        nodes = self.info("said.vtu")["mid_nodes"]
        for name in ("a.vtu", "a.vtk", "a.mesh", "a.meshb", "a.msh", "a.inp", "a.unv", "a.bdf", "a.vol", "a.xdmf", "a.med", "a.exo", "a.cgns",
                     "a.k", "a.cdb", "a.feb", "a.node"):
            with self.subTest(name):
                self.run_program("convert", "said.vtu", name, "-q")
                self.run_program("convert", name, "back.vtu", "-q")
                found = self.info("back.vtu")
                self.assertEqual((found["order"], found["mid_nodes"]), (2, nodes))
                self.run_program("check", "boxes.mesh", "back.vtu")

    def test_hard_names_never_break_a_file(self):
        names = [x for i, n in enumerate(HARD_NAMES) for x in ("--name", f"{i + 1 if i < 7 else 'region:10'}={n}")]
        names += ["--name", "region:20=two words"]
        self.mesh("said.vtu", *names, names=False)
        said = self.info("said.vtu")
        self.assertEqual([m["name"] for m in said["markers"]], HARD_NAMES[:7])
        for name, (_, interface) in FORMATS.items():
            with self.subTest(name):
                self.run_program("convert", "said.vtu", name, "-q")
                found = self.info(name)
                if interface:
                    self.assertEqual([(r["id"], r["tetrahedra"]) for r in found["regions"]],
                                     [(r["id"], r["tetrahedra"]) for r in said["regions"]])
                self.assertEqual([m["triangles"] for m in found["markers"]], [2] * 6 + [12] * interface)
                given = [m["name"] for m in found["markers"] if m["name"]]
                self.assertEqual(len(given), len(set(given)))

    def test_openfoam_packed_and_by_the_case(self):
        self.mesh("said.vtu")
        said = self.info("said.vtu")
        self.run_program("convert", "said.vtu", "case", "--format", "openfoam", "--gzip", "-q")
        folder = self.folder / "case/constant/polyMesh"
        self.assertTrue((folder / "points.gz").exists())
        for path in ("case", "case/constant/polyMesh", "case/constant/polyMesh/"):
            self.require_same(self.info(path), said, True, True)
        self.run_program("check", "boxes.mesh", "case")
        self.run_program("mesh", "case", "-o", "again.vtu", "--surface-of", "--keep", "bounded")
        self.assertEqual(self.info("again.vtu")["triangles"], said["triangles"])

    def test_what_is_several_files_or_a_volume_is_refused_elsewhere(self):
        for name in ("xdmf", "node", "vtm"):
            with open(self.folder / "out", "wb") as out:  # a regular file, but without its second file
                code = subprocess.run([self.program, "mesh", "cube.off", "-o", "-", "--format", name, "--fill"], cwd=self.folder,
                                      stdout=out, stderr=subprocess.DEVNULL, timeout=60, check=False).returncode
            self.assertEqual(code, 2)
        self.assertIn("without tetrahedra", self.run_program("convert", "cube.off", "polyMesh", expect=3).stderr)
        self.assertNotIn("polyMesh", self.files())

    def test_no_interfaces(self):
        self.mesh("a.msh", "--no-interfaces")
        self.mesh("b.msh")
        self.run_program("convert", "b.msh", "c.msh", "--no-interfaces")
        for name in ("a.msh", "c.msh"):
            found = self.info(name)
            self.assertEqual([m["id"] for m in found["markers"]], [1, 2, 3, 4, 5, 6])
            self.assertEqual([r["id"] for r in found["regions"]], [10, 20])
        self.run_program("convert", "cube.off", "d.msh", "--no-interfaces", expect=2)
        self.run_program("mesh", "cube.off", "-o", "d.stl", "--no-interfaces", expect=2)

    def damaged(self, folder, name, change):
        packed = folder / name
        before = packed.read_text()
        after = change(before)
        self.assertNotEqual(before, after)
        packed.write_text(after)
        said = self.run_program("info", folder, expect=3).stderr
        packed.write_text(before)
        self.assertIn(name, said)
        return said

    def test_damaged_openfoam_is_3_with_the_place(self):
        self.mesh("polyMesh")
        folder = self.folder / "polyMesh"
        self.assertIn("line", self.damaged(folder, "points", lambda s: s.replace("(0 0 0)", "(0 nan 0)", 1)))
        self.assertIn("not finite", self.damaged(folder, "points", lambda s: s.replace("(0 0 0)", "(0 inf 0)", 1)))
        self.damaged(folder, "points", lambda s: s.replace("\n(\n", "\n(\n(1 2)\n", 1))
        self.damaged(folder, "points", lambda s: s.replace("\n\n", "\n\n9", 1))
        self.damaged(folder, "faces", lambda s: s.replace("3(", "3(99999 ", 1))
        self.damaged(folder, "faces", lambda s: s.replace("3(", "4(0 ", 1))
        self.damaged(folder, "owner", lambda s: s.replace("\n(\n0\n", "\n(\n-1\n", 1))
        self.damaged(folder, "owner", lambda s: s.replace("\n(\n0\n", "\n(\n1\n", 1))
        self.damaged(folder, "owner", lambda s: s.replace("ascii", "binary"))
        self.damaged(folder, "boundary", lambda s: s.replace("startFace ", "startFace 7777"))
        self.damaged(folder, "boundary", lambda s: s.replace("nFaces ", "nFoxes "))
        self.damaged(folder, "cellZones", lambda s: s.replace("cellLabels", "cellLabels List<label> 3000000000{0}; x"))
        for name in ("points", "faces", "owner", "neighbour", "boundary", "cellZones", "faceZones"):
            text = (folder / name).read_text()
            for part in (0, 1, 3, 5, 7, 9):
                self.damaged(folder, name, lambda s, part=part: s[:len(s) * part // 10])
            (folder / name).write_bytes(gzip.compress(text.encode())[:60])
            self.run_program("info", "polyMesh", expect=3)
            (folder / name).unlink()
            self.run_program("info", "polyMesh", expect=0 if "Zones" in name else 3)
            (folder / name).write_text(text)
        random.seed(7)
        for name in ("points", "faces", "owner", "neighbour", "boundary", "cellZones", "faceZones"):
            before = (folder / name).read_bytes()
            for _ in range(12):
                after = bytearray(before)
                for _ in range(3):
                    after[random.randrange(len(after))] = random.choice(b"(){};0123456789- n/*\"\xff")
                (folder / name).write_bytes(after)
                self.assert_ends(self.folder / "polyMesh")
            (folder / name).write_bytes(before)

    def assert_ends(self, path):
        """Read, or refused with exit 3."""
        code = subprocess.run([self.program, "info", path, "-q"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              timeout=60, check=False).returncode
        self.assertIn(code, (0, 3))

    def test_damaged_hdf5_is_3(self):
        self.mesh("a.med")
        self.mesh("a.xdmf")
        for name, shown in (("a.med", "a.med"), ("a.h5", "a.xdmf"), ("a_surface.h5", "a.xdmf")):
            before = (self.folder / name).read_bytes()
            for part in (0, 1, 2, 5, 8, 9.9):
                (self.folder / name).write_bytes(before[:int(len(before) * part / 10)])
                self.assertIn(name, self.run_program("info", shown, expect=3).stderr)
            random.seed(5)
            for _ in range(60):
                after = bytearray(before)
                for _ in range(random.randrange(1, 4)):
                    at = random.randrange(len(after))
                    after[at:at + 4] = random.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", bytes([random.randrange(256)]),
                                                      struct.pack("<I", random.randrange(len(after)))])[:len(after) - at]
                (self.folder / name).write_bytes(after)
                self.assert_ends(self.folder / shown)
            (self.folder / name).write_bytes(before)
        # A node's number and a coordinate.
        before = (self.folder / "a.med").read_bytes()
        (self.folder / "a.med").write_bytes(before.replace(struct.pack("<d", 4.0), struct.pack("<d", float("nan")), 1))
        self.assertIn("node", self.run_program("info", "a.med", expect=3).stderr)

    def test_attributes_that_stand_in_a_heap(self):
        """As HDF5 stores those of a MED mesh since 1.8: an object has at most eight in its header."""
        self.mesh("a.med")
        script = ("import h5py\nold, new = h5py.File('a.med'), h5py.File('b.med', 'w', libver='latest')\n"
                  "[old.copy(name, new) for name in old]\n"
                  "mesh = next(iter(new['ENS_MAA'].values()))\nmesh.attrs['ESP'], mesh.attrs['TYP'] = 3, %d\n"
                  "[mesh.attrs.create(f'A{i}', i) for i in range(%d)]")
        for more in (12, 300):  # a tree of one leaf, and of several
            if subprocess.run(["/usr/bin/python3", "-c", script % (0, more)], cwd=self.folder, check=False).returncode:
                self.skipTest("there is no h5py")
            self.assertEqual(self.info("b.med")["regions"], self.info("a.med")["regions"])
        subprocess.run(["/usr/bin/python3", "-c", script % (1, 12)], cwd=self.folder, check=True)  # the attribute is read
        self.assertIn("structured", self.run_program("info", "b.med", expect=3).stderr)

    def test_tags_of_cells_that_an_earlier_grid_has(self):
        """As DOLFINx writes them: the cells again, in another order, without a type of the tags."""
        self.write("tags.xdmf", """<Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude"><Domain><Grid Name="mesh">
<Topology TopologyType="Tetrahedron" NumberOfElements="2"><DataItem Dimensions="2 4" Format="XML">0 1 2 3 1 2 3 4</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="5 3" Format="XML">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataItem></Geometry></Grid>
<Grid Name="tags"><xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)"/>
<Topology TopologyType="Tetrahedron"><DataItem Dimensions="2 4" Format="XML">4 3 2 1 3 1 2 0</DataItem></Topology>
<Attribute Name="cell_tags" Center="Cell"><DataItem NumberType="Int" Dimensions="2 1" Format="XML">6 5</DataItem></Attribute></Grid>
</Domain></Xdmf>""")
        found = self.info("tags.xdmf")
        self.assertEqual([(r["id"], r["tetrahedra"]) for r in found["regions"]], [(5, 1), (6, 1)])
        self.assertAlmostEqual(found["regions"][0]["volume"], 1 / 6)

    def test_damaged_xdmf_is_3(self):
        self.mesh("a.xdmf")
        before = (self.folder / "a.xdmf").read_text()
        for old, new in (('Dimensions="', 'Dimensions="9'), ("a.h5:/points", "a.h5:/paints"), ("a.h5:", "b.h5:"),
                         ("Tetrahedron", "Hexahedron"), ("</Xdmf>", ""), ('Format="HDF"', 'Format="TIFF"'),
                         ("NumberOfElements=\"", "NumberOfElements=\"1"), ("a.h5:/tetrahedra", "a.h5"),
                         ("<Geometry", "<Geometrie"), ("XYZ", "VXVYVZ")):
            self.write("a.xdmf", before.replace(old, new))
            self.assertIn("a.xdmf", self.run_program("info", "a.xdmf", expect=3).stderr + "a.xdmf" * (new == "b.h5:"))
        self.write("text.xdmf", """<?xml version="1.0"?><Xdmf Version="3.0"><Domain><Grid Name="g">
<Geometry GeometryType="XYZ"><DataItem DataType="Float" Dimensions="4 3" Format="XML">0 0 0 1 0 0 0 1 0 0 0 1</DataItem></Geometry>
<Topology TopologyType="Mixed" NumberOfElements="2"><DataItem DataType="Int" Dimensions="9" Format="XML">6 0 1 2 3 4 0 1 2</DataItem></Topology>
<Attribute Name="medit:ref" Center="Cell"><DataItem NumberType="Int" Dimensions="2" Format="XML">5 6</DataItem></Attribute>
</Grid></Domain></Xdmf>""")
        found = self.info("text.xdmf")
        self.assertEqual(([r["id"] for r in found["regions"]], [m["id"] for m in found["markers"]]), ([5], [6]))
        text = (self.folder / "text.xdmf").read_text()
        for old, new in (("6 0 1 2 3", "6 0 1 2 9"), ("0 0 1<", "0 0 nan<"), ("6 0 1", "77 0 1"), ("5 6<", "5<")):
            self.write("text.xdmf", text.replace(old, new))
            self.run_program("info", "text.xdmf", expect=3)


if __name__ == "__main__":
    main()
