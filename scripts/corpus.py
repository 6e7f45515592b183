"""Meshes and verifies every surface of a corpus, in parallel processes, and tells what became of each.

    corpus.py --holdfast build/release/holdfast --corpus DIR [options]

DIR holds surfaces, or folders `valid` and `invalid` of surfaces, or the archives core.tar.xz and more.tar.xz of
such folders (then they are unpacked once into ~/.cache/holdfast-corpus). A valid surface is meshed with and
without flips; the mesh is verified by `holdfast check` and, where ../shared/tools/check_mesh.cpp exists, by that
independent program. An invalid surface must be refused with exit code 4. A valid surface that encloses nothing is
meshed with `--keep box`.

Every run is one line of build/corpus/<hash of the program>.jsonl, so that an interrupted run goes on where it
stopped. The table goes to build/corpus/table.md and .tsv. Exit code: 0 if all is as it should be, else 1, also if a limit
ran out (exit 5), if no mesh in doubles was found (exit 7) or if a run never started (--budget), unless
tests/corpus/known.tsv lists the surface with the reason; 77 (the "skipped" of CTest) if there is no corpus and
--skip-missing is given.
"""
import argparse
import concurrent.futures
import csv
import fnmatch
import hashlib
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

from blocks import read_records

ROOT = Path(__file__).resolve().parent.parent
CACHE = Path.home() / ".cache" / "holdfast-corpus"
SHARED = ROOT.parent / "shared"
SUFFIXES = {".off", ".stl", ".obj", ".ply", ".mesh", ".poly", ".smesh"}
GRACE = 30  # seconds past the time limit that a process may take to end by itself
KNOWN = ROOT / "tests" / "corpus" / "known.tsv"
NEEDS_BOX = {14, 15}  # rules of a surface that encloses nothing, or has parts outside

COLUMNS = ["name", "mode", "class", "triangles", "outcome", "delaunay_segments", "delaunay_facets", "flips_segments",
           "flips_facets", "points_added", "steiner", "unrounded", "seconds", "memory_mb", "check", "check_mesh",
           "as_expected", "message"]


@dataclass(frozen=True)
class Case:
    path: Path
    name: str
    mode: str  # flips, noflips, field, or invalid
    group: str  # what is expected: "closed" (every segment has two facets or more), "open", "invalid"
    triangles: int


# ---------------------------------------------------------------------------------------------- the surfaces


def unpack(folder, archives):
    """Unpacks the archives whose surfaces are not in the cache yet; returns the cache."""
    CACHE.mkdir(parents=True, exist_ok=True)
    for name in archives:
        done = CACHE / f".{name}.done"
        if done.exists():
            continue
        with tarfile.open(folder / name) as archive:
            members = [m for m in archive if m.isfile() and not (CACHE / m.name).exists()]
            if members:
                print(f"unpacking {len(members)} surfaces of {name} into {CACHE}", flush=True)
                archive.extractall(CACHE, members, filter="data") if hasattr(tarfile, "data_filter") \
                    else archive.extractall(CACHE, members)
        done.touch()
    return CACHE


def locate(text, core_only):
    """The folder of surfaces that `text` (a folder, "none", or nothing: look around) means, or None."""
    if text == "none":
        return None
    places = [Path(text)] if text else [CACHE, SHARED / "corpus"]
    for place in places:
        archives = [name for name in ("core.tar.xz", "more.tar.xz") if (place / name).exists()]
        if archives:
            return unpack(place, archives[:1] if core_only else archives)
        if place.is_dir() and any(p.suffix in SUFFIXES for p in place.rglob("*")):
            return place
    return None


def manifest_of(folder):
    for path in (folder / "manifest.tsv", SHARED / "corpus" / "manifest.tsv"):
        if path.exists():
            with open(path, encoding="utf-8") as file:
                return {row["name"]: row for row in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)}
    return {}


