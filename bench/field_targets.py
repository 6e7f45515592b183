"""The targets of meshes with field points, computed from the rows of field.py: surface -> mesher -> row."""
import json
from statistics import mean, median

from target import Target, table

OURS, HXT, GMSH, TETGEN = "Holdfast", "Gmsh HXT", "Gmsh Delaunay", "TetGen"
PEERS = (HXT, GMSH, TETGEN, "Netgen")
BEST = 6 / 8  # share of surfaces with the best least angle
LIKE_HXT = 0.2  # by which the number of tetrahedra may differ
EVEN = 2.5  # factor by which sizes that count as the same may differ
THREADS, IN_PARTS = 1.5, 60_000  # speed-up on two threads, from so many tetrahedra on


def pairs(results, peer, ours=OURS):
    """(row of Holdfast, or of another, row of a peer) of the surfaces that both meshed."""
    return [(rows[ours], rows[peer]) for rows in results.values()
            if peer in rows and "failed" not in rows[ours] and "failed" not in rows[peer]]


def least_angle(results):
    """A surface that Holdfast does not mesh counts against it, one that a peer does not mesh for Holdfast."""
    best = sum("failed" not in rows[OURS] and all(
        "failed" in rows[peer] or rows[peer]["min_dihedral"] <= rows[OURS]["min_dihedral"] for peer in PEERS if peer in rows)
        for rows in results.values())
    return Target("Least dihedral angle at least the best of the others' on 6 of 8 surfaces", f"on {best} of {len(results)}",
                  best >= BEST * len(results) if results else None)


def small_angles(results, k):
    """Each peer on the surfaces that it meshed; the best is the one with the lowest mean."""
    shares = {peer: tuple(mean(row["below"][k] for row in column) for column in zip(*both))
              for peer in PEERS if (both := pairs(results, peer))}
    text = f"Mean share of dihedral angles below {10 * (k + 1)} degrees at most the best of the others'"
    if not shares:
        return Target(text, "not measured", None)
    peer = min(shares, key=lambda p: shares[p][1])
    ours, theirs = shares[peer]
    return Target(text, f"{ours:.2g} % ({peer} {theirs:.2g} %)", ours <= theirs)


def counts(text, results, peer, ours=OURS):
    """Ratios of numbers of tetrahedra to those of a peer; a target for HXT, which reads sizes as Holdfast does."""
    ratios = [mine["tetrahedra"] / theirs["tetrahedra"] for mine, theirs in pairs(results, peer, ours)]
    if not ratios:
        return Target(text, "not measured", None)
    within = sum(abs(r - 1) <= LIKE_HXT for r in ratios)
    return Target(text, f"median {median(ratios):.2f}, {min(ratios):.2f} to {max(ratios):.2f}; within on {within} of {len(ratios)}",
                  within == len(ratios) if peer == HXT else None)


def sizes(results, spreads):
    """If the sizes of a surface differ, each mesher interpolates them differently; they are the same for all only if they
    are nearly constant."""
    even = {name: rows for name, rows in results.items() if spreads[name] <= EVEN}
    aim = f"Number of tetrahedra within {100 * LIKE_HXT:.0f} % of {HXT}'s"
    return [counts(aim, results, HXT), counts(f"The same, where edges of the surface differ by at most {EVEN} times (95th over 5th percentile)", even, HXT),
            *(counts(f"Number of tetrahedra over {peer}'s (no target)", results, peer) for peer in PEERS if peer != HXT),
            counts(f"{HXT}'s number over {GMSH}'s, for comparison", results, GMSH, HXT)]


def speed(results, peer, times, per_tetrahedron=False):
    """Seconds of meshing; per tetrahedron if the other program makes far fewer of them."""
    ratios = [theirs["seconds"] / ours["seconds"] * (ours["tetrahedra"] / theirs["tetrahedra"] if per_tetrahedron else 1)
              for ours, theirs in pairs(results, peer)]
    text = f"At least {f'{times} times ' if times > 1 else ''}as fast as {peer}" + (", a tetrahedron" if per_tetrahedron else "")
    if not ratios:
        return Target(text, "not measured", None)
    fast = sum(r >= times for r in ratios)
    return Target(text, f"on {fast} of {len(ratios)}; median {median(ratios):.2f}, least {min(ratios):.2f}", fast == len(ratios))


def on_two_threads(threads):
    """`threads`: surface -> seconds on one and on two threads, and how many tetrahedra that makes."""
    large = [row["one"] / row["two"] for row in threads.values() if "failed" not in row and row["tetrahedra"] >= IN_PARTS]
    text = f"Two threads: at least {THREADS} times from {IN_PARTS:,} tetrahedra on"
    if not large:
        return Target(text, "not measured", None)
    fast = sum(r >= THREADS for r in large)
    return Target(text, f"on {fast} of {len(large)}; median {median(large):.2f}, least {min(large):.2f}", fast == len(large))


def same_files(threads):
    told = [row["same"] for row in threads.values() if "failed" not in row]
    return Target("Two threads: the same mesh, bit for bit", f"on {sum(told)} of {len(told)}", all(told) if told else None)


def lines(results, threads, spreads, extra=()):
    """The table; surfaces of the names in `extra` count on two threads only. `spreads`: surface -> how far its sizes differ."""
    compared = {name: rows for name, rows in results.items() if name not in extra}
    return table([least_angle(compared), *(small_angles(compared, k) for k in range(3)), *sizes(compared, spreads),
                  speed(compared, TETGEN, 2, per_tetrahedron=True), speed(compared, GMSH, 2), speed(compared, HXT, 1),
                  on_two_threads(threads), same_files(threads)])


def keep(path, program, told):
    """For docs/benchmarks.md; `program` is a digest of the one that was measured."""
    path.write_text(json.dumps({"program": program, "lines": told}, indent=1), encoding="utf-8")


def kept(path, program):
    if not path.exists():
        return ["Not measured yet: `make field`."]
    told = json.loads(path.read_text(encoding="utf-8"))
    return told["lines"] if told["program"] == program else ["Measured with another build of Holdfast.", "", *told["lines"]]
