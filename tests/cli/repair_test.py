"""`holdfast repair` and `holdfast check --repaired` from outside: results of repair pass, manipulated ones do not.

    repair_test.py PROGRAM [unittest options]
"""
import itertools
import json
import math
import random
import subprocess

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted


def read_off(text):
    lines = text.split("\n")
    n, m, _ = map(int, lines[1].split())
    points = [list(map(float, line.split())) for line in lines[2:2 + n]]
    return points, [list(map(int, line.split()))[1:] for line in lines[2 + n:2 + n + m]]


def two_cubes(by=(0.3, 0.41, 0.37)):
    """Two cubes that cross in edges whose ends are not doubles."""
    turned = [(0.9 * x - 0.2 * y + by[0], 0.15 * x + 0.95 * y + by[1], z + 0.1 * x + by[2]) for x, y, z in cube()]
    return cube() + turned, CUBE_FACETS + shifted(CUBE_FACETS, 8)


MEDIT = "MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n{}Triangles\n{}\n{}End\n"


def medit(points, facets, markers):
    return MEDIT.format(len(points), "".join("%r %r %r 0\n" % tuple(p) for p in points), len(facets),
                        "".join("%d %d %d %d\n" % (*(v + 1 for v in f), m) for f, m in zip(facets, markers)))


class Repaired(CliTest):
    def repair(self, *inputs, options=(), output="out.off", expect=0):
        return self.run_program("repair", *inputs, "-o", output, "--parents", "p.txt", "--report", "r.json", "-q",
                                *options, expect=expect)

    def check(self, *inputs, output="out.off", expect=0, files=("--parents", "p.txt", "--report", "r.json")):
        return self.run_program("check", "--repaired", *inputs, output, *files, expect=expect).stdout

    def broken(self, *inputs, **kinds):
        """The names of the rules that are broken."""
        listing = self.check(*inputs, expect=6, **kinds)
        return {line.split(":")[0].removeprefix("BROKEN").strip() for line in listing.splitlines()
                if line.startswith("BROKEN")}

    def report(self):
        return json.loads((self.folder / "r.json").read_text())

    def write_report(self, report):
        self.write("r.json", json.dumps(report))

    def both_files(self, report):
        """The report, and an equivalent file of parents."""
        self.write_report(report)
        lines = [f"# max_displacement {report['max_displacement']!r}"]
        lines += [f"# moved {m['vertex']} {m['distance']!r}" for m in report["moved"]]
        lines += [f"# dropped {d['facet']} {d['reason']}" for d in report["dropped"]]
        lines += ["# marker_set %s %s" % (k, " ".join(map(str, v))) for k, v in report["marker_sets"].items()]
        lines += [" ".join(map(str, p)) or "-" for p in report["parents"]]
        self.write("p.txt", "\n".join(lines) + "\n")

    def crossing_cubes(self):
        self.write("in.off", off(*two_cubes()))
        self.repair("in.off")