def count_off(path):
    """Triangles of an OFF file and whether each of its edges has two facets or more."""
    edges, triangles, dangling = {}, 0, False
    with open(path, encoding="ascii", errors="replace") as file:
        words = [line.split("#")[0].split() for line in file]
    rows = [w for w in words if w and w != ["OFF"]]
    vertices, faces = int(rows[0][0]), int(rows[0][1])
    for row in rows[1 + vertices: 1 + vertices + faces]:
        corners = [int(x) for x in row[1: 1 + int(row[0])]]
        dangling |= len(corners) == 2
        if len(corners) == 3:
            triangles += 1
            for i in range(3):
                edge = frozenset((corners[i - 1], corners[i]))
                edges[edge] = edges.get(edge, 0) + 1
    return triangles, not dangling and all(n > 1 for n in edges.values())


def describe(path, row):
    """(triangles, group) of a valid surface."""
    if row:
        closed = int(row["border_edges"]) == 0 and int(row["ndangle"]) == 0
        return int(row["ntri"]), "closed" if closed else "open"
    if path.suffix == ".off":
        try:
            triangles, closed = count_off(path)
            return triangles, "closed" if closed else "open"
        except (ValueError, IndexError):
            pass
    return 0, "closed"


def surfaces_in(folder):
    """All below `folder`, or below its `valid` and `invalid` where it has these: what stands beside them, such as
    surfaces to repair, promises nothing."""
    parts = [part for part in (folder / "valid", folder / "invalid") if part.is_dir()] or [folder]
    return [path for part in parts for path in part.rglob("*") if path.suffix in SUFFIXES]


def find_cases(folder, options):
    manifest = manifest_of(folder)
    paths = sorted(surfaces_in(folder), key=lambda p: (p.stat().st_size, p.name))
    cases = []
    for path in paths:
        row = manifest.get(path.stem)
        if options.only and not any(fnmatch.fnmatch(path.stem, glob) for glob in options.only):
            continue
        if path.parent.name == "invalid":
            if not options.valid_only:
                cases.append(Case(path, path.stem, "invalid", "invalid", int(row["ntri"]) if row else 0))
            continue
        triangles, group = describe(path, row)
        modes = ["flips", "noflips"] if options.mode == "both" else [options.mode]
        cases += [Case(path, path.stem, mode, group, triangles) for mode in modes]
    if options.limit_triangles:
        cases = [c for c in cases if c.triangles <= options.limit_triangles]
    if options.group:
        cases = [c for c in cases if c.group == options.group]
    if options.subset:
        names = sorted({c.name for c in cases}, key=lambda name: hashlib.sha256(name.encode()).digest())
        chosen = set(names[: options.subset])
        cases = [c for c in cases if c.name in chosen]
    if options.shard:
        index, count = (int(x) for x in options.shard.split("/"))
        if not 0 <= index < count:
            sys.exit("corpus.py: --shard i/n needs 0 <= i < n")
        cases = cases[index::count]
    return cases


# ------------------------------------------------------------------------------------------------- one surface


