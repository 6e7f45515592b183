"""The program `holdfast` from outside: exit codes (docs/command-line.md), messages, files and signals.

    cli_test.py PROGRAM [unittest options]
"""
import itertools
import json
import os
import pty
import re
import signal
import struct
import subprocess
import sys
from pathlib import Path

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, read_terminal, shifted

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


class Usage(CliTest):
    def test_version_and_help(self):
        self.assertRegex(self.run_program("--version").stdout, r"^holdfast \d+\.\d+\.\d+\n$")
        for command in ("mesh", "check", "diagnose", "delaunay", "untangle"):
            self.assertIn("Exit codes", self.run_program(command, "--help").stdout)

    def test_help_names_the_formats(self):
        """Those of volumes that messages list, except other endings of the same format."""
        self.run_program("mesh", "cube.off", "-o", "a.vtu")
        known = {
            "written": self.run_program("mesh", "cube.off", "-o", "a.none", expect=2).stderr,
            "read": self.run_program("check", "cube.off", "a.vtu", "--format", "none", expect=3).stderr,
        }
        for command, option, use in [("mesh", "--output", "written"), ("delaunay", "--output", "written"),
                                     ("untangle", "--output", "written"), ("check", "SURFACE VOLUME", "read"),
                                     ("untangle", "VOLUME TEXT", "read")]:
            described = self.run_program(command, "--help").stdout.split(option, 1)[1].split(" or OpenFOAM", 1)[0]
            listed = known[use].split("formats are" if use == "read" else "use ", 1)[1].split("of surfaces alone", 1)[0]
            for ending in set(re.findall(r"\.[a-z]\w*", listed)):
                if ending not in (".nas", ".fem", ".ucd", ".ele", ".face", ".openfoam", ".msh2"):
                    with self.subTest([command, option, ending]):
                        self.assertIn(ending, described)

    def test_wrong_usage_is_2_and_says_what_is_wrong(self):
        for arguments, word in [
            ([], "subcommand"),
            (["nonsense"], "nonsense"),
            (["mesh"], "SURFACE"),
            (["mesh", "cube.off"], "--output"),
            (["mesh", "cube.off", "-o", "out.vtu", "--bogus"], "--bogus"),
            (["mesh", "cube.off", "-o", "out.txt"], "format"),
            (["mesh", "cube.off", "-o", "out.vtu", "--keep", "some"], "some"),
            (["mesh", "cube.off", "-o", "out.vtu", "--keep", "box=-1"], "margin"),
            (["mesh", "cube.off", "-o", "out.vtu", "--hole", "1,2"], "x,y,z"),
            (["mesh", "cube.off", "-o", "out.vtu", "--hole", "1,2,nan"], "x,y,z"),
            (["mesh", "cube.off", "-o", "out.vtu", "--region", "1,2,3,0.5"], "integer"),
            (["mesh", "cube.off", "-o", "out.vtu", "--without", "everything"], "flips"),
            (["mesh", "cube.off", "-o", "out.vtu", "--stop-after", "lunch"], "delaunay"),
            (["mesh", "cube.off", "-o", "out.vtu", "--time-limit", "-1"], "--time-limit"),
            (["mesh", "cube.off", "-o", "out.vtu", "--memory-limit", "nan"], "--memory-limit"),
            (["mesh", "cube.off", "-o", "out.vtu", "--threads", "-1"], "--threads"),
            (["mesh", "cube.off", "-o", "out.vtu", "--size", "-1"], "--size"),
            (["mesh", "cube.off", "-o", "out.vtu", "--gradation", "7"], "--gradation"),
            (["mesh", "cube.off", "-o", "out.vtu", "--quality", "superb"], "best"),
            (["mesh", "cube.off", "-o", "out.vtu", "-q", "-v"], "excludes"),
            (["check", "cube.off"], "volume"),
        ]:
            with self.subTest(arguments):
                self.assertIn(word, self.run_program(*arguments, expect=2).stderr)
                self.assertEqual(self.files(), ["cube.off"])

    def test_an_output_never_overwrites_an_input(self):
        text = (self.folder / "cube.off").read_text()
        self.write("cube.mesh", text)
        self.run_program("mesh", "cube.mesh", "-o", "./cube.mesh", expect=2)
        self.assertEqual((self.folder / "cube.mesh").read_text(), text)

    def test_an_output_never_overwrites_a_buffer_of_the_input(self):
        self.write("a.gltf", '{"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin","byteLength":4}]}')
        self.write("a b.bin", "kept")
        for arguments in (["mesh", "a.gltf", "-o", "./a b.bin", "--format", "vtk"],
                          ["diagnose", "a.gltf", "--report", "a b.bin"]):
            with self.subTest(arguments):
                self.assertIn("a b.bin", self.run_program(*arguments, expect=2).stderr)
                self.assertEqual((self.folder / "a b.bin").read_text(), "kept")


