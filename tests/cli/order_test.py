"""--order 2 and --curved: mid-edge nodes in every format that holds them, read by other programs if they are installed.

    order_test.py PROGRAM [unittest options]
"""
import json
import math
import shutil
import subprocess
from pathlib import Path

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, main, off

# The edges of a tetrahedron in the order of their nodes in each format.
VTK = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
GMSH = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
TETGEN = [(2, 3), (0, 3), (0, 1), (1, 2), (1, 3), (0, 2)]


def sphere(n):
    """Points and triangles on the unit sphere."""
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, n):
        t = math.pi * i / n
        points += [(math.sin(t) * math.cos(2 * math.pi * j / n), math.sin(t) * math.sin(2 * math.pi * j / n), math.cos(t))
                   for j in range(n)]
    points.append((0.0, 0.0, -1.0))
    ring = lambda i, j: 1 + (i - 1) * n + j % n
    triangles = []
    for j in range(n):
        triangles += [(0, ring(1, j), ring(1, j + 1)), (len(points) - 1, ring(n - 1, j + 1), ring(n - 1, j))]
        for i in range(1, n - 1):
            triangles += [(ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)), (ring(i, j), ring(i + 1, j + 1), ring(i, j + 1))]
    return points, triangles


class Order(CliTest):
    def read(self, name):
        """Points and tetrahedra of ten nodes, from the text of a file."""
        path = self.folder / name
        words = path.read_text().split()
        if path.suffix == ".mesh":
            def rows(section, width):
                at = words.index(section) + 2
                return [words[at + i * width:at + (i + 1) * width] for i in range(int(words[at - 1]))]
            points = [tuple(map(float, r[:3])) for r in rows("Vertices", 4)]
            return points, [[int(v) - 1 for v in r[:10]] for r in rows("TetrahedraP2", 11)]
        lines = lambda p: [line.split() for line in p.read_text().splitlines() if line and line[0] != "#"][1:]
        points = [tuple(map(float, r[1:4])) for r in lines(path)]
        return points, [list(map(int, r[1:11])) for r in lines(path.with_suffix(".ele"))]

    def check_middles(self, points, tetrahedra, edges, digits=None):
        of_edge = {}
        for t in tetrahedra:
            for node, (a, b) in zip(t[4:], edges):
                for p, x, y in zip(points[node], points[t[a]], points[t[b]]):
                    self.assertAlmostEqual(p, (x + y) / 2, digits if digits else 17)
                self.assertEqual(of_edge.setdefault(frozenset((t[a], t[b])), node), node)

    def test_nodes_are_in_the_middle_in_the_order_of_the_format(self):
        for name, edges in (("cube.mesh", VTK), ("cube.node", TETGEN)):
            self.run_program("mesh", "cube.off", "-o", name, "--order", "2", "--size", "0.6")
            points, tetrahedra = self.read(name)
            self.assertGreater(len(tetrahedra), 10)
            self.check_middles(points, tetrahedra, edges)

    def test_every_format_is_read_back_and_checked(self):
        for ending in ("mesh", "meshb", "node", "vtu", "vtk", "msh"):
            with self.subTest(ending):
                self.run_program("mesh", "cube.off", "-o", "a." + ending, "--order", "2", "--size", "0.6", "-q")
                said = self.run_program("check", "cube.off", "a." + ending).stdout
                self.assertIn("holds   mid-edge nodes placed", said)
                self.assertIn("holds   Jacobians positive", said)
                found = json.loads(self.run_program("info", "a." + ending, "--json").stdout)
                self.assertEqual((found["order"], found["mid_nodes"]), (2, found["edges"]))
                self.assertIn("of the straight elements", self.run_program("info", "a." + ending).stdout)
                self.run_program("convert", "a." + ending, "b.mesh", "--order", "1", "-q")
                found = json.loads(self.run_program("info", "b.mesh", "--json").stdout)
                self.assertEqual((found["order"], found["unused_vertices"]), (1, 0))
        self.run_program("convert", "a.msh", "again.node", "-q")
        self.run_program("check", "cube.off", "again.node", "-q")

    def test_check_finds_a_node_that_was_moved(self):
        self.run_program("mesh", "cube.off", "-o", "a.node", "--order", "2", "--size", "0.4", "-q")
        points, tetrahedra = self.read("a.node")
        inner = next(n for t in tetrahedra for n in t[4:] if all(0 < x < 1 for x in points[n]))
        lines = (self.folder / "a.node").read_text().splitlines()
        words = lines[1 + inner].split()
        words[1] = repr(float(words[1]) + 1e-6)
        lines[1 + inner] = " ".join(words)
        (self.folder / "a.node").write_text("\n".join(lines) + "\n")
        self.assertIn("BROKEN  mid-edge nodes placed", self.run_program("check", "cube.off", "a.node", expect=6).stdout)

    def test_meshio_reads_it(self):
        python = shutil.which("python3", path="/usr/bin") or "python3"
        script = ("import meshio, sys\nm = meshio.read(sys.argv[1])\n"
                  "for b in m.cells:\n  if b.type == 'tetra10':\n"
                  "    for t in b.data:\n      for n, (i, j) in zip(t[4:], [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]):\n"
                  "        assert abs(m.points[n] - (m.points[t[i]] + m.points[t[j]]) / 2).max() < 1e-12\n    print('read')\n")
        if subprocess.run([python, "-c", "import meshio"], stderr=subprocess.DEVNULL, check=False).returncode:
            self.skipTest("there is no meshio")
        for name in ("a.vtu", "a.vtk", "a.msh"):
            self.run_program("mesh", "cube.off", "-o", name, "--order", "2", "--size", "0.6", "-q")
            said = subprocess.run([python, "-c", script, name], cwd=self.folder, stdout=subprocess.PIPE, text=True, check=True)
            self.assertIn("read", said.stdout, name)

    def test_report_and_wrong_usage(self):
        self.run_program("mesh", "cube.off", "-o", "cube.mesh", "--order", "2", "--fill", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())["second_order"]
        self.assertEqual(report["order"], 2)
        self.assertGreater(report["nodes"], 18)
        for arguments in (["--order", "3"], ["--order", "0"], ["--curved", "cube.off"], ["--order", "2", "--curved-tolerance", "1"],
                          ["--order", "2", "--curved", "cube.off", "--curved-tolerance", "0"]):
            self.run_program("mesh", "cube.off", "-o", "no.mesh", *arguments, expect=2)
            self.run_program("convert", "cube.mesh", "no.mesh", *arguments, expect=2)
        self.run_program("mesh", "cube.off", "-o", "no.mesh", "--order", "2", "--curved", "missing.stl", expect=3)
        self.run_program("convert", "cube.off", "no.mesh", "--order", "2", expect=2)
        self.assertNotIn("no.mesh", self.files())

    def test_curved(self):
        self.write("coarse.off", off(*sphere(10)))
        self.write("fine.off", off(*sphere(80)))
        self.run_program("mesh", "coarse.off", "-o", "ball.mesh", "--order", "2", "--curved", "fine.off", "--report", "r.json")
        told = json.loads((self.folder / "r.json").read_text())["second_order"]
        self.assertEqual(told["moved"] + told["beyond_tolerance"] + told["straightened"], told["on_triangles"])
        self.assertGreater(told["moved"], 0.9 * told["on_triangles"])
        points, tetrahedra = self.read("ball.mesh")
        on_sphere = {n for t in tetrahedra for n in t[4:] if abs(math.hypot(*points[n]) - 1) < 1e-2}
        self.assertGreaterEqual(len(on_sphere), told["moved"])
        said = self.run_program("mesh", "coarse.off", "-o", "b.mesh", "--order", "2", "--curved", "fine.off",
                                "--curved-tolerance", "1e-9").stderr
        self.assertIn("farther", said)

    def test_the_smooth_surface_is_scaled_with_the_volume(self):
        self.write("coarse.off", off(*sphere(10)))
        self.write("fine.off", off(*sphere(80)))
        self.run_program("mesh", "coarse.off", "-o", "flat.vtu")
        for tolerance in ([], ["--curved-tolerance", "0.03"]):
            options = ["--order", "2", "--curved", "fine.off", *tolerance]
            said = self.run_program("convert", "flat.vtu", "one.mesh", *options).stderr
            self.assertNotRegex(said, r": 0 of \d+ nodes")
            self.run_program("convert", "flat.vtu", "half.mesh", *options, "--scale", "0.5")
            halves = [tuple(x / 2 for x in p) for p in self.read("one.mesh")[0]]
            self.assertEqual(self.read("half.mesh")[0], halves)

    def test_gmsh_reads_it(self):
        if shutil.which("gmsh") is None:
            self.skipTest("there is no gmsh")
        self.run_program("mesh", "cube.off", "-o", "cube.mesh", "--order", "2", "--size", "0.6")
        subprocess.run(["gmsh", "-0", "cube.mesh", "-o", "again.msh", "-format", "msh22", "-save_all"], cwd=self.folder,
                       stdout=subprocess.DEVNULL, timeout=120, check=True)
        words = (self.folder / "again.msh").read_text().split()
        at = words.index("$Nodes") + 2
        points = {int(words[at + 4 * i]): tuple(map(float, words[at + 4 * i + 1:at + 4 * i + 4])) for i in range(int(words[at - 1]))}
        lines = (self.folder / "again.msh").read_text().split("$Elements")[1].split("\n")[2:]
        elements = [list(map(int, line.split())) for line in lines if line and line[0] != "$"]
        tetrahedra = [e[3 + e[2]:] for e in elements if e[1] == 11]
        self.assertEqual(len(tetrahedra), len(self.read("cube.mesh")[1]))
        self.check_middles(points, tetrahedra, GMSH, digits=14)


if __name__ == "__main__":
    main()