class Runner:
    def __init__(self, options, checker):
        self.options, self.checker = options, checker

    def limited(self, command, timeout):
        """Runs a command with limits. Returns (exit code, or "timeout", or the name of a signal; output)."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (self.options.memory, self.options.memory))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        try:
            ended = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   timeout=timeout + GRACE, preexec_fn=limit, check=False)
        except subprocess.TimeoutExpired as late:
            return "timeout", (late.output or b"").decode(errors="replace")
        output = ended.stdout.decode(errors="replace")
        if ended.returncode < 0:
            return signal.Signals(-ended.returncode).name, output
        return ended.returncode, output

    def mesh(self, case, volume, report_file, extra):
        options = self.options
        command = [options.holdfast, "mesh", case.path, "-o", volume, "--quiet", "--report", report_file,
                   "--time-limit", options.timeout, "--memory-limit", options.memory / 1e9, *extra]
        if case.mode != "field":
            command += ["--fill"]
        if case.mode == "noflips":
            command += ["--without", "flips"]
        code, output = self.limited(command, options.timeout)
        report = json.loads(report_file.read_text()) if report_file.exists() else {}
        return code, output, report

    def verify(self, case, volume, box):
        """Exit codes of both checkers, and the first that has something to say."""
        code, output = self.limited([self.options.holdfast, "check", case.path, volume, *(["--box"] if box else [])],
                                    self.options.timeout)
        verdict = {"check": "pass" if code == 0 else str(code), "check_mesh": ""}
        why = "" if code == 0 else "; ".join(l for l in output.splitlines() if not l.startswith("holds"))
        if self.checker:
            code, output = self.limited([self.checker, readable_by_checker(case.path, volume.parent), volume, "--quiet",
                                         *(["--allow-hull"] if box else [])], self.options.timeout)
            verdict["check_mesh"] = "pass" if code == 0 else str(code)
            why = why or ("" if code == 0 else output.strip())
        return verdict, why

    def run(self, case):
        with tempfile.TemporaryDirectory(prefix="holdfast-corpus-") as folder:
            volume, report_file = Path(folder) / "out.mesh", Path(folder) / "report.json"
            started = time.monotonic()
            code, output, report = self.mesh(case, volume, report_file, [])
            defects = report.get("defects", [])
            box = case.group != "invalid" and code == 4 and bool(defects) and \
                all(d["rule"] in NEEDS_BOX for d in defects)
            if box:
                code, output, report = self.mesh(case, volume, report_file, ["--keep", "box"])
            seconds = time.monotonic() - started
            verdict, why = {"check": "", "check_mesh": ""}, ""
            if code == 0:
                verdict, why = self.verify(case, volume, box)
            leftover = volume.exists() != (code == 0)
        message = why or report.get("message") or " ".join(output.split())[:300]
        if leftover:
            message = f"after exit {code}, an output file is {'missing' if code == 0 else 'left'}; {message}"
        good = code == 4 if case.mode == "invalid" else code == 0 and verdict["check"] == "pass" \
            and verdict["check_mesh"] in ("pass", "")
        get = lambda *keys: nested(report, keys)
        return {"name": case.name, "mode": case.mode, "class": case.group + (" box" if box else ""),
                "triangles": case.triangles, "exit": code,
                "outcome": get("outcome") or (code if isinstance(code, str) else f"exit {code}"),
                "delaunay_segments": get("delaunay", "missing_segments"),
                "delaunay_facets": get("delaunay", "missing_facets"),
                "flips_segments": get("flips", "missing_segments"), "flips_facets": get("flips", "missing_facets"),
                "points_added": (get("partition", "segment_points") or 0) + (get("partition", "facet_points") or 0),
                "steiner": get("steiner", "count"), "unrounded": get("steiner", "unrounded"),
                "seconds": round(seconds, 3), "memory_mb": round((get("peak_memory_bytes") or 0) / 1e6, 1),
                "stages": report.get("seconds", {}), "tetrahedra": get("mesh", "tetrahedra"), **verdict,
                "as_expected": good and not leftover, "message": "" if good and not leftover else message}


def readable_by_checker(path, folder):
    """The surface, or a copy without the "polygons" of one corner (isolated points), which check_mesh refuses."""
    if path.suffix != ".off":
        return path
    lines = path.read_text(encoding="ascii", errors="replace").splitlines()
    try:
        vertices, faces, *_ = (int(x) for x in lines[1].split())
        rows = lines[2 + vertices: 2 + vertices + faces]
        kept = [row for row in rows if not row.startswith("1 ")]
    except (ValueError, IndexError):
        return path
    if len(kept) == len(rows):
        return path
    copy = folder / "surface.off"
    copy.write_text("\n".join(["OFF", f"{vertices} {len(kept)} 0", *lines[2: 2 + vertices], *kept]) + "\n")
    return copy


def nested(value, keys):
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def build_checker(folder):
    """Compiles the independent checker where its source is; None where it is not or does not compile."""
    source, program = SHARED / "tools" / "check_mesh.cpp", folder / "check_mesh"
    if not source.exists():
        print("no independent checker: ../shared/tools/check_mesh.cpp is missing")
        return None
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        beside = folder / f"check_mesh.{os.getpid()}"
        made = subprocess.run(["g++", "-O2", "-std=c++17", source, "-o", beside, "-lgmpxx", "-lgmp"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if made.returncode != 0:
            print("no independent checker: it does not compile (libgmp-dev?)")
            return None
        beside.rename(program)
    return program


# ------------------------------------------------------------------------------------------------ the whole run


def latest_records(paths):
    """The latest record of every (name, mode)."""
    return {(record["name"], record["mode"]): record
            for path in sorted(paths, key=lambda p: p.stat().st_mtime) for record in read_records(path)}


def run_all(cases, runner, results, options):
    """Runs the cases that have no record yet; returns the records of all that were run."""
    known = latest_records(results.parent.glob("*.jsonl") if options.resume_any else
                         [results] if results.exists() else [])
    if options.again:
        known = {}
    elif options.retry_failed:
        known = {key: record for key, record in known.items() if record["as_expected"]}
    todo = [case for case in cases if (case.name, case.mode) not in known]
    print(f"{len(cases)} runs, {len(cases) - len(todo)} done before, {options.jobs} at a time", flush=True)
    started, lock, finished = time.monotonic(), threading.Lock(), [0]

    def work(case):
        if options.budget and time.monotonic() - started > options.budget:
            return
        record = runner.run(case)
        with lock:
            known[case.name, case.mode] = record
            finished[0] += 1
            with open(results, "a", encoding="utf-8") as file:
                file.write(json.dumps(record) + "\n")
            if options.verbose:
                print(f"{record['name']} ({record['mode']}): {record['outcome']}: {record['message']}", flush=True)
            if finished[0] % 100 == 0:
                bad = sum(not r["as_expected"] for r in known.values())
                print(f"[{time.monotonic() - started:.0f} s] {finished[0]} of {len(todo)}, {bad} not as expected",
                      flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(work, todo))
    return [known[c.name, c.mode] for c in cases if (c.name, c.mode) in known]


def show(value):
    return "yes" if value is True else "NO" if value is False else "" if value is None else str(value)


def write_tables(records, folder):
    rows = sorted(records, key=lambda r: (r["as_expected"], r["name"], r["mode"]))
    with open(folder / "table.tsv", "w", encoding="utf-8") as file:
        file.write("\t".join(COLUMNS) + "\n")
        for r in rows:
            file.write("\t".join(show(r.get(c)).replace("\t", " ") for c in COLUMNS) + "\n")
    with open(folder / "table.md", "w", encoding="utf-8") as file:
        file.write("| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|\n")
        for r in rows:
            file.write("| " + " | ".join(show(r.get(c)).replace("|", "/") for c in COLUMNS) + " |\n")


def read_known(path):
    """{(name, mode): outcome} of what cannot be as it should be; every row needs its reason."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader((line for line in file if not line.startswith("#")), delimiter="\t",
                                   quoting=csv.QUOTE_NONE))
    for row in rows:
        if not row["reason"] or row["mode"] not in ("flips", "noflips", "field", "invalid"):
            sys.exit(f"corpus.py: {path}: '{row['name']}' needs a mode and a reason")
    return {(row["name"], row["mode"]): row["outcome"] for row in rows}


