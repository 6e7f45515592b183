"""Several files as parts: `holdfast mesh a b`, `--paste`, `--overlap`, and `holdfast paste`."""
import gzip
import json
import math
import struct
from collections import Counter

from assemblies import as_float32, box, cylinder, ring, rotated, volume, wedge, write_off, write_stl
from cli_case import CliTest, main


def read_mesh(path):
    """Vertices, triangles with markers, tetrahedra with regions of a .mesh file."""
    words = path.read_text().split()
    at, sections = 0, {}
    width = {"Vertices": 4, "Triangles": 4, "Tetrahedra": 5, "Edges": 3}
    while at < len(words):
        if words[at] in width:
            kind, n = words[at], int(words[at + 1])
            k, at = width[kind], at + 2
            sections[kind] = [words[at + k * i: at + k * i + k] for i in range(n)]
            at += n * k
        else:
            at += 1
    points = [tuple(float(x) for x in row[:3]) for row in sections["Vertices"]]
    entities = {kind: [tuple(int(x) for x in row) for row in sections.get(kind, [])]
                for kind in ("Triangles", "Tetrahedra")}
    triangles = [(tuple(v - 1 for v in row[:3]), row[3]) for row in entities["Triangles"]]
    tets = [(tuple(v - 1 for v in row[:4]), row[4]) for row in entities["Tetrahedra"]]
    return points, triangles, tets


def minus(p, q):
    return tuple(a - b for a, b in zip(p, q))


def cross(u, v):
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def volumes(points, tets):
    """By region."""
    total = Counter()
    for (a, b, c, d), region in tets:
        p = points[a]
        total[region] += dot(minus(points[b], p), cross(minus(points[c], p), minus(points[d], p))) / 6
    return total


def interface_areas(points, tets):
    """By pair of regions (seen from the first), the area of the faces between them."""
    sides = {}
    for tet, region in tets:
        for i in range(4):
            sides.setdefault(tuple(sorted(tet[:i] + tet[i + 1:])), []).append(region)
    total = Counter()
    for (a, b, c), regions in sides.items():
        if len(regions) == 2 and regions[0] != regions[1]:
            n = cross(minus(points[b], points[a]), minus(points[c], points[a]))
            total[tuple(sorted(regions))] += math.sqrt(dot(n, n)) / 2
    return total


