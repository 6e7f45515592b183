"""The targets, and whether they are met: computed from the figures of the parts (None for a part that is not measured)."""
from flips import WITHIN
from mesh import LARGE, PROMISED, VAST
from target import Target, missing

CGAL, TETGEN = 1.9, 2.3  # times faster at Delaunay
PLANE = 2  # times CGAL's speed
READING, VALIDATION = 0.3, 0.15  # shares of the Delaunay time, and of the whole
THREADS = 1.6
FIG15 = 1.0  # seconds
FLAT = 1.05  # exponent: a tenth more per tetrahedron for ten times as many, since caches and page tables are limited
MACHINE = 24  # GiB


def below_tetgen(text, ratios):
    """The ratio of peak memory to TetGen's, and whether the target is met; programs that need little are not distinguished."""
    return (f"{text} of TetGen's", max(ratios) < 1) if ratios else ("too little to tell", None)


def of_delaunay(sets):
    texts = (f"Delaunay at least {CGAL} times as fast as CGAL", f"Delaunay at least {TETGEN} times as fast as TetGen 1.5",
             f"Two threads: at least {THREADS} times on Delaunay of a million points", "Two threads: the same Delaunay mesh, bit for bit",
             "Delaunay: memory below TetGen's")
    if not sets:
        return missing(*texts)

    def each(key):
        return ", ".join(f"{s[key]:.2f} ({s['points']:,})" for s in sets if s[key] is not None)

    cube = sets[0]
    memory = [s["memory"] for s in sets if s["memory"]]
    return [Target(texts[0], f"{each('cgal')}, for so many points", min(s["cgal"] for s in sets) >= CGAL),
            Target(texts[1], each("tetgen"), min(s["tetgen"] for s in sets) >= TETGEN),
            Target(texts[2], f"{cube['threads']:.2f} ({cube['points']:,})", cube["threads"] >= THREADS),
            Target(texts[3], f"{sum(s['same'] for s in sets)} of {len(sets)} sets", all(s["same"] for s in sets)),
            Target(texts[4], *below_tetgen(each("memory"), memory))]


def of_surfaces(figures):
    texts = (f"Fill at least {PROMISED} times as fast as `tetgen -pY` on generated surfaces of {VAST // 1000}k triangles and more",
             f"Validation below {100 * VALIDATION:.0f} % of the whole",
             f"Reading 1 million triangles of binary STL below {READING} of the Delaunay time",
             "Fill: memory below TetGen's", f"Two threads: at least {THREADS} times on validation",
             "Two threads: the same filled mesh, bit for bit")
    if not figures:
        return missing(*texts)

    def each(key, pattern="{:.2f}", factor=1):
        return ", ".join(f"{pattern.format(factor * f[key])} ({f['triangles']:,})" for f in figures if f[key] is not None)

    # A torus of about 100,000 triangles has a few less.
    vast = [f for f in figures if f["triangles"] >= 0.99 * VAST]
    ratios = [f["tetgen"] for f in vast if f["tetgen"]]
    memory = [f["memory"] for f in figures if f["memory"]]
    last = figures[-1]
    return [Target(texts[0], each("tetgen"), min(ratios) >= PROMISED if ratios else None),
            Target(texts[1], each("validate", "{:.1f} %", 100), max(f["validate"] for f in figures) < VALIDATION),
            Target(texts[2], f"{last['read']:.2f} ({last['triangles']:,})", last["read"] < READING),
            Target(texts[3], *below_tetgen(each("memory"), memory)),
            Target(texts[4], each("threads"), last["threads"] >= THREADS),
            Target(texts[5], f"{sum(f['same'] for f in figures)} of {len(figures)} surfaces", all(f["same"] for f in figures))]


def of_corpus(f):
    texts = (f"Fill at least {PROMISED} times as fast as `tetgen -pY` on the corpus's surfaces of {VAST // 1000}k triangles and more",
             f"Fill never slower than `tetgen -pY` on the corpus above {LARGE:,} triangles")
    if not f or not f["large"]:
        return missing(*texts)
    vast = (f"least {f['vast_least']:.2f}, median {f['vast_median']:.2f}; below {PROMISED} on {f['vast_below']} of {f['vast']} "
            f"({f['vast_in_corpus']} in the corpus)") if f["vast"] else "none of that size"
    slower = (f"slower on {f['slower']} of {f['large']} ({f['large_in_corpus']} in the corpus); CPU time over TetGen's: "
              f"median {f['median']:.2f}, most {f['worst']:.2f}")
    return [Target(texts[0], vast, f["vast_below"] == 0 if f["vast"] else None), Target(texts[1], slower, f["slower"] == 0)]


