"""Where each section of the paper is in the source, and which test shows it. tests/paper.py fails when one of these is gone."""

SECTIONS = (
    ("2.1", "A naive construction: ears", ("src/plane/ears.cpp",), ("tests/cli/plane_test.py",)),
    ("2.1.1", "Convex domain", ("src/plane/ears.cpp",), ("tests/cli/plane_test.py",)),
    ("2.1.2", "Non-convex domain; the second construction", ("src/plane/ears.cpp",), ("tests/cli/plane_test.py",)),
    ("2.1.3", "Arbitrary domain: parts linked to each other", ("src/plane/sweep.cpp", "src/plane/faces.cpp"), ("tests/cli/plane_test.py",)),
    ("2.2", "Delaunay, then swaps at random", ("src/plane/delaunay.cpp", "src/plane/swaps.cpp"), ("tests/cli/plane_test.py",)),
    ("2.3", "Partition, then removal of its points", ("src/plane/partition.cpp",), ("tests/cli/plane_test.py",)),
    ("2.4", "Complexity in the plane", ("src/numbers/halving.h", "bench/paper/complexity.py"), ("tests/cli/plane_test.py",)),
    ("3", "What a valid surface is", ("src/surface/diagnose.cpp",), ("tests/unit/surface/surface_defects_test.cpp",)),
    ("3.1", "Schönhardt's prism", ("examples/make_hard.py",), ("tests/unit/api/api_test.cpp",)),
    ("3.2", "Chazelle's polyhedron", ("examples/make_hard.py",), ("tests/cli/cli_test.py",)),
    ("3.3", "Arbitrary polyhedron", ("src/api/attempt.cpp",), ("tests/random/random_complexes.cpp",)),
    ("4", "Delaunay and swaps of faces and edges", ("src/recover/recover.cpp", "src/recover/flipper.cpp"), ("tests/unit/recover/recover_test.cpp",)),
    ("5", "The method: partition, then elimination", ("src/enforce/enforce.cpp", "src/enforce/partition.cpp"), ("tests/unit/recover/enforce_test.cpp",)),
    ("5.1", "Delaunay triangulation in a box", ("src/delaunay/delaunay.cpp", "src/delaunay/box.cpp"), ("tests/unit/recover/delaunay_test.cpp",)),
    ("5.2", "Partition of segments, then of facets", ("src/enforce/partition_segment.cpp", "src/enforce/partition_facet.cpp"),
     ("tests/unit/recover/constraint_partition_test.cpp",)),
    ("5.3", "Elimination of points", ("src/enforce/cut_and_cone.cpp", "src/enforce/collapse_within.cpp", "src/mesh/kernel.cpp"), ("tests/unit/recover/eliminate_test.cpp",)),
    ("6.1", "Intersections: the walk along a segment, the flood of a facet", ("src/enforce/partition_segment.cpp", "src/enforce/facet_section.cpp"),
     ("tests/unit/recover/constraint_partition_test.cpp",)),
    ("6.2", "Insertion of points", ("src/enforce/partition_segment.cpp", "src/enforce/partition_facet.cpp", "src/refine/point_cavity.cpp", "bench/literal/insert.cpp"), ("tests/unit/refine/field_test.cpp",)),
    ("6.3.1", "Edges of two or more facets", ("src/enforce/cut_and_cone.cpp",), ("tests/unit/recover/eliminate_test.cpp",)),
    ("6.3.2", "Edges of one facet", ("src/enforce/fictitious_cut.cpp",), ("tests/unit/recover/eliminate_test.cpp",)),
    ("6.4", "Null and negative elements", ("src/untangle/make_positive.cpp", "src/untangle/swap.cpp", "src/untangle/relocate.cpp", "src/suppress/suppress.cpp",
      "src/optimise/optimise.cpp"), ("tests/unit/optimise/untangle_test.cpp", "tests/unit/optimise/untangle_swap_test.cpp")),
    ("6.5", "Robustness", ("src/exact/predicates.cpp",), ("tests/unit/exact/exact_predicates_test.cpp",)),
    ("7", "Complexity in space", ("bench/paper/complexity.py",), ("tests/cli/cli_test.py",)),
    ("8", "The quality Q, and its Target", ("src/mesh/quality.cpp", "src/mesh/target_quality.cpp"), ("tests/unit/mesh/quality_test.cpp",)),
    ("8.1", "Two academic cases", ("examples/make_paper.py",), ("tests/cli/cli_test.py",)),
    ("8.2", "Concrete examples", ("bench/paper/models.py", "bench/paper/results.py"), ("tests/paper.py",)),
    ("9", "Applications: field points, STL, self-intersection, conformal surfaces, pasting",
     ("src/refine/field_points.cpp", "src/io/stl.cpp", "src/surface/diagnose.cpp", "src/api/repair.cpp", "src/api/paste.cpp"),
     ("tests/unit/refine/field_test.cpp", "tests/unit/surface/surface_intersect_test.cpp", "tests/unit/repair/repair_promise_test.cpp", "tests/cli/paste_test.py")),
)


def link(path):
    return f"[{path.rsplit('/', 1)[-1]}](../{path})"


def table():
    lines = ["| § | what | source | test |", "|---|---|---|---|"]
    for number, what, sources, tests in SECTIONS:
        lines.append(f"| {number} | {what} | {', '.join(map(link, sources))} | {', '.join(map(link, tests))} |")
    return lines
