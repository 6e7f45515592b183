"""Every format into every program that reads it, and problems solved by them: `make solvers` writes docs/solvers.md.

Usage: run.py PROGRAM [--write FILE] [--short] [--only NAME]. Without --write it prints; exit code 1 if anything is wrong,
77 if no program is installed. --short leaves the problems out and takes one program a format.
"""
import argparse
import importlib.util
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import assembly  # noqa: E402

PYTHON = "/usr/bin/python3"
# What each program reads; the first of a row is the one of the short form.
READS = {
    "vtu": ["meshio", "vtk", "sfepy"],
    "vtm": ["vtk"],
    "vtk": ["meshio", "vtk"],
    "msh": ["gmsh", "meshio", "dolfinx", "getfem"],
    "msh2": ["meshio", "gmsh", "openfoam", "freefem", "getfem"],
    "msh binary": ["gmsh", "meshio", "dolfinx"],
    "msh2 binary": ["meshio", "gmsh"],
    "mesh": ["meshio", "freefem", "gmsh"],
    "meshb": ["freefem"],
    "inp": ["ccx", "meshio"],
    "unv": ["openfoam", "gmsh"],
    "bdf": ["meshio", "gmsh"],
    "su2": ["meshio"],
    "vol": ["meshio", "netgen"],
    "xdmf": ["meshio", "dolfinx"],
    "openfoam": ["openfoam"],
}
PROGRAMS = ["meshio", "vtk", "gmsh", "dolfinx", "sfepy", "getfem", "freefem", "netgen", "openfoam", "ccx"]
LEAST = {"openfoam": "checkMesh", "freefem": "FreeFem++", "gmsh": "gmsh", "ccx": "ccx"}
MODULE = {"meshio": "meshio", "vtk": "vtk", "dolfinx": "dolfinx", "sfepy": "sfepy", "getfem": "getfem", "netgen": "netgen"}


def is_installed(name):
    if name in LEAST:
        return shutil.which(LEAST[name]) is not None
    return subprocess.run([PYTHON, "-c", f"import importlib.util as u, sys; import site; "
                           f"sys.exit(u.find_spec('{MODULE[name]}') is None)"], check=False).returncode == 0


def write(program, folder, kind):
    form, *options = kind.split()
    if form == "openfoam":
        assembly.mesh(program, folder, folder / "case" / "constant" / "polyMesh")
        return folder / "case"
    path = folder / f"{kind.replace(' ', '_')}.{'msh' if form == 'msh2' else form}"
    arguments = (["--format", "msh2"] if form == "msh2" else []) + (["--binary"] if options else [])
    assembly.mesh(program, folder, path, *arguments)
    return path


def with_numbers(found):
    """The answer with the ids as numbers again, which JSON has as text."""
    return {key: {int(k): v for k, v in value.items()} if key == "volumes" else value for key, value in found.items()}


def near(a, b):
    return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9)


def faults(found, counts, kind):
    """What of the answer is wrong, one string each."""
    names = {name.lower(): i for i, name in assembly.MARKERS.items()}
    for key in ("points", "tetrahedra"):
        if key in found and found[key] != counts[key]:
            yield f"{key} {found[key]} for {counts[key]}"
    if "volumes" in found and kind != "su2":
        for region, volume in assembly.VOLUMES.items():
            if not near(found["volumes"].get(region, 0), volume):
                yield f"volumes {found['volumes']}"
                break
    if "volume" in found and not math.isclose(found["volume"], 6, rel_tol=1e-5):
        yield f"volume {found['volume']}"
    if "volumes_by_name" in found and {n: round(v, 5) for n, v in found["volumes_by_name"].items()} != \
            {assembly.REGIONS[i]: v for i, v in assembly.VOLUMES.items()}:
        yield f"volumes {found['volumes_by_name']}"
    if "force" in found and (found["force"] is None or not math.isclose(abs(found["force"]), 2, rel_tol=1e-4)):
        yield f"the pressure on 'outlet' is {found['force']} on 'inlet'"
    if "areas" in found:
        areas = {names.get(k, int(k) if k.lstrip("-").isdigit() else k): v for k, v in
                 ((str(k).lower(), v) for k, v in found["areas"].items())}
        wanted = {i: a for i, a in assembly.AREAS.items() if i != 7 or 7 in areas or kind not in ("su2", "openfoam", "msh2", "unv")}
        if set(areas) != set(wanted) or not all(math.isclose(areas[i], a, rel_tol=1e-6) for i, a in wanted.items()):
            yield f"areas {areas}"
    if "zones" in found and set(found["zones"]) != set(assembly.REGIONS.values()):
        yield f"zones {found['zones']}"
    if found.get("region_names") and {n: i for n, i in found["region_names"].items()} != \
            {n: i for i, n in assembly.REGIONS.items()}:
        yield f"region names {found['region_names']}"
    if found.get("marker_names") and not set(found["marker_names"].items()) <= {(n, i) for i, n in assembly.MARKERS.items()}:
        yield f"marker names {found['marker_names']}"


