"""`holdfast untangle` from outside.

    untangle_test.py PROGRAM [unittest options]
"""
import json
import random
import signal
import subprocess
import sys
from pathlib import Path

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off

BENCH = Path(__file__).resolve().parents[2] / "bench"


class Untangle(CliTest):
    """A cube of 8 x 8 x 8 cells, 6 tetrahedra each, whose inner vertices are displaced or not."""

    def setUp(self):
        super().setUp()
        sys.path.insert(0, str(BENCH))
        import untangle
        self.bench = untangle
        self.grid = untangle.grid(8, 0.2, random.Random(1))
        points, _, facets = self.grid
        self.write("grid.off", off(points, [tuple(v - 1 for v in f[:3]) for f in facets]))

    def tangle(self, name, mesh):
        self.bench.write_mesh(self.folder / name, mesh)

    def test_displaced_and_rounded_and_moved(self):
        rng = random.Random(2)
        for share in (0.3, 2):
            self.tangle("tangled.mesh", self.bench.displaced(self.grid, share, rng))
            told = self.run_program("untangle", "tangled.mesh", "-o", "out.mesh", "--report", "r.json").stderr
            self.assertRegex(told, r"out\.mesh: \d+ negative and \d+ null of 3072 tetrahedra untangled: \d+ vertices")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(report["outcome"], "done")
            self.assertEqual(report["input"]["tetrahedra"], 3072)
            self.assertGreater(report["input"]["negative"], 0)
            self.assertEqual(report["left"], {"negative": 0, "null": 0})
            for key in "moved swapped cavities added removed rounds mesh seconds version options".split():
                self.assertIn(key, report)
            again = self.run_program("untangle", "out.mesh", "-o", "again.vtu", "--report", "r.json").stderr
            self.assertIn(" 0 negative and 0 null", again)
        self.assertEqual(self.run_program("untangle", "tangled.mesh", "-o", "a.msh", "-q").stderr, "")
        self.assertIn("relocate", self.run_program("untangle", "tangled.mesh", "-o", "a.msh", "-v").stderr)

    def test_improving(self):
        self.write("cube.off", off(CUBE_POINTS, CUBE_FACETS))
        self.run_program("mesh", "cube.off", "-o", "filled.mesh", "--size", "0.2", "--without", "optimise", "-q")
        told = self.run_program("untangle", "filled.mesh", "-o", "out.mesh", "--improve", "--report", "r.json").stderr
        self.assertRegex(told, r"improved: least dihedral angle [\d.]+ to [\d.]+ degrees")
        improved = json.loads((self.folder / "r.json").read_text())["improved"]
        self.assertGreater(improved["after"]["min_dihedral_deg"], improved["before"]["min_dihedral_deg"])
        self.assertLess(improved["after"]["mean_q"], improved["before"]["mean_q"])
        self.run_program("check", "cube.off", "out.mesh")
        refused = self.run_program("untangle", "filled.mesh", "-o", "b.mesh", "--improve", "--no-refill", expect=2)
        self.assertIn("--no-refill", refused.stderr)

    def test_a_filled_surface_is_checked_against_it(self):
        self.write("moved.off", off([(x + 0.4 * y * z, y, z * (1 + x)) for x, y, z in CUBE_POINTS], CUBE_FACETS))
        self.run_program("mesh", "moved.off", "-o", "a.mesh", "--fill", "-q")
        self.run_program("untangle", "a.mesh", "-o", "b.mesh", "-q")
        self.run_program("check", "moved.off", "b.mesh")

    def test_an_invalid_boundary_is_4_and_named(self):
        points, tets, facets = self.grid
        points[0] = [4.3, 4.4, 9]
        self.tangle("a.mesh", (points, tets, facets))
        told = self.run_program("untangle", "a.mesh", "-o", "b.mesh", "--report", "r.json", expect=4).stderr
        self.assertIn("boundary", told)
        self.assertIn("triangle", told)
        self.assertGreater(len(json.loads((self.folder / "r.json").read_text())["defects"]), 0)
        self.tangle("a.mesh", (points, tets + tets[:1], facets))
        self.assertIn("connectivity", self.run_program("untangle", "a.mesh", "-o", "b.mesh", expect=4).stderr)
        self.assertNotIn("b.mesh", self.files())

    def test_limits_and_usage_leave_nothing(self):
        self.tangle("a.mesh", self.bench.displaced(self.grid, 2, random.Random(3)))
        before = self.files()
        for arguments, code, word in [
            (["--time-limit", "1e-6"], 5, "--time-limit"), (["--memory-limit", "0.001"], 5, "--memory-limit"),
            (["--time-limit", "-1"], 2, "--time-limit"), (["--format", "lunch"], 2, "lunch"), (["-q", "-v"], 2, "excludes"),
        ]:
            with self.subTest(arguments):
                told = self.run_program("untangle", "a.mesh", "-o", "b.mesh", *arguments, expect=code).stderr
                self.assertIn(word, told)
                self.assertEqual(self.files(), before)
        self.run_program("untangle", "a.mesh", "-o", "a.mesh", expect=2)
        self.run_program("untangle", "missing.mesh", "-o", "b.mesh", expect=3)
        self.assertEqual(self.files(), before)

    def test_interrupt_is_5_and_leaves_nothing(self):
        self.tangle("a.mesh", self.bench.displaced(self.bench.grid(28, 0.2, random.Random(1)), 1, random.Random(3)))
        before = self.files()
        process = subprocess.Popen([self.program, "untangle", "a.mesh", "-o", "b.mesh", "-v"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        process.stderr.readline()  # the first step has begun
        process.send_signal(signal.SIGINT)
        told = process.communicate(timeout=240)[1]
        self.assertEqual(process.returncode, 5, told)
        self.assertIn("cancelled", told)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    main()