class Files(CliTest):
    def test_unreadable_input_is_3_and_names_the_file(self):
        (self.folder / "folder.off").mkdir()
        for name, content in [
            ("missing.off", None), ("folder.off", None), ("empty.off", ""), ("empty.stl", b""),
            ("no_numbers.off", "OFF\n3 1 0\n0 0 zero\n"),
            ("cut.off", off(CUBE_POINTS, CUBE_FACETS)[:60]),
            ("many.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"),
            ("negative.off", "OFF\n-8 12 0\n"),
            ("cut.stl", bytes(80) + struct.pack("<I", 1000) + bytes(100)),
            ("unknown.xyzw", "1 2 3"),
        ]:
            with self.subTest(name):
                if content is not None:
                    self.write(name, content)
                for command in (["mesh", name, "-o", "out.vtu"], ["diagnose", name]):
                    self.assertIn(name, self.run_program(*command, expect=3).stderr)
                self.assertNotIn("out.vtu", self.files())

    def test_unreadable_text_names_the_line(self):
        self.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 oops 0\n3 0 1 2\n")
        self.assertIn("line 5", self.run_program("diagnose", "bad.off", expect=3).stderr)

    def test_unwritable_output_is_3_before_any_work(self):
        (self.folder / "volume.vtu").mkdir()
        for output in ("nowhere/out.vtu", "volume.vtu"):
            self.assertIn(output, self.run_program("mesh", "missing.off", "-o", output, expect=3).stderr)
        self.assertIn("nowhere", self.run_program("mesh", "cube.off", "-o", "out.vtu", "--report",
                                                  "nowhere/r.json", expect=3).stderr)
        self.assertNotIn("out.vtu", self.files())

    def test_an_output_below_a_file_names_that_file(self):
        self.write("taken", "")
        for arguments in (("taken/out.vtu",), ("taken/deep/out.vtu",), ("taken", "--format", "openfoam"),
                          ("taken/case", "--format", "openfoam")):
            told = self.run_program("mesh", "missing.off", "-o", *arguments, expect=3).stderr
            self.assertIn("'taken' is a file, not a folder", told)
            self.assertNotIn("create it", told)
        self.run_program("mesh", "cube.off", "-o", "new/case", "--format", "openfoam", "-q")

    def test_every_volume_format_is_written_and_checked(self):
        for name in ("a.vtu", "a.vtm", "a.vtk", "a.mesh", "a.msh", "a.inp", "a.unv", "a.vol", "a.mfem", "a.su2", "a.bdf", "a.node"):
            with self.subTest(name):
                self.run_program("mesh", "cube.off", "-o", name, "--fill", "--quiet")
                self.run_program("check", "cube.off", name)
        self.run_program("mesh", "cube.off", "-o", "old.msh", "--format", "msh2", "--fill", "-q")
        self.assertIn("2.2", (self.folder / "old.msh").read_text(errors="replace")[:40])
        self.assertFalse([f for f in self.files() if "part" in f or "tmp" in f])


