"""`holdfast plane` from outside: formats, methods, defects, exit codes, files.

    plane_test.py PROGRAM [unittest options]
"""
import json
import math
import random
import resource

from cli_case import CliTest, main


def poly(points, segments, holes=(), regions=(), base=1):
    lines = [f"{len(points)} 2 0 0"]
    lines += ["%d %r %r" % (base + i, *p) for i, p in enumerate(points)]
    lines += [f"{len(segments)} 0"] + [f"{base + i} {a} {b}" for i, (a, b) in enumerate(segments)]
    lines += [f"{len(holes)}"] + ["%d %r %r" % (i + 1, *p) for i, p in enumerate(holes)]
    lines += [f"{len(regions)}"] + ["%d %r %r %d" % (i + 1, *p) for i, p in enumerate(regions)]
    return "\n".join(lines) + "\n"


SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
INNER = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)]
RING = [(1, 2), (2, 3), (3, 4), (4, 1), (5, 6), (6, 7), (7, 8), (8, 5)]
METHODS = (["--method", "ears"], ["--method", "ears", "--ears", "best"], ["--method", "ears", "--ears", "join"],
           ["--method", "swaps"], ["--method", "partition"], ["--method", "partition", "--partition-first"])


def read_off(path):
    lines = path.read_text().split("\n")
    n, m, _ = map(int, lines[1].split())
    points = [tuple(map(float, line.split())) for line in lines[2:2 + n]]
    triangles = [tuple(map(int, line.split()))[1:] for line in lines[2 + n:2 + n + m]]
    return points, triangles


def area(points, triangle):
    (ax, ay, _), (bx, by, _), (cx, cy, _) = (points[v] for v in triangle)
    return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2