def of_fig15(f):
    text = f"The Fig. 15 case in less than {FIG15:.0f} s (311 s in the paper)"
    return [Target(text, f"{f['seconds']:.2f} s" + (f" (TetGen {f['tetgen']:.2f} s)" if f["tetgen"] else ""), f["seconds"] < FIG15)] \
        if f else missing(text)


def of_flips(f):
    text = f"`--without flips` within {WITHIN} times the run with flips, on real parts"
    if not f:
        return missing(text)
    failed = f", {f['failed']} not meshed" if f["failed"] else ""
    return [Target(text, f"median {f['median']:.2f}; above {WITHIN} on {f['above']} of {f['surfaces']} ({f['in_corpus']} in the corpus)"
                   f"{failed}; most {f['worst']:.1f}", f["above"] + f["failed"] == 0)]


def flatness(tetrahedra, seconds, exponent):
    """Nanoseconds per tetrahedron at each size, and the exponent of their growth."""
    each = ", ".join(f"{1e9 * s / t:,.0f}" for t, s in zip(tetrahedra, seconds))
    return f"{each} ns from {tetrahedra[0]:,} to {tetrahedra[-1]:,} tetrahedra: power {exponent:.2f}"


def of_growth(f):
    texts = ("Growth: time a tetrahedron of Delaunay flat from 10^4 to 10^7 tetrahedra", f"10^7 points triangulated in {MACHINE} GiB")
    if not f:
        return missing(*texts)
    d, many = f["delaunay"], f["delaunay"]["many"]
    flat = [Target(f"{texts[0]} (power at most {FLAT})", flatness(d["tetrahedra"], d["seconds"], d["exponent"]), d["exponent"] <= FLAT)] \
        if "exponent" in d else missing(texts[0])
    return [*flat, Target(texts[1], f"{many['points']:,} points: {many['tetrahedra']:,} tetrahedra in {many['seconds']:.1f} s, "
                          f"{many['peak'] / 2**30:.2f} GiB", many["peak"] < MACHINE * 2**30)]


def of_recovery(figures):
    targets = []
    for name, title in (("plates", "plates with holes"), ("parts", "housings side by side")):
        text = f"Growth: time a tetrahedron of recovery flat from 10^4 to 10^7 tetrahedra, {title}"
        f = figures and figures[name]
        targets += [Target(f"{text} (power at most {FLAT})", flatness(f["tetrahedra"], f["recovery"], f["exponent"]),
                           f["exponent"] <= FLAT)] if f else missing(text)
    return targets


def of_profile(figures):
    """By stage, of the largest surface that was measured."""
    text = "A profile of where the time goes, by stage"
    return [Target(text, "below, for large surfaces, Fig. 15 and recovery", True)] if figures.get("surfaces") else missing(text)


def of_native(figures):
    text = "-march=native, measured apart: portable time over native"
    if not figures:
        return missing(text)
    same = "the same meshes" if all(f["same"] for f in figures) else "meshes DIFFER"
    return [Target(text, ", ".join(f"{f['ratio']:.2f} ({f['task']})" for f in figures) + f"; {same}", None)]


def of_plane(f):
    texts = (f"Plane: constrained Delaunay of 10^6 points with 10^5 segments at least {PLANE:.0f} times as fast as CGAL",
             "Plane: ears at least as fast as earcut", "Plane: ears without a failure on hard polygons")
    if not f:
        return missing(*texts)
    ears = ", ".join(f"{e['ratio']:.2f} ({e['what']})" for e in f["ears"])
    failed = ", ".join(f"{name} {count}" for name, count in f["failed"].items())
    return [Target(texts[0], f"{f['cgal']:.2f}", f["cgal"] >= PLANE),
            Target(texts[1], ears, min(e["ratio"] for e in f["ears"]) >= 1 if f["ears"] else None),
            Target(texts[2], f"failures: {failed}", f["failed"]["holdfast"] == 0)]


def targets(figures):
    """Of all parts; `figures` maps the names of measured parts to their figures."""
    get = figures.get
    return [*of_delaunay(get("delaunay")), *of_surfaces(get("surfaces")), *of_corpus(get("mesh")), *of_fig15(get("fig15")),
            *of_flips(get("flips")), *of_growth(get("growth")), *of_recovery(get("recovery")), *of_profile(figures),
            *of_native(get("native")), *of_plane(get("plane"))]
