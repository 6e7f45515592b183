"""`holdfast tetgen`: switches, and files named and numbered as by TetGen.

    tetgen_test.py PROGRAM [unittest options]
"""
import shutil
import subprocess
from fractions import Fraction

from bounds_test import volume
from cli_case import CUBE_FACETS, CliTest, cube, main, off, shifted

QUADS = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]


def poly(first=1, regions=((0.5, 0.5, 0.5, 10, 0.5), (1.5, 1.5, 1.5, 20, 0.01)), holes=()):
    """A box in a box: six quadrilaterals with markers 1 to 6 outside, 7 inside."""
    points = cube(size=4) + cube((1, 1, 1))
    text = f"# boxes\n{len(points)} 3 0 1\n"
    text += "".join(f"{first + i} {x} {y} {z} {5 if i == 0 else 0}\n" for i, (x, y, z) in enumerate(points))
    text += "12 1\n"
    for by in (0, 8):
        for i, quad in enumerate(QUADS):
            text += f"1 0 {i + 1 if by == 0 else 7}\n4 {' '.join(str(v + by + first) for v in quad)}\n"
    text += f"{len(holes)}\n" + "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(holes))
    text += f"{len(regions)}\n" + "".join(f"{i} {' '.join(map(str, r))}\n" for i, r in enumerate(regions))
    return text