class Triangles(CliTest):
    def areas(self, *options):
        self.run_program("plane", "in.poly", "-o", "out.off", "--report", "r.json", *options)
        points, triangles = read_off(self.folder / "out.off")
        self.assertTrue(all(area(points, t) > 0 for t in triangles))
        self.report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(self.report["mesh"]["triangles"], len(triangles))
        return sum(area(points, t) for t in triangles), points

    def test_every_method_keeps_a_ring_and_its_inside_but_for_holes(self):
        for method in METHODS:
            self.write("in.poly", poly(SQUARE + INNER, RING))
            self.assertEqual(self.areas(*method)[0], 16)
            self.assertEqual(self.report["mesh"]["regions"], 2)
            self.write("in.poly", poly(SQUARE + INNER, RING, holes=[(2.0, 2.0)]))
            self.assertEqual(self.areas(*method, "--delaunay")[0], 12)
            self.assertEqual(self.report["mesh"]["regions"], 1)

    def test_repair_cuts_segments_where_they_meet(self):
        # A wall from side to side, and one across it that ends short of the sides by 1e-7.
        d = 1e-7
        walls = SQUARE + [(1.0, 0.0), (1.0, 4.0), (d, 2.0), (4.0 - d, 2.0)]
        self.write("in.poly", poly(walls, RING[:4] + [(5, 6), (7, 8)]))
        refused = self.run_program("plane", "in.poly", "-o", "out.off", expect=4)
        self.assertIn("--repair cuts segments where they meet", refused.stderr)
        area_of_all, points = self.areas("--repair")
        self.assertEqual(area_of_all, 16)
        self.assertEqual(self.report["mesh"]["regions"], 2)
        self.assertEqual([p[:2] for p in points[:8]], walls)
        self.assertEqual(self.report["repair"]["new_points"], 1)
        self.assertEqual(self.report["options"]["repair"], "true")
        told = self.run_program("plane", "in.poly", "-o", "out.off", "--repair=1e-6", "--report", "r.json")
        self.assertIn("repair: ", told.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["mesh"]["regions"], 4)
        self.assertLessEqual(report["repair"]["max_displacement"], 1e-6)
        self.run_program("plane", "in.poly", "-o", "out.off", "--repair=-1", expect=2)
        self.write("in.poly", poly(SQUARE, RING[:4]))
        valid = self.run_program("plane", "in.poly", "-o", "out.off", "--repair")
        self.assertIn("repair: the segments are valid as they are", valid.stderr)

    def test_points_come_out_bit_for_bit_and_in_order(self):
        tiny, huge = 5e-324, 1e301
        corners = [(-0.0, -tiny), (huge, 0.0), (0.1, huge), (0.30000000000000004, 0.2)]
        self.write("in.poly", poly(corners, [(1, 2), (2, 3), (3, 1)]))
        for method in METHODS:
            _, points = self.areas(*method)
            self.assertEqual([tuple(map(float.hex, p[:2])) for p in points],
                             [tuple(map(float.hex, p)) for p in corners])

    def test_dangling_segments_and_isolated_points_are_in_the_mesh(self):
        self.write("in.poly", poly(SQUARE + [(1.0, 1.0), (2.0, 3.0), (3.0, 1.0)],
                                   [(1, 2), (2, 3), (3, 4), (4, 1), (5, 6)]))
        for method in METHODS:
            self.run_program("plane", "in.poly", "-o", "out.off", *method)
            _, triangles = read_off(self.folder / "out.off")
            self.assertEqual(len(triangles), 2 * 7 - 2 - 4)
            sides = {frozenset((t[i], t[i - 1])) for t in triangles for i in range(3)}
            self.assertIn(frozenset((4, 5)), sides)
            self.assertEqual({v for t in triangles for v in t}, set(range(7)))

    def test_the_method_named_does_the_work(self):
        # Two rows of points with a zigzag of Delaunay edges between them; the segment runs along it.
        points = [(-10.0, 0.5), (21.0, 0.5)] + [(float(i), 0.0) for i in range(12)] + [(i + 0.5, 1.0) for i in range(12)]
        outline = [1] + list(range(3, 15)) + [2] + list(range(26, 14, -1))
        segments = [(outline[i], outline[(i + 1) % 26]) for i in range(26)] + [(1, 2)]
        self.write("in.poly", poly(points, segments))
        self.areas("--method", "swaps")
        self.assertEqual(self.report["missing_segments"], 1)
        self.assertGreater(self.report["swaps"], 20)
        self.areas("--method", "partition")
        self.assertEqual(self.report["partition_points"], 23)
        self.assertGreater(self.report["swaps"], 20)
        self.areas("--method", "ears")
        self.assertEqual(self.report["ears"], 26 - 2)
        self.assertEqual(self.report["partition_points"], 0)
        _, stood = self.areas("--method", "partition", "--stop-after", "partition")
        self.assertEqual(len(stood), 26 + 23)
        self.assertTrue(all(y == 0.5 for _, y, _ in stood[26:]))
        told = self.report["intermediate"]
        self.assertEqual(told["missing_segments"], [[0, 1]])
        self.assertEqual(told["chains"][0]["vertices"][::24], [0, 1])
        self.assertEqual({point["vertex"] for point in told["added"]}, set(range(26, 49)))
        self.areas("--method", "swaps", "--stop-after", "delaunay")
        self.assertEqual(self.report["swaps"], 0)
        self.assertEqual(self.report["intermediate"]["missing_segments"], [[0, 1]])

    def test_states_between_swaps(self):
        low, high = [(float(i), 0.0) for i in range(12)], [(i + 0.5, 1.6) for i in range(12)]
        self.write("in.poly", poly([(-1.6, 0.8), (13.1, 0.8), *low, *high], [(1, 2)]))
        whole = self.areas("--hull")[0]
        swaps = self.report["swaps"]
        before = None
        for k in range(swaps + 2):
            self.assertAlmostEqual(self.areas("--hull", "--stop-after", f"swap={k}")[0], whole, places=9)
            self.assertEqual(self.report["swaps"], min(k, swaps))
            self.assertEqual(self.report["intermediate"]["missing_segments"], [[0, 1]] if k < swaps else [])
            triangles = set(map(frozenset, read_off(self.folder / "out.off")[1]))
            self.assertEqual(len(triangles - (before or triangles)), 2 if 0 < k <= swaps else 0)  # one swap, two triangles
            before = triangles
        for wrong in ("swap", "swap=", "swap=x", "swap=-1", "delaunay=3", "swap=1.5"):
            self.run_program("plane", "in.poly", "-o", "out.off", "--stop-after", wrong, expect=2)
        self.run_program("plane", "in.poly", "-o", "out.off", "--method", "partition", "--stop-after", "swap=1", expect=2)

    def test_points_and_angles_without_effect_are_told(self):
        self.write("in.poly", poly(SQUARE + INNER, RING))
        for idle in (["--hole", "9,9"], ["--region", "9,9,7"]):
            said = self.run_program("plane", "in.poly", "-o", "out.off", "--report", "r.json", *idle).stderr
            self.assertIn(f"{' '.join(idle)} does nothing: the point is in no region", said)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual((report["idle_holes"], report["idle_seeds"]), ([0], []) if "--hole" in idle else ([], [0]))
        said = self.run_program("plane", "in.poly", "-o", "out.off", "--hole", "2,2", "--region", "2,2.1,7", "--region", "0.5,0.5,8",
                                "--region", "0.4,0.5,9").stderr
        self.assertIn("--region 2,2.1,7 does nothing", said)
        self.assertIn("--region 0.5,0.5,8 does nothing", said)
        self.assertEqual(said.count("does nothing"), 2)
        self.run_program("plane", "in.poly", "-o", "out.off", "--method", "ears", "--hole", "2,2", "--region", "0.5,0.5,8")
        for wrong in (["--arcs", "10"], ["--stop-after", "delaunay", "--hole", "2,2"], ["--stop-after", "swap=1", "--region", "2,2,5"],
                      ["--stop-after", "delaunay", "--delaunay"]):
            self.run_program("plane", "in.poly", "-o", "out.off", *wrong, expect=2)

    def test_order(self):
        # Seven parallel segments through a pencil: from the top, points lead to more points; from the middle, to fewer.
        low, high, most = [(float(i), 0.0) for i in range(-8, 9)], [(0.0, 2.0)], 7
        sides = [(x, 2.0 - 0.25 * (k + 1)) for k in range(most) for x in (-40.0, 40.0)]
        points = low + high + sides
        segments = [(19 + 2 * k, 20 + 2 * k) for k in range(most)]
        self.write("in.poly", poly(points, segments))
        counts = {}
        for order in ("given", "random", "halving"):
            self.areas("--hull", "--method", "partition", "--stop-after", "partition", "--order", order)
            counts[order] = self.report["partition_points"]
            self.areas("--hull", "--method", "partition", "--order", order)
            self.areas("--hull", "--method", "swaps", "--order", order)
        self.assertLess(counts["halving"], counts["given"])

    def test_numbers_go_on_as_they_began(self):
        for base in (0, 1):
            self.write("in.poly", poly(SQUARE[:3], [(base, base + 1), (base + 1, base + 2), (base + 2, base)], base=base))
            said = self.run_program("plane", "in.poly", "-o", "out.ele").stderr
            self.assertIn("3 points, 1 triangle in 1 region", said)
            lines = (self.folder / "out.ele").read_text().split("\n") + (self.folder / "out.node").read_text().split("\n")
            self.assertEqual(sorted(map(int, lines[1].split()[1:4])), [base, base + 1, base + 2])
            self.assertEqual([line.split()[0] for line in lines if line], ["1", str(base), "3", *(str(base + k) for k in range(3))])

    def test_formats(self):
        self.write("in.poly", poly(SQUARE, RING[:4], regions=[(1.0, 2.0, 7)]))
        self.run_program("plane", "in.poly", "-o", "out.node")
        self.assertEqual(self.files(), ["cube.off", "in.poly", "out.edge", "out.ele", "out.node"])
        self.assertEqual((self.folder / "out.edge").read_text(), "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n")
        self.assertEqual((self.folder / "out.node").read_text(), "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n")
        elements = (self.folder / "out.ele").read_text().split("\n")
        self.assertEqual(elements[0], "2 3 1")
        self.assertEqual({int(v) for line in elements[1:3] for v in line.split()[1:4]}, {1, 2, 3, 4})
        self.assertEqual([line.split()[::4] for line in elements[1:3]], [["1", "7"], ["2", "7"]])
        self.run_program("plane", "in.poly", "-o", "out.vtu")
        self.assertIn(b'NumberOfCells="6"', (self.folder / "out.vtu").read_bytes())
        self.assertIn("`plane`", self.run_program("convert", "out.node", "other.msh", expect=3).stderr)
        self.run_program("plane", "out.node", "-o", "hull.off")
        self.assertEqual(len(read_off(self.folder / "hull.off")[1]), 2)
        self.run_program("plane", "in.poly", "-o", "out.step", expect=2)
        self.run_program("plane", "in.poly", "-o", "case", "--format", "openfoam", expect=2)

    def test_every_format_that_holds_triangles(self):
        text = poly(SQUARE + INNER, RING, regions=[(0.5, 0.5, 4), (2.0, 2.0, 6)])
        self.write("in.poly", text.replace("8 0\n1 1 2\n", "8 1\n1 1 2 3\n"))
        names = ["--name", "4=outer", "--name", "region:6=inner", "--name", "segment:3=bottom"]
        unnamed, unmarked = ("mesh", "meshb", "poly", "gts", "xml"), ("off", "su2")
        for form in ("msh msh2 mesh meshb vtk vtm vtu stl obj ply gts poly off inp unv bdf nas su2 mfem vol xdmf med exo cgns "
                     "fluent k cdb feb xml").split():
            said = self.run_program("plane", "in.poly", "-o", f"out.{form}", "--format", form, *names).stderr
            if form in unnamed + unmarked:
                self.assertIn("2 regions are one zone" if form == "su2" else "3 names have no place in", said, form)
            reading = [] if form != "msh2" else ["--input-format", "msh"]
            known = json.loads(self.run_program("info", f"out.{form}", "--json", *reading).stdout)
            self.assertEqual((known["triangles"], known["area"]), (10, 16), form)
            if form not in unmarked:
                found = [(m["id"], m["area"], m.get("name")) for m in known["markers"]]
                if form == "stl":  # solids are numbered
                    found = [(i, *rest) for i, (_, *rest) in zip((4, 6), found)]
                wanted = [(4, 12, "outer"), (6, 4, "inner")]
                self.assertEqual(found, [(i, a, None) for i, a, _ in wanted] if form in unnamed else wanted, form)
        marked = json.loads(self.run_program("info", "out.msh", "--json").stdout)["segment_markers"]
        self.assertIn((3, 4.0, "bottom"), [(m["id"], m["length"], m.get("name")) for m in marked])
        said = self.run_program("plane", "in.poly", "-o", "out.off", "--name", "5=none").stderr
        self.assertIn("--name 5=none does nothing", said)
        self.assertIn("10 triangles' regions have no place in .off", said)

    def test_outlines_of_drawings(self):
        lines = ["0", "SECTION", "2", "ENTITIES"]
        for layer, ends in (("wall", (0, 0, 4, 0)), ("wall", (4, 0, 4, 4)), ("inlet", (4, 4, 0, 4)), ("wall", (0, 4, 0, 0))):
            lines += ["0", "LINE", "8", layer] + [word for code, x in zip(("10", "20", "11", "21"), ends) for word in (code, str(x))]
        circle = ["0", "CIRCLE", "8", "bore", "10", "2", "20", "2", "40", "1"]
        self.write("in.dxf", "\n".join([*lines, *circle, "0", "ENDSEC", "0", "EOF", ""]))
        self.assertIn("(arcs, in degrees)", self.run_program("plane", "in.dxf", "-o", "out.msh", expect=3).stderr)
        self.run_program("plane", "in.dxf", "-o", "out.msh", "--arcs", "200", expect=2)
        self.run_program("plane", "in.dxf", "-o", "out.msh", "--arcs", "15")
        known = json.loads(self.run_program("info", "out.msh", "--json").stdout)
        self.assertEqual([(m["name"], m["segments"]) for m in known["segment_markers"]], [("wall", 3), ("inlet", 1), ("bore", 24)])
        bored = self.run_program("plane", "in.dxf", "-o", "out.msh", "--arcs", "15", "--hole", "2,2", "--region", "0.5,0.5,0,8", "--name", "8=plate")
        self.assertIn("in 1 region", bored.stderr)
        known = json.loads(self.run_program("info", "out.msh", "--json").stdout)
        self.assertEqual([(m["id"], m["name"]) for m in known["markers"]], [(8, "plate")])
        self.assertAlmostEqual(known["area"], 16 - 12 * math.sin(math.pi / 12))
        for wrong in (["--hole", "2"], ["--hole", "1,2,3,4"], ["--region", "1,1"], ["--region", "1,1,1.5"], ["--hole", "2,x"]):
            self.run_program("plane", "in.dxf", "-o", "out.msh", "--arcs", "15", *wrong, expect=2)
        self.assertIn("`holdfast plane` fills outlines", self.run_program("mesh", "in.dxf", "-o", "x.vtu", expect=3).stderr)