class WhatIsMade(Repaired):
    def test_cubes_that_cross(self):
        self.crossing_cubes()
        self.assertIn("holds   parents covered: 24 input triangles", self.check("in.off"))
        self.check("in.off", files=("--parents", "p.txt"))
        self.check("in.off", files=("--report", "r.json"))
        self.assertGreater(self.report()["max_displacement"], 0)

    def test_isolated_vertices(self):
        """A face of one corner in OFF: written again if nothing uses the vertex, with a separate line."""
        points = cube() + [(0.5, 0.5, 0.5), (0.5, 0.25, 0.5)]
        self.write("in.off", off(points, [*CUBE_FACETS, (8,), (9,)]))
        self.repair("in.off")
        self.assertEqual(read_off((self.folder / "out.off").read_text()), read_off((self.folder / "in.off").read_text()))
        self.assertEqual((self.folder / "p.txt").read_text().split("\n")[-3:], ["-", "-", ""])
        self.check("in.off")
        self.check("in.off", files=("--parents", "p.txt"))
        points[9] = (0.5, 0.25, 0.0)
        self.write("in.off", off(points, [*CUBE_FACETS, (8,), (9,)]))
        self.repair("in.off")
        self.assertEqual(read_off((self.folder / "out.off").read_text())[1][-1], [8])
        self.check("in.off")

    def test_a_valid_surface(self):
        self.repair("cube.off")
        self.assertIn("the triangles are as they were", self.check("cube.off"))
        self.assertEqual((self.folder / "out.off").read_bytes().split(b"\n")[2:],
                         (self.folder / "cube.off").read_bytes().replace(b".0", b"").split(b"\n")[2:])

    def test_cubes_on_one_another(self):
        """Faces that overlap, with different diagonals."""
        other = [(0, 2, 3), (0, 3, 1), (4, 5, 6), (5, 7, 6)] + CUBE_FACETS[4:]
        self.write("in.off", off(cube() + cube((0.25, 0.5, 1)), CUBE_FACETS + shifted(other, 8)))
        self.repair("in.off")
        self.check("in.off")
        self.assertEqual(self.report()["max_displacement"], 0)

    def test_repeated_facets_and_flat_ones(self):
        facets = CUBE_FACETS + [CUBE_FACETS[3][::-1], (0, 1, 8)]
        self.write("in.off", off(cube() + [(0.5, 0, 0)], facets))
        self.repair("in.off")
        self.check("in.off")
        report = self.report()
        self.assertEqual((report["merged"], report["dropped"]),
                         ([{"facet": 12, "into": 3}], [{"facet": 13, "reason": "no area"}]))

    def test_welded_vertices(self):
        points = cube() + [(x + 1e-9, y, z) for x, y, z in cube((1, 0, 0))]
        self.write("in.off", off(points, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.repair("in.off", options=["--weld", "1e-8"])
        self.check("in.off")
        self.assertEqual(len(self.report()["moved"]), 4)

    def test_a_length_to_weld_below_the_last_bit_is_told(self):
        """Far from the origin, where places are 4.7e-10 apart."""
        self.write("in.off", off([(x + 3e6, y, z) for x, y, z in cube()], CUBE_FACETS))
        def told(length):
            return self.run_program("repair", "in.off", "-o", "out.off", "--weld", length).stderr
        self.assertIn("--weld 1e-10 is less than the last bit of the largest coordinate, 4.7e-10", told("1e-10"))
        self.assertNotIn("last bit", told("1e-9"))
        self.assertNotIn("last bit", told("0"))

    def test_holes(self):
        self.write("in.off", off(cube(), CUBE_FACETS[1:]))
        self.repair("in.off", options=["--fill-holes"])
        self.check("in.off")

    def test_holes_that_stay_open_are_told_with_the_reason(self):
        # A spike stands in a cube without its top, and out of it.
        points = cube() + [(0.4, 0.4, 0.5), (0.6, 0.4, 0.5), (0.5, 0.6, 0.5), (0.5, 0.5, 1.5)]
        spike = [(8, 10, 9), (8, 9, 11), (9, 10, 11), (10, 8, 11)]
        top = [f for f in CUBE_FACETS if all(points[v][2] == 1 for v in f)]
        self.assertEqual(len(top), 2)
        self.write("in.off", off(points, [f for f in CUBE_FACETS if f not in top] + spike))
        for most, reason, words in (("3", "too many sides", "more sides than"), ("4", "meets surface", "would meet the surface")):
            said = self.run_program("repair", "in.off", "-o", "out.off", "--report", "r.json", "--fill-holes", most).stderr
            self.assertIn("1 hole stays open (4 sides", said)
            self.assertIn(words, said)
            report = self.report()
            self.assertEqual((report["filled"], [hole["reason"] for hole in report["left_open"]]), ([], [reason]))
            self.assertEqual({points[v][2] for v in report["left_open"][0]["border"]}, {1.0})
        self.assertIn("no cure: 1 hole", self.run_program("diagnose", "in.off").stdout)
        said = self.run_program("mesh", "in.off", "-o", "v.vtu", expect=4).stderr
        self.assertIn("diagnose", said)

    def test_triangles_that_were_written_one_by_one(self):
        # Each triangle of a torus is enlarged by some 1e-12, and has separate corners.
        def at(i, j):
            u, v = (2 * math.pi * k / n for k, n in ((i, 20), (j, 15)))
            return ((3 + math.cos(v)) * math.cos(u), (3 + math.cos(v)) * math.sin(u), math.sin(v))
        points = []
        for i in range(20):
            for j in range(15):
                a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
                for corners in ((a, b, c), (a, c, d)):
                    middle = [sum(p[k] for p in corners) / 3 for k in range(3)]
                    points += [tuple(m + (1 + 1e-12) * (x - m) for x, m in zip(p, middle)) for p in corners]
        self.write("in.off", off(points, [(k, k + 1, k + 2) for k in range(0, len(points), 3)]))
        self.repair("in.off", options=["--time-limit", "60"])
        self.check("in.off")
        report = self.report()
        self.assertEqual(report["output"]["facets"], 600)
        self.assertLess(report["max_displacement"], 8 * 2**-40)
        self.run_program("mesh", "out.off", "-o", "out.mesh", "--drop-outside")

    def test_triangles_that_overlap_in_turned_planes(self):
        # A rotated cube of 4 by 4 squares per face, each triangle enlarged by a thousandth: all triangles of a face
        # overlap in one plane up to rounding, with sides that are collinear up to rounding.
        def turned(p):
            c, s = math.cos(0.3), math.sin(0.3)
            x, y, z = c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]
            return x, c * y - s * z, s * y + c * z
        n, points = 4, []
        for axis, height, i, j in itertools.product(range(3), (0, 1), range(n), range(n)):
            def at(u, v):
                p = [height] * 3
                p[(axis + 1) % 3], p[(axis + 2) % 3] = u / n, v / n
                return turned(p)
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            for corners in ((a, b, c), (a, c, d)):
                middle = [sum(p[k] for p in corners) / 3 for k in range(3)]
                points += [tuple(m + 1.001 * (x - m) for x, m in zip(p, middle)) for p in corners]
        self.write("in.off", off(points, [(k, k + 1, k + 2) for k in range(0, len(points), 3)]))
        self.repair("in.off", options=["--time-limit", "60"])
        self.check("in.off")
        self.assertEqual(self.report()["moved"], [])

    def test_a_tip_thinner_than_the_tolerance_counts_as_lost(self):
        # A vertex of another triangle lies near both sides of a tip, which becomes a line of length 1.
        points = [(0, 0, 0), (10, 0.4, 0), (10, -0.4, 0), (1, 0, 0.02), (1, 1, 1), (2, 1, 1)]
        self.write("in.off", off(points, [(0, 1, 2), (3, 4, 5)]))
        self.repair("in.off", options=["--weld", "0.1"])
        self.check("in.off")
        self.assertGreater(self.report()["max_displacement"], 1)

    def test_holes_that_a_union_takes_with_their_borders(self):
        # Two triangles cross: the border of the hole passes through points that the union drops.
        points = [(-1, -1, 0), (1, -1, 0), (0, 1, 0), (-1, 0, -1), (1, 0, -1), (0, 0, 1)]
        self.write("in.off", off(points, [(0, 1, 2), (3, 4, 5)]))
        said = self.run_program("repair", "in.off", "-o", "out.off", "--report", "r.json", "--union", "--fill-holes").stderr
        self.assertIn("open: ", said)
        self.assertEqual([hole["border"] for hole in self.report()["left_open"]], [[], []])

    def test_several_inputs_and_markers(self):
        points, facets = two_cubes()
        self.write("a.mesh", medit(points[:8], facets[:12], range(1, 13)))
        self.write("b.mesh", medit(points[8:], [[v - 8 for v in f] for f in facets[12:]], [40] * 12))
        self.repair("a.mesh", "b.mesh", output="out.mesh")
        self.assertIn("holds   markers kept", self.check("a.mesh", "b.mesh", output="out.mesh"))

    def test_a_union_of_what_encloses_nothing(self):
        self.write("in.off", off(CUBE_POINTS, CUBE_FACETS[:-1]))
        self.assertIn("no triangle is left", self.run_program("repair", "in.off", "-o", "out.off", "--union").stderr)
        self.write("in.off", off(CUBE_POINTS, CUBE_FACETS))
        self.assertNotIn("note: ", self.run_program("repair", "in.off", "-o", "out.off", "--union").stderr)
        apart = [(3, 0, 0), (4, 0, 0), (3, 1, 0), (3, 0, 1)]
        tetrahedron = [(8, 10, 9), (8, 9, 11), (9, 10, 11), (10, 8, 11)]
        self.write("in.off", off(CUBE_POINTS + apart, CUBE_FACETS[:-1] + tetrahedron))
        self.assertIn("note: 11 of 15 triangles have material on both sides or, as those of an open part, on neither",
                      self.run_program("repair", "in.off", "-o", "out.off", "--union").stderr)

    def test_a_union_of_what_a_weld_closes(self):
        """Every triangle has corners of its own, some last digits apart, as in STL of poor programs."""
        points = [tuple(x + 1e-9 * (3 * f + k) for x in CUBE_POINTS[v])
                  for f, facet in enumerate(CUBE_FACETS) for k, v in enumerate(facet)]
        self.write("in.off", off(points, [(3 * f, 3 * f + 1, 3 * f + 2) for f in range(len(CUBE_FACETS))]))
        self.repair("in.off", options=["--weld", "1e-6", "--union"])
        self.check("in.off")
        self.assertEqual(self.report()["dropped"], [])

    def test_union(self):
        self.write("in.off", off(*two_cubes()))
        self.repair("in.off", options=["--union"])
        self.check("in.off")


class WhatWasTamperedWith(Repaired):
    def setUp(self):
        super().setUp()
        self.crossing_cubes()
        self.points, self.facets = read_off((self.folder / "out.off").read_text())

    def write_output(self):
        self.write("out.off", off(self.points, self.facets))

    def test_nothing(self):
        self.write_output()
        self.check("in.off")

    def test_an_input_vertex_moved_by_an_ulp(self):
        self.points[3][1] = math.nextafter(self.points[3][1], 2)
        self.write_output()
        self.assertIn("vertices kept", self.broken("in.off"))

    def test_it_is_listed_with_a_false_distance(self):
        step = math.nextafter(self.points[3][1], 2) - self.points[3][1]
        self.points[3][1] += step
        self.write_output()
        report = self.report()
        report["moved"] = [{"vertex": 3, "distance": step / 2}]
        self.both_files(report)
        self.assertIn("distances right", self.broken("in.off"))
        report["moved"][0]["distance"] = step * 2
        self.both_files(report)
        self.assertIn("distances right", self.broken("in.off"))
        report["moved"] = [{"vertex": 4, "distance": step}]
        self.both_files(report)
        self.assertLess({"vertices kept", "distances right"}, self.broken("in.off"))

    def test_the_largest_distance_is_too_small(self):
        report = self.report()
        report["max_displacement"] /= 1000
        self.both_files(report)
        self.assertIn("children near", self.broken("in.off"))
        report["max_displacement"] = 0
        self.both_files(report)
        self.assertIn("children near", self.broken("in.off"))

    def test_a_new_vertex_moved(self):
        self.points[17][0] += 1e-7
        self.write_output()
        self.assertIn("children near", self.broken("in.off"))

    def test_a_parent_is_missing(self):
        """For each triangle in turn: its place is still covered, but not by a child."""
        report = self.report()
        for f, own in enumerate(report["parents"]):
            other = next(p for p in range(24) if p not in own)
            for now in ([other], own + [other]):
                parents = list(report["parents"])
                parents[f] = now
                self.both_files({**report, "parents": parents})
                self.assertTrue({"parents covered", "children near", "losses listed"} & self.broken("in.off"), f)

    def test_segments_have_lines_behind_those_of_triangles(self):
        points = cube() + [(0.5, 0.25, 0.5), (2.0, 0.25, 0.5)]
        self.write("in.off", off(points, CUBE_FACETS + [(8, 9)]))
        self.repair("in.off")
        lines = [x for x in (self.folder / "p.txt").read_text().splitlines() if not x.startswith("#")]
        faces = int((self.folder / "out.off").read_text().split()[2])
        self.assertEqual(len(lines), faces)
        self.assertEqual(lines[-2:], ["12", "12"])
        self.check("in.off")
        self.check("in.off", files=("--parents", "p.txt"))
        (self.folder / "p.txt").write_text((self.folder / "p.txt").read_text().replace("\n12\n", "\n11\n", 1))
        self.check("in.off", files=("--parents", "p.txt"), expect=6)

    def test_one_of_two_parents_is_missing(self):
        other = [(0, 2, 3), (0, 3, 1), (4, 5, 6), (5, 7, 6)] + CUBE_FACETS[4:]
        self.write("in.off", off(cube() + cube((0.25, 0.5, 1)), CUBE_FACETS + shifted(other, 8)))
        self.repair("in.off")
        report = self.report()
        both = [f for f, p in enumerate(report["parents"]) if len(p) > 1]
        self.assertGreater(len(both), 2)
        for f in both:
            for p in report["parents"][f]:
                parents = list(report["parents"])
                parents[f] = [p]
                self.both_files({**report, "parents": parents})
                self.assertEqual({"parents covered"}, self.broken("in.off"), f)

    def test_a_parent_is_missing_in_one_file(self):
        lines = (self.folder / "p.txt").read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if not line.startswith("#"))
        lines[at] = "-"
        self.write("p.txt", "\n".join(lines) + "\n")
        self.assertIn("files agree", self.broken("in.off"))

    def test_a_parent_too_many(self):
        report = self.report()
        report["parents"][0].append(23)
        self.both_files(report)
        self.assertIn("children near", self.broken("in.off"))
        report["parents"][0][-1] = 24
        self.both_files(report)
        self.assertIn("parents named", self.broken("in.off"))

    def test_a_triangle_is_missing(self):
        report = self.report()
        for f in range(len(self.facets)):
            facets, parents = list(self.facets), list(report["parents"])
            del facets[f], parents[f]
            self.write("out.off", off(self.points, facets))
            self.both_files({**report, "parents": parents})
            self.assertTrue({"parents covered", "losses listed"} & self.broken("in.off"), f)

    def test_an_unlisted_drop_and_one_without_reason(self):
        report = self.report()
        last = report["parents"][-1]
        keep = [f for f, p in enumerate(report["parents"]) if p != last]
        self.facets = [self.facets[f] for f in keep]
        self.write_output()
        report["parents"] = [report["parents"][f] for f in keep]
        self.both_files(report)
        self.assertIn("losses listed", self.broken("in.off"))
        for reason in "no area", "vanished", "not finite", "inner":
            report["dropped"] = [{"facet": last[0], "reason": reason}]
            self.both_files(report)
            self.assertIn("losses listed", self.broken("in.off"), reason)

    def test_a_crossing(self):
        self.write("out.off", off(*two_cubes()))
        report = self.report()
        report["parents"] = [[p] for p in range(24)]
        self.both_files(report)
        self.assertEqual(self.broken("in.off"), {"output valid"})

    def test_a_valid_surface_changed(self):
        self.write("out.off", off(cube() + [(0.5, 0.5, 0)],
                                  [(0, 2, 8), (2, 3, 8), (0, 8, 1), (8, 3, 1)] + CUBE_FACETS[2:]))
        report = self.report()
        report["parents"] = [[0], [0], [1], [1]] + [[p] for p in range(2, 12)]
        report["max_displacement"] = 0
        self.both_files(report)
        self.assertEqual(self.broken("cube.off"), {"valid unchanged"})

    def test_false_markers(self):
        points, facets = two_cubes()
        self.write("in.mesh", medit(points, facets, range(1, 25)))
        self.repair("in.mesh", output="out.mesh")
        text = (self.folder / "out.mesh").read_text()
        head, tail = text.split("Triangles", 1)
        lines = tail.strip().split("\n")
        lines[1] = lines[1].rsplit(None, 1)[0] + " 99"
        self.write("out.mesh", head + "Triangles\n" + "\n".join(lines) + "\n")
        self.assertEqual(self.broken("in.mesh", output="out.mesh"), {"markers kept"})