class Tetgen(CliTest):
    def rows(self, name):
        lines = (self.folder / name).read_text().splitlines()
        rows = [line.split("#")[0].split() for line in lines]
        rows = [row for row in rows if row]
        self.assertEqual(int(rows[0][0]), len(rows) - 1, name)
        return rows[0], rows[1:]

    def tetrahedra(self, name="box.1"):
        _, nodes = self.rows(name + ".node")
        points = {int(r[0]): tuple(Fraction(float(x)) for x in r[1:4]) for r in nodes}
        _, elements = self.rows(name + ".ele")
        return points, [[int(x) for x in r[1:]] for r in elements]

    def test_names_and_numbers_are_those_of_tetgen(self):
        for first in (0, 1):
            self.write("box.poly", poly(first))
            self.run_program("tetgen", "-pA", "box.poly")
            self.assertEqual(self.files(), ["box.1.edge", "box.1.ele", "box.1.face", "box.1.node", "box.poly", "cube.off"])
            header, nodes = self.rows("box.1.node")
            self.assertEqual((header[1:], nodes[0]), (["3", "0", "1"], [str(first), "0", "0", "0", "5"]))
            self.assertLess(len(nodes), 20)
            header, elements = self.rows("box.1.ele")
            self.assertEqual(header[1:], ["4", "1"])
            self.assertEqual(int(elements[0][0]), first)
            self.assertEqual({r[5] for r in elements}, {"10", "20"})
            points, tets = self.tetrahedra()
            self.assertEqual(sum(volume(points, t[:4]) for t in tets), 64)
            self.assertEqual(sum(volume(points, t[:4]) for t in tets if t[4] == 20), 1)
            _, faces = self.rows("box.1.face")
            self.assertEqual(sorted(int(r[4]) for r in faces), sorted([1, 2, 3, 4, 5, 6] * 2 + [7] * 12))

    def test_zero_and_iteration_numbers(self):
        self.write("box.1.poly", poly())
        self.run_program("tetgen", "-pz", "box.1.poly")
        self.assertIn("box.2.node", self.files())
        self.assertEqual(self.rows("box.2.node")[1][0][0], "0")
        self.run_program("tetgen", "-pI", "box.1.poly")
        self.assertTrue({"box.1.node", "box.1.ele"} <= set(self.files()))

    def test_a_surface_of_another_format_and_its_smesh(self):
        self.run_program("tetgen", "-pY", "cube.off")
        self.assertEqual(self.files(), ["cube.1." + e for e in ("edge", "ele", "face", "node", "smesh")] + ["cube.off"])
        self.assertEqual({r[4] for r in self.rows("cube.1.face")[1]}, {"1"})
        self.run_program("check", "cube.off", "cube.1.node")
        self.run_program("diagnose", "cube.1.smesh")

    def test_first_numbers_are_those_of_tetgen(self):
        for ending, first, smesh in (("stl", 1, True), ("ply", 0, True), ("mesh", 1, False), ("vtk", 0, True)):
            self.run_program("convert", "cube.off", "c." + ending, "-q")
            self.run_program("tetgen", "-p", "c." + ending)
            self.assertEqual(int(self.rows("c.1.node")[1][0][0]), first, ending)
            self.assertEqual((self.folder / "c.1.smesh").exists(), smesh, ending)
            for file in self.folder.glob("c.*"):
                file.unlink()

    def test_debians_tetgen_finds_the_files_consistent(self):
        if shutil.which("tetgen") is None:
            self.skipTest("there is no tetgen")
        self.write("box.poly", poly())
        self.run_program("tetgen", "-pq1.4aA", "box.poly")
        said = subprocess.run(["tetgen", "-rC", "box.1"], cwd=self.folder, stdout=subprocess.PIPE, text=True, timeout=60,
                              check=True).stdout
        self.assertIn("the mesh appears to be consistent", said)
        self.assertIn("Mesh tetrahedra: %d" % len(self.rows("box.1.ele")[1]), said)

    def test_bounds_are_true_and_by_region(self):
        self.write("box.poly", poly())
        self.run_program("tetgen", "-pq1.4aA", "box.poly")
        points, tets = self.tetrahedra()
        for t in tets:
            self.assertLessEqual(volume(points, t[:4]), Fraction({10: 0.5, 20: 0.01}[t[4]]))
        self.run_program("tetgen", "-pq1.4/10a0.2AY", "box.poly")
        points, tets = self.tetrahedra()
        self.assertLessEqual(max(volume(points, t[:4]) for t in tets), Fraction(0.2))
        # Without a the regions' bounds do not count.
        self.run_program("tetgen", "-pA", "box.poly")
        self.assertLess(len(self.rows("box.1.node")[1]), 20)

    def test_holes(self):
        self.write("box.poly", poly(regions=(), holes=[(1.5, 1.5, 1.5)]))
        self.run_program("tetgen", "-pAV", "box.poly")
        points, tets = self.tetrahedra()
        self.assertEqual(sum(volume(points, t[:4]) for t in tets), 63)

    def test_all_faces_edges_and_neighbours(self):
        self.write("box.poly", poly())
        self.run_program("tetgen", "-pfennkg", "box.poly")
        _, tets = self.tetrahedra()
        header, sides = self.rows("box.1.neigh")
        self.assertEqual(header, [str(len(tets)), "4"])
        outer = 0
        for row, tet in zip(sides, tets):
            for k, other in enumerate(map(int, row[1:])):
                outer += other == -1
                if other != -1:
                    self.assertLessEqual(set(tet) - {tet[k]}, set(tets[other - 1]))
        _, faces = self.rows("box.1.face")
        self.assertEqual(len(faces), (4 * len(tets) + outer) // 2)
        self.assertEqual(sum(r[4] != "0" for r in faces), 24)
        for row in faces:
            corners, inside = set(map(int, row[1:4])), [int(t) for t in row[5:7] if t != "-1"]
            self.assertTrue(inside and all(corners <= set(tets[t - 1]) for t in inside))
        _, edges = self.rows("box.1.edge")
        self.assertEqual({frozenset(r[1:3]) for r in edges},
                         {frozenset((str(a), str(b))) for t in tets for a in t for b in t if a < b})
        self.assertIn(f"CELLS {len(tets)} {5 * len(tets)}", (self.folder / "box.1.vtk").read_text())
        self.assertIn("box.1.mesh", self.files())

    def test_what_is_not_to_be_written(self):
        for switches, gone in [("-pN", ["node"]), ("-pE", ["ele"]), ("-pF", ["face", "edge"]), ("-pNEF", ["node", "ele", "face", "edge"])]:
            with self.subTest(switches):
                for file in self.folder.glob("cube.1.*"):
                    file.unlink()
                self.run_program("tetgen", switches, "cube.off")
                written = {"edge", "ele", "face", "node", "smesh"} - set(gone)
                self.assertEqual(set(self.files()), {"cube.off"} | {"cube.1." + e for e in written})
        self.run_program("tetgen", "-pB", "cube.off")
        self.assertEqual(self.rows("cube.1.face")[0], ["12", "0"])

    def test_second_order(self):
        self.run_program("tetgen", "-po2f", "cube.off")
        points, tets = self.tetrahedra("cube.1")
        self.assertEqual(self.rows("cube.1.ele")[0][1], "10")
        middle = lambda a, b: tuple((x + y) / 2 for x, y in zip(points[a], points[b]))
        for t in tets:
            for node, (i, j) in zip(t[4:], [(2, 3), (0, 3), (0, 1), (1, 2), (1, 3), (0, 2)]):
                self.assertEqual(points[node], middle(t[i], t[j]))
        for row in self.rows("cube.1.face")[1]:
            f = list(map(int, row[1:7]))
            for node, (i, j) in zip(f[3:], [(0, 1), (1, 2), (0, 2)]):
                self.assertEqual(points[node], middle(f[i], f[j]))
        for row in self.rows("cube.1.edge")[1]:
            a, b, node = map(int, row[1:4])
            self.assertEqual(points[node], middle(a, b))

    def test_points_alone(self):
        self.write("pts.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n")
        self.run_program("tetgen", "pts.node")
        self.assertEqual(set(self.files()), {"cube.off", "pts.node", "pts.1.node", "pts.1.ele", "pts.1.face"})
        self.assertEqual(len(self.rows("pts.1.face")[1]), 6)
        self.run_program("tetgen", "-qa0.01", "pts")
        points, tets = self.tetrahedra("pts.1")
        self.assertLessEqual(max(volume(points, t) for t in tets), Fraction(0.01))

    def test_more_points_and_sizes(self):
        self.write("cube.a.node", "1 3 0 0\n1 0.4 0.5 0.6\n")
        self.run_program("tetgen", "-pi", "cube.off")
        self.assertEqual(self.rows("cube.1.node")[1][8], ["8", "0.4", "0.5", "0.6"])
        self.write("cube.mtr", "8 1\n" + "0.2\n" * 8)
        self.write("cube.node", "8 3 0 0\n" + "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(cube())))
        self.run_program("tetgen", "-pq", "cube.off")
        without = len(self.rows("cube.1.ele")[1])
        self.run_program("tetgen", "-pqm", "cube.off")
        self.assertGreater(len(self.rows("cube.1.ele")[1]), without)
        (self.folder / "cube.mtr").unlink()
        self.run_program("tetgen", "-pqm", "cube.off", expect=3)

    def test_the_convex_hull_is_filled(self):
        # A block with a notch: hull faces that the surface covers partly, with other diagonals.
        outline = [(0, 0), (4, 0), (4, 4), (3, 4), (2, 1), (1, 4), (0, 4)]
        points = [(x, y, z) for z in (0, 1) for x, y in outline]
        text = f"{len(points)} 3 0 0\n" + "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points)) + "9 1\n"
        n = len(outline)
        text += "1 0 1\n%d %s\n" % (n, " ".join(str(i) for i in reversed(range(n))))
        text += "1 0 2\n%d %s\n" % (n, " ".join(str(i + n) for i in range(n)))
        for i in range(n):
            j = (i + 1) % n
            text += f"1 0 3\n4 {i} {j} {j + n} {i + n}\n"
        self.write("notch.poly", text + "0\n0\n")
        for switches, whole in (("-p", 13), ("-pc", 16)):
            self.run_program("tetgen", switches, "notch.poly")
            points, tets = self.tetrahedra("notch.1")
            self.assertEqual(sum(volume(points, t[:4]) for t in tets), whole)
        self.run_program("check", "notch.poly", "notch.1.node", "-q", expect=6)  # its boundary is the hull
        self.run_program("tetgen", "-pc", "cube.off")
        self.assertEqual(len(self.rows("cube.1.face")[1]), 12)

    def test_self_intersections(self):
        self.run_program("tetgen", "-d", "cube.off")
        self.assertEqual(self.files(), ["cube.off"])
        self.write("two.off", off(cube() + cube((0.5, 0.25, 0.25), 1), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        said = self.run_program("tetgen", "-d", "two.off", expect=4)
        self.assertIn("cross", said.stdout)
        self.assertTrue({"two.1.node", "two.1.face"} <= set(self.files()))
        self.assertNotIn("two.1.ele", self.files())
        self.run_program("tetgen", "-p", "two.off", expect=4)

    def test_what_there_is_not_is_refused_by_name(self):
        for switch in ("r", "R", "v", "w", "D", "y"):
            with self.subTest(switch):
                said = self.run_program("tetgen", "-" + switch, "cube.off", expect=2).stderr
                self.assertIn(f"switch {switch[-1]}", said)
                self.assertEqual(self.files(), ["cube.off"])
        for arguments in (["-p"], ["-pq0.1", "cube.off"], ["-pa-1", "cube.off"], ["-po3", "cube.off"], ["-", "cube.off"]):
            self.run_program("tetgen", *arguments, expect=2)
        self.run_program("tetgen", "-p", "nothing.poly", expect=3)

    def test_differences_are_told_unless_quiet(self):
        said = self.run_program("tetgen", "-pT1e-9O2/7", "cube.off").stderr
        self.assertIn("without Y", said)
        self.assertIn("T1e-9, O2/7", said)
        self.assertEqual(self.run_program("tetgen", "-pQ", "cube.off").stderr, "")
        self.assertNotIn("without Y", self.run_program("tetgen", "-pY", "cube.off").stderr)

    def test_glued_apart_and_without_a_dash(self):
        results = []
        for words in (["-pq1.4a0.1e"], ["-p", "-q1.4", "-a0.1", "-e"], ["pq1.4a1e-1e"]):
            self.run_program("tetgen", *words, "cube.off")
            results.append([self.rows("cube.1." + e) for e in ("node", "ele", "face", "edge")])
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])

    def test_the_input_is_not_overwritten(self):
        self.write("part.node", "8 3 0 0\n" + "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(cube())))
        self.write("part.smesh", "0 3 0 0\n12 0\n" + "".join("3 %d %d %d\n" % f for f in CUBE_FACETS) + "0\n0\n")
        before = (self.folder / "part.node").read_text()
        self.run_program("tetgen", "-pI", "part.smesh", expect=2)
        self.assertEqual((self.folder / "part.node").read_text(), before)
        self.run_program("tetgen", "-pIN", "part.smesh")

    def test_check_and_vertices_that_nothing_uses(self):
        self.write("more.off", off(cube() + [(9, 9, 9), (0, 0, 0)], CUBE_FACETS))
        self.run_program("tetgen", "-pC", "cube.off")
        self.run_program("tetgen", "-pJ", "more.off")
        self.assertEqual(self.rows("more.1.node")[1][8], ["8", "9", "9", "9"])

    def test_counts_beside_debians_tetgen(self):
        if shutil.which("tetgen") is None:
            self.skipTest("there is no tetgen")
        for switches, names in [("-pYA", ["box.poly"]), ("-pYzfen", ["box.poly", "cube.off"]), ("-pYB", ["cube.off"]), ("-n", ["pts.node"])]:
            for name in names:
                with self.subTest(f"{switches} {name}"):
                    self.write("box.poly", poly())
                    self.write("pts.node", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n")
                    stem = name.split(".")[0]
                    for file in self.folder.glob("*.1.*"):
                        file.unlink()
                    subprocess.run(["tetgen", switches, name], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, timeout=60, check=True)
                    theirs = {f.name: self.rows(f.name) for f in self.folder.glob(f"{stem}.1.*") if f.suffix != ".smesh"}
                    names_of_theirs = self.files()
                    for file in self.folder.glob("*.1.*"):
                        file.unlink()
                    self.run_program("tetgen", switches, name)
                    self.assertEqual(self.files(), names_of_theirs)
                    for file, (header, rows) in theirs.items():
                        own, lines = self.rows(file)
                        self.assertEqual(own[1:], header[1:], file)
                        self.assertEqual(lines[0][0], rows[0][0], file)
                        self.assertEqual({len(r) for r in lines}, {len(r) for r in rows}, file)
                    nodes = theirs[f"{stem}.1.node"][1]
                    self.assertEqual(self.rows(f"{stem}.1.node")[1][:len(nodes)], nodes)


if __name__ == "__main__":
    main()