class PasteTest(CliTest):
    def parts(self, *parts, write=write_off, ending=".off"):
        names = []
        for name, part in zip("abcdefgh", parts):
            write(self.folder / (name + ending), part)
            names.append(name + ending)
        return names

    def mesh(self, names, *options, expect=0):
        ended = self.run_program("mesh", *names, "-o", "out.mesh", "--fill", "--report", "r.json", *options,
                                 expect=expect)
        if expect != 0:
            return ended
        report = json.loads((self.folder / "r.json").read_text())
        return *read_mesh(self.folder / "out.mesh"), report, ended

    def require_vertices(self, points, *parts):
        there = {struct.pack("<3d", *p) for p in points}
        for part in parts:
            for p in part[0]:
                self.assertIn(struct.pack("<3d", *p), there)

    # --- identical interfaces, no option ------------------------------------------------------------

    def test_identical_interface_needs_no_option(self):
        a, b = box((0, 0, 0), (1, 1, 1), 3), box((1, 0, 0), (2, 1, 1), 3)
        names = self.parts(a, b)
        points, triangles, tets, report, _ = self.mesh(names)
        self.run_program("check", *names, "out.mesh")
        found = volumes(points, tets)
        self.assertEqual(set(found), {1, 2})
        for region in (1, 2):
            self.assertAlmostEqual(found[region], 1, places=12)
        self.assertAlmostEqual(interface_areas(points, tets)[1, 2], 1, places=12)
        self.require_vertices(points, a, b)
        markers = Counter(marker for _, marker in triangles)
        self.assertEqual(report["marker_sets"], {"3": [1, 2]})
        self.assertEqual(markers, {1: 5 * 18, 2: 5 * 18, 3: 18})
        self.assertEqual(report["names"]["regions"], {"1": "a", "2": "b"})
        self.assertEqual(report["shared_facets"], 18)

    def test_vtu_and_stl(self):
        a, b = as_float32(box((0, 0, 0), (1, 1, 1), 3)), as_float32(box((1, 0, 0), (2, 1, 1), 3))
        names = self.parts(a, b, write=write_stl, ending=".stl")
        self.run_program("mesh", *names, "-o", "ab.vtu")
        self.run_program("check", *names, "ab.vtu")

    def test_same_marker_stays(self):
        parts = [box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 2)]
        for name, (points, triangles) in zip("ab", parts):
            rows = "".join(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in points)
            faces = "".join(f"{a + 1} {b + 1} {c + 1} 7\n" for a, b, c in triangles)
            self.write(name + ".mesh", f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n{rows}"
                                       f"Triangles\n{len(triangles)}\n{faces}End\n")
        _, triangles, _, report, _ = self.mesh(["a.mesh", "b.mesh"])
        self.assertEqual({marker for _, marker in triangles}, {7})
        self.assertEqual(report["marker_sets"], {})
        self.run_program("check", "a.mesh", "b.mesh", "out.mesh")

    def test_repeated_triangle_within_one_file_stays_a_defect(self):
        points, triangles = box((0, 0, 0), (1, 1, 1), 2)
        names = self.parts((points, triangles + triangles[:1]), box((1, 0, 0), (2, 1, 1), 2))
        ended = self.mesh(names, expect=4)
        self.assertIn("repeated", ended.stderr)
        self.assertIn(f"triangles 0 and {len(triangles)}", ended.stderr)
        self.assertFalse((self.folder / "out.mesh").exists())

    def test_three_parts_round_an_edge(self):
        parts = [wedge(0, 120, 1, 4), wedge(120, 240, 1, 4), wedge(240, 360, 1, 4)]
        # The last angle closes the circle with the bits of the first.
        parts[2] = [tuple(q) if q != p else p for p, q in zip(parts[2][0], parts[2][0])], parts[2][1]
        first = wedge(0, 120, 1, 4)[0]
        fixed = [(first[3 * (i // 3) + 1] if i % 3 == 2 else p) for i, p in enumerate(parts[2][0])]
        parts[2] = fixed, parts[2][1]
        names = self.parts(*parts)
        points, _, tets, report, _ = self.mesh(names)
        self.run_program("check", *names, "out.mesh")
        found = volumes(points, tets)
        for k, part in enumerate(parts):
            self.assertAlmostEqual(found[k + 1], volume(part), places=12)
        areas = interface_areas(points, tets)
        for pair in ((1, 2), (2, 3), (1, 3)):
            self.assertAlmostEqual(areas[pair], 1, places=12)
        self.assertEqual(len(report["marker_sets"]), 3)

    def test_regions_keep_ids_and_names(self):
        poly = self.folder / "b.poly"
        points, triangles = box((1, 0, 0), (2, 1, 1), 2)
        write_off(self.folder / "a.off", box((0, 0, 0), (1, 1, 1), 2))
        poly.write_text(f"{len(points)} 3 0 0\n" + "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))
                        + f"{len(triangles)} 0\n" + "".join(f"1\n3 {a} {b} {c}\n" for a, b, c in triangles)
                        + "0\n1\n0 1.5 0.5 0.5 1 -1\n")
        _, _, tets, report, _ = self.mesh(["a.off", "b.poly"])
        self.assertEqual({r for _, r in tets}, {1, 2})
        self.assertEqual(report["parts"][1]["region"], 1)  # the id in the file; the first file gets the next free number
        self.assertEqual(report["parts"][0]["region"], 2)
        self.run_program("check", "a.off", "b.poly", "out.mesh")

    def test_void_between_parts_stays_empty(self):
        # A box with a box-shaped hole, and a smaller box in one end of the hole.
        outer, hole = box((0, 0, 0), (3, 3, 3), 3), box((1, 1, 1), (2, 2, 2), (1, 1, 2))
        plug = box((1, 1, 1), (2, 2, 1.5), 1)
        names = self.parts(ring(hole, outer), plug)
        points, _, tets, _, _ = self.mesh(names)
        found = volumes(points, tets)
        self.assertAlmostEqual(found[1], 26, places=12)
        self.assertAlmostEqual(found[2], 0.5, places=12)
        self.run_program("check", *names, "out.mesh")

    # --- overlap and distance ------------------------------------------------------------------------

    def overlapping(self):
        """The second box holds the right third of the first one, and shares its lower face there."""
        a = box((0, 0, 0), (3, 1, 1), (3, 1, 1))
        b = box((2, 0, 0), (4, 1, 2), (2, 1, 2))
        return a, b

    def test_overlap_is_refused(self):
        names = self.parts(*self.overlapping())
        ended = self.mesh(names, expect=4)
        self.assertRegex(ended.stderr, r"a\.off and b\.off overlap by 1\b")
        self.assertFalse((self.folder / "out.mesh").exists())

    def test_small_overlap_names_the_tolerance(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), (1, 1, 1)), box((1 - 1e-6, 0.2, 0.2), (2, 0.6, 0.9), (1, 1, 1)))
        for ended in (self.run_program("mesh", *names, "-o", "x.mesh", "--paste", expect=4),
                      self.run_program("paste", *names, "-o", "x.mesh", expect=4)):
            self.assertRegex(ended.stderr, r"a\.off and b\.off overlap by 1e-06 at")
            self.assertIn("T joins parts that are nearer than T", ended.stderr)
        ended = self.run_program("paste", *names, "-o", "x.mesh", "--tolerance", "1e-9", expect=4)
        self.assertNotIn("T brings", ended.stderr)
        self.mesh(names, "--paste=1e-5")

    def test_overlap_goes_where_it_is_sent(self):
        names = self.parts(*self.overlapping())
        for option, expected in (("first", {1: 3, 2: 3}), ("last", {1: 2, 2: 4}), ("new", {1: 2, 2: 3, 3: 1})):
            points, _, tets, _, _ = self.mesh(names, "--overlap", option)
            found = volumes(points, tets)
            self.assertEqual({r: round(v, 9) for r, v in found.items()}, expected)
        self.assertIn("there is first, last and new",
                      self.run_program("mesh", *names, "-o", "x.mesh", "--overlap", "both", expect=2).stderr)

    def test_options_of_parts_need_parts(self):
        ended = self.run_program("mesh", "cube.off", "-o", "x.mesh", "--overlap=first", expect=2)
        self.assertIn("a single file", ended.stderr)
        ended = self.run_program("mesh", "cube.off", "-o", "x.mesh", "--paste", expect=2)
        self.assertIn("one part", ended.stderr)
        self.run_program("mesh", "cube.off", "cube.off", "-o", "x.mesh", "--paste=-1", expect=2)
        self.run_program("paste", "cube.off", "-o", "x.off", expect=2)
        self.assertEqual(self.files(), ["cube.off"])

    def test_distance_of_parts_that_do_not_touch(self):
        names = self.parts(rotated(box((0, 0, 0), (1, 1, 1), 2)), rotated(box((1.5, 0.3, 0.2), (2, 1, 1), 3)))
        *_, report, ended = self.mesh(names, "--paste")
        self.assertRegex(ended.stderr, r"a\.off and b\.off do not touch: they are 0\.5 apart")
        self.assertEqual([w["message"][:5] for w in report["warnings"]], ["a.off"])

    # --- parts with different triangles --------------------------------------------------------------

    def require_pasted(self, parts, *options, interfaces, exact=True, places=12):
        """Meshes the parts, checks the mesh against the pasted surface, and compares volumes and areas."""
        names = self.parts(*parts)
        points, _, tets, report, _ = self.mesh(names, *options)
        self.run_program("paste", *names, "-o", "pasted.mesh", "--parents", "p.txt", "--report", "p.json",
                         *[o.replace("--paste=", "--tolerance=") for o in options if o.startswith("--paste=")])
        self.run_program("check", "pasted.mesh", "out.mesh")
        self.assertEqual(self.run_program("diagnose", "pasted.mesh").returncode, 0)
        if exact:
            self.require_vertices(points, *parts)
        self.require_vertices(points, parts[0])
        found = volumes(points, tets)
        for k, part in enumerate(parts):
            self.assertAlmostEqual(found[k + 1], volume(part), places=places)
        self.assertEqual(set(found), set(range(1, len(parts) + 1)))
        areas = interface_areas(points, tets)
        self.assertEqual(set(areas), set(interfaces))
        for pair, area in interfaces.items():
            self.assertAlmostEqual(areas[pair], area, places=min(places, 6))
        return report

    def test_different_grids(self):
        a, b = box((0, 0, 0), (1, 1, 1), 4), box((1, 0, 0), (2, 1, 1), 7)
        self.require_pasted([a, b], "--paste", interfaces={(1, 2): 1})

    def test_different_grids_rotated(self):
        a, b = rotated(box((0, 0, 0), (1, 1, 1), 4)), rotated(box((1, 0, 0), (2, 1, 1), 7))
        self.require_pasted([a, b], "--paste", interfaces={(1, 2): 1})

    def test_different_grids_float32(self):
        parts = [as_float32(rotated(p)) for p in (box((0, 0, 0), (1, 1, 1), 4), box((1, 0, 0), (2, 1, 1), 7))]
        self.require_pasted(parts, "--paste", interfaces={(1, 2): 1}, places=6)

    def test_tips_that_rounding_puts_into_a_face(self):
        """A tip beyond a face by less than doubles can tell: its sides were cut next to it, and it was lost."""
        corners = [(0.3 + 0.25 * math.cos(k), 0.6 + 0.25 * math.sin(k), 1.5) for k in (0, 2 * math.pi / 3, 4 * math.pi / 3)]
        tip = [(0.3, 0.6, 1.0), *corners], [(0, 2, 1), (0, 3, 2), (0, 1, 3), (1, 2, 3)]
        for degrees in 118, 127, 136, 148, 153:
            by = (degrees, 2 * degrees + 1, 3 * degrees + 2)
            self.require_pasted([rotated(box((0, 0, 0), (1, 1, 1), 1), by), rotated(tip, by)], "--paste", interfaces={})

    def test_texts_of_floats_are_rounded_to_floats(self):
        """STL as text: 9 digits, and the usual 7."""
        parts = [rotated(p) for p in (box((0, 0, 0), (1, 1, 1), 4), box((1, 0, 0), (2, 1, 1), 7))]
        for digits in 9, 7:
            written = [([tuple(float(f"{x:.{digits}g}") for x in p) for p in as_float32(part)[0]], part[1])
                       for part in parts]
            self.require_pasted(written, "--paste", interfaces={(1, 2): 1}, places=5)

    def test_a_thin_overlap_names_its_thickness(self):
        """The box round it is as large as the interface, which is turned; its thickness says which T to ask for."""
        parts = [rotated(p) for p in (box((0, 0, 0), (1, 1, 1), 2), box((0.999, 0, 0), (2, 1, 1), 3))]
        ended = self.mesh(self.parts(*parts), "--paste", expect=4)
        self.assertRegex(ended.stderr, r"where their common space is 0\.000998 thick")
        self.mesh(self.parts(*parts), "--paste=0.002")

    def test_overlap_at_any_scale(self):
        for scale in 1e-160, 1e-25, 1e25, 1e100:
            a, b = (([tuple(x * scale for x in p) for p in part[0]], part[1]) for part in self.overlapping())
            self.assertIn("overlap by", self.mesh(self.parts(a, b), "--paste", expect=4).stderr)

    def test_points_inside_a_volume_do_not_tell_how_its_surface_is_rounded(self):
        a = as_float32(rotated(box((0, 0, 0), (1, 1, 1), 3)))
        b = as_float32(rotated(box((1, 0, 0), (2, 1, 1), 4)))
        self.parts(a, b)
        self.run_program("mesh", "b.off", "-o", "b.vtu", "--size", "0.2")
        points, _, tets, _, _ = self.mesh(["a.off", "b.vtu"], "--paste")
        for region in (1, 2):
            self.assertAlmostEqual(volumes(points, tets)[region], 1, places=5)

    def test_interfaces_that_cover_each_other_in_part(self):
        a, b = rotated(box((0, 0, 0), (1, 1, 1), 5)), rotated(box((1, 0.23, 0.17), (2, 0.81, 1.3), 4))
        self.require_pasted([a, b], "--paste", interfaces={(1, 2): 0.58 * 0.83})

    def test_cylinder_in_box(self):
        hole, plug = cylinder(0.4, -0.7, 0.7, 24, layers=4), cylinder(0.4, -0.7, 0.7, 24, layers=7)
        area = 2 * 24 * (0.4 * math.sin(math.pi / 24) * 1.4 + 0.08 * math.sin(2 * math.pi / 24))
        self.require_pasted([rotated(ring(hole, box((-1, -1, -1), (1, 1, 1), 3))), rotated(plug)], "--paste",
                            interfaces={(1, 2): area})

    def test_curved_interface_with_other_facets(self):
        hole, plug = cylinder(0.4, -0.7, 0.7, 24, layers=4), cylinder(0.4, -0.7, 0.7, 31, layers=7, turn=0.1)
        parts = [rotated(ring(hole, box((-1, -1, -1), (1, 1, 1), 3))), rotated(plug)]
        names = self.parts(*parts)
        self.mesh(names, "--paste", expect=4)  # facets cut each other's corners off
        for tolerance in ("0.006", "0.02"):
            points, _, tets, _, _ = self.mesh(names, f"--paste={tolerance}")
            self.run_program("paste", *names, "-o", "pasted.mesh", "--tolerance", tolerance)
            self.run_program("check", "pasted.mesh", "out.mesh")
            self.require_vertices(points, parts[0])
            found = volumes(points, tets)
            self.assertAlmostEqual(found[1] + found[2], 8, places=9)
            self.assertAlmostEqual(found[1], volume(parts[0]), delta=0.001)

    def test_flat_ends_of_a_plug_whose_rim_bends_are_not_folded(self):
        """Ends of triangles with two sides on the rim: fans of these, from a corner, were folded, and the plug became open."""
        sides, sagitta = 20, 1 - math.cos(math.pi / 20)
        hole = cylinder(1, 0, 2, sides)
        points, triangles = cylinder(1, 0.1, 1.9, sides, turn=0.03)
        del points[2 * sides:], triangles[2 * sides:]
        for k in range(1, sides - 1):
            triangles += [(0, k + 1, k), (sides, sides + k, sides + k + 1)]
        plug = points, triangles
        names = self.parts(plug, ring(hole, box((-2, -2, -1), (2, 2, 3), 2)))
        for tolerance in 1.1 * sagitta, 2 * sagitta:
            points, _, tets, _, _ = self.mesh(names, f"--paste={tolerance}")
            found = volumes(points, tets)
            self.assertAlmostEqual(found[1], volume(plug), delta=0.15)
            self.assertAlmostEqual(found[2], 64 - volume(hole), delta=0.15)
        self.run_program("paste", *names, "-o", "pasted.off", "--parents", "p.txt", "--report", "p.json", "--tolerance", str(tolerance))
        self.run_program("check", "--repaired", *names, "pasted.off", "--parents", "p.txt", "--report", "p.json")

    def test_triangles_that_fold_do_not_fill_the_hole_of_their_part(self):
        """Some are turned against their neighbours by their normals, and a part without winding numbers would hold what it encloses."""

        def tapered(part):
            return [(x * (1 - 0.1 * z), y * (1 - 0.1 * z), z) for x, y, z in part[0]], part[1]

        hole, plug = tapered(cylinder(1, 0, 2, 6)), tapered(cylinder(1, 0, 2, 8, turn=0.1))
        names = self.parts(rotated(plug), rotated(ring(hole, box((-2, -2, -1), (2, 2, 3), 1))))
        points, _, tets, _, ended = self.mesh(names, "--paste=0.275")
        found = volumes(points, tets)
        self.assertAlmostEqual(found[1], volume(plug), delta=0.5)
        self.assertAlmostEqual(found[1] + found[2], 64, places=9)
        self.assertNotIn("winding numbers", ended.stderr)

    def test_a_poly_has_seeds_of_the_parts_regions(self):
        far = box((10, 0, 0), (11, 1, 1), 1)
        wall = box((1, 2, 1), (2, 3, 2), 2)
        wall = (wall[0] + far[0], wall[1] + [tuple(v + len(wall[0]) for v in t) for t in far[1]])
        # Slabs and walls round a space in no part; the last file is of two pieces.
        names = self.parts(box((0, 0, 0), (3, 3, 1), 2), box((0, 0, 2), (3, 3, 3), 3), box((0, 0, 1), (1, 3, 2), 1),
                           box((2, 0, 1), (3, 3, 2), 2), box((1, 0, 1), (2, 1, 2), 3), wall)
        said = self.run_program("paste", *names, "-o", "parts.poly").stderr
        self.assertNotIn("numbers its regions anew", said)
        lines = (self.folder / "parts.poly").read_text().splitlines()
        self.assertEqual(lines[-8], "7")
        self.assertEqual(sorted(int(line.split()[4]) for line in lines[-7:]), [1, 2, 3, 4, 5, 6, 6])
        hole = [float(x) for x in lines[-9].split()[1:]]
        self.assertEqual(lines[-10], "1")
        self.assertTrue(all(1 < x < 2 for x in hole), hole)
        points, _, tets, _, _ = self.mesh(["parts.poly"])
        for region, size in volumes(points, tets).items():
            self.assertAlmostEqual(size, {1: 9, 2: 9, 3: 3, 4: 3, 5: 1, 6: 2}[region], places=12)
        self.run_program("paste", *names, "-o", "parts.off")  # which has no place for seeds, and needs none
        self.run_program("paste", *names, "-o", "parts.poly", "--time-limit", "1e-9", expect=5)

    def test_a_poly_of_a_part_in_a_hollow_of_another_is_meshed_by_its_seeds(self):
        """The interface faces into the hollow, as in the first file, so that the winding number there is 0."""
        hollow = ring(box((1, 1, 1), (2, 2, 2), 2), box((0, 0, 0), (3, 3, 3), 3))
        names = self.parts(hollow, box((1, 1, 1), (2, 2, 2), 3))
        self.run_program("paste", *names, "-o", "parts.poly")
        points, _, tets, _, _ = self.mesh(["parts.poly"])
        self.assertEqual({r: round(v, 12) for r, v in volumes(points, tets).items()}, {1: 26, 2: 1})
        # As a part in its turn: its seeds are those of its regions.
        write_off(self.folder / "lid.off", box((0, 0, 3), (3, 3, 4), 2))
        points, _, tets, _, _ = self.mesh(["parts.poly", "lid.off"], "--paste")
        self.assertEqual({r: round(v, 12) for r, v in volumes(points, tets).items()}, {1: 26, 2: 1, 3: 9})

    def test_three_parts_round_an_edge_cut_differently(self):
        parts = [as_float32(rotated(wedge(*w))) for w in ((0, 120, 1, 3), (120, 240, 1, 5), (240, 360, 1, 4))]
        self.require_pasted(parts, "--paste", interfaces={(1, 2): 1, (2, 3): 1, (1, 3): 1}, places=6)

    def test_slab_on_two_boxes(self):
        parts = [rotated(p) for p in (box((0, 0, 0), (1, 1, 1), 3), box((1, 0, 0), (2, 1, 1), 4),
                                      box((0, 0, 1), (2, 1, 1.7), 5))]
        self.require_pasted(parts, "--paste", interfaces={(1, 2): 1, (1, 3): 1, (2, 3): 1})

    def test_tolerance_closes_a_gap_and_an_overlap(self):
        for x in (1.01, 0.99):
            a, b = rotated(box((0, 0, 0), (1, 1, 1), 4)), rotated(box((x, 0, 0), (2, 1, 1), 7))
            names = self.parts(a, b)
            points, _, tets, _, _ = self.mesh(names, "--paste=0.02")
            self.require_vertices(points, a)
            found = volumes(points, tets)
            self.assertAlmostEqual(found[1], 1, places=9)
            self.assertAlmostEqual(found[2], 1, places=9)
            self.assertAlmostEqual(interface_areas(points, tets)[1, 2], 1, places=9)
            self.run_program("paste", *names, "-o", "pasted.off", "--tolerance", "0.02", "--report", "p.json")
            report = json.loads((self.folder / "p.json").read_text())
            self.assertEqual(len(report["moved"]), 64)
            self.assertTrue(all(0.0099 < m["distance"] < 0.0101 for m in report["moved"]))
            self.assertTrue(all(m["vertex"] >= len(a[0]) for m in report["moved"]))

    def test_what_snaps_and_is_led_is_told_by_a_distance_that_is_proved(self):
        """The bounds of both steps add up to 0.54."""
        names = self.parts(box((0, 0, 0), (2, 2, 2), 1), box((2.1, 0.3, 0.2), (4, 1.7, 1.9), 2))
        self.run_program("paste", *names, "-o", "pasted.off", "--tolerance", "0.2", "--parents", "p.txt", "--report", "p.json")
        report = json.loads((self.folder / "p.json").read_text())
        self.assertAlmostEqual(report["max_displacement"], 0.2, places=6)
        self.assertGreater(report["max_displacement"], 0.2)
        self.run_program("check", "--repaired", *names, "pasted.off", "--parents", "p.txt", "--report", "p.json")

    def test_components_of_one_file(self):
        a, b = box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 3)
        n = len(a[0])
        write_off(self.folder / "ab.off", (a[0] + b[0], a[1] + [tuple(n + v for v in t) for t in b[1]]))
        points, _, tets, _, _ = self.mesh(["ab.off"], "--paste")
        found = volumes(points, tets)
        self.assertAlmostEqual(found[1], 1, places=12)
        self.assertAlmostEqual(found[2], 1, places=12)
        self.assertAlmostEqual(interface_areas(points, tets)[1, 2], 1, places=12)

    def test_overlap_of_pasted_parts_names_both(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), 2), box((0.7, 0.2, 0.2), (2, 0.6, 0.9), 3))
        for ended in (self.run_program("mesh", *names, "-o", "x.mesh", "--paste", expect=4),
                      self.run_program("paste", *names, "-o", "x.mesh", expect=4)):
            self.assertIn("a.off and b.off overlap by 0.3 at", ended.stderr)
        self.assertFalse((self.folder / "x.mesh").exists())
        points, _, tets, _, _ = self.mesh(names, "--paste", "--overlap", "new")
        found = volumes(points, tets)
        self.assertAlmostEqual(found[3], 0.3 * 0.4 * 0.7, places=9)

    def test_tolerances_that_are_too_large(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), 3), box((1, 0, 0), (2.5, 1, 1), 4))
        for tolerance in "0.5", "10", "1e300":
            for ended in (self.run_program("mesh", *names, "-o", "x.mesh", "--paste=" + tolerance, expect=2),
                          self.run_program("paste", *names, "-o", "x.mesh", "--tolerance", tolerance, expect=2)):
                self.assertIn("half the extent of a.off, which is 1", ended.stderr)
        self.assertFalse((self.folder / "x.mesh").exists())

    def test_a_tolerance_that_opens_a_part(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), 3), box((1.1, -0.3, 0.2), (2.1, 0.7, 1.2), 3))
        for ended in (self.run_program("mesh", *names, "-o", "x.mesh", "--paste=0.45", expect=7),
                      self.run_program("paste", *names, "-o", "x.mesh", "--tolerance", "0.45", expect=7)):
            self.assertRegex(ended.stderr, r"[ab]\.off was closed, and is not once it is brought together within 0\.45 of the others; [ab]\.off "
                             r"has details smaller than the tolerance, which take one below 0\.236: so far is its vertex \d+, at \(")
        self.assertFalse((self.folder / "x.mesh").exists())

    def test_a_part_that_is_as_small_as_coordinates_are_rounded_opens_another(self):
        """It used to be open, and the mesher then reported triangles outside every region."""
        e = 2.0**-23
        names = self.parts(box((0, 0, 0), (1, 1, 1), 1), box((1 + 3 * e, 1, 1 - 4 * e), (1 + 4 * e, 1 + e, 1 - 3 * e), 1))
        for ended in (self.run_program("mesh", *names, "-o", "x.mesh", "--paste", "--overlap", "first", expect=7),
                      self.run_program("paste", *names, "-o", "x.mesh", "--overlap", "first", "--report", "r.json", expect=7)):
            self.assertIn("a.off was closed, and is not once it is brought together within 4.77e-07 of the others, as near as "
                          "coordinates are rounded; coordinates of more digits, or nearer to the origin, may help", ended.stderr)
        self.assertFalse((self.folder / "x.mesh").exists())
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outcome"], "not_representable")

    def test_a_corner_near_to_a_crossing_may_be_far_from_a_side(self):
        """A side was routed through a corner 0.04 away from it, since the other side that crosses it there ends in it."""
        parts = box((0.2, 0.8, 0), (1, 1, 0.6), (4, 1, 3)), box((0.76, 0, 0), (1, 0.8, 0.48), (2, 1, 3))
        points, _, tets, _, _ = self.mesh(self.parts(*parts), "--paste=0.03")
        for k, part in enumerate(parts):
            self.assertAlmostEqual(volumes(points, tets)[k + 1], volume(part), delta=0.01)

    def test_a_tolerance_that_leaves_a_triangle_outside(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), 2), box((1.02, -0.3, 0.2), (2, 0.7, 1.2), 3))
        ended = self.mesh(names, "--paste=0.3", expect=4)
        self.assertIn("--paste=0.3 may be above the size of the parts' details, which are lost then: a smaller tolerance may help\n",
                      ended.stderr)

    def box_and_edge(self, x, d):
        """A box, and a prism with a side at the distance d above it."""
        turned, triangles = cylinder(0.5, 0.2, 0.8, 3, turn=0.1)
        up = 1 - min(p[1] for p in turned)
        prism = [(a + x, b + up - d, c + d) for a, b, c in turned], triangles
        return rotated(box((0, 0, 0), (1, 1, 1), 2)), rotated(prism)

    def test_side_near_a_face_leaves_no_part_open(self):
        """Sides that were routed twice left the prism open: the pieces of one of its facets were folded onto each other."""
        parts = self.box_and_edge(0.7, -0.0002)
        points, _, tets, _, _ = self.mesh(self.parts(*parts), "--paste=0.001")
        found = volumes(points, tets)
        for k, part in enumerate(parts):
            self.assertAlmostEqual(found[k + 1], volume(part), delta=0.003)

    def test_what_parts_share_within_the_tolerance_is_no_overlap(self):
        parts = self.box_and_edge(0.7, 0.0003)
        names = self.parts(*parts)
        for option, expected in (("first", volume(parts[0])), ("last", volume(parts[0])), (None, volume(parts[0]))):
            points, _, tets, _, _ = self.mesh(names, "--paste=0.001", *(["--overlap", option] if option else []))
            found = volumes(points, tets)
            self.assertEqual(set(found), {1, 2})
            self.assertAlmostEqual(found[1], expected, delta=0.003)
        # A thicker one is still refused.
        names = self.parts(*self.box_and_edge(0.7, 0.1))
        self.assertIn("overlap by", self.mesh(names, "--paste=0.001", expect=4).stderr)

    def test_the_distance_that_is_told_holds_where_only_last_bits_are_moved(self):
        """A round face as a fan, and in two rings: points of one are some last bits off the sides of the other."""
        rim = [(25.4 * math.cos(2 * math.pi * k / 8), 25.4 * math.sin(2 * math.pi * k / 8), 0.0) for k in range(8)]
        rings = [[(s * x, s * y, 0.0) for x, y, _ in rim] for s in (2 / 3, 1 / 3)]
        fan = rim + [(0.0, 0.0, 0.0), (0.0, 0.0, 20.0)], [t for k in range(8) for t in ((k, 8, (k + 1) % 8), (k, (k + 1) % 8, 9))]
        points = rim + rings[0] + rings[1] + [(0.0, 0.0, 0.0), (0.0, 0.0, -20.0)]
        triangles = []
        for k in range(8):
            a, b = k, (k + 1) % 8
            triangles += [(a, b, b + 8), (a, b + 8, a + 8), (a + 8, b + 8, b + 16), (a + 8, b + 16, a + 16),
                          (a + 16, b + 16, 24), (b, a, 25)]
        names = self.parts(fan, (points, triangles))
        self.run_program("paste", *names, "-o", "pasted.off", "--parents", "p.txt", "--report", "p.json")
        self.run_program("check", "--repaired", *names, "pasted.off", "--parents", "p.txt", "--report", "p.json")
        self.assertLess(json.loads((self.folder / "p.json").read_text())["max_displacement"], 1e-14)

    def test_a_tolerance_changes_valid_surfaces_too(self):
        """A tetrahedron in a box, from one of its corners, is valid: the common triangles have opposite orientations."""
        inside = [(0, 0, 0), (0.5, 0.2, 0.2), (0.2, 0.5, 0.2), (0.2, 0.2, 0.5)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
        names = self.parts(box((0, 0, 0), (1, 1, 1), 1), inside)
        self.run_program("paste", *names, "-o", "pasted.off", "--parents", "p.txt", "--report", "p.json",
                         "--overlap", "new", "--tolerance", "1e-6")
        self.run_program("check", "--repaired", *names, "pasted.off", "--parents", "p.txt", "--report", "p.json")

    def test_a_tolerance_below_the_rounding_of_coordinates_bounds_no_move(self):
        """Floats of one plane, rotated: they are further from each other than the tolerance."""
        parts = [as_float32(rotated(box(low, high, n))) for low, high, n in
                 (((0, 0, 0), (1, 1, 1), 2), ((1, 0, 0), (2, 1, 1), 3))]
        names = self.parts(*parts)
        self.run_program("paste", *names, "-o", "pasted.off", "--parents", "p.txt", "--report", "p.json", "--tolerance", "1e-12")
        self.assertGreater(json.loads((self.folder / "p.json").read_text())["max_displacement"], 1e-12)
        self.run_program("check", "--repaired", *names, "pasted.off", "--parents", "p.txt", "--report", "p.json")

    def write_patches(self, name, part, order):
        """Solids minX and so on of an STL file, in the given order."""
        points, triangles = part
        text = ""
        for patch in order:
            axis = "XYZ".index(patch[3])
            at = (min if patch[:3] == "min" else max)(p[axis] for p in points)
            text += f"solid {patch}\n"
            for t in triangles:
                if all(points[v][axis] == at for v in t):
                    text += "facet normal 0 0 0\nouter loop\n" + "".join("vertex {!r} {!r} {!r}\n".format(*points[v]) for v in t)
                    text += "endloop\nendfacet\n"
            text += f"endsolid {patch}\n"
        self.write(name, text)

    def test_patches_of_one_name_are_told_apart_by_the_part(self):
        order = ["minX", "maxX", "minY", "maxY", "minZ", "maxZ"]
        self.write_patches("a.stl", box((0, 0, 0), (1, 1, 1), 2), order)
        self.write_patches("b.stl", box((1, 0, 0), (2, 1, 1), 2), order[:4] + order[:3:-1])
        *_, report, _ = self.mesh(["a.stl", "b.stl"])
        named = report["names"]["facets"]
        self.assertEqual({named[k] for k in "1234"}, {"minX", "maxX", "minY", "maxY"})  # numbers and names agree
        self.assertEqual([named["5"], named["6"]], ["a.minZ", "a.maxZ"])
        self.assertEqual(sorted(n for k, n in named.items() if int(k) > 6), ["b.maxZ", "b.minZ", "minX+maxX"])
        self.run_program("check", "a.stl", "b.stl", "out.mesh")

    def test_what_patches_share_has_their_names(self):
        order = ["minX", "maxX", "minY", "maxY", "minZ", "maxZ"]
        self.write_patches("a.stl", box((0, 0, 0), (1, 1, 1), 2), order)
        points, triangles = box((1, 0, 0), (2, 1, 1), 3)
        self.write_patches("b.stl", (points, triangles), order)
        text = (self.folder / "b.stl").read_text().replace("minX", "left")
        self.write("b.stl", text)
        *_, report, _ = self.mesh(["a.stl", "b.stl"], "--paste")
        (shared, of), = report["marker_sets"].items()
        named = report["names"]["facets"]
        self.assertEqual([named[str(k)] for k in of], ["maxX", "left"])
        self.assertEqual(named[shared], "maxX+left")
        for ending, name in (".msh", '"maxX+left"'), (".inp", "maxX_left"), (".unv", "maxX_left"):
            self.run_program("mesh", "a.stl", "b.stl", "--paste", "--fill", "-o", "out" + ending)
            self.assertTrue(name in (self.folder / ("out" + ending)).read_text(), ending)

    def test_a_region_and_a_patch_of_one_name_are_both_read_back(self):
        names = self.parts(box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 2))
        for ending in (".unv", ".inp", ".msh", ".med", ".vtu", ".xdmf"):
            out = "out" + ending
            self.run_program("mesh", *names, "--fill", "-o", out)
            found = json.loads(self.run_program("info", "--json", out).stdout)
            regions = {r["name"]: r["volume"] for r in found["regions"]}
            self.assertEqual(set(regions), {"a", "b"}, ending)
            self.assertAlmostEqual(regions["a"], 1, places=12)
            patches = {m["name"].replace("_", "+"): m["triangles"] for m in found["markers"]}
            self.assertEqual(patches, {"a": 40, "b": 40, "a+b": 8}, ending)

    def test_regions_of_one_name_are_told_apart_by_the_part(self):
        for k, name in enumerate("ab"):
            points, triangles = box((k, 0, 0), (k + 1, 1, 1), 2)
            self.write(name + ".msh", f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 {7 + k} "fluid"\n$EndPhysicalNames\n'
                       f"$Nodes\n{len(points)}\n" + "".join(f"{i + 1} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))
                       + f"$EndNodes\n$Elements\n{len(triangles)}\n"
                       + "".join(f"{i + 1} 2 2 0 1 {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(triangles))
                       + "$EndElements\n")
        _, _, tets, report, _ = self.mesh(["a.msh", "b.msh"])
        self.assertEqual({r for _, r in tets}, {7, 8})
        self.assertEqual(report["names"]["regions"], {"7": "a.fluid", "8": "b.fluid"})

    def test_corners_within_rounding_become_the_first(self):
        up = math.nextafter(1, 2)
        a, b = box((0, 0, 0), (1, 1, 1), 3), box((up, 0, 0), (2, 1, up), 4)
        points, _, tets, report, _ = self.mesh(self.parts(a, b), "--paste")
        self.require_vertices(points, a)
        found = volumes(points, tets)
        for region in (1, 2):
            self.assertAlmostEqual(found[region], 1, places=12)
        self.assertAlmostEqual(interface_areas(points, tets)[1, 2], 1, places=12)

    def test_regions_with_the_same_id(self):
        parts = [box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 3)]
        for name, (points, triangles) in zip("ab", parts):
            self.write(name + ".poly", f"{len(points)} 3 0 0\n"
                       + "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))
                       + f"{len(triangles)} 0\n" + "".join(f"1\n3 {a} {b} {c}\n" for a, b, c in triangles)
                       + f"0\n1\n0 {points[0][0] + 0.4} 0.5 0.5 7\n")
        points, _, tets, _, _ = self.mesh(["a.poly", "b.poly"], "--paste")
        self.assertEqual(set(volumes(points, tets)), {7})
        self.assertAlmostEqual(volumes(points, tets)[7], 2, places=12)

    def test_parents_and_report(self):
        a, b = box((0, 0, 0), (1, 1, 1), 4), box((1, 0, 0), (2, 1, 1), 7)
        names = self.parts(a, b)
        self.run_program("paste", *names, "-o", "pasted.off", "--parents", "p.txt", "--report", "p.json")
        report = json.loads((self.folder / "p.json").read_text())
        rows = [r for r in (self.folder / "p.txt").read_text().splitlines() if not r.startswith("#")]
        self.assertEqual(len(rows), report["output"]["facets"])
        shared = [r for r in rows if len(r.split()) == 2]
        self.assertEqual(len(shared), report["shared_facets"])
        n = len(a[1])
        self.assertTrue(all(int(r.split()[0]) < n <= int(r.split()[1]) for r in shared))
        self.assertEqual(report["marker_sets"], {"3": [1, 2]})
        self.assertEqual([p["region"] for p in report["parts"]], [1, 2])

    # --- volumes -----------------------------------------------------------------------------------

    def test_volumes_that_overlap_are_refused(self):
        for name in self.parts(box((0, 0, 0), (1, 1, 1), 2), box((0.7, 0, 0), (2, 1, 1), 2)):
            self.run_program("mesh", name, "-o", name[0] + ".vtu", "--fill")
        for options in (), ("--overlap", "first"), ("--overlap", "last"), ("--overlap", "new"):
            ended = self.run_program("paste", "a.vtu", "b.vtu", "-o", "ab.vtu", *options, expect=4)
            self.assertIn("a.vtu and b.vtu overlap by 0.3 at", ended.stderr)
            self.assertIn("tetrahedra of volumes stay, so that --overlap is for surfaces", ended.stderr)
        self.assertFalse((self.folder / "ab.vtu").exists())

    def test_volumes(self):
        parts = [rotated(box((0, 0, 0), (1, 1, 1), 4)), rotated(box((1, 0, 0), (2, 1, 1), 7))]
        names = self.parts(*parts)
        given = []
        for k, name in enumerate(names, 1):
            self.run_program("mesh", name, "-o", f"{name[0]}.mesh", "--region",
                             ",".join(map(repr, (*rotated(([(k - 0.5, 0.5, 0.5)], []))[0][0], k))))
            given.append(read_mesh(self.folder / f"{name[0]}.mesh"))
        self.run_program("paste", "a.mesh", "b.mesh", "-o", "ab.mesh", "--report", "r.json", "--parents", "p.txt")
        points, triangles, tets = read_mesh(self.folder / "ab.mesh")
        report = json.loads((self.folder / "r.json").read_text())
        found = volumes(points, tets)
        self.assertEqual(set(found), {1, 2})
        for region in (1, 2):
            self.assertAlmostEqual(found[region], 1, places=12)
        self.assertAlmostEqual(interface_areas(points, tets)[1, 2], 1, places=12)
        self.require_vertices(points, *((g[0], None) for g in given))

        def corners(mesh):
            return {frozenset(struct.pack("<3d", *mesh[0][v]) for v in t) for t, _ in mesh[2]}

        def at_interface(mesh):
            """Tetrahedra with a corner on the common face."""
            back = {v for t, _ in mesh[2] for v in t if self.is_on_interface(mesh[0][v])}
            return {frozenset(struct.pack("<3d", *mesh[0][v]) for v in t) for t, _ in mesh[2] if back & set(t)}

        after = corners((points, triangles, tets))
        gone = [corners(mesh) - after for mesh in given]
        self.assertEqual(sum(map(len, gone)), report["tetrahedra"]["replaced"])
        for mesh, lost in zip(given, gone):
            self.assertTrue(lost)
            self.assertLessEqual(lost, at_interface(mesh))

    def test_volumes_that_are_packed_or_told_by_the_option(self):
        for name in self.parts(box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 2)):
            self.run_program("mesh", name, "-o", name[0] + ".msh", "--fill")
            data = (self.folder / (name[0] + ".msh")).read_bytes()
            self.write(name[0] + ".msh.gz", gzip.compress(data))
            self.write(name[0], data)
        self.run_program("paste", "a.msh", "b.msh", "-o", "ab.vtu")
        want = (self.folder / "ab.vtu").read_bytes()
        for given in ("a.msh.gz", "b.msh.gz"), ("a", "b", "--input-format", "msh"):
            said = self.run_program("paste", *given, "-o", "other.vtu").stderr
            self.assertIn("new tetrahedr", said)
            self.assertEqual((self.folder / "other.vtu").read_bytes(), want)

    def test_regions_of_volumes_that_become_one_are_told(self):
        for name in self.parts(box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 2)):
            self.run_program("mesh", name, "-o", name[0] + ".vtu", "--fill")
        said = self.run_program("paste", "a.vtu", "b.vtu", "-o", "ab.vtu").stderr
        self.assertIn("region 1 of a.vtu and of b.vtu is one; to keep them apart", said)
        self.run_program("convert", "b.vtu", "c.vtu", "--name", "region:1=c")  # as the message proposes
        self.assertNotIn("is one", self.run_program("paste", "a.vtu", "c.vtu", "-o", "ac.mesh").stderr)
        points, _, tets = read_mesh(self.folder / "ac.mesh")
        self.assertEqual({r: round(v, 12) for r, v in volumes(points, tets).items()}, {1: 1, 2: 1})

    def test_names_of_regions_never_come_to_others(self):
        """A mesh of the pasted file numbers regions by its triangles: c touches b, and d touches a."""
        boxes = [box((0, 0, 0), (1, 1, 1), 2), box((1, 0, 0), (2, 1, 1), 2), box((2, 0, 0), (3, 1, 3), 2), box((0, 1, 0), (1, 2, 1), 2)]
        names = self.parts(*boxes)
        said = self.run_program("paste", *names, "-o", "all.vtu", "--name", "region:9=x").stderr
        self.assertIn("5 names of regions are left out, since a mesh of all.vtu numbers its regions anew; `mesh --paste`", said)
        self.run_program("mesh", "all.vtu", "-o", "v.vtu", "--fill", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["names"]["regions"], {})
        *_, report, _ = self.mesh(names, "--paste")
        self.assertEqual(report["names"]["regions"], {"1": "a", "2": "b", "3": "c", "4": "d"})
        self.assertNotIn("left out", self.run_program("paste", *names, "-o", "all.vtu", "-q").stderr)

    @staticmethod
    def is_on_interface(p):
        face = rotated(([(1, 0, 0), (1, 1, 0), (1, 0, 1)], []))[0]
        n = cross(minus(face[1], face[0]), minus(face[2], face[0]))
        return abs(dot(minus(p, face[0]), n)) < 1e-12


if __name__ == "__main__":
    main()