class MarkersInSpace(CliTest):
    """Formats of surfaces have markers of edges and vertices, too."""

    def edges(self, corners, edges, more="", *options):
        points = "".join("%r %r %r %d\n" % p for p in corners)
        lines = "".join("%d %d %d\n" % e for e in edges)
        self.write("in.mesh", f"MeshVersionFormatted 2\nDimension 3\nVertices {len(corners)}\n{points}Edges {len(edges)}\n"
                              f"{lines}{more}End\n")
        self.run_program("plane", "in.mesh", "-o", "out.node", "-q", *options)
        rows = [list(map(int, line.split())) for line in (self.folder / "out.edge").read_text().splitlines()]
        self.assertEqual(rows[0][1], 1)
        return [(frozenset(row[1:3]), row[3]) for row in rows[1:]]

    def test_of_outlines(self):
        corners = [(0.0, 0.0, 5.0, 1), (2.0, 0.0, 5.0, 0), (2.0, 1.0, 5.0, 3), (0.0, 1.0, 5.0, 0), (2.0, 0.0, 5.0, 2)]
        found = self.edges(corners, [(1, 2, 11), (5, 3, 12), (3, 4, 0), (4, 1, 14)])  # 2 and 5 are at one place
        self.assertEqual(sorted(m for _, m in found), [0, 11, 12, 14])
        self.assertIn((frozenset((0, 1)), 11), found)
        node = (self.folder / "out.node").read_text().splitlines()
        self.assertEqual(node[0], "5 3 0 1")
        self.assertEqual([line.split()[-1] for line in node[1:5]], ["1", "2", "3", "0"])
        pieces = self.edges([(*c[:3], 0) for c in corners[:4]], [(1, 2, 11), (2, 3, 12), (3, 4, 0), (4, 1, 14)], "", "--size", "0.5")
        self.assertGreater(sum(m == 11 for _, m in pieces), 3)
        self.assertEqual({m for _, m in pieces}, {0, 11, 12, 14})

    def test_holes_in_space(self):
        corners = [(5.0, 0.0, 0.0), (5.0, 4.0, 0.0), (5.0, 4.0, 4.0), (5.0, 0.0, 4.0), (5.0, 1.0, 1.0), (5.0, 2.0, 1.0), (5.0, 2.0, 2.0), (5.0, 1.0, 2.0)]
        self.write("in.off", "OFF\n8 2 0\n" + "".join("%r %r %r\n" % p for p in corners) + "4 0 1 2 3\n4 4 5 6 7\n")
        self.run_program("plane", "in.off", "-o", "out.obj", "--hole", "5,1.5,1.5")
        self.assertEqual(json.loads(self.run_program("info", "out.obj", "--json").stdout)["area"], 15)
        self.assertIn("three coordinates", self.run_program("plane", "in.off", "-o", "out.obj", "--hole", "1.5,1.5", expect=2).stderr)
        self.write("in.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n")
        self.assertIn("several planes", self.run_program("plane", "in.off", "-o", "out.obj", "--hole", "0,0,0", expect=2).stderr)

    def test_of_polygons_in_two_planes(self):
        corners = [(0.0, 0.0, 0.0, 0), (1.0, 0.0, 0.0, 0), (1.0, 1.0, 0.0, 0), (0.0, 1.0, 0.0, 0), (1.0, 0.0, 1.0, 0), (1.0, 1.0, 1.0, 9)]
        found = self.edges(corners, [(1, 2, 4), (2, 3, 5)], "Quadrilaterals 2\n1 2 3 4 0\n2 3 6 5 0\n")
        self.assertEqual(len(found), 8)
        self.assertEqual([m for e, m in found if e == frozenset((1, 2))], [5, 5])
        self.assertEqual(sorted(m for _, m in found), [0] * 5 + [4, 5, 5])
        self.assertEqual((self.folder / "out.node").read_text().splitlines()[6].split()[-1], "9")


