"""Decisions that `holdfast mesh` makes for its user, reported on standard error and in the report.

    decisions_test.py PROGRAM [unittest options]
"""
import json

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted


def without_integer_points(offset):
    """The polyhedron of docs/concepts.md that has no mesh in doubles at 2^52."""
    points = [(2, 1, 0), (1, 1, 3), (1, 2, 1), (3, 2, 2), (0, 0, 3), (2, 1, 3)]
    facets = [(0, 1, 2), (3, 4, 5)]
    for k in range(3):
        j = (k + 1) % 3
        facets += [(k, j, 3 + j), (k, 3 + j, 3 + k)]
    return off([tuple(x + offset for x in p) for p in points], facets)


class Decisions(CliTest):
    def mesh(self, name, *arguments, expect=0):
        said = self.run_program("mesh", name, "-o", "out.vtu", "--report", "r.json", *arguments, expect=expect).stderr
        return said, json.loads((self.folder / "r.json").read_text())

    def test_the_rule_that_kept_regions(self):
        said, report = self.mesh("cube.off")
        self.assertIn("in 1 region (by winding number),", said)
        self.assertEqual(report["keep"], {"rule": "winding", "turned_facets": []})
        said, report = self.mesh("cube.off", "--keep", "bounded")
        self.assertIn("in 1 region, ", said)
        self.assertEqual(report["keep"]["rule"], "bounded")

    def test_a_turned_triangle(self):
        facets = list(CUBE_FACETS)
        facets[5] = facets[5][::-1]
        self.write("turned.off", off(CUBE_POINTS, facets))
        said, report = self.mesh("turned.off")
        self.assertIn("triangle 5 is turned against the rest", said)
        self.assertEqual(report["keep"], {"rule": "bounded", "turned_facets": [5]})
        self.assertEqual([w["name"] for w in report["warnings"]], ["orientation"])
        self.assertEqual(self.mesh("turned.off", "-q")[0], "")

    def test_attempts(self):
        self.write("hard.off", without_integer_points(2 ** 52))
        said, report = self.mesh("hard.off", expect=7)
        self.assertIn("5 attempts", said)
        self.assertEqual(report["attempts"], 5)
        said, report = self.mesh("cube.off")
        self.assertNotIn("attempts", said)
        self.assertEqual(report["attempts"], 1)

    def test_an_interface_that_lacks_a_triangle(self):
        wall = [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)]
        points = cube() + cube((1, 0, 0))[1::2] + [(1, 0.25, 0.25), (1, 0.75, 0.25), (1, 0.75, 0.75), (1, 0.25, 0.75)]
        at = {p: i for i, p in reversed(list(enumerate(points)))}
        second = [at[p] for p in cube((1, 0, 0))]
        facets = ([f for f in CUBE_FACETS if not all(CUBE_POINTS[v][0] == 1 for v in f)]
                  + [tuple(second[v] for v in f) for f in CUBE_FACETS if not all(CUBE_POINTS[v][0] == 0 for v in f)])
        for k in range(4):
            a, b = at[wall[k]], at[wall[(k + 1) % 4]]
            facets += [(a, b, 12 + (k + 1) % 4), (a, 12 + (k + 1) % 4, 12 + k)]
        facets += [(12, 13, 14), (12, 14, 15)]
        self.write("two.off", off(points, facets))
        said, report = self.mesh("two.off")
        self.assertIn("in 2 regions", said)
        self.assertNotIn("warning", said)
        self.write("open.off", off(points, facets[:-1]))
        said, report = self.mesh("open.off")
        self.assertIn("in 1 region", said)
        self.assertRegex(said, r"warning: region 1 would be two.*open border of 3 edges at vertex 12 \(1, 0\.25, 0\.25\)")
        self.assertEqual(report["warnings"][0]["border"], [[12, 14], [12, 15], [14, 15]])

    def test_the_last_line_tells_the_quality(self):
        said, report = self.mesh("cube.off")
        self.assertRegex(said.splitlines()[-1], r"; least dihedral angle \d\d(\.\d)? degrees, 0 % of elements below 10$")
        thin = [(x, y, 0.001 * z) for x, y, z in CUBE_POINTS]
        self.write("thin.off", off(thin, CUBE_FACETS))
        said, report = self.mesh("thin.off", "--fill")
        self.assertRegex(said.splitlines()[-1], r"% of elements below 10: poor, as without field points")
        self.assertGreater(report["quality"]["below_10_deg"], 0)
        said, report = self.mesh("thin.off")
        self.assertRegex(said.splitlines()[-1], r": poor, as (small angles of the surface force|the surface's triangles are)")

        said, report = self.mesh("thin.off", "--stop-after", "suppress")
        self.assertRegex(said.splitlines()[-1], r": poor, as the run stops before elements are improved$")

    def test_limits_are_told_as_given(self):
        points, facets = [], []
        for k in range(3000):
            facets += shifted(CUBE_FACETS, len(points))
            points += cube((2 * k, 0, 0))
        self.write("many.off", off(points, facets))
        for limit in ("0.03", "1e-9"):  # the second runs out while the file is read
            self.assertIn(f"the time limit of {limit} s ran out",
                          self.run_program("mesh", "many.off", "-o", "a.vtu", "--time-limit", limit, expect=5).stderr)

    def test_lone_vertices_and_the_surface_of_a_volume(self):
        self.run_program("mesh", "cube.off", "-o", "v.vtu", "--size", "0.3", "-q")
        said, report = self.mesh("v.vtu", "--fill")
        inner = report["input"]["vertices"] - 8
        self.assertGreater(inner, 5)
        self.assertIn(f"{inner} vertices in v.vtu on no triangle and no segment are kept", said)
        self.assertIn("--surface-of", said)
        said, report = self.mesh("v.vtu", "--fill", "--surface-of")
        self.assertEqual((report["input"]["vertices"], report["input"]["facets"]), (8, 12))
        self.assertNotIn("no triangle", said)
        self.run_program("check", "v.vtu", "out.vtu", "--surface-of")
        self.run_program("check", "v.vtu", "out.vtu", expect=6)  # inner vertices of v.vtu are missing
        for arguments in (["v.vtu", "out.vtu", "--repaired"], ["."]):
            self.assertIn("--surface-of", self.run_program("check", *arguments, "--surface-of", expect=2).stderr)
        self.assertNotIn("no triangle", self.mesh("cube.off")[0])

    def test_open_borders_are_named_where_there_are_some(self):
        """A hole that removes everything, and a vertex outside, have nothing to do with borders."""
        said = self.run_program("mesh", "cube.off", "-o", "a.vtu", "--hole", "0.4,0.5,0.6", expect=4).stderr
        self.assertNotIn("open borders", said)
        self.write("apart.off", off(CUBE_POINTS + [(9, 9, 9)], CUBE_FACETS))
        self.assertNotIn("open borders", self.run_program("mesh", "apart.off", "-o", "a.vtu", expect=4).stderr)
        self.write("open.off", off(CUBE_POINTS, CUBE_FACETS[1:]))
        self.assertIn("open borders", self.run_program("mesh", "open.off", "-o", "a.vtu", expect=4).stderr)

    def test_lone_vertices_that_are_left_out_are_not_kept(self):
        self.write("lone.off", off(CUBE_POINTS + [CUBE_POINTS[0], (0.4, 0.5, 0.6), (float("nan"), 0, 0)], CUBE_FACETS))
        said, report = self.mesh("lone.off", "--fill")
        self.assertEqual(report["input"]["vertices"], 9)
        self.assertIn("1 vertex in lone.off on no triangle and no segment is kept", said)
        self.assertNotIn("--surface-of", said)  # there is no volume in the file
        self.write("none.off", off(CUBE_POINTS, []))
        self.assertNotIn("--surface-of", self.run_program("mesh", "none.off", "-o", "a.vtu", expect=4).stderr)
        self.run_program("convert", "out.vtu", "none.vtu", "--only", "volume")
        self.assertIn("--surface-of takes", self.run_program("mesh", "none.vtu", "-o", "a.vtu", expect=4).stderr)


if __name__ == "__main__":
    main()
