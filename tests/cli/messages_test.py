"""Messages about a surface that cannot be filled: the cause first, then the list, and what to do.

    messages_test.py PROGRAM [unittest options]
"""
import json
import os
import pty
import re
import subprocess

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, read_terminal, shifted

OPEN_FACETS = CUBE_FACETS[:2] + CUBE_FACETS[4:]  # without its side z = 1


class DiagnoseAndMesh(CliTest):
    def test_an_open_surface_is_valid_to_both(self):
        self.write("open.off", off(CUBE_POINTS, OPEN_FACETS))
        told = self.run_program("diagnose", "open.off", "--report", "r.json").stdout
        self.assertTrue(told.startswith("valid, encloses nothing: needs `--keep box`"), told)
        self.assertIn("4 sides of one triangle alone", told)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["valid"])
        self.assertEqual(report["summary"]["encloses"], 0)
        self.assertEqual(sorted(map(sorted, report["summary"]["open_sides"])), [[4, 5], [4, 6], [5, 7], [6, 7]])

        said = self.run_program("mesh", "open.off", "-o", "a.vtu", expect=4).stderr
        self.assertNotIn("not valid", said)
        self.assertIn("encloses nothing", said)
        self.assertIn("--keep box", said)
        self.assertIn("4 edges at vertex 4", said)
        self.run_program("mesh", "open.off", "-o", "a.vtu", "--keep", "box", "--fill")

    def test_one_thing_is_no_many(self):
        points, facets = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
        self.write("one.off", off(points, facets))
        self.write("one.node", "4 3 0 0\n" + "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points)))
        self.write("twice.off", off(points + [(1, 0, 0)], facets[:3] + [(2, 0, 3), (0, 1, 4)]))
        self.write("triangle.off", off(points[:3], [(0, 1, 2)]))
        self.write("plane.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n")
        self.write("short.stl", "x" * 80 + "\x01\0\0\0" + "\0" * 101)
        said = ""
        for command in (["mesh", "one.off", "-o", "a.vtu", "--verbose"], ["mesh", "one.off", "-o", "b.vtu", "--layers", "2"],
                        ["mesh", "one.off", "-o", "b.vtu", "--max-volume", "1", "--max-ratio", "9"],
                        ["mesh", "one.off", "-o", "p.vtu", "--partition", "2"], ["mesh", "one.off", "-o", "p.stl"],
                        ["mesh", "one.off", "-o", "c.vtu", "--order", "2", "--curved", "one.off"],
                        ["mesh", "twice.off", "-o", "b.vtu"], ["diagnose", "twice.off"], ["diagnose", "one.off"],
                        ["repair", "one.off", "-o", "r.off"], ["repair", "twice.off", "-o", "r.off", "--parents", "p.txt", "--report", "r.json"],
                        ["check", "--repaired", "twice.off", "r.off", "--parents", "p.txt", "--report", "r.json"],
                        ["check", "one.off", "a.vtu"], ["check", "one.off", "c.vtu"], ["untangle", "a.vtu", "-o", "u.vtu"],
                        ["delaunay", "one.node", "-o", "d.vtu"], ["delaunay", "triangle.off", "-o", "d.vtu"],
                        ["convert", "triangle.off", "t.poly"], ["convert", "a.vtu", "t.bdf"], ["convert", "short.stl", "t.off"],
                        ["info", "a.vtu"], ["view", "a.vtu", "-o", "a.html"], ["plane", "plane.node", "-o", "p.off", "--hull"],
                        ["split", "one.off", "--parts", "1", "-o", "parts"], ["tetgen", "-p", "one.off"], ["tetgen", "one.node"]):
            told = subprocess.run([self.program, *command], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertNotIn(told.returncode, (1, 2 if "--partition" not in command else 1), (command, told.stderr))
            said += f"{command}\n{told.stdout}{told.stderr}"
        found = [line for line in said.splitlines() if re.search(
            r"(?<![\d.(])1 (\w+ )?(vertices|tetrahedra|triangles|segments|facets|regions|points|parts|nodes|edges|faces|files|defects|sides|swaps|cavities|are|have)\b",
            line) and "of 1 " not in line]
        self.assertEqual(found, [], said)

    def test_what_a_valid_surface_encloses(self):
        for points, facets, regions in [
            (CUBE_POINTS, CUBE_FACETS, "1 region"),
            (CUBE_POINTS + cube((0.25, 0.25, 0.25), 0.5), CUBE_FACETS + shifted(CUBE_FACETS, 8), "2 regions"),
            (CUBE_POINTS, CUBE_FACETS + [(0, 1, 7)], "1 region"),
        ]:
            self.write("s.off", off(points, facets))
            told = self.run_program("diagnose", "s.off").stdout
            self.assertRegex(told, rf"^valid: .*; encloses {regions}\n")
            self.assertNotIn("outside", told)

    def test_check_names_the_option_that_accepts_what_lies_outside(self):
        self.write("wing.off", off(CUBE_POINTS + [(3, 0, 0), (3, 1, 0)], CUBE_FACETS + [(1, 8, 9)]))
        self.run_program("mesh", "wing.off", "-o", "a.vtu", "--drop-outside")
        said = self.run_program("check", "wing.off", "a.vtu", expect=6).stderr
        self.assertIn("--outside-dropped accepts that", said)
        self.run_program("check", "wing.off", "a.vtu", "--outside-dropped")
        self.write("more.off", off(CUBE_POINTS + [(3, 0, 0), (3, 1, 0), (0.5, 0.4, 0.3)],
                                   CUBE_FACETS + [(1, 8, 9), (0, 1, 10)]))
        said = self.run_program("check", "more.off", "a.vtu", expect=6).stderr
        self.assertNotIn("--outside-dropped", said)

    def test_what_does_not_suit_the_kept_regions_leaves_the_surface_valid(self):
        self.write("wing.off", off(CUBE_POINTS + [(3, 0, 0), (3, 1, 0)], CUBE_FACETS + [(1, 8, 9)]))
        said = self.run_program("mesh", "wing.off", "-o", "a.vtu", expect=4).stderr
        self.assertNotIn("not valid", said)
        self.assertIn("--drop-outside", said)
        told = self.run_program("diagnose", "wing.off", "--report", "r.json").stdout
        self.assertIn("encloses 1 region", told)
        self.assertIn("triangle 12 at (1, 0, 0) borders on no kept region", told)
        self.assertIn("--drop-outside", told)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual([defect["facets"] for defect in report["outside"]], [[12]])
        turned = [CUBE_FACETS[0][::-1]] + CUBE_FACETS[1:]
        self.write("turned.off", off(CUBE_POINTS, turned))
        said = self.run_program("mesh", "turned.off", "-o", "a.vtu", "--keep", "winding", expect=4).stderr
        self.assertNotIn("not valid", said)
        self.assertIn("--keep bounded", said)


class Causes(CliTest):
    def test_a_crack_names_both_vertices_and_the_distance(self):
        # The side z = 1 has separate corners, 2^-30 above those of the walls.
        above = [(x, y, 1 + 2**-30) for x, y, z in CUBE_POINTS if z == 1]
        lid = [tuple(v + 4 for v in f) for f in CUBE_FACETS[2:4]]
        self.write("crack.off", off(CUBE_POINTS + above, OPEN_FACETS + lid))
        told = self.run_program("diagnose", "crack.off").stdout
        self.assertIn("4 vertices of open borders that lie almost on another border, at most 9.31e-10 apart", told)
        for vertex in (4, 5, 6, 7):
            self.assertRegex(told, rf"crack: vertex {vertex} \(.*\) lies 9.31e-10 from vertex {vertex + 4}: merge")
        said = self.run_program("mesh", "crack.off", "-o", "a.vtu", expect=4).stderr
        self.assertIn("lies 9.31e-10 from vertex", said)

    def test_unwelded_vertices_are_told_where_triangles_cross(self):
        # The same, but with two of the corners below.
        lid = [(x, y, 1 + (2**-30 if x == y else -2**-30)) for x, y, z in CUBE_POINTS if z == 1]
        self.write("unwelded.off", off(CUBE_POINTS + lid, OPEN_FACETS + shifted(CUBE_FACETS[2:4], 4)))
        told = self.run_program("diagnose", "unwelded.off", "--report", "r.json", expect=4).stdout
        self.assertRegex(told.splitlines()[1], r"^  \d+ misfits? at vertices that are almost one .*apart.*merge them")
        self.assertRegex(told, r"unwelded: vertex \d \(.*\) lies 9.31e-10 from vertex \d+: merge")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["summary"]["causes"][0]["cause"], "unwelded vertices")
        self.assertEqual(report["summary"]["gaps"][0]["distance"], 2**-30)

    def test_a_t_junction_beside_a_border_is_told_as_a_crack(self):
        # A vertex 1e-9 off the wall's upper side, of a lid of three triangles.
        points = CUBE_POINTS + [(0.5, 0, 1 + 1e-9)]
        lid = [(4, 8, 6), (8, 7, 6), (8, 5, 7)]
        self.write("t.off", off(points, OPEN_FACETS + lid))
        self.assertRegex(self.run_program("diagnose", "t.off").stdout,
                         r"crack: vertex 8 \(.*\) lies 1e-09 from the side 4-5: split it")

    def test_separate_parts_and_one_part_that_crosses_itself(self):
        self.write("parts.off", off(CUBE_POINTS + cube((0.5, 0.25, 0.125)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        told = self.run_program("diagnose", "parts.off", expect=4).stdout
        self.assertRegex(told, r"^not valid: 16 vertices, 0 segments, 24 facets in 2 parts; \d+ defects\n"
                               r"  \d+ crossings of separate parts, the longest: triangles \d+ and \d+ along")
        self.write("self.off", off(CUBE_POINTS[:-1] + [(-1, -1, 0.5)], CUBE_FACETS))
        told = self.run_program("diagnose", "self.off", expect=4).stdout
        self.assertIn("where a part passes through itself", told)
        self.assertNotIn("separate parts", told)

    def test_the_summary_counts_every_kind(self):
        points = CUBE_POINTS + [(0.5, 0, 0), (0.5, 0.25, 1)]
        facets = CUBE_FACETS + [CUBE_FACETS[5], (0, 8, 1)]
        self.write("many.off", off(points, facets))
        told = self.run_program("diagnose", "many.off", "--report", "r.json", expect=4).stdout
        report = json.loads((self.folder / "r.json").read_text())
        causes = {cause["cause"]: cause for cause in report["summary"]["causes"]}
        self.assertEqual(causes["no extent"]["count"], 1)
        self.assertEqual(causes["repeated triangles"]["count"], 1)
        self.assertEqual(causes["T-junctions"]["count"], 1)
        self.assertEqual(causes["vertices in triangles"]["count"], 1)
        listed = [i for cause in causes.values() for i in cause["defects"]]
        self.assertEqual(sorted(listed), list(range(len(report["defects"]))))
        for cause in causes.values():
            self.assertIn("\n  " + cause["message"] + "\n", told)
        said = self.run_program("mesh", "many.off", "-o", "a.vtu", expect=4).stderr
        self.assertIn("not valid", said)
        self.assertIn("  1 T-junction", said)


class LongLists(CliTest):
    def setUp(self):
        super().setUp()
        # 300 triangles in a row, each twice.
        points = [(i, j, 0) for i in range(301) for j in range(2)]
        self.write("rows.off", off(points, 2 * [(2 * i, 2 * i + 1, 2 * i + 2) for i in range(300)]))

    def on_terminal(self, *arguments):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([self.program, *arguments], cwd=self.folder, stdout=theirs,
                                   stderr=subprocess.DEVNULL)
        os.close(theirs)
        shown = b"".join(iter(lambda: read_terminal(ours), b"")).decode().replace("\r\n", "\n")
        os.close(ours)
        self.assertEqual(process.wait(60), 4)
        return shown

    def test_a_terminal_gets_the_summary_and_a_hundred_of_a_kind(self):
        shown = self.on_terminal("diagnose", "rows.off")
        self.assertIn("  300 repeated triangles", shown)
        self.assertEqual(shown.count("repeated facet:"), 100)
        self.assertIn("... and 200 more like these; --all", shown)
        self.assertEqual(self.on_terminal("diagnose", "rows.off", "--all").count("repeated facet:"), 300)

    def test_a_file_gets_a_thousand_of_a_kind(self):
        self.assertEqual(self.run_program("diagnose", "rows.off", expect=4).stdout.count("repeated facet:"), 300)
        points = [(i, j, 0) for i in range(1203) for j in range(2)]
        self.write("long.off", off(points, 2 * [(2 * i, 2 * i + 1, 2 * i + 2) for i in range(1202)]))
        told = self.run_program("diagnose", "long.off", "--report", "all.json", expect=4)
        self.assertIn("1202 defects", told.stdout.splitlines()[0])
        self.assertEqual(told.stdout.count("repeated facet:"), 1000)
        self.assertIn("... and 202 more like these; --all lists them, --report FILE.json, too\n", told.stdout)
        self.assertEqual(len(json.loads((self.folder / "all.json").read_text())["defects"]), 1202)
        told = self.run_program("diagnose", "long.off", "--all", expect=4)
        self.assertEqual(told.stdout.count("repeated facet:"), 1202)

    def test_mesh_shows_the_summary_and_a_few(self):
        said = self.run_program("mesh", "rows.off", "-o", "a.vtu", expect=4).stderr
        self.assertEqual(said.count("repeated facet:"), 20)
        self.assertIn("more like these; `holdfast diagnose`", said)

    def test_names_that_nothing_has(self):
        names = ["--name", "region:7=x", "--name", "region:1=core", "--name", "3=wall", "--name", "0=skin", "--name", "segment:4=rim"]
        said = self.run_program("mesh", "cube.off", "-o", "v.vtu", *names).stderr
        self.assertIn("--name region:7=x does nothing: there is no such region; the only id is 1\n", said)
        self.assertIn("--name 3=wall does nothing: no triangle has the marker 3; the only id is 0\n", said)
        self.assertIn("--name segment:4=rim does nothing: no segment has the marker 4; there is none at all\n", said)
        self.assertEqual(said.count("does nothing"), 3)
        said = self.run_program("convert", "v.vtu", "w.vtu", *names).stderr
        self.assertEqual(said.count("does nothing"), 3)
        # The mesh of a surface without seeds numbers its regions, so names may refer to them later.
        said = self.run_program("convert", "cube.off", "s.off", "--name", "region:7=x", "--name", "3=wall").stderr
        self.assertEqual((said.count("does nothing"), said.count("region:7")), (1, 0))
        self.assertNotIn("does nothing", self.run_program("mesh", "cube.off", "-o", "v.vtu", "-q", *names).stderr)
        self.write("next.off", off(cube((1, 0, 0)), CUBE_FACETS))
        said = self.run_program("paste", "cube.off", "next.off", "-o", "p.off", "--name", "region:2=b", "--name", "region:3=c",
                                "--name", "3=between", "--name", "4=none").stderr
        self.assertEqual((said.count("does nothing"), said.count("4=none")), (1, 1))

    def test_two_names_of_one_marker(self):
        for command in (("mesh", "cube.off", "-o", "v.vtu", "--fill"), ("convert", "cube.off", "w.obj")):
            said = self.run_program(*command, "--name", "0=a", "--name", "facet:0=b", expect=2).stderr
            self.assertIn("--name facet:0=b: it has the name 'a' by another --name", said)
            self.run_program(*command, "--name", "0=a", "--name", "0=a", "--name", "region:0=b")


if __name__ == "__main__":
    main()
