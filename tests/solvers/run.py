"""Every format into every program that reads it, and problems solved by them: `make solvers` writes docs/solvers.md.

Usage: run.py PROGRAM [--write FILE] [--short] [--only NAME]. Without --write it prints; exit code 1 if anything is wrong,
77 if no program is installed. --short leaves out the problems and uses one program per format.
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
# The programs that read each format; --short uses the first of a row.
READS = {
    "vtu": ["meshio", "vtk", "sfepy"],
    "vtm": ["vtk"],
    "vtk": ["meshio", "vtk", "gmsh"],
    "msh": ["gmsh", "meshio", "dolfinx", "getfem", "dealii", "petsc", "escript", "saturne"],
    "msh2": ["meshio", "gmsh", "openfoam", "freefem", "getfem", "dealii", "petsc", "getdp", "escript", "saturne", "rheolef"],
    "msh binary": ["gmsh", "meshio", "dolfinx", "petsc", "saturne"],
    "msh2 binary": ["meshio", "gmsh", "petsc", "getdp", "saturne"],
    "mesh": ["meshio", "freefem", "gmsh", "sfepy"],
    "meshb": ["freefem"],
    "inp": ["ccx", "meshio"],
    "unv": ["openfoam", "gmsh", "saturne"],
    "bdf": ["meshio", "gmsh"],
    "su2": ["meshio"],
    "mfem": ["parser"],
    "vol": ["meshio", "netgen"],
    "xdmf": ["meshio", "dolfinx", "dolfin"],
    "med": ["meshio", "libmed", "saturne"],
    "exo": ["vtk", "meshio"],
    "cgns": ["saturne"],
    "fluent": ["openfoam", "vtk"],
    "xml": ["dolfin"],
    "node": ["meshio"],
    "openfoam": ["openfoam"],
}
# The same for second order: counts of nodes, and volumes and areas of the elements by their corners.
SECOND_ORDER = {
    "vtu": ["meshio", "vtk"],
    "vtk": ["meshio", "vtk", "gmsh"],
    "msh": ["gmsh", "meshio", "dolfinx", "escript"],
    "msh2": ["meshio", "gmsh", "getdp", "escript", "rheolef"],
    "msh binary": ["gmsh", "meshio"],
    "inp": ["ccx"],
    "unv": ["gmsh"],
    "bdf": ["meshio", "gmsh"],
    "vol": ["netgen"],
    "xdmf": ["meshio", "dolfinx"],
    "med": ["meshio", "libmed"],
    "exo": ["vtk", "meshio"],
}
PROGRAMS = ["meshio", "vtk", "gmsh", "dolfinx", "sfepy", "getfem", "freefem", "netgen", "openfoam", "ccx", "dealii",
            "libmed", "petsc", "getdp", "escript", "dolfin", "saturne", "rheolef", "parser"]
LEAST = {"openfoam": "checkMesh", "freefem": "FreeFem++", "gmsh": "gmsh", "ccx": "ccx", "libmed": "mdump", "getdp": "getdp",
         "escript": "run-escript3", "rheolef": "msh2geo", "saturne": "/usr/lib/code_saturne/cs_preprocess"}
MODULE = {"meshio": "meshio", "vtk": "vtk", "dolfinx": "dolfinx", "sfepy": "sfepy", "getfem": "getfem", "netgen": "netgen",
          "petsc": "petsc4py", "dolfin": "dolfin"}


def is_installed(name):
    if name == "parser":
        return True
    if name == "dealii":
        return Path("/usr/include/deal.II/grid/grid_in.h").exists() and shutil.which("mpicxx") is not None
    if name in LEAST:
        return shutil.which(LEAST[name]) is not None
    return subprocess.run([PYTHON, "-c", f"import importlib.util as u, sys; import site; "
                           f"sys.exit(u.find_spec('{MODULE[name]}') is None)"], check=False).returncode == 0


def write(program, folder, kind, order=1):
    form, *options = kind.split()
    if form == "openfoam":
        assembly.mesh(program, folder, folder / "case" / "constant" / "polyMesh")
        return folder / "case"
    path = folder / f"{kind.replace(' ', '_')}_{order}.{'msh' if form == 'msh2' else form}"
    arguments = ["--order", "2"] if order == 2 else []
    arguments += (["--format", "msh2"] if form == "msh2" else []) + (["--binary"] if options else [])
    assembly.mesh(program, folder, path, *arguments)
    return path


# Formats that some programs read without the interface, which OpenFOAM has as a face zone.
INSIDE_IS_LOST = ("su2", "openfoam", "msh2", "unv", "fluent")


def with_numbers(found):
    """The answer with ids as numbers again; JSON has them as text."""
    return {key: {int(k): v for k, v in value.items()} if key == "volumes" else value for key, value in found.items()}


def near(a, b):
    return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9)


def faults(found, counts, kind, reader):
    """The errors in the answer, one string each."""
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
        wanted = {i: a for i, a in assembly.AREAS.items() if i != 7 or 7 in areas or kind not in INSIDE_IS_LOST and reader != "dealii"}
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


def asked(program, reader, path, folder):
    """The contents that a program found in a file. Raises ValueError with its last output."""
    command = [PYTHON, HERE / "read_with.py", reader, path]
    if reader == "dealii":  # which does not accept inner faces as boundary
        outer = path.with_stem(path.stem + "_outer")
        subprocess.run([program, "convert", path, outer, "--no-interfaces", "-q", *(["--format", "msh2"] if "msh2" in path.stem else [])],
                       check=True, capture_output=True, timeout=120)
        command = [build_dealii(folder), outer]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    lines = done.stdout.strip().splitlines()
    if done.returncode or not lines:
        raise ValueError((done.stderr.strip().splitlines() or ["no answer"])[-1][:400])
    return with_numbers(json.loads(lines[-1]))


def build_dealii(folder):
    """deal.II is a library: a program that reads with it is compiled once."""
    built = folder / "read_with_dealii"
    if not built.exists():
        flags = [subprocess.run(["mpicxx", f"--showme:{what}"], capture_output=True, text=True, check=True).stdout.split()
                 for what in ("compile", "link")]
        subprocess.run(["g++", "-O1", "-std=c++17", "-w", "-I/usr/include/trilinos", *flags[0], HERE / "read_with_dealii.cpp", "-o",
                        built, "-Wl,--copy-dt-needed-entries", "-ldeal.ii", *flags[1], "-ltbb"], check=True, timeout=1200,
                       capture_output=True)
    return built


def table(program, folder, short, only, order=1):
    rows, wrong = {}, []
    counts = None
    installed = {name for name in PROGRAMS if is_installed(name)}
    if installed == {"parser"}:
        sys.exit(77)
    for kind, readers in (READS if order == 1 else SECOND_ORDER).items():
        if only and only not in (kind, *readers):
            continue
        path = write(program, folder, kind, order)
        if counts is None:
            reference = write(program, folder, "vtu", order)
            found = json.loads(subprocess.run([program, "info", reference, "--json"], capture_output=True, text=True,
                                              check=True).stdout)
            counts = {"points": found["vertices"] + found["mid_nodes"], "tetrahedra": found["tetrahedra"]}
        present = [r for r in readers if r in installed and (not only or only in (kind, r))]
        for reader in present[:1] if short else present:
            try:
                found = asked(program, reader, path, folder)
                bad = list(faults(found, counts, kind, reader))
            except (ValueError, OSError, subprocess.SubprocessError) as error:
                found, bad = {}, [str(error)]
            rows.setdefault(kind, {})[reader] = "**wrong**" if bad else cell(found)
            wrong += [f"{kind}{' of second order' if order == 2 else ''} by {reader}: {fault}" for fault in bad]
            print(kind, order, reader, "; ".join(bad) or cell(found), flush=True)
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
        except Exception as error:  # any failure of a foreign program is a finding
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


def document(rows, second, solved):
    def lines_of(kinds, found):
        return ["| format | " + " | ".join(PROGRAMS) + " |", "|---" * (len(PROGRAMS) + 1) + "|",
                *(f"| {kind} | " + " | ".join(found.get(kind, {}).get(p, "") for p in PROGRAMS) + " |" for kind in kinds)]

    text = ["# Solvers", "",
            "`make solvers` writes this page. It installs Debian's programs, meshes a box in a box (two regions, six named sides,",
            "a named interface) into every format, and lets each program that reads the format report what it finds: *counts* of",
            "points and tetrahedra, *regions* with their volumes, *faces* with the area of each marker, *names*. Everything listed",
            "in a cell was right in that run, unless marked **wrong**; an empty cell means that the program does not read the format.",
            "*dealii* is deal.II, with files of `--no-interfaces`; *libmed* is its `mdump`; *dolfin* is the legacy DOLFIN; *saturne*",
            "is code_saturne; *parser* is the test's own reader of MFEM's format, as MFEM has no Debian package. MFEM's meshes are",
            "of first order here.", "",
            "GetDP (as Debian builds it), rheolef and DUNE read `.msh` of version 2.2 only (`--format msh2`), and escript, rheolef",
            "and DUNE only as text. DUNE's GmshReader takes no names of groups (leave out what is between `$PhysicalNames` and",
            "`$EndPhysicalNames`), and with UGGrid no interfaces (`--no-interfaces`). FreeCAD reads `.med` if the mesh has the",
            "file's name, and `.bdf` only of second order; it reads `.unv` with the groups.", "",
            *lines_of(READS, rows), "", "## Second order", "", "`mesh --order 2`, read by the same programs if they support it.", "",
            *lines_of(SECOND_ORDER, second)]
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
        solved, second = [], {}
        if not arguments.short:
            second, more = table(program, Path(folder), False, arguments.only, 2)
            wrong += more
            solved, more = problems(program, Path(folder), arguments.only)
            wrong += more
    if arguments.write:
        Path(arguments.write).write_text(document(rows, second, solved))
    for line in wrong:
        print("WRONG", line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