class Mesh(CliTest):
    def test_a_cube(self):
        ended = self.run_program("mesh", "cube.off", "-o", "cube.vtu", "--fill", "--report", "r.json")
        self.assertEqual(ended.stdout, "")
        self.assertRegex(ended.stderr, r"cube\.vtu: 8 vertices \(0 added\), \d+ tetrahedra in 1 region")
        report = json.loads((self.folder / "r.json").read_text())
        for key in ("input delaunay flips partition steiner mesh quality seconds peak_memory_bytes version "
                    "options outcome defects").split():
            self.assertIn(key, report)
        self.assertEqual(report["outcome"], "done")
        self.assertEqual(report["input"]["facets"], 12)
        self.assertEqual(report["input"]["segments"], 18)
        self.assertTrue(report["input"]["closed"])
        self.assertEqual(report["steiner"], {"count": 0, "forced": 0, "unrounded": 0})
        self.assertEqual(report["mesh"]["vertices"], 8)
        self.assertIn("total", report["seconds"])
        self.assertIn(report["mesh"]["tetrahedra"], (5, 6))

    def test_quiet_is_silent_and_verbose_is_not(self):
        self.assertEqual(self.run_program("mesh", "cube.off", "-o", "a.vtu", "--quiet").stderr, "")
        told = self.run_program("mesh", "cube.off", "-o", "a.vtu", "--fill", "--verbose").stderr
        self.assertIn("missing", told)
        self.assertNotIn("\r", told)

    def test_a_bar_on_a_terminal(self):
        ours, theirs = pty.openpty()
        code = subprocess.run([self.program, "mesh", "cube.off", "-o", "a.vtu", "--fill"], cwd=self.folder, stderr=theirs,
                              timeout=240, check=False).returncode
        os.close(theirs)
        shown = b""
        while chunk := read_terminal(ours):
            shown += chunk
        os.close(ours)
        self.assertEqual(code, 0)
        *bar, last = shown.decode().replace("\r\n", "\n").split("\r")
        self.assertTrue(last.startswith("a.vtu: 8 vertices"), shown)
        for part in bar[1:-1]:
            self.assertRegex(part, r"^\w+ +\[=* *\] +\d+ %$")

    def test_field_points_make_edges_of_the_wanted_size(self):
        counts = []
        for size in ("0.5", "0.25"):
            self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size", size, "--report", "r.json")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertGreater(report["field_points"], 0)
            counts.append(report["mesh"]["tetrahedra"])
            self.run_program("check", "cube.off", "a.vtu")
        self.assertGreater(counts[1], 5 * counts[0])
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--fill", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["field_points"], 0)

    def test_sizes_that_no_mesh_can_have_are_told_at_once(self):
        round_it = "(-9,-9,-9, 99,-9,-9, -9,99,-9, -9,-9,99){"
        self.write("f.pos", f'View "f" {{\nSS{round_it}1e-5,1e-5,1e-5,1e-300}};\n}};\n')
        self.write("m.pos", f'View "m" {{\nTT{round_it}{",".join(["1e60,0,0,0,4,0,0,0,4"] * 4)}}};\n}};\n')
        for asked, word in ((("--size", "1e-5"), "the size asked for"), (("--region", "0.5,0.5,0.5,3,1e-200"), "the size asked for"),
                            (("--max-volume", "1e-12"), "the largest volume asked for"),
                            (("--size-field", "f.pos"), "the size field asked for"), (("--size-field", "m.pos"), "the size in the metric asked for")):
            with self.subTest(asked):
                told = self.run_program("mesh", "cube.off", "-o", "a.vtu", *asked, expect=5).stderr
                self.assertIn(word + " takes more than 2^30 tetrahedra", told)
                self.assertEqual(self.files(), ["cube.off", "f.pos", "m.pos"])
        # Fine at one end only.
        self.write("f.pos", 'View "f" {\nSS(0,0,0, 3,0,0, 0,3,0, 0,0,3){1e-9,1,1,1};\n};\n')
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "f.pos")

    def test_a_size_field_elsewhere_is_told(self):
        self.write("f.pos", 'View "f" {\nSS(2,2,2, 3,2,2, 2,3,2, 2,2,3){0.1,0.1,0.1,0.1};\n};\n')
        told = self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "f.pos").stderr
        self.assertIn("the sizes of f.pos have no effect: its mesh lies in (2, 2, 2) to (3, 3, 3)", told)
        self.assertNotIn("no size", self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "f.pos", "--keep", "box=3").stderr)
        self.write("e.mesh", "MeshVersionFormatted 2 Dimension 3 Vertices 0 Tetrahedra 0 End\n")
        self.write("e.sol", "MeshVersionFormatted 2 Dimension 3 SolAtVertices 0 1 1 End\n")
        self.assertIn("e.mesh", self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "e.mesh", expect=3).stderr)

    def test_size_fields_of_files(self):
        # One tetrahedron round the cube, in every format; the size is 0.15 at x = -1 and grows by 0.05 a unit.
        corners, sizes = [(-1, -1, -1), (9, -1, -1), (-1, 9, -1), (-1, -1, 9)], [0.15, 0.65, 0.15, 0.15]
        flat = " ".join(str(x) for p in corners for x in p)
        lines = "\n".join(" ".join(map(str, p)) + " 0" for p in corners)
        values = "\n".join(map(str, sizes))
        (self.folder / "m.mesh").write_text(f"MeshVersionFormatted 2 Dimension 3 Vertices 4\n{lines}\n"
                                            "Tetrahedra 1\n1 2 3 4 0\nEnd\n")
        (self.folder / "m.sol").write_text(f"MeshVersionFormatted 2 Dimension 3 SolAtVertices 4 1 1\n{values}\nEnd\n")
        (self.folder / "t.node").write_text("4 3 0 0\n" + "".join(f"{i} {p[0]} {p[1]} {p[2]}\n"
                                                                 for i, p in enumerate(corners)))
        (self.folder / "t.ele").write_text("1 4 0\n0 0 1 2 3\n")
        (self.folder / "t.mtr").write_text(f"4 1\n{values}\n")
        (self.folder / "g.pos").write_text('View "size" {\nSS(' + flat.replace(" ", ",") + "){"
                                           + ",".join(map(str, sizes)) + "};\n};\n")
        (self.folder / "v.vtu").write_text(
            '<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">'
            f'<PointData><DataArray type="Float64" Name="size" format="ascii">{values}</DataArray></PointData>'
            '<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">' + flat + "</DataArray></Points>"
            '<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>'
            '<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>'
            '<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>'
            "</Piece></UnstructuredGrid></VTKFile>")
        counts = set()
        for name in ("m.mesh", "m.sol", "t.mtr", "g.pos", "v.vtu"):
            self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", name, "--report", "r.json")
            counts.add(json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"])
            self.run_program("check", "cube.off", "a.vtu")
        self.assertEqual(len(counts), 1, counts)
        self.assertGreater(counts.pop(), 300)
        (self.folder / "cube.mtr").write_text("8 1\n" + 8 * "0.2\n")
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "cube.mtr", "--report", "r.json")
        self.assertGreater(json.loads((self.folder / "r.json").read_text())["field_points"], 5)
        (self.folder / "m.sol").write_text("MeshVersionFormatted 2 Dimension 3 SolAtVertices 4 1 1\n1 2 -3 4\nEnd\n")
        self.assertIn("not positive", self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "m.sol",
                                                         expect=3).stderr)
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "missing.pos", expect=3)

    def test_a_metric_field_of_a_file(self):
        # A layer at z = 0.5: edges of 0.05 across and 0.5 along it.
        corners = [(-1, -1, -1), (9, -1, -1), (-1, 9, -1), (-1, -1, 9)]
        lines = "\n".join(" ".join(map(str, p)) + " 0" for p in corners)
        (self.folder / "m.mesh").write_text(f"MeshVersionFormatted 2 Dimension 3 Vertices 4\n{lines}\n"
                                            "Tetrahedra 1\n1 2 3 4 0\nEnd\n")
        sol = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices 4\n1 3\n"
        (self.folder / "m.sol").write_text(sol + 4 * "4 0 4 0 0 400\n" + "End\n")
        self.make("chazelle", "surface.off", "-n", "3")
        counts = []
        for size in (["--size-field", "m.mesh"], ["--size-field", "m.sol"], ["--size", "0.05"]):
            self.run_program("mesh", "cube.off", "-o", "a.vtu", *size, "--report", "r.json")
            self.run_program("check", "cube.off", "a.vtu")
            report = json.loads((self.folder / "r.json").read_text())
            counts.append(report["mesh"]["tetrahedra"])
            lengths = report["field"]["edge_length_histogram"]  # in bins of 1/8
            self.assertGreater(sum(lengths[5:12]), 0.3 * sum(lengths))
        self.assertEqual(counts[0], counts[1])
        self.assertGreater(counts[2], 4 * counts[0])
        self.assertGreater(counts[0], 100)
        (self.folder / "m.sol").write_text(sol + 4 * "1 0 1 0 0 100\n" + "End\n")
        self.run_program("mesh", "surface.off", "-o", "a.vtu", "--size-field", "m.mesh", "--threads", "2")
        self.run_program("check", "surface.off", "a.vtu")
        self.assertIn("Field points", self.run_program("mesh", "--help").stdout)
        (self.folder / "m.sol").write_text(sol + 2 * "4 0 4 0 0 400\n" + "4 9 4 0 0 400\n4 0 4 0 0 400\nEnd\n")
        self.assertIn("m.sol: line 7: the tensor is not positive definite",
                      self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "m.mesh", expect=3).stderr)

    def test_a_region_with_a_size(self):
        inner = cube((0.25, 0.25, 0.25), 0.5)
        self.write("nested.off", off(CUBE_POINTS + inner, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        counts = []
        for region in ("0.5,0.5,0.5,77", "0.5,0.5,0.5,77,0.1"):
            self.run_program("mesh", "nested.off", "-o", "a.mesh", "--keep", "bounded", "--region", region, "--report",
                             "r.json")
            counts.append(json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"])
            self.run_program("check", "nested.off", "a.mesh")
        self.assertGreater(counts[1], counts[0] + 100)
        self.run_program("mesh", "nested.off", "-o", "a.mesh", "--region", "0.5,0.5,0.5,77,-1", expect=2)

    def test_same_result_for_any_number_of_threads_and_twice(self):
        self.make("chazelle", "hard.off", "-n", "2")
        volumes = []
        for threads in (1, 1, 4):
            self.run_program("mesh", "hard.off", "-o", "a.mesh", "--fill", "-q", "--threads", threads)
            volumes.append((self.folder / "a.mesh").read_bytes())
        self.assertEqual(len(set(volumes)), 1)

    def make(self, kind, name, *arguments):
        subprocess.run([sys.executable, EXAMPLES / "make_hard.py", kind, self.folder / name, *arguments],
                       stdout=subprocess.DEVNULL, check=True)

    def test_hard_surfaces_with_and_without_flips(self):
        self.make("schonhardt", "prism.off", "--twist", "50")
        self.make("chazelle", "chazelle.off", "-n", "2")
        for name in ("prism.off", "chazelle.off"):
            for extra in ([], ["--without", "flips"]):
                with self.subTest(name, extra=extra):
                    self.run_program("mesh", name, "-o", "a.vtu", "--fill", "--report", "r.json", *extra)
                    self.assertGreater(json.loads((self.folder / "r.json").read_text())["steiner"]["count"], 0)
                    self.run_program("check", name, "a.vtu")

    def test_what_stands_after_every_stage(self):
        self.make("schonhardt", "prism.off", "--twist", "50")
        for stage in "validate delaunay flips partition eliminate classify suppress field_points".split():
            with self.subTest(stage):
                self.run_program("mesh", "prism.off", "-o", "a.vtu", "--stop-after", stage)

    def test_what_stands_after_partition_is_told(self):
        self.make("chazelle", "notches.off", "-n", "2")
        facets = [tuple(map(int, row.split()[1:4])) for row in (self.folder / "notches.off").read_text().split("\n")
                  if row.startswith("3 ")]
        told = {}
        for order in ("given", "random", "halving"):
            self.run_program("mesh", "notches.off", "-o", "a.node", "--without", "flips", "--stop-after", "partition",
                             "--order", order, "--report", "r.json")
            report = json.loads((self.folder / "r.json").read_text())
            told[order] = state = report["intermediate"]
            tets = [set(map(int, row.split()[1:5])) for row in (self.folder / "a.ele").read_text().split("\n")[1:]
                    if row and not row.startswith("#")]
            self.assertEqual(len(state["missing_facets"]), report["flips"]["missing_facets"])
            self.assertEqual(len(state["missing_segments"]), report["flips"]["missing_segments"])
            self.assertEqual(len(state["added"]), sum(report["partition"].values()))
            self.assertEqual(sorted(s["facet"] for s in state["sub_facets"]), sorted(state["missing_facets"]))
            self.assertEqual(sorted(c["segment"] for c in state["chains"]), sorted(state["missing_segments"]))
            edges = {frozenset(pair) for tet in tets for pair in itertools.combinations(tet, 2)}
            faces = {frozenset(triple) for tet in tets for triple in itertools.combinations(tet, 3)}
            on_segments = {point["vertex"] for point in state["added"] if "segment" in point}
            for chain in state["chains"]:
                self.assertEqual([chain["vertices"][0], chain["vertices"][-1]], chain["segment"])
                self.assertTrue(on_segments.issuperset(chain["vertices"][1:-1]))
                self.assertTrue(all(frozenset(pair) in edges for pair in itertools.pairwise(chain["vertices"])))
            for pieces in state["sub_facets"]:
                self.assertTrue(all(frozenset(face) in faces for face in pieces["faces"]))
                corners = {v for face in pieces["faces"] for v in face}
                self.assertTrue(corners.issuperset(facets[pieces["facet"]]))
        self.assertNotEqual(told["given"], told["halving"])
        self.run_program("mesh", "notches.off", "-o", "a.node", "--stop-after", "delaunay", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(len(report["intermediate"]["missing_facets"]), report["delaunay"]["missing_facets"])
        self.run_program("mesh", "notches.off", "-o", "a.node", "--fill", "--report", "r.json", "--order", "given")
        self.assertNotIn("intermediate", json.loads((self.folder / "r.json").read_text()))
        self.run_program("check", "notches.off", "a.node")

    def test_surfaces_are_joined_where_coordinates_are_identical(self):
        self.write("right.off", off(cube((1, 0, 0)), [f for f in CUBE_FACETS if f not in ((0, 4, 6), (0, 6, 2))]))
        self.run_program("mesh", "cube.off", "right.off", "-o", "two.vtu", "--fill", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["input"]["vertices"], 12)
        self.assertEqual(report["mesh"]["regions"], 2)
        self.run_program("check", "cube.off", "right.off", "two.vtu")

    def test_holes_and_regions(self):
        inner = cube((0.25, 0.25, 0.25), 0.5)
        self.write("nested.off", off(CUBE_POINTS + inner, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.run_program("mesh", "nested.off", "-o", "a.mesh", "--fill", "--keep", "bounded", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["mesh"]["regions"], 2)
        self.run_program("mesh", "nested.off", "-o", "a.mesh", "--fill", "--keep", "bounded", "--hole",
                         "0.5,0.5,0.5", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["mesh"]["regions"], 1)
        self.run_program("check", "nested.off", "a.mesh")
        self.run_program("mesh", "nested.off", "-o", "a.mesh", "--fill", "--keep", "bounded", "--region",
                         "0.5,0.5,0.5,77")
        text = (self.folder / "a.mesh").read_text()
        tetrahedra = text[text.index("Tetrahedra"):].split()
        self.assertIn("77", tetrahedra[6::5])

    def test_invalid_surfaces_are_4_and_named(self):
        crossing = off(CUBE_POINTS + cube((0.5, 0.5, 0.5)), CUBE_FACETS + shifted(CUBE_FACETS, 8))
        for name, content, said in [
            ("crossing.off", crossing, "not valid"),
            ("repeated.off", off(CUBE_POINTS, CUBE_FACETS + [CUBE_FACETS[0]]), "not valid"),
            ("flat.off", off([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]), "not valid"),
            ("open.off", off(CUBE_POINTS, CUBE_FACETS[:-1]), "encloses nothing"),
        ]:
            with self.subTest(name):
                self.write(name, content)
                told = self.run_program("mesh", name, "-o", "a.vtu", "--fill", "--report", "r.json", expect=4)
                self.assertIn(said, told.stderr)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertEqual(report["outcome"], "invalid_input")
                self.assertTrue(report["defects"])
                self.assertNotIn("a.vtu", self.files())

    def test_an_open_surface_in_a_box(self):
        self.write("open.off", off(CUBE_POINTS, CUBE_FACETS[:-2]))
        self.run_program("mesh", "open.off", "-o", "a.vtu", "--fill", "--keep", "box=0.5")
        self.run_program("check", "open.off", "a.vtu", "--box")

    def test_not_representable_is_7_and_offers_the_exact_mesh(self):
        far = 2**52  # docs/concepts.md, What cannot be guaranteed: valid, and no double lies inside
        points = [(2, 1, 0), (1, 1, 3), (1, 2, 1), (3, 2, 2), (0, 0, 3), (2, 1, 3)]
        facets = [(0, 1, 2), (3, 4, 5)]
        for k in range(3):
            j = (k + 1) % 3
            facets += [(k, j, 3 + j), (k, 3 + j, 3 + k)]
        self.write("far.off", off([tuple(float(far + x) for x in p) for p in points], facets))
        told = self.run_program("mesh", "far.off", "-o", "a.vtu", "--fill", expect=7)
        self.assertIn("--exact", told.stderr)
        self.run_program("mesh", "far.off", "-o", "a.vtu", "--fill", "--exact", "far.jsonl", expect=7)
        self.assertNotIn("a.vtu", self.files())
        lines = [json.loads(line) for line in (self.folder / "far.jsonl").read_text().splitlines()]
        exact = [x for line in lines for x in line.get("coordinates", []) if isinstance(x, str)]
        self.assertTrue(exact)
        for x in exact:
            self.assertRegex(x, r"^-?\d+\*2\^-?\d+$")
        self.assertTrue([line for line in lines if "tetrahedron" in line])


class Limits(CliTest):
    def setUp(self):
        super().setUp()
        subprocess.run([sys.executable, EXAMPLES / "make_part.py", self.folder / "part.stl", "--detail", "3"],
                       stdout=subprocess.DEVNULL, check=True)
        self.before = self.files()

    def test_time_limit_is_5(self):
        told = self.run_program("mesh", "part.stl", "-o", "a.vtu", "--fill", "--time-limit", "0.001", expect=5)
        self.assertIn("--time-limit", told.stderr)
        self.assertEqual(self.files(), self.before)

    def test_memory_limit_is_5(self):
        told = self.run_program("mesh", "part.stl", "-o", "a.vtu", "--fill", "--memory-limit", "0.005", expect=5)
        self.assertIn("--memory-limit", told.stderr)
        self.assertEqual(self.files(), self.before)

    def test_interrupt_and_termination_are_5_and_leave_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = subprocess.Popen([self.program, "mesh", "part.stl", "-o", "a.vtu", "--fill", "--without", "flips",
                                            "--verbose"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                process.stderr.readline()  # the first stage has begun
                os.kill(process.pid, number)
                told = process.communicate(timeout=240)[1]
                self.assertEqual(process.returncode, 5, told)
                self.assertIn("cancelled", told)
                self.assertEqual(self.files(), self.before)


class Check(CliTest):
    def test_every_rule_has_a_line(self):
        self.run_program("mesh", "cube.off", "-o", "a.mesh", "--fill", "-q")
        lines = self.run_program("check", "cube.off", "a.mesh").stdout.splitlines()
        self.assertGreater(len(lines), 4)
        for line in lines:
            self.assertTrue(line.startswith("holds"), line)

    def test_violations_are_6(self):
        self.run_program("mesh", "cube.off", "-o", "a.mesh", "--fill", "-q")
        text = (self.folder / "a.mesh").read_text()
        head, tail = text.split("Tetrahedra", 1)
        count, *rows = tail.strip().split("\n")[0:1] + tail.strip().split("\n")[1:]
        rows = [r for r in rows if re.match(r"^\s*\d+ \d+ \d+ \d+", r)]
        self.assertEqual(len(rows), int(count))
        a, b, *rest = rows[0].split()
        turned = [" ".join([b, a, *rest]), *rows[1:]]
        for name, broken in [("gap.mesh", rows[1:]), ("twice.mesh", [*rows, rows[0]]), ("turned.mesh", turned)]:
            with self.subTest(name):
                self.write(name, head + f"Tetrahedra\n{len(broken)}\n" + "\n".join(broken) + "\nEnd\n")
                told = self.run_program("check", "cube.off", name, "--report", "r.json", expect=6)
                self.assertIn("BROKEN", told.stdout)
                self.assertFalse(json.loads((self.folder / "r.json").read_text())["holds"])
        self.write("moved.off", off([(0, 0, 2.0**-60), *CUBE_POINTS[1:]], CUBE_FACETS))
        self.run_program("check", "moved.off", "a.mesh", expect=6)

    def test_a_damaged_volume_is_3(self):
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--fill", "-q")
        whole = (self.folder / "a.vtu").read_bytes()
        self.write("cut.vtu", whole[: len(whole) // 2])
        self.assertIn("cut.vtu", self.run_program("check", "cube.off", "cut.vtu", expect=3).stderr)


class Diagnose(CliTest):
    def test_a_valid_surface_is_0(self):
        self.assertIn("valid", self.run_program("diagnose", "cube.off").stdout)

    def test_all_defects_are_listed_and_marked(self):
        self.write("crossing.off",
                   off(CUBE_POINTS + cube((0.5, 0.25, 0.125)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        told = self.run_program("diagnose", "crossing.off", "--marks", "m.vtu", "--report", "r.json", expect=4)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertFalse(report["valid"])
        listed = told.stdout.split("\n\n")[1].splitlines()
        self.assertEqual(len(report["defects"]), len(listed))
        for defect in report["defects"]:
            self.assertTrue(defect["message"])
        self.assertGreater((self.folder / "m.vtu").stat().st_size, 0)
        self.assertEqual(json.loads(self.run_program("diagnose", "crossing.off", "--json", expect=4).stdout), report)


class Examples(CliTest):
    """The surfaces that the examples make are valid, and are meshed with and without flips."""

    def make(self, script, *arguments):
        subprocess.run([sys.executable, EXAMPLES / script, *map(str, arguments)], cwd=self.folder,
                       stdout=subprocess.DEVNULL, check=True)

    def mesh_and_check(self, name):
        self.run_program("diagnose", name)
        for extra in ([], ["--without", "flips"]):
            with self.subTest(name, extra=extra):
                self.run_program("mesh", name, "-o", "a.vtu", "--fill", "-q", *extra)
                self.run_program("check", name, "a.vtu")

    def test_the_bearing_housing(self):
        self.make("make_part.py", "part.stl")
        self.mesh_and_check("part.stl")

    def test_points_go_again_where_needles_make_them_useless_unless_growth_is_asked_for(self):
        self.make("make_part.py", "part.stl")
        count = {}
        for asked in ((), ("--fill",), ("--gradation", "0.3"), ("--no-growth",), ("--size", "1000"), ("--size", "3")):
            self.run_program("mesh", "part.stl", "-o", "a.vtu", "-q", "--report", "r.json", *asked)
            count[asked] = json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"]
        self.assertLess(count[()], 1.5 * count[("--fill",)])
        self.assertGreater(count[("--gradation", "0.3")], 1.8 * count[("--fill",)])
        self.assertGreater(count[("--no-growth",)], 1.8 * count[("--fill",)])
        # A size above all that the surface allows has no effect, and a smaller one is respected.
        self.assertAlmostEqual(count[("--size", "1000")] / count[()], 1, delta=0.03)
        self.assertGreater(count[("--size", "3")], 2 * count[()])

    def test_a_size_has_nearly_the_elements_that_it_asks_for_where_needles_make_more_useless(self):
        self.make("make_part.py", "part.stl")
        size, volume = 4, 274124
        self.run_program("mesh", "part.stl", "-o", "a.vtu", "-q", "--report", "r.json", "--size", str(size))
        count = json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"]
        regular = 6 * 2 ** 0.5 * volume / size ** 3
        self.assertGreater(count, 0.55 * regular)
        self.assertLess(count, 0.8 * regular)

    def test_schonhardts_prism_at_many_twists(self):
        for twist in (1e-3, 1, 10, 20, 30, 40, 50, 59, 59.9):
            self.make("make_hard.py", "schonhardt", f"twist{twist}.off", "--twist", twist)
            self.mesh_and_check(f"twist{twist}.off")

    def test_chazelles_polyhedron(self):
        for n in range(1, 6):
            self.make("make_hard.py", "chazelle", f"chazelle{n}.off", "-n", n)
            self.mesh_and_check(f"chazelle{n}.off")

    def test_the_papers_cases(self):
        for name, kind, *arguments in (
                ("worst.off", "worst", "-n", 6, "-m", 6, "--height", 0.1),
                ("free.off", "worst", "-n", 6, "-m", 2, "--free"),
                ("dangling.smesh", "dangling", "-n", 8),
                ("touching.smesh", "touching", "-n", 12, "--height", 0.01),
                ("semiconductor.smesh", "semiconductor", "-n", 2, "--thickness", 1e-4),
                ("gap.off", "gap", "-n", 4, "--gap", 1e-12)):
            self.make("make_paper.py", kind, name, *arguments)
            self.mesh_and_check(name)

    def test_the_papers_counts_of_triangles(self):
        for kind, count in (("dangling", 2082), ("touching", 26326)):
            self.make("make_paper.py", kind, "case.off")
            self.assertIn(f" {count} ", (self.folder / "case.off").read_text().split("\n")[1])


if __name__ == "__main__":
    main()
