"""docs/paper.md: every figure and table of the paper under a heading of its own."""
import complexity
import literal_part
import models
import plane_pictures
import results
import sections
import space_pictures

PARTS = ("results", "pictures", "complexity", "literal")
PROGRAMS = {"literal": ("holdfast", "literal")}

CAPTIONS = {
    1: ("Polygons that are convex, not convex, and with holes", plane_pictures.figure_1, "svg",
        "`holdfast plane --method ears`. Links join the parts of an outline (§2.1.3), before ears are cut off."),
    2: ("Swaps until a missing edge stands", plane_pictures.figure_2, "svg",
        "`--method swaps`: what `--stop-after delaunay`, `--stop-after swap=K` and the whole run write."),
    3: ("Points where a missing edge crosses the mesh", plane_pictures.figure_3, "svg",
        "`--method partition`: `--stop-after delaunay`, `--stop-after partition`, and the end. The paper's third drawing stops after the first point; ours has all of them."),
    4: ("The worst case in the plane", plane_pictures.figure_4, "svg",
        "The quadrilateral of §2.4, its Delaunay edges and the sought segments (dashed), stretched. Measured [below](#complexity-in-the-plane)."),
    5: ("Points beget points", plane_pictures.figure_5, "svg",
        "Partition alone of none, one, two and three of the segments, from the top."),
    6: ("Schönhardt's prism", space_pictures.figure_6, "png",
        "A straight prism has three tetrahedra, unless its diagonals run all one way: then, and when it is turned, a point is needed. Right: its tetrahedra moved apart."),
    7: ("Chazelle's polyhedron", space_pictures.figure_7, "png",
        "From above, from below, and a cut through its tetrahedra. The height is not to scale, and the notches are thinner than the paper draws them."),
    8: ("Points on an edge of two facets, before and after elimination", space_pictures.figure_8, "png",
        "Left: the sub-facets of both facets (`--stop-after partition --without flips`); points on the edge and in the facets in red. Right: the two facets in the end."),
    9: ("The edges that pierce a facet", space_pictures.figure_9, "svg",
        "One of the large triangles in Figure 13's box, n = 6, m = 1, in its plane. The flood of §6.1 (`src/enforce/facet_section.cpp`) finds all edges that pierce it, of which each gets a point (red); points on its sides are blue."),
    10: ("Insertion by a cavity that takes in more", literal_part.figure_10, "png",
         "By `bench/literal` (§6.2), in Fig. 13's box: the tetrahedra that a local split replaces; in orange those whose spheres hold the point, in red those that "
         "do not break the Delaunay criterion, but whose faces the point sees; the star that replaces all of them. The paper draws it in the plane."),
    12: ("A swap that would repeat a triangle", literal_part.figure_12, "svg",
         "The paper's example, with the signs computed. `src/untangle/swap.cpp` refuses an exchange whose edges or faces stand already, whatever the signs."),
    11: ("Edges of two and of three facets", space_pictures.figure_11, "png",
         "As Figure 8, for two and for three facets at the edge."),
    13: ("The worst case in space", space_pictures.figure_13, "png",
         "`examples/make_paper.py worst`: the surface, and the prescribed triangles inside above its lower face. Measured [below](#complexity-in-space)."),
}
MODELS_OF = {m.figure: m for m in models.MODELS}
VIEWS = {14: "The surface; the two large triangles over the bottom; two cuts through the tetrahedra of our default options.",
         15: "The surface with its pencils of edges; the two large triangles, which touch the sides; two cuts."}


def told_in_words(told):
    def word(value):
        return ", ".join(f"{k} {word(v)}" for k, v in value.items()) if isinstance(value, dict) else str(value)

    return "; ".join(f"{k}: {word(v)}" for k, v in told.items() if k != "level" and v != 0)


def picture(options, folder, rows, number, title, draw, ending, caption):
    path = options.out / "paper" / f"figure-{number}.{ending}"

    def drawn():
        return draw(options, folder, path)

    if not path.exists():
        rows.rows.pop(f"figure {number}", None)
    told = rows.get(f"figure {number}", drawn)
    words = told_in_words(told)
    return [f"### Figure {number}", "", f"*{title}.* {caption}" + (f" Counted: {words}." if words else ""), "",
            f"![Figure {number}](paper/{path.name})", ""]


def figure(options, folder, rows, number):
    if number in MODELS_OF:
        model = MODELS_OF[number]
        caption = VIEWS.get(number, f"In place of {model.name}: {model.what}, by `{models.command(model)}`. The surface; its edges; two cuts through "
                                    "the tetrahedra of our default options.")
        return picture(options, folder, rows["pictures"], number, model.name if number > 15 else model.what.capitalize(),
                       space_pictures.figure_of_model(model), "png", caption)
    title, draw, ending, caption = CAPTIONS[number]
    return picture(options, folder, rows["pictures"], number, title, draw, ending, caption)


def academic(told, number):
    model = MODELS_OF[number]
    return [*results.table_1(told, [model]), "", *results.table_2(told, [model]), "", *results.verdicts(told, [model]), ""]


