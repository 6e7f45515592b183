"""`holdfast delaunay` from outside.

    delaunay_test.py PROGRAM [unittest options]
"""
import json

from cli_case import CliTest, cube, main, off


class Delaunay(CliTest):
    def test_points_of_every_kind(self):
        rows = [f"{x} {y} {z}" for x, y, z in [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1)]]
        self.write("p.xyz", "# five points\n" + "\n".join(rows) + "\n")
        self.write("p.node", "5 3 0 0\n" + "\n".join(f"{i + 1} {r}" for i, r in enumerate(rows)) + "\n")
        for name in ("p.xyz", "p.node", "cube.off"):
            with self.subTest(name):
                self.run_program("delaunay", name, "-o", "d.vtu", "--report", "r.json")
                report = json.loads((self.folder / "r.json").read_text())
                self.assertIn("delaunay", report["seconds"])
                self.assertGreaterEqual(report["mesh"]["tetrahedra"], 4)

    def test_threads_change_nothing(self):
        for command, name in (("delaunay", "cube.off"), ("mesh", "cube.off")):
            written = set()
            for threads in "012":
                self.run_program(command, name, "-o", "d.vtk", "-q", "--threads", threads)
                written.add((self.folder / "d.vtk").read_bytes())
            self.assertEqual(len(written), 1, command)
        self.run_program("delaunay", "cube.off", "-o", "d.vtk", "--threads", "-1", expect=2)

    def test_coplanar_points_give_no_tetrahedra(self):
        self.write("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n")
        self.assertIn("plane", self.run_program("delaunay", "flat.xyz", "-o", "d.vtu").stderr)

    def test_bad_points(self):
        self.write("short.xyz", "0 0 0\n1 2\n")
        self.assertIn("line 2", self.run_program("delaunay", "short.xyz", "-o", "d.vtu", expect=3).stderr)
        self.write("cut.node", "5 3 0 0\n1 0 0 0\n")
        self.run_program("delaunay", "cut.node", "-o", "d.vtu", expect=3)
        self.write("nan.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 nan\n")
        self.assertIn("holdfast: nan.xyz: point 3 is not finite", self.run_program("delaunay", "nan.xyz", "-o", "d.vtu", expect=4).stderr)
        self.assertNotIn("d.vtu", self.files())


if __name__ == "__main__":
    main()