class Refined(CliTest):
    def refined(self, *options):
        self.run_program("plane", "in.poly", "-o", "out.off", "--report", "r.json", *options)
        self.report = json.loads((self.folder / "r.json").read_text())
        return read_off(self.folder / "out.off")

    def test_angles_and_edges_keep_their_bounds(self):
        self.write("in.poly", poly(SQUARE + INNER, RING, holes=[(2.0, 2.0)]))
        points, triangles = self.refined("--angle", "26", "--size", "0.5")
        self.assertAlmostEqual(sum(area(points, t) for t in triangles), 12)
        self.assertEqual(points[:8], [(x, y, 0.0) for x, y in SQUARE + INNER])
        self.assertLessEqual(max(math.dist(points[t[i]], points[t[i - 1]]) for t in triangles for i in range(3)), 0.5)
        self.assertGreaterEqual(self.report["mesh"]["least_angle"], 26)
        self.assertEqual(self.report["small_angles"] + self.report["small_angles_left"] + self.report["large_left"], 0)
        self.assertEqual(len(points), 8 + self.report["field_points"] + self.report["segment_points"])

    def test_a_boundary_that_is_kept_gets_no_points(self):
        self.write("in.poly", poly(SQUARE + INNER, RING, holes=[(2.0, 2.0)]))
        points, _ = self.refined("--size", "0.5", "--keep-boundary")
        self.assertEqual(self.report["segment_points"], 0)
        self.assertGreater(self.report["field_points"], 0)
        for x, y, _ in points[8:]:
            self.assertTrue(0 < x < 4 and 0 < y < 4 and not (1 <= x <= 3 and 1 <= y <= 3))

    def test_markers_of_segments_are_kept(self):
        marked = poly(SQUARE, RING[:4]).replace("4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n", "4 1\n1 1 2 7\n2 2 3 0\n3 3 4 9\n4 4 1 9\n")
        self.write("in.poly", marked)
        self.run_program("plane", "in.poly", "-o", "out.node", "--size", "1")
        numbers = {name: [[float(word) for word in line.split()] for line in (self.folder / f"out.{name}").read_text().splitlines()]
                   for name in ("node", "edge")}
        self.assertEqual(numbers["node"][0][2:], [0, 1])
        self.assertEqual(numbers["edge"][0], [len(numbers["edge"]) - 1, 1])
        at = {}
        for number, x, y, marker in numbers["node"][1:]:
            at[number] = x, y
            # Corners have that of the first of their segments with one.
            self.assertEqual(marker, 7 if y == 0 else 9 if y == 4 or x == 0 else 0, (x, y))
        for _, a, b, marker in numbers["edge"][1:]:
            x, y = ((at[a][k] + at[b][k]) / 2 for k in range(2))
            self.assertEqual(marker, 7 if y == 0 else 0 if x == 4 else 9)
        # Points with markers keep them.
        self.write("in.poly", marked.replace("4 2 0 0\n", "4 2 0 1\n").replace("1 0.0 0.0\n", "1 0.0 0.0 5\n").replace("2 4.0 0.0\n", "2 4.0 0.0 0\n")
                   .replace("3 4.0 4.0\n", "3 4.0 4.0 0\n").replace("4 0.0 4.0\n", "4 0.0 4.0 0\n"))
        self.run_program("plane", "in.poly", "-o", "out.node", "--size", "1")
        lines = (self.folder / "out.node").read_text().splitlines()
        self.assertEqual(lines[1:5], ["1 0 0 5", "2 4 0 0", "3 4 4 0", "4 0 4 0"])
        self.assertIn("7", {line.split()[3] for line in lines[5:]})

    def test_a_cap_is_told(self):
        self.write("in.poly", poly(SQUARE, RING[:4]))
        for size in "0.001", "1e-300":  # the square of which is 0
            said = self.run_program("plane", "in.poly", "-o", "out.off", "--size", size, "--max-points", "50").stderr
            self.assertIn("no more than 50 points are added", said)

    def test_options_that_do_nothing_are_refused(self):
        self.write("in.poly", poly(SQUARE, RING[:4]))
        for options in (["--keep-boundary"], ["--max-points", "5"], ["--size", "0"], ["--size", "nan"], ["--angle", "40"],
                        ["--angle", "-1"], ["--angle", "20", "--stop-after", "delaunay"], ["--tolerance", "-1"]):
            self.assertIn(options[0], self.run_program("plane", "in.poly", "-o", "out.off", *options, expect=2).stderr)
        self.assertIn("--angle 40", self.run_program("plane", "in.poly", "-o", "out.off", "--angle", "40", expect=2).stderr)
        self.assertNotIn("out.off", self.files())


