"""--max-volume, --max-ratio and --layers: a strict bound on every tetrahedron, by region too; an aim with its exceptions; elements across.

    bounds_test.py PROGRAM [unittest options]
"""
import json
import math
from fractions import Fraction

from cli_case import CUBE_FACETS, CliTest, cube, main, off, shifted


def read_mesh(path):
    """Points, tetrahedra and their references of a .mesh file."""
    words = path.read_text().split()
    def block(name, width):
        at = words.index(name) + 1
        count = int(words[at])
        rows = words[at + 1:at + 1 + count * width]
        return [rows[i:i + width] for i in range(0, len(rows), width)]
    points = [tuple(Fraction(float(x)) for x in row[:3]) for row in block("Vertices", 4)]
    tets = [(tuple(int(v) - 1 for v in row[:4]), int(row[4])) for row in block("Tetrahedra", 5)]
    return points, tets


def volume(points, tet):
    a, b, c, d = (points[v] for v in tet)
    u, v, w = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


class Bounds(CliTest):
    def box_in_box(self):
        points = cube(size=4) + cube((1, 1, 1))
        self.write("boxes.off", off(points, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        return ["--region", "0.5,0.5,0.5,10", "--region", "1.5,1.5,1.5,20", "--name", "region:20=core",
                "--keep", "bounded"]

    def largest(self, region=None):
        points, tets = read_mesh(self.folder / "out.mesh")
        return max(volume(points, t) for t, r in tets if region in (None, r))

    def test_no_tetrahedron_is_larger(self):
        for bound in ("0.01", "0.3"):
            said = self.run_program("mesh", "cube.off", "-o", "out.mesh", "--max-volume", bound, "--report", "r.json").stderr
            self.assertLessEqual(self.largest(), Fraction(float(bound)))
            self.assertIn("bounds: ", said)
            bounds = json.loads((self.folder / "r.json").read_text())["bounds"]
            self.assertTrue(0 < bounds["fullest"] <= 1)
            self.run_program("check", "cube.off", "out.mesh")

    def test_by_region_named_by_id_or_name(self):
        regions = self.box_in_box()
        for inner in ("20=0.01", "region:20=0.01", "core=0.01"):
            self.run_program("mesh", "boxes.off", "-o", "out.mesh", *regions, "--max-volume", inner)
            self.assertLessEqual(self.largest(20), Fraction(0.01))
            self.assertGreater(self.largest(10), Fraction(0.01))
        self.run_program("mesh", "boxes.off", "-o", "out.mesh", *regions, "--max-volume", "0.5", "--max-volume", "20=0.02")
        self.assertLessEqual(self.largest(20), Fraction(0.02))
        self.assertTrue(Fraction(0.02) < self.largest(10) <= Fraction(0.5))

    def test_by_region_that_no_seed_numbers(self):
        self.box_in_box()
        for number in (1, 2):
            self.run_program("mesh", "boxes.off", "-o", "out.mesh", "--keep", "bounded", "--max-volume", f"{number}=0.01",
                             "--name", f"region:{number}=fine")
            self.assertLessEqual(self.largest(number), Fraction(0.01))
            self.assertGreater(self.largest(3 - number), Fraction(0.01))
        said = self.run_program("mesh", "boxes.off", "-o", "no.mesh", "--keep", "bounded", "--max-volume", "3=1", expect=2)
        self.assertIn("its regions are 1, 2", said.stderr)

    def test_a_region_that_is_not_there_is_2(self):
        regions = self.box_in_box()
        for region in ("7", "shell"):
            said = self.run_program("mesh", "boxes.off", "-o", "out.mesh", *regions, "--max-volume", region + "=1",
                                    expect=2).stderr
            self.assertIn(region, said)
            self.assertNotIn("out.mesh", self.files())

    def test_ratio_is_an_aim_and_exceptions_are_counted(self):
        self.run_program("mesh", "cube.off", "-o", "out.mesh", "--size", "0.4", "--max-ratio", "1.2", "--report", "r.json")
        bounds = json.loads((self.folder / "r.json").read_text())["bounds"]
        self.assertGreater(bounds["worst_ratio"], 0.612)
        self.assertEqual(bounds["above_ratio"] > 0, bounds["worst_ratio"] > 1.2)

    def test_ratio_does_not_make_angles_smaller(self):
        """Cylinders whose least angle was reduced to 8 to 10 degrees by points for ratios."""
        for around, rows, ratio in (8, 4, 1.2), (12, 3, 1.2), (12, 4, 1.0):
            ring = [(round(math.cos(2 * math.pi * i / around), 6), round(math.sin(2 * math.pi * i / around), 6))
                    for i in range(around)]
            points = [(x, y, 2 * k / rows) for k in range(rows + 1) for x, y in ring] + [(0, 0, 0), (0, 0, 2)]
            facets, low, high = [], len(points) - 2, len(points) - 1
            for i in range(around):
                j = (i + 1) % around
                for k in range(rows):
                    a, b, c, d = k * around + i, k * around + j, (k + 1) * around + j, (k + 1) * around + i
                    facets += [(a, b, c), (a, c, d)]
                facets += [(high, rows * around + i, rows * around + j), (low, j, i)]
            self.write("cylinder.off", off(points, facets))
            self.run_program("mesh", "cylinder.off", "-o", "out.mesh", "--max-ratio", ratio, "--report", "r.json")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertGreater(report["quality"]["min_dihedral_deg"], 15, (around, rows, ratio))
            self.assertGreater(report["bounds"]["ratio_points"], 0)
            self.assertLess(report["bounds"]["above_ratio"], report["mesh"]["tetrahedra"] / 5)
            self.run_program("check", "cylinder.off", "out.mesh")

    def test_layers_across_a_plate(self):
        n, thickness = 6, 0.3
        points = [(x, y, k * thickness) for x in range(n + 1) for y in range(n + 1) for k in range(2)]
        at = lambda x, y, k: (x * (n + 1) + y) * 2 + k
        facets = []
        def quadrangle(a, b, c, d):
            facets.extend([(a, b, c), (a, c, d)])
        for i in range(n):
            for j in range(n):
                quadrangle(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0))
                quadrangle(at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1))
            quadrangle(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1))
            quadrangle(at(i, n, 0), at(i, n, 1), at(i + 1, n, 1), at(i + 1, n, 0))
            quadrangle(at(0, i, 0), at(0, i, 1), at(0, i + 1, 1), at(0, i + 1, 0))
            quadrangle(at(n, i, 0), at(n, i + 1, 0), at(n, i + 1, 1), at(n, i, 1))
        self.write("plate.off", off(points, facets))
        run = self.run_program("mesh", "plate.off", "-o", "out.mesh", "--layers", "3", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertGreater(report["layers"]["points"], 0)
        self.assertEqual(report["layers"]["left"], 0)
        self.assertEqual(report["layers"]["at_rims"], 8 * n)
        self.assertEqual(report["options"]["layers"], 3)
        self.assertIn("for 3 layers, 0 edges too long for them, 48 vertices left out", run.stderr)
        self.run_program("check", "plate.off", "out.mesh")


if __name__ == "__main__":
    main()