def cell(found):
    parts = []
    if "points" in found or "tetrahedra" in found:
        parts.append("counts")
    if any(k in found for k in ("volumes", "volumes_by_name", "zones")):
        parts.append("regions")
    elif "volume" in found:
        parts.append("volume")
    if found.get("areas") or "force" in found:
        parts.append("faces")
    if found.get("region_names") or found.get("marker_names") or "zones" in found or "volumes_by_name" in found:
        parts.append("names")
    return ", ".join(parts)


def table(program, folder, short, only):
    rows, wrong = {}, []
    counts = None
    installed = {name for name in PROGRAMS if is_installed(name)}
    if not installed:
        sys.exit(77)
    for kind, readers in READS.items():
        if only and only not in (kind, *readers):
            continue
        path = write(program, folder, kind)
        if counts is None:
            reference = write(program, folder, "mesh")
            lines = reference.read_text().split("\n")
            counts = {"points": int(lines[lines.index("Vertices") + 1]), "tetrahedra": int(lines[lines.index("Tetrahedra") + 1])}
        present = [r for r in readers if r in installed and (not only or only in (kind, r))]
        for reader in present[:1] if short else present:
            done = subprocess.run([PYTHON, HERE / "read_with.py", reader, path], capture_output=True, text=True, timeout=300,
                                  check=False)
            lines = done.stdout.strip().splitlines()
            if done.returncode or not lines:
                bad = [(done.stderr.strip().splitlines() or ["no answer"])[-1][:400]]
                found = {}
            else:
                found = with_numbers(json.loads(lines[-1]))
                bad = list(faults(found, counts, kind))
            rows.setdefault(kind, {})[reader] = "**wrong**" if bad else cell(found)
            wrong += [f"{kind} by {reader}: {fault}" for fault in bad]
            print(kind, reader, "; ".join(bad) or cell(found), flush=True)
    return rows, wrong


def problems(program, folder, only):
    import solves

    order = "--order" in subprocess.run([program, "mesh", "--help"], capture_output=True, text=True, check=True).stdout
    rows, wrong = [], []
    for name, solve in solves.ALL.items():
        if only and only != name:
            continue
        probe = {"calculix": "ccx"}.get(name, name)
        if not is_installed(probe):
            continue
        place = folder / name
        place.mkdir()
        try:
            found = solve(program, place, order)
        except Exception as error:  # whatever a foreign program does is a finding
            wrong.append(f"{name}: {error}")
            print(name, error, flush=True)
            continue
        for what, value, expected, tolerance in found:
            right = abs(value - expected) <= tolerance
            rows.append((what, value, expected, tolerance, right))
            print(what, value, "" if right else "WRONG", flush=True)
            if not right:
                wrong.append(f"{what}: {value} for {expected} +- {tolerance}")
    return rows, wrong


def document(rows, solved):
    text = ["# Solvers", "",
            "Written by `make solvers`, which installs Debian's programs, meshes a box in a box (two regions, six named sides, a",
            "named interface) into every format, and has each program that reads the format tell what it found: *counts* of",
            "points and tetrahedra, *regions* with their volumes, *faces* with the area of each marker, *names*. What stands in a",
            "cell was right in that run, but for **wrong**; an empty one is what the program does not read.", "",
            "| format | " + " | ".join(PROGRAMS) + " |", "|---" * (len(PROGRAMS) + 1) + "|"]
    for kind in READS:
        text.append(f"| {kind} | " + " | ".join(rows.get(kind, {}).get(p, "") for p in PROGRAMS) + " |")
    text += ["", "## Problems solved", "", "| | found | expected |", "|---|---|---|"]
    for what, value, expected, tolerance, right in solved:
        text.append(f"| {what} | {value:.6g}{'' if right else ' **wrong**'} | {expected:.6g} ± {tolerance:g} |")
    return "\n".join(text) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--write")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--only")
    arguments = parser.parse_args()
    program = str(Path(arguments.program).resolve())
    with tempfile.TemporaryDirectory() as folder:
        rows, wrong = table(program, Path(folder), arguments.short, arguments.only)
        solved = []
        if not arguments.short:
            solved, more = problems(program, Path(folder), arguments.only)
            wrong += more
    if arguments.write:
        Path(arguments.write).write_text(document(rows, solved))
    for line in wrong:
        print("WRONG", line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