class InSpace(CliTest):
    """Polygons in planes in space: the points are unchanged, bit for bit."""

    CORNERS = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 1.0), (0.0, 3.0)]

    def off(self, points, polygons, name="in.off"):
        lines = ["OFF", f"{len(points)} {len(polygons)} 0"] + ["%r %r %r" % tuple(p) for p in points]
        self.write(name, "\n".join(lines + [" ".join(map(str, [len(f), *f])) for f in polygons]) + "\n")

    def test_a_concave_polygon_of_a_leaning_plane(self):
        points = [(u, v, u + 2 * v + 0.125) for u, v in self.CORNERS]
        self.off(points, [[0, 1, 2, 3, 4]])
        for method in METHODS:
            self.run_program("plane", "in.off", "-o", "out.off", *method)
            back, triangles = read_off(self.folder / "out.off")
            self.assertEqual(back, points)
            self.assertEqual(len(triangles), 3)
            self.assertTrue(all(area(points, t) > 0 for t in triangles))
        self.off(points, [[4, 3, 2, 1, 0]])
        self.run_program("plane", "in.off", "-o", "out.off")
        self.assertTrue(all(area(points, t) < 0 for t in read_off(self.folder / "out.off")[1]))

    def test_polygons_of_one_plane_are_outlines_together(self):
        inner = [(1.0, 0.5), (2.0, 0.5), (1.5, 0.75)]
        points = [(7.0, u, v) for u, v in self.CORNERS + inner]
        self.off(points, [[0, 1, 2, 3, 4], [5, 6, 7]])
        self.run_program("plane", "in.off", "-o", "out.off", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["mesh"]["regions"], 2)
        self.assertEqual(len(read_off(self.folder / "out.off")[1]), 5 - 2 + 2 * 3)

    def obj(self, points, polygons, segments):
        lines = ["v %r %r %r" % tuple(p) for p in points] + [" ".join(["f", *map(str, f)]) for f in polygons]
        self.write("in.obj", "\n".join(lines + ["l %d %d" % s for s in segments]) + "\n")

    def test_segments_round_an_outline(self):
        ring = [(math.cos(2 * math.pi * i / 60), math.sin(2 * math.pi * i / 60)) for i in range(60)]
        sides = [(i + 1, (i + 1) % 60 + 1) for i in range(60)]
        for points in ([(x, y, 5.0) for x, y in ring], [(round(x, 6), round(y, 6), round(x - 0.3 * y + 1, 6)) for x, y in ring]):
            self.obj(points, [], sides)  # the second in a plane up to rounding to six digits
            self.run_program("plane", "in.obj", "-o", "out.off")
            back, triangles = read_off(self.folder / "out.off")
            self.assertEqual((back, len(triangles)), (points, 58))

    def test_segments_that_lie_in_no_plane(self):
        points = [(x, y, z) for z in (0.0, 1.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
        polygons = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5)]
        self.obj(points, polygons, [(1, 2), (6, 2)])  # sides of polygons are segments, too
        self.run_program("plane", "in.obj", "-o", "out.off")
        self.assertEqual(len(read_off(self.folder / "out.off")[1]), 6)
        self.obj(points, polygons, [(1, 2), (3, 7)])
        said = self.run_program("plane", "in.obj", "-o", "out.off", expect=3).stderr
        self.assertIn("in.obj: segment 2: it is no side of a polygon, and not all is in one plane", said)
        self.obj(points, [], [(1, 2), (3, 7), (5, 8)])
        said = self.run_program("plane", "in.obj", "-o", "out.off", expect=3).stderr
        self.assertIn("in.obj: it lies in no plane: its corners are up to", said)

    def test_faces_of_a_solid_are_planes_of_their_own(self):
        bottom = [(u, v, 0.0) for u, v in self.CORNERS]
        top = [(u, v, 1.0) for u, v in self.CORNERS]
        sides = [[i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(5)]
        self.off(bottom + top, [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9]] + sides)
        self.run_program("plane", "in.off", "-o", "out.off")
        self.assertEqual(len(read_off(self.folder / "out.off")[1]), 3 + 3 + 10)
        self.assertIn("encloses 1 region", self.run_program("diagnose", "out.off").stdout)
        self.run_program("plane", "in.off", "-o", "out.off", "--size", "1", expect=2)
        self.run_program("plane", "in.off", "-o", "out.off", "--size", "1", "--keep-boundary")
        self.assertIn("encloses 1 region", self.run_program("diagnose", "out.off").stdout)
        self.assertIn("encloses 1 region", self.run_program("diagnose", "in.off").stdout)

    def test_a_tolerance_takes_what_is_not_plane(self):
        points = [(u, v, 0.01 if u == 2 else 0.0) for u, v in self.CORNERS]
        self.off(points, [[0, 1, 2, 3, 4]])
        command = ["plane", "in.off", "-o", "out.off"]
        self.assertIn("lies in no plane", self.run_program(*command, expect=3).stderr)
        self.assertIn("from the mean plane", self.run_program(*command, "--tolerance", "0.02").stderr)
        self.assertIn("from the mean plane", self.run_program("diagnose", "in.off").stderr)
        self.assertEqual(read_off(self.folder / "out.off")[0], points)

    def pipe(self, name, low, high):
        """A square pipe whose ends are facets with a hole; a corner of the upper end is 0.01 off."""
        outer = [(0, 0), (4, 0), (4, 4), (0, 4)]
        corners = [(u, v, z + (0.01 if (u, z) == (4, high) else 0)) for z in (low, high) for u, v in outer + INNER]
        lines = [f"{len(corners)} 3 0 0"] + ["%d %r %r %r" % (k, *map(float, p)) for k, p in enumerate(corners)] + ["10 0"]
        for k, z in ((0, low), (8, high)):
            lines += ["2 1", f"4 {k} {k + 1} {k + 2} {k + 3}", f"4 {k + 4} {k + 5} {k + 6} {k + 7}", f"1 2 2 {z}"]
        for k in (0, 4):
            lines += [f"1\n4 {k + i} {k + (i + 1) % 4} {k + 8 + (i + 1) % 4} {k + 8 + i}" for i in range(4)]
        self.write(name, "\n".join([*lines, "0", ""]))

    def test_every_command_that_reads_surfaces_has_the_tolerance(self):
        self.pipe("in.poly", 0, 1)
        self.pipe("other.poly", 9, 10)
        (self.folder / "copy").mkdir()
        self.write("copy/in.poly", (self.folder / "in.poly").read_text())
        for command in (["mesh", "in.poly", "-o", "out.vtu"], ["convert", "in.poly", "out.ply"], ["info", "in.poly"],
                        ["diagnose", "in.poly"], ["split", "in.poly", "--parts", "1", "-o", "parts"],
                        ["paste", "in.poly", "other.poly", "-o", "both.off"], ["repair", "in.poly", "-o", "repaired.off"],
                        ["tetgen", "-p", "copy/in.poly"], ["view", "in.poly", "-o", "page.html"]):
            with self.subTest(command[0]):
                said = self.run_program(*command, expect=3).stderr
                self.assertIn("lies in no plane", said)
                self.assertIn("tolerance", said)
                self.run_program(*command, "--tolerance", "0.02")
                self.run_program(*command, "--tolerance", "-1", expect=2)

    def test_holes_of_facets(self):
        square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
        nodes = "".join("%d %r 3.0 %r\n" % (i, u, v) for i, (u, v) in enumerate(square + INNER))
        self.write("in.poly", f"8 3 0 0\n{nodes}1 0\n2 1\n4 0 1 2 3\n4 4 5 6 7\n1 2 3 2\n0\n")
        self.run_program("plane", "in.poly", "-o", "out.node")
        self.assertTrue((self.folder / "out.node").read_text().startswith("8 3 0 0\n0 0 3 0\n"))
        self.assertTrue((self.folder / "out.ele").read_text().startswith("8 3 1\n"))

    def test_crossing_sides_are_named(self):
        self.off([(0.0, 0.0, 1.0), (4.0, 4.0, 1.0), (4.0, 0.0, 1.0), (0.0, 4.0, 1.0)], [[0, 1, 2, 3]])
        said = self.run_program("plane", "in.off", "-o", "out.off", expect=4).stderr
        self.assertIn("cross at (2, 2, 1)", said)
        self.assertIn("triangles 0 and 1 lie in one plane and overlap", self.run_program("diagnose", "in.off", expect=4).stdout)

    def test_points_apart_by_the_least_double_have_a_place(self):
        self.off([(1e300, 0, 0), (1e300, 5e-324, 5e-324), (1e300, 5e-324, 0), (1e300, 0, 5e-324)], [[0, 1, 2, 3]])
        told = self.run_program("plane", "in.off", "-o", "out.off", expect=4).stderr
        self.assertIn("the sides 0-1 and 3-2 cross at (1e+300, 0, 0)", told)