def summarize(records, cases, known):
    """Prints the failures, then the counts. Returns whether every surface is as it should be, or as is known of it."""
    listed = [r for r in records if not r["as_expected"] and known.get((r["name"], r["mode"])) == r["outcome"]]
    for r in listed:
        print(f"as known         {r['class']:<8} {r['name']} ({r['mode']}): {r['outcome']}")
    bad = [r for r in records if not r["as_expected"] and r not in listed]
    for r in sorted(bad, key=lambda r: (r["class"], r["name"])):
        print(f"NOT AS EXPECTED  {r['class']:<8} {r['name']} ({r['mode']}): {r['outcome']}: {r['message']}")
    for group in sorted({(r["class"], r["mode"]) for r in records}):
        mine = [r for r in records if (r["class"], r["mode"]) == group]
        outcomes = {}
        for r in mine:
            outcomes[r["outcome"]] = outcomes.get(r["outcome"], 0) + 1
        times = sorted(r["seconds"] for r in mine)
        print(f"{group[0]}, {group[1]}: {sum(r['as_expected'] for r in mine)} of {len(mine)} as expected; "
              + ", ".join(f"{n} {o}" for o, n in sorted(outcomes.items()))
              + f"; points added {sum(r['points_added'] or 0 for r in mine)}, left {sum(r['steiner'] or 0 for r in mine)}, "
              f"unrounded {sum(r['unrounded'] or 0 for r in mine)}; "
              f"seconds: median {times[len(times) // 2]:.2f}, most {times[-1]:.1f}")
    disagree = [r for r in records if r["check_mesh"] and (r["check"] == "pass") != (r["check_mesh"] == "pass")]
    for r in disagree:
        print(f"THE CHECKERS DISAGREE on {r['name']} ({r['mode']}): {r['check']} and {r['check_mesh']}")
    if len(records) < len(cases):
        print(f"{len(cases) - len(records)} of {len(cases)} runs were not started (--budget)")
    return bool(records) and not disagree and not bad and len(records) == len(cases)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--holdfast", type=Path, required=True)
    parser.add_argument("--corpus", default=os.environ.get("HOLDFAST_CORPUS", ""),
                        help="folder; 'none' for none; default: HOLDFAST_CORPUS, or look around")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes at a time")
    parser.add_argument("--mode", choices=["flips", "noflips", "field", "both"], default="both",
                        help="fill with or without flips or both ways (default), or a mesh with field points")
    parser.add_argument("--only", action="append", metavar="GLOB", help="only surfaces of such a name (repeatable)")
    parser.add_argument("--group", choices=["closed", "open", "invalid"], help="only such surfaces")
    parser.add_argument("--valid-only", action="store_true")
    parser.add_argument("--limit-triangles", type=int, metavar="N")
    parser.add_argument("--subset", type=int, metavar="N", help="only N surfaces, always the same ones")
    parser.add_argument("--shard", metavar="I/N", help="only every N-th run, from the I-th on (0 <= I < N)")
    parser.add_argument("--timeout", type=float, default=600, help="seconds a surface (default 600)")
    parser.add_argument("--memory", type=int, default=4 << 30, help="bytes a process (default 4 GiB)")
    parser.add_argument("--budget", type=float, help="start no more runs after so many seconds")
    parser.add_argument("--resume-any", action="store_true", help="take results of other versions of the program")
    parser.add_argument("--retry-failed", action="store_true", help="run again what was not as expected")
    parser.add_argument("--again", action="store_true", help="run everything again")
    parser.add_argument("--known", type=Path, default=KNOWN,
                        help="surfaces that end otherwise than they should, with the outcome and the reason")
    parser.add_argument("--skip-missing", action="store_true", help="exit 77 if there is no corpus")
    parser.add_argument("--core-only", action="store_true", help="unpack only the small archive")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "corpus", help="folder of the results")
    parser.add_argument("--verbose", action="store_true", help="a line for every run")
    return parser.parse_args()


def main():
    options = parse_arguments()
    folder = locate(options.corpus, options.core_only)
    if folder is None:
        print(f"skipped: no corpus of surfaces at '{options.corpus or CACHE}'")
        return 77 if options.skip_missing else 1
    options.output.mkdir(parents=True, exist_ok=True)
    digest = hashlib.sha256(options.holdfast.read_bytes()).hexdigest()[:12]
    cases = find_cases(folder, options)
    checker = build_checker(options.output)
    with tempfile.TemporaryDirectory(prefix="holdfast-program-") as private:  # it may be rebuilt meanwhile
        options.holdfast = shutil.copy2(options.holdfast, private)
        records = run_all(cases, Runner(options, checker), options.output / f"{digest}.jsonl", options)
    write_tables(records, options.output)
    good = summarize(records, cases, read_known(options.known))
    print(f"table: {options.output / 'table.md'}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