class Usage(Repaired):
    def test_files_that_are_none(self):
        self.crossing_cubes()
        self.run_program("check", "--repaired", "in.off", "out.off", expect=2)
        self.run_program("check", "in.off", "out.off", "--parents", "p.txt", expect=2)
        self.run_program("check", "--repaired", "--box", "in.off", "out.off", "--parents", "p.txt", expect=2)
        for text in "1 2 x\n", "# max_displacement 0\n-1\n", "# max_displacement 0\n# dropped 3 nothing\n", "0\n1\n":
            self.write("q.txt", text)
            self.check("in.off", files=("--parents", "q.txt"), expect=3)
        for text in "", "{}", "[1]", '{"parents": 3}', "x" * 1000:
            self.write("q.json", text)
            self.check("in.off", files=("--report", "q.json"), expect=3)

    def test_verdict(self):
        self.crossing_cubes()
        self.check("in.off", files=("--parents", "p.txt", "--report", "r.json", "--verdict", "v.json"))
        verdict = json.loads((self.folder / "v.json").read_text())
        self.assertTrue(verdict["holds"])
        self.assertEqual(len(verdict["rules"]), 12)


class Proposals(Repaired):
    """The proposals of `diagnose` cure the defects."""

    def cure(self, points, facets):
        self.write("in.off", off(points, facets))
        found = self.program_says_of("in.off")
        self.repair("in.off", options=found["cures"]["options"].split())
        self.check("in.off")
        self.assertTrue(found["cures"]["tried"])
        return found["cures"], self.program_says_of("out.off")

    def program_says_of(self, name):
        broken = self.run_anyhow("diagnose", name, "--report", "d.json")
        report = json.loads((self.folder / "d.json").read_text())
        self.assertEqual(broken.returncode, 0 if report["valid"] else 4)
        if report["cures"]["proposals"]:
            self.assertIn("cure: ", broken.stdout)
        return report

    def run_anyhow(self, *arguments):
        return subprocess.run([self.program, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=240, check=False)

    def test_none_for_a_valid_surface(self):
        self.assertEqual(self.program_says_of("cube.off")["cures"], {"tried": True, "options": "", "proposals": [], "left_open": 0})

    def test_vertices_to_weld(self):
        points = cube() + [(x + 2.3e-9, y, z) for x, y, z in cube((1, 0, 0))]
        cures, after = self.cure(points, CUBE_FACETS[:10] + shifted(CUBE_FACETS[:8] + CUBE_FACETS[10:], 8))
        self.assertEqual(cures["options"], "--weld 3e-09")
        self.assertEqual(cures["proposals"][0]["count"], 4)
        self.assertTrue(after["valid"])
        self.assertEqual(after["summary"]["gaps"], [])
        self.assertEqual(after["summary"]["encloses"], 1)

        said = self.run_program("repair", "in.off", "-o", "out.off", "--weld", "3e-9").stderr
        self.assertIn("moved", said)
        self.assertNotIn("valid as it is", said)

    def test_a_length_to_weld_is_a_short_number(self):
        points = [(x - 1, y, z) for x, y, z in cube()] + [(x + 1.7e-16, y, z) for x, y, z in cube()]
        cures, after = self.cure(points, CUBE_FACETS[:10] + shifted(CUBE_FACETS[:8] + CUBE_FACETS[10:], 8))
        self.assertEqual(cures["options"], "--weld 2e-16")
        self.assertTrue(after["valid"])

    def test_a_side_is_led_through_vertices_on_both_of_its_sides(self):
        # Routed through only one, it would be twice as far from the other; where it passes the side between them, it gets a vertex.
        points = [(0, 0, 0), (10, 0, 0), (5, -5, 0), (4.9, 0, 6.1e-6), (5.1, 0, -6.1e-6), (5, 5, 0)]
        cures, after = self.cure(points, [(0, 1, 2), (0, 3, 5), (3, 4, 5), (4, 1, 5)])
        self.assertEqual(cures["options"], "--weld 7e-06")
        self.assertEqual((after["valid"], after["summary"]["gaps"]), (True, []))

    def test_faces_that_nearly_touch(self):
        # Two beams lie across each other, 1e-7 too deep; a third lies too far above to be meant.
        beams = [[(4 * x, y, z) for x, y, z in cube()], [(x + 1, 4 * y - 1, z + 1 - 1e-7) for x, y, z in cube()],
                 [(x + 1, 4 * y - 1, z + 2.1) for x, y, z in cube()]]
        cures, after = self.cure(sum(beams, []), CUBE_FACETS + shifted(CUBE_FACETS, 8) + shifted(CUBE_FACETS, 16))
        join = cures["proposals"][-1]
        self.assertEqual((join["kind"], join["option"]), ("join", "--weld 2e-07 --join 2e-07"))
        self.assertEqual(cures["options"], "", "whether they touch is for the user to say")
        self.assertEqual(after["summary"]["encloses"], 4, "the overlap is a body, too")
        self.repair("in.off", options=join["option"].split())
        self.check("in.off")
        touching = self.program_says_of("out.off")
        self.assertEqual((touching["valid"], touching["summary"]["encloses"]), (True, 3))

    def test_faces_of_a_valid_surface_that_nearly_touch(self):
        points = cube() + [(x + 0.3, y + 0.2, z + 1 + 1e-7) for x, y, z in cube()]
        self.write("in.off", off(points, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        found = self.program_says_of("in.off")
        self.assertEqual((found["valid"], found["summary"]["encloses"], found["cures"]["options"]), (True, 2, ""))
        self.repair("in.off", options=found["cures"]["proposals"][0]["option"].split())
        self.check("in.off")
        touching = self.program_says_of("out.off")
        self.assertEqual((touching["valid"], touching["cures"]["proposals"]), (True, []))

    def test_edges_that_nearly_touch(self):
        def roof(along, height):
            points = [(-1, 0, 0), (1, 0, 0), (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]
            return points if along == "x" else [(y, x, height - z) for x, y, z in points]
        facets = [(0, 2, 3), (0, 3, 1), (0, 1, 4), (0, 4, 5), (2, 5, 4), (2, 4, 3), (0, 5, 2), (1, 3, 4)]
        for depth in (1e-9, 2.0 ** -52):
            cures, _ = self.cure(roof("x", 0) + roof("y", -depth), facets + shifted(facets, 6))
            join = cures["proposals"][-1]
            self.assertEqual((join["kind"], join["count"], join["distance"]), ("join", 1, depth))
            self.assertNotIn("--join", join["option"])
            self.repair("in.off", options=join["option"].split())
            self.check("in.off")
            touching = self.program_says_of("out.off")
            self.assertEqual((touching["valid"], touching["summary"]["encloses"], touching["cures"]["proposals"]), (True, 2, []))
            self.assertEqual(len(read_off((self.folder / "out.off").read_text())[0]), 13, "a common vertex")

    def test_a_hole(self):
        cures, after = self.cure(cube(), CUBE_FACETS[2:])
        self.assertEqual(cures["options"], "--fill-holes 4")
        self.assertEqual(after["summary"]["encloses"], 1)
        self.assertEqual(after["cures"]["proposals"], [])

    def test_a_valid_surface_of_which_a_hole_stays_open(self):
        # Two cubes without their tops; a spike protrudes from one.
        points = cube() + [(x + 3, y, z) for x, y, z in cube()]
        points += [(0.4, 0.4, 0.5), (0.6, 0.4, 0.5), (0.5, 0.6, 0.5), (0.5, 0.5, 1.5)]
        spike = [(16, 18, 17), (16, 17, 19), (17, 18, 19), (18, 16, 19)]
        open_cube = [f for f in CUBE_FACETS if not all(points[v][2] == 1 for v in f)]
        cures, after = self.cure(points, open_cube + shifted(open_cube, 8) + spike)
        self.assertEqual((cures["options"], cures["left_open"], after["cures"]["left_open"]), ("--fill-holes 4", 1, 1))
        said = self.run_anyhow("diagnose", "in.off").stdout
        self.assertIn("closes it, but for 1 hole that stays open", said)
        self.assertNotIn("makes it valid", said)

    def test_a_crack_and_a_hole(self):
        points = cube() + [(1 + 1e-7, 1, 0.0)]
        facets = [tuple(8 if v == 3 and i == 1 else v for v in f) for i, f in enumerate(CUBE_FACETS) if i not in (4, 5)]
        cures, after = self.cure(points, facets)
        self.assertEqual(cures["options"], "--weld 2e-07 --fill-holes 4")
        self.assertEqual((after["valid"], after["summary"]["encloses"], after["summary"]["open_sides"]), (True, 1, []))

    def test_parts_that_cross(self):
        cures, after = self.cure(*two_cubes())
        self.assertEqual([p["kind"] for p in cures["proposals"]], ["cut", "unite"])
        self.assertTrue(after["valid"])
        self.repair("in.off", options=["--union"])
        self.assertEqual(self.program_says_of("out.off")["summary"]["encloses"], 1)


class MeshAtOnce(Repaired):
    """`mesh --repair`."""

    def test_the_surface_that_was_meshed(self):
        self.write("in.off", off(*two_cubes()))
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", expect=4)
        said = self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--repaired", "out.off", "--report",
                                "r.json").stderr
        self.assertIn("repair: ", said)
        self.run_program("check", "out.off", "v.vtu")
        self.check("in.off", files=("--report", "r.json"))
        self.assertEqual((self.report()["repair"]["moved"], self.report()["repair"]["rung"]), ([], "nearest"))

    def test_a_tolerance(self):
        points = cube() + [(x + 1e-9, y, z) for x, y, z in cube((1, 0, 0))]
        self.write("in.off", off(points, CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair=1e-8", "--repaired", "out.off", "--report", "r.json")
        self.run_program("check", "out.off", "v.vtu")
        self.assertEqual(len(self.report()["repair"]["moved"]), 4)

    def stack(self, seed, count=8, turn=None):
        """Boxes that overlap by half: sums of 0.05 make sheets that differ in their last bits, and no mesh in doubles."""
        rng = random.Random(seed)
        points, facets = [], []
        low = 0.0
        for _ in range(count):
            x, y = rng.uniform(0, 0.5), rng.uniform(0, 0.5)
            facets += shifted(CUBE_FACETS, len(points))
            points += [(x + a, y + b, low + 0.1 if c else low) for a, b, c in cube()]
            low += 0.05
        self.write("in.off", off([turn(p) if turn else p for p in points], facets))

    def test_sheets_a_last_bit_apart_are_joined(self):
        """No vertex moves. Welding does not help with the first: it has no vertices that close to each other."""
        for seed in 1, 3:
            self.stack(seed)
            said = self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--repaired", "out.off", "--report",
                                    "r.json").stderr
            self.assertIn("repaired again, with sheets within", said)
            self.run_program("check", "out.off", "v.vtu")
            self.check("in.off", files=("--report", "r.json"))
            repair = self.report()["repair"]
            self.assertGreater(repair["options"]["join"], 0)
            self.assertEqual((repair["options"]["weld"], repair["moved"]), (0, []))
            self.assertLess(repair["max_displacement"], 1e-14)

    def test_repaired_with_joined_sheets_then_meshed(self):
        self.stack(1)
        self.repair("in.off", options=("--join", "1e-15"))
        self.run_program("mesh", "out.off", "-o", "v.vtu", "--fill")
        self.run_program("repair", "in.off", "-o", "out.off", "--join", "1e-15", "--exact", "e.jsonl", expect=2)
        self.run_program("repair", "in.off", "-o", "out.off", "--join", "-1", expect=2)

    def test_turned_sheets(self):
        self.stack(2, turn=lambda p: (0.8 * p[0] - 0.6 * p[2], p[1], 0.6 * p[0] + 0.8 * p[2]))
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--repaired", "out.off", "--report", "r.json")
        self.run_program("check", "out.off", "v.vtu")
        self.check("in.off", files=("--report", "r.json"))

    def test_holes_are_filled(self):
        self.write("in.off", off(cube(), CUBE_FACETS[1:]))
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", expect=4)
        said = self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--fill-holes", "3", "--repaired", "out.off",
                                "--report", "r.json").stderr
        self.assertIn("1 filled", said)
        self.run_program("check", "out.off", "v.vtu")
        self.check("in.off", files=("--report", "r.json"))
        self.assertEqual((self.report()["repair"]["options"]["fill_holes"], self.report()["options"]["fill_holes"]), (3, 3))
        self.write("in.off", off(cube(), CUBE_FACETS[2:]))
        said = self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--fill-holes", "3", expect=4).stderr
        self.assertIn("more sides than --fill-holes allows", said)
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--fill-holes")

    def test_union(self):
        self.write("in.off", off(*two_cubes()))
        for options, regions in ((), 3), (("--union",), 1):
            self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", *options, "--report", "r.json")
            self.assertEqual((self.report()["mesh"]["regions"], self.report()["repair"]["options"]["union"]), (regions, bool(options)))

    def test_corners_of_what_a_union_drops_are_left_out(self):
        blade = [(0.2, 0.2, 0.5), (2, 0.2, 0.5), (2, 2, 0.5), (0.2, 2, 0.5)]
        self.write("in.off", off(cube() + blade, CUBE_FACETS + [(8, 9, 10), (8, 10, 11)]))
        said = self.run_program("repair", "in.off", "-o", "out.off", "--union").stderr
        self.assertIn("4 vertices belong to nothing any more", said)
        self.run_program("mesh", "out.off", "-o", "v.vtu", "--fill", "--drop-outside")
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--union", "--repaired", "out.off")
        self.run_program("check", "out.off", "v.vtu", "--outside-dropped")
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--fill", "--repair", "--union", "--repaired", "out.off", "--drop-unused",
                         "--report", "r.json")
        self.assertEqual((self.report()["input"]["left_out_vertices"], self.report()["vertex_map"][8:12]), (4, [-1] * 4))
        self.run_program("check", "out.off", "v.vtu", "--unused-dropped")
        self.run_program("check", "out.off", "v.vtu", "--outside-dropped", expect=6)
        self.run_program("mesh", "out.off", "-o", "v.vtu", "--fill", "--drop-unused")
        self.run_program("check", "out.off", "v.vtu", "--unused-dropped")
        self.assertIn("--drop-unused leaves out all such", self.run_program("mesh", "out.off", "-o", "v.vtu", "--fill", expect=4).stderr)

    def test_a_valid_surface(self):
        said = self.run_program("mesh", "cube.off", "-o", "v.vtu", "--fill", "--repair").stderr
        self.assertIn("valid as it is", said)
        self.run_program("check", "cube.off", "v.vtu")

    def test_wrong_usage(self):
        self.run_program("mesh", "cube.off", "-o", "v.vtu", "--repaired", "out.off", expect=2)
        for option in "--union", "--fill-holes", "--fill-holes=4":
            said = self.run_program("mesh", "cube.off", "-o", "v.vtu", option, expect=2).stderr
            self.assertIn("does nothing without --repair", said)
        self.run_program("mesh", "cube.off", "-o", "v.vtu", "--repair", "--fill-holes", "2", expect=2)
        for tolerance in "x", "-1", "nan", "1,2":
            self.run_program("mesh", "cube.off", "-o", "v.vtu", f"--repair={tolerance}", expect=2)
        self.run_program("mesh", "cube.off", "-o", "v.vtu", "--repair", "--repaired", "v.vtu", expect=2)
        self.assertEqual(self.files(), ["cube.off"])

    def test_limits(self):
        points, facets = [], []
        for i in range(120):
            facets += shifted(CUBE_FACETS, len(points))
            points += [(x + 0.003 * i + 0.001 * y, y + 0.002 * i, z + 0.0037 * i + 0.0007 * x) for x, y, z in cube()]
        self.write("in.off", off(points, facets))
        self.run_program("mesh", "in.off", "-o", "v.vtu", "--repair", "--repaired", "out.off", "--time-limit", "0.05", expect=5)
        self.run_program("repair", "in.off", "-o", "out.off", "--time-limit", "0.05", expect=5)
        self.assertEqual(self.files(), ["cube.off", "in.off"])


if __name__ == "__main__":
    main()
