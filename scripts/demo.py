"""The demonstration behind `make demo`: makes surfaces, fills them with tetrahedra, checks every mesh.

    demo.py HOLDFAST FOLDER
"""
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"


def run(*command):
    shown = ["python3" if word == sys.executable else os.path.relpath(word) if isinstance(word, Path) else word
             for word in command]
    print("$ " + shlex.join(shown), flush=True)
    code = subprocess.run(command, check=False).returncode
    if code != 0:
        sys.exit(f"demo: this command ended with {code}")


def show(holdfast, folder, title, name, generate):
    print(f"\n== {title}")
    surface, volume = folder / name, folder / Path(name).with_suffix(".vtu")
    report_file = folder / Path(name).with_suffix(".json")
    run(sys.executable, EXAMPLES / generate[0], *[surface if word == "@" else word for word in generate[1:]])
    run(holdfast, "mesh", surface, "-o", volume, "--fill", "--report", report_file)
    run(holdfast, "check", surface, volume)
    report = json.loads(report_file.read_text())
    before, added = report["delaunay"], report["partition"]
    return [name, report["input"]["facets"], f"{before['missing_segments']} + {before['missing_facets']}",
            added["segment_points"] + added["facet_points"], report["steiner"]["count"], report["mesh"]["tetrahedra"],
            f"{report['seconds']['total']:.2f}"]


def main(holdfast, folder):
    folder.mkdir(parents=True, exist_ok=True)
    rows = [["surface", "triangles", "missing*", "points on the way", "points added", "tetrahedra", "seconds"],
            show(holdfast, folder, "A flanged bearing housing, as a CAD system exports it", "housing.stl",
                 ["make_part.py", "@"]),
            show(holdfast, folder, "Schönhardt's prism: eight triangles, impossible without an added point",
                 "schonhardt.off", ["make_hard.py", "schonhardt", "@", "--twist", "50"]),
            show(holdfast, folder, "Chazelle's polyhedron: needs many added points", "chazelle.off",
                 ["make_hard.py", "chazelle", "@", "-n", "3"])]
    print("\nEvery mesh keeps every triangle of its surface; `holdfast check` proved it above.\n")
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("  ".join(str(cell).ljust(w) if i == 0 else str(cell).rjust(w)
                        for i, (cell, w) in enumerate(zip(row, widths))))
    print("* segments and triangles of the surface that a Delaunay triangulation lacks")
    print(f"\nThe meshes are in {folder}: open housing.vtu in ParaView (filter Clip shows the inside).")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]))