class Refused(CliTest):
    def refused(self, points, segments, message, **more):
        self.write("in.poly", poly(points, segments, **more))
        for method in METHODS:
            said = self.run_program("plane", "in.poly", "-o", "out.off", *method, expect=4).stderr
            self.assertIn(message, said)
        self.assertNotIn("out.off", self.files())

    def test_defects_are_named_by_their_numbers_in_the_file(self):
        self.refused(SQUARE + [(4.0, 4.0)], RING[:4], "points 3 and 5 are both at (4, 4)")
        self.refused(SQUARE + [(2.0, 0.0)], RING[:4], "point 5 (2, 0) lies inside segment 1 (1-2)")
        self.refused(SQUARE, RING[:4] + [(1, 3), (2, 4)], "segment 5 (1-3) and segment 6 (2-4) cross at (2, 2)")
        self.refused(SQUARE, RING[:4] + [(2, 1)], "segment 5 (2-1) is segment 1 (1-2) again")
        self.refused(SQUARE, RING[:4] + [(3, 3)], "segment 5 (3-3) has no length")
        self.refused(SQUARE + [(6.0, 0.0)], RING[:4] + [(1, 5)], "segment 1 (1-2) and segment 5 (1-5) overlap")
        self.refused(SQUARE, RING[:3], "enclose nothing")
        self.refused([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], [], "so that there is no triangle\n")
        self.refused(SQUARE[:3] + [(float("nan"), 1.0)], RING[:3], "point 4 (nan, 1) is not finite")

    def test_millions_of_crossings_end_soon(self):
        # A hundred of a kind are reported, and the search then ends: all would take a dozen seconds.
        numbers = random.Random(1)
        points = [(numbers.random(), numbers.random()) for _ in range(10_000)]
        segments = [(2 * i + 1, 2 * i + 2) for i in range(5_000)]
        self.write("in.poly", poly(points, segments))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        said = self.run_program("plane", "in.poly", "-o", "out.off", expect=4).stderr
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 5)
        self.assertIn("segment 1 (1-2) and segment 3 (5-6) cross", said)
        self.assertIn("and 80 more", said)

    def test_numbers_may_begin_with_0(self):
        segments = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)]
        self.refused(SQUARE, segments, "segment 4 (0-2) and segment 5 (1-3) cross", base=0)

    def test_segments_may_be_numbered_apart_from_points(self):
        text = poly(SQUARE, [(0, 1), (1, 2), (2, 3), (3, 0)], base=0)
        for k in range(3, -1, -1):
            text = text.replace(f"\n{k} {k} ", f"\n{k + 1} {k} ")
        self.write("in.poly", text)
        said = self.run_program("plane", "in.poly", "-o", "out.off").stderr
        self.assertIn("segments are numbered from 1 and points from 0", said)
        self.assertEqual(len(read_off(self.folder / "out.off")[1]), 2)

    def test_files_that_are_wrong(self):
        whole = poly(SQUARE, RING[:4])
        for text, message in [
            (whole.replace("4 4 1", "4 4 9"), "out of range: 9"),
            (whole.replace("4 2 0 0", "4 4 0 0", 1), "the dimension is not 2"),
            (whole.replace("4 2 0 0", "400000000 2 0 0", 1), "truncated or damaged"),
            (whole[:40], "truncated"),
            (whole + "1 2 3\n", "text after the last section"),
        ]:
            self.write("in.poly", text)
            said = self.run_program("plane", "in.poly", "-o", "out.off", expect=3).stderr
            self.assertIn(message, said)
            self.assertRegex(said, "line [0-9]+")
        self.run_program("plane", "none.poly", "-o", "out.off", expect=3)
        self.assertEqual(self.files(), ["cube.off", "in.poly"])

    def test_holes_on_segments(self):
        for hole in [(2.0, 0.0), (4.0, 4.0)]:
            self.write("in.poly", poly(SQUARE, RING[:4], holes=[hole]))
            for method in ("ears", "swaps", "partition"):
                said = self.run_program("plane", "in.poly", "-o", "out.off", "--method", method, expect=4).stderr
                self.assertIn(f"hole 1 ({hole[0]:g}, {hole[1]:g}) lies on segment", said)
        # The method ears has no triangle at a segment outside, and reports it anyway.
        self.write("in.poly", poly(SQUARE + [(6, 0), (6, 4)], RING[:4] + [(5, 6)], holes=[(6.0, 2.0)]))
        for method in ("ears", "swaps", "partition"):
            said = self.run_program("plane", "in.poly", "-o", "out.off", "--method", method, expect=4).stderr
            self.assertIn("hole 1 (6, 2) lies on segment", said)
        # A segment that is only a side of the hull is in no region.
        self.write("in.poly", poly(SQUARE, [(1, 3)], holes=[(2.0, 0.0)]))
        self.run_program("plane", "in.poly", "-o", "out.off", "--hull")
        self.write("in.poly", poly(SQUARE, RING[:4], holes=[(math.nan, 0.0)]))
        said = self.run_program("plane", "in.poly", "-o", "out.off", expect=3).stderr
        self.assertRegex(said, "line [0-9]+.*finite")

    def test_attributes_of_regions(self):
        self.write("in.poly", poly(SQUARE, [*RING[:4], (1, 3)])[:-2] + "2\n1 3 1 1.5 0\n2 1 3 1 0\n")
        said = self.run_program("plane", "in.poly", "-o", "out.ele").stderr
        self.assertIn("the attribute 1.5 of regions is no whole number; it is 2 in the output", said)
        regions = [int(line.split()[4]) for line in (self.folder / "out.ele").read_text().splitlines()[1:]]
        self.assertEqual(sorted(regions), [1, 2])

    def test_usage(self):
        self.write("in.poly", poly(SQUARE, RING[:4]))
        for options in (["--method", "ear"], ["--method", "ears", "--stop-after", "delaunay"],
                        ["--stop-after", "partition"], ["--ears", "best"], ["--partition-first"],
                        ["--order", "last"], ["--method", "ears", "--order", "random"],
                        ["--time-limit", "-1"]):
            self.run_program("plane", "in.poly", "-o", "out.off", *options, expect=2)
        self.run_program("plane", "in.poly", "-o", "in.poly", expect=2)
        self.assertEqual(self.files(), ["cube.off", "in.poly"])
        self.run_program("plane", "in.poly", "-o", "out.off", "--time-limit", "1e-9", expect=5)


if __name__ == "__main__":
    main()