def plane(options, folder, rows):
    lines = ["## The plane (§2)", ""]
    for number in range(1, 6):
        lines += figure(options, folder, rows, number)
    table, _ = complexity.plane_lines(options, folder, rows["complexity"])
    sums, _ = complexity.equation_lines(options, folder, rows["complexity"])
    return lines + [
        "### Complexity in the plane", "",
        "The quadrilateral of Figure 4 with n = m. Columns are n; a series ends with the first case that takes longer than "
        f"{options.most_seconds:g} s of the processor, of partition alone {options.most_seconds_alone:g} s, or with one that takes over "
        f"{complexity.PATIENCE} times as long, or over {complexity.MEMORY / 2**30:.0f} GiB, which then stands in place of a number. The power fits the larger half of the sizes. Points are those added by partition (temporarily, with elimination).", "",
        *table, "",
        "By the power in the given order, n = 1,024 would have some 600 million points.", "",
        "With elimination in the given order, the paper's n^2 shows. In random order and by halving far fewer points are made, about 2.5 n log2 n by halving: "
        "the first segments part the edges, and a later one crosses those of its part alone. Without elimination, halving also lowers the power, since "
        "only half of a point's new edges lie on the side of a later segment. Swaps: 2n edges cross each of the m segments, and random ones may leave their number as it was.", "",
        "Equation (1) assumes that the first segment crosses a pencil of n edges, that segments are laid from the top, and that no point goes. "
        "Then each segment has n points more than the one before. `--method partition --stop-after partition` on that case, n = 1,024:", "",
        *sums, "",
        "The difference comes from the edges at the ends of the segments, which the equation leaves out.", "",
        "Ears (§2.1), in seconds of the processor for the whole program, by n; r reflex vertices. The paper's n (1 + r) tests every reflex vertex against every "
        "ear; ours looks up those near in boxes along a Hilbert curve, which is near linear, on a comb, too.", "",
        *complexity.ears_lines(options, folder, rows["complexity"]), ""]


def space(options, folder, rows):
    lines = ["## Existence in space (§3)", ""]
    for number in (6, 7):
        lines += figure(options, folder, rows, number)
    lines += ["Tetrahedra of Chazelle's polyhedron with a gap of 1/(2 n²), by n:", "",
              *complexity.chazelle_lines(options, folder, rows["complexity"]), "",
              "All are above n²; at these sizes the surface itself, whose triangles grow as n, still lowers the power.", ""]
    lines += ["## Partition and elimination (§5, §6)", ""]
    for number in range(8, 13):
        lines += figure(options, folder, rows, number)
    lines += ["### The method, literally", "",
              "`bench/literal` does what §5 and §6 say in the order in which they say it, without flips but where it says so: all segments are partitioned, then all facets; the points "
              "of facets are taken off, then those of segments with 1, 2, 3 or more facets standing; each point becomes as many as its ball has parts, all left in "
              "its place; null and negative tetrahedra are counted; `untangle` makes them positive, and `check` looks at the result. Nothing takes the copies out "
              "again, so that the meshes have more points than those of `holdfast mesh`.", "",
              *literal_part.lines(options, folder, rows["literal"]), ""]
    table, _ = complexity.space_lines(options, folder, rows["complexity"])
    return lines + ["## Complexity (§7)", "", *figure(options, folder, rows, 13), "### Complexity in space", "",
                    "`examples/make_paper.py worst -n N -m N --height 0.05`, `--without flips`. Columns are n = m; the counts are those of partition points, all of them "
                    "made whether or not they stay. Edges alone are counted in runs that partition the facets as well, which is what ends the series. Elimination "
                    "after each constraint (the paper's remark at the end of §7) takes the power from above four to two. Series end as in the plane, of partition alone "
                    f"after {options.most_seconds_space:g} s.", "", *table, ""]


def examples(options, folder, rows):
    told = {name: results.columns(row) for name, row in results.rows_of(options, folder, rows["results"]).items()}
    concrete = [m for m in models.MODELS if m.figure > 15]
    lines = ["## Application examples (§8)", ""]
    for number in (14, 15):
        lines += [*figure(options, folder, rows, number), *academic(told, number)]
    lines += ["### Table I", "", *results.table_1(told, concrete), "", "### Table II", "", *results.table_2(told, concrete), "",
              *results.verdicts(told, concrete), "", *results.why(told), ""]
    for number in (16, 17, 18, 19):
        lines += figure(options, folder, rows, number)
    return lines


def write(options, folder, rows, head):
    return ["# The paper, measured", "", f"{head}.", "",
            "P.L. George, H. Borouchaki, E. Saltel, \"'Ultimate' robustness in meshing an arbitrary polyhedron\" (Int. J. Numer. Meth. Engng 2003): "
            "every figure drawn again from a run of Holdfast, every number of its examples beside ours. `make paper` writes this page and its pictures.", "",
            "## Sections", "", *sections.table(), "",
            *plane(options, folder, rows), *space(options, folder, rows), *examples(options, folder, rows)]
