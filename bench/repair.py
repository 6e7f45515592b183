"""Repairs broken surfaces and evaluates the results: `make repair` writes docs/repair.md.

    bench/repair.py --holdfast PROGRAM --rows FILE.jsonl --out docs/repair.md [--checker CHECK_REPAIR] [--autorefine PROGRAM]
                    [--jobs N] [--most TRIANGLES] [--only PATTERN] [--without-others] [--report-only] [--test N]
                    [FOLDER...]

Every surface is repaired with the options of its group, and the result is judged by `holdfast check --repaired` and by an
independent checker; then it is meshed if it encloses anything, and the mesh is checked. The same surfaces go through Debian's
admesh and CGAL's autorefine, whose results are only tested for validity. A row is kept as long as the program is the
same, so a run may be interrupted; rows of other programs are kept when ours changes.
"""
import argparse
import fnmatch
import sys
import hashlib
import json
import os
import resource
import shutil
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scripts"))
import corpus  # noqa: E402  (where the independent checker is)

LIMIT = 120  # seconds for a program of ours
INDEPENDENT = 100  # seconds of CPU for the independent checker
OTHERS = 10  # seconds of CPU for one of another project: admesh does not end on some surfaces with T-junctions


# The independent checker measures its samples in doubles, and says so: near slivers its error exceeds its allowance.
# Its second build measures those that it would refuse once more, in the rationals of its other rules.
IN_DOUBLES = "if (d > lim + 1e-14 * sc) bad("
IN_RATIONALS = """if (d > lim + 1e-14 * sc) {
            auto v3 = [](const P& a) { return V3{a.x(), a.y(), a.z()}; };
            mpq_class least(d); least *= least; CGAL::Bbox_3 near(p.x() - d, p.y() - d, p.z() - d, p.x() + d, p.y() + d, p.z() + d);
            for (auto& u : to) if (CGAL::do_overlap(u.bbox(), near)) least = min(least, trid2(v3(p), v3(u[0]), v3(u[1]), v3(u[2])));
            d = root(least); }
          if (d > lim + 1e-14 * sc) bad("""


def build_checkers(folder):
    """The independent checker and the one that measures in rationals, if its source exists and compiles; else None."""
    source = corpus.SHARED / "tools" / "check_repair.cpp"
    if not source.exists():
        return None, None
    text, exact = source.read_text(), folder / "check_repair_exact.cpp"
    in_rationals = text.replace(IN_DOUBLES, IN_RATIONALS)
    if text.count(IN_DOUBLES) == 1 and not (exact.exists() and exact.read_text() == in_rationals):
        exact.write_text(in_rationals)
    return build_checker(source, folder / "check_repair"), build_checker(exact, folder / "check_repair_exact")


def build_checker(source, program):
    if not source.exists():
        return None
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        made = subprocess.run(["g++", "-O2", "-std=c++17", "-frounding-math", "-DNDEBUG", source, "-o", program, "-lgmpxx", "-lgmp",
                               "-lmpfr"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if made.returncode != 0:
            print("no independent checker: it does not compile (libcgal-dev?)")
            return None
    return program


def folders_of(arguments):
    """Those named, or the broken and invalid surfaces of the corpus and those that its generator makes."""
    if arguments.folders:
        return arguments.folders
    made, generator = Path(arguments.rows).parent / "broken", corpus.SHARED / "corpus" / "gen_broken.py"
    if generator.exists() and not (made / "list.tsv").exists():
        subprocess.run([sys.executable, generator, made], check=True)
    return [f for f in (corpus.CACHE / "broken", corpus.CACHE / "invalid", made) if f.is_dir()]


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]


def counts(path):
    """Vertices and facets of an OFF file."""
    with open(path, encoding="latin-1") as file:
        words = []
        while len(words) < 3:
            line = file.readline()
            if not line:
                return 0, 0
            words += line.split("#")[0].replace("OFF", " ").split()
    return int(words[0]), int(words[1])


def has_more_than_triangles(path):
    """Whether an OFF file has faces of one or two corners: isolated vertices and segments."""
    n, m = counts(path)
    with open(path, encoding="latin-1") as file:
        words = [w for line in file for w in line.split("#")[0].replace("OFF", " ").split()]
    at = 3 + 3 * n
    for _ in range(m):
        if int(words[at]) < 3:
            return True
        at += 1 + int(words[at])
    return False


def extent(path):
    """The longest side of the box of an OFF file."""
    n, _ = counts(path)
    low, high = [float("inf")] * 3, [float("-inf")] * 3
    with open(path, encoding="latin-1") as file:
        words = (w for line in file for w in line.split("#")[0].replace("OFF", " ").split())
        for _ in range(3):
            next(words, None)
        for _ in range(n):
            for k in range(3):
                x = float(next(words))
                if x - x == 0:
                    low[k], high[k] = min(low[k], x), max(high[k], x)
    return max((h - l for l, h in zip(low, high) if h >= l), default=0)


def run(command, folder, cpu_limit=None):
    """(exit code or None, output, seconds of CPU): the machine may be busy with other things."""
    def prepare():
        if cpu_limit:
            resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + 1))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

    ends, pause = time.monotonic() + 5 * LIMIT, 0.002
    with tempfile.TemporaryFile() as said:
        program = subprocess.Popen(list(map(str, command)), cwd=folder, stdout=said, stderr=subprocess.STDOUT, preexec_fn=prepare)
        while True:
            ended, status, usage = os.wait4(program.pid, os.WNOHANG)
            if ended:
                break
            if time.monotonic() > ends:
                program.kill()
            time.sleep(pause)
            pause = min(0.1, pause * 1.5)
        program.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        code = program.returncode if program.returncode >= 0 else None
        return code, said.read().decode(errors="replace"), usage.ru_utime + usage.ru_stime


class Bench:
    def __init__(self, arguments):
        self.holdfast = Path(arguments.holdfast).resolve()
        self.checker, self.exact_checker = build_checkers(Path(arguments.rows).resolve().parent)
        if arguments.checker:
            self.checker = Path(arguments.checker).resolve()
        self.autorefine = arguments.autorefine and Path(arguments.autorefine).resolve()
        self.admesh = shutil.which("admesh")
        self.stamp = digest(self.holdfast)

    def limited(self, *words):
        return [self.holdfast, *words, "--time-limit", LIMIT, "--memory-limit", 6, "-q"]

    def measure(self, path, group, others=None):
        """A row; `others` are earlier results of the other projects' programs, if known."""
        row = {"name": path.stem, "group": group, "stamp": self.stamp, "triangles": counts(path)[1]}
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            self.repair(path, folder, row)
            row["others"] = dict(others or {})
            if self.admesh and "admesh" not in row["others"]:
                row["others"]["admesh"] = self.other(path, folder, [self.admesh, "-b", "admesh.stl", "in.stl"], "admesh.stl", True)
            if self.autorefine and "autorefine" not in row["others"]:
                row["others"]["autorefine"] = self.other(path, folder, [self.autorefine, path, "refined.off"], "refined.off", False)
        return row

    def repair(self, path, folder, row):
        code, said, row["seconds"] = run(self.limited("repair", path, "-o", "out.off", "--parents", "p.txt", "--report", "r.json"),
                                         folder)
        row["exit"], row["said"] = code, said.strip()[-300:]
        if code != 0:
            return
        report = json.loads((folder / "r.json").read_text())
        row.update(rung=report["rung"], moved=len(report["moved"]), dropped=len(report["dropped"]), points=report["points"],
                   vertices=report["output"]["vertices"], displacement=report["max_displacement"],
                   share=report["max_displacement"] / (extent(path) or 1))
        code, said, row["check_seconds"] = run(
            [self.holdfast, "check", "--repaired", path, "out.off", "--parents", "p.txt", "--report", "r.json", "--time-limit",
             4 * LIMIT], folder)
        row["own"] = code == 0
        if code != 0:
            row["own_said"] = "\n".join(line for line in said.splitlines() if not line.startswith("holds"))[:1500]
        if self.checker:
            self.check_independently(path, folder, row)
        code, said, row["mesh_seconds"] = run(self.limited("mesh", "out.off", "-o", "out.mesh", "--fill"), folder)
        row["mesh"] = code
        if code == 4 and "encloses" in said:
            row["mesh"] = "open"
        elif code == 4 and "outside" in said:
            code, said, _ = run(self.limited("mesh", "out.off", "-o", "out.mesh", "--fill", "--drop-outside"), folder)
            row["mesh"] = code
            if code == 0:
                code, said, _ = run(self.limited("check", "out.off", "out.mesh", "--outside-dropped"), folder)
                row["mesh_check"] = code == 0
        elif code == 0:
            code, said, _ = run(self.limited("check", "out.off", "out.mesh"), folder)
            row["mesh_check"] = code == 0
        if row["mesh"] not in (0, "open") or row.get("mesh_check") is False:
            row["mesh_said"] = said[-1500:]

    def check_independently(self, path, folder, row):
        """That checker reads only triangles: it cannot decide whether a surface with segments or isolated vertices was valid."""
        command = [path, "out.off", "r.json", "--parents", "p.txt", *(["--no-identity"] if has_more_than_triangles(path) else [])]
        code, said, _ = run([self.checker, *command], folder, INDEPENDENT)
        if code is not None:  # else it took too long
            row["independent"] = code == 0
        if code != 0:
            row["independent_said"] = said[:1500]
        if code == 1 and self.exact_checker:
            code, said, _ = run([self.exact_checker, *command], folder, INDEPENDENT)
            row["in_rationals"] = code == 0
            if code != 0:
                row["in_rationals_said"] = said[:1500]

    def other(self, path, folder, command, result, from_stl):
        """Whether another program's result is valid, by our check and the independent one, and its seconds."""
        if from_stl:
            write_stl(path, folder / "in.stl")
        code, _, seconds = run(command, folder, OTHERS)
        found = {"exit": code, "seconds": seconds}
        out = folder / result
        if not out.exists() or out.stat().st_size == 0:
            return {**found, "valid": False}
        code, _, _ = run(self.limited("diagnose", result), folder)
        found["valid"] = code == 0
        if found["valid"] and self.checker:
            found["valid"] = self.independently_valid(folder, result)
        return found

    def independently_valid(self, folder, result):
        """The independent checker compares; comparing a surface with itself only tests its validity."""
        code, _, _ = run([self.holdfast, "convert", result, "other.off"], folder)
        if code != 0:
            return False
        weld(folder / "other.off")
        lines = "".join(f"{k}\n" for k in range(counts(folder / "other.off")[1]))
        (folder / "other.txt").write_text("# max_displacement 0\n" + lines)
        (folder / "other.json").write_text('{"max_displacement": 0}')
        code, _, _ = run([self.checker, "other.off", "other.off", "other.json", "--parents", "other.txt", "--samples", "0"], folder)
        return code in (0, None)


def weld(path):
    """Vertices at one place become one: that is not a defect of the surface."""
    with open(path, encoding="latin-1") as file:
        words = [w for line in file for w in line.split("#")[0].replace("OFF", " ").split()]
    n, m, first, number = int(words[0]), int(words[1]), {}, []
    for v in range(n):
        number.append(first.setdefault(tuple(float(x) + 0.0 for x in words[3 + 3 * v:6 + 3 * v]), len(first)))
    at, facets = 3 + 3 * n, []
    for _ in range(m):
        k = int(words[at])
        facets.append(" ".join([str(k)] + [str(number[int(v)]) for v in words[at + 1:at + 1 + k]]))
        at += 1 + k
    points = [" ".join(map(repr, p)) for p in first]
    path.write_text("\n".join(["OFF", f"{len(points)} {m} 0", *points, *facets]) + "\n")


def write_stl(path, out):
    import struct
    with open(path, encoding="latin-1") as file:
        words = [w for line in file for w in line.split("#")[0].replace("OFF", " ").split()]
    n, m = int(words[0]), int(words[1])
    points = [tuple(map(float, words[3 + 3 * i:6 + 3 * i])) for i in range(n)]
    at, facets = 3 + 3 * n, []
    for _ in range(m):
        k = int(words[at])
        corners = list(map(int, words[at + 1:at + 1 + k]))
        at += 1 + k
        facets += [(corners[0], corners[i], corners[i + 1]) for i in range(1, k - 1)]

    def short(x):
        try:
            return struct.pack("<f", x)
        except OverflowError:
            return struct.pack("<f", float("inf"))

    with open(out, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(facets)))
        for f in facets:
            file.write(bytes(12) + b"".join(short(x) for v in f for x in points[v]) + bytes(2))


def surfaces(folders):
    """(path, group): the family of a generated surface, else the name of its folder."""
    found = []
    for folder in (Path(f).resolve() for f in folders):
        families = {}
        if (folder / "list.tsv").exists():
            families = dict(line.split("\t")[:2] for line in (folder / "list.tsv").read_text().splitlines()[1:])
        found += [(path, families.get(path.stem, folder.name)) for path in folder.glob("*.off")]
    return sorted(found, key=lambda s: (s[0].stat().st_size, s[0].name))


def share(part, whole):
    return f"{part} of {whole}"


def verified(row):
    return row.get("own") and row.get("independent", True)


def is_right(row):
    """Repaired, verified, and meshed if it encloses anything."""
    return row["exit"] == 0 and verified(row) and row["mesh"] in (0, "open") and row.get("mesh_check", True)


def summary(rows):
    done = [r for r in rows if r["exit"] == 0]
    good = [r for r in done if verified(r)]
    meshed = [r for r in done if r["mesh"] != "open"]
    return {
        "surfaces": len(rows),
        "repaired": len(done),
        "own": sum(r["own"] for r in done),
        "independent": sum(r.get("independent", False) for r in done),
        "verified": len(good),
        "in_rationals": sum(bool(r.get("own") and r.get("in_rationals")) for r in done),
        "refused": sum(r["exit"] in (5, 7) for r in rows),
        "meshed": f"{sum(r.get('mesh_check', False) for r in meshed)} of {len(meshed)}",
        "moved": sum(r["moved"] > 0 for r in done),
        "displacement": max((r["share"] for r in done), default=0),
        "near": sum(r["share"] < 2**-40 for r in done),
        "seconds": sum(r["seconds"] for r in rows),
        # of surfaces that take longer than starting the program
        "speed": 1e6 * sum(r["seconds"] for r in done if r["vertices"] >= 1000) /
        max(1, sum(r["vertices"] for r in done if r["vertices"] >= 1000)),
    }


def document(rows, arguments, wanted):
    by_group = {}
    for row in rows:
        by_group.setdefault(row["group"], []).append(row)
    lines = ["# Repairs, measured", "",
             "Written by `make repair` ([bench/repair.py](../bench/repair.py)). Each surface is repaired without options; what comes out is",
             "verified by `holdfast check --repaired` and by an independent program, then filled where it encloses anything, and that mesh",
             "checked. *moved*: surfaces on which vertices of the input moved. *largest distance*: in parts of the surface's extent, as",
             "reported and verified. *seconds*: of CPU, of all repairs of the group together, on one thread. *ms per 1,000*: the same by vertices",
             f"of the results that have 1,000 or more. Other programs have {OTHERS} s of CPU a surface; their results are only asked whether they",
             "are valid, by `holdfast diagnose` and by the independent program.", "",
             *([f"The table has {len(rows)} of {wanted} surfaces, the smallest.", ""] if len(rows) < wanted else []),
             "| group | surfaces | repaired | own check | independent | mesh checked | moved | largest distance | seconds | ms per 1,000 | admesh valid | autorefine valid |",
             "|---|---|---|---|---|---|---|---|---|---|---|---|"]

    def others(rows, name):
        asked = [r["others"][name] for r in rows if name in r.get("others", {})]
        return share(sum(o["valid"] for o in asked), len(asked)) if asked else "-"

    for group, members in [*sorted(by_group.items()), ("all", rows)]:
        s = summary(members)
        speed = f"{s['speed']:.0f}" if s["speed"] else "-"
        lines.append(f"| {group} | {s['surfaces']} | {s['repaired']} | {s['own']} | {s['independent']} | {s['meshed']} | {s['moved']} | "
                     f"{s['displacement']:.1e} | {s['seconds']:.1f} | {speed} | {others(members, 'admesh')} | {others(members, 'autorefine')} |")
    s = summary(rows)
    n = max(1, s["surfaces"])
    lines += ["", f"Repaired and verified by both: {s['verified']} of {s['surfaces']} ({100 * s['verified'] / n:.1f} %); ended with exit 5 or 7: "
              f"{s['refused']}. {s['in_rationals']} more hold where the independent program measures in rationals the samples that it refuses in "
              f"doubles. Largest distance below 2^-40 of the extent: {s['near']} of {s['repaired']}.", ""]
    bad = [r for r in rows if not is_right(r)]
    if bad:
        lines += ["Not so:", "", "| surface | triangles | what |", "|---|---|---|"]
        for r in sorted(bad, key=lambda r: (r["group"], r["name"])):
            what = []
            if r["exit"] != 0:
                what.append(f"exit {r['exit']} after {r['seconds']:.0f} s")
            else:
                if not r["own"]:
                    what.append("own check")
                if not r.get("independent", True):
                    what.append("independent check" + (", holds in rationals" if r.get("in_rationals") else ""))
                if "independent" not in r:
                    what.append("independent check: no time")
                if r["mesh"] not in (0, "open") or not r.get("mesh_check", True):
                    what.append(f"mesh: exit {r['mesh']}")
            lines.append(f"| {r['group']}/{r['name']} | {r['triangles']} | {', '.join(what)} |")
        lines.append("")
    if arguments.most:
        lines += [f"Surfaces of at most {arguments.most} triangles.", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--holdfast", required=True)
    parser.add_argument("--rows", required=True)
    parser.add_argument("--out")
    parser.add_argument("--checker")
    parser.add_argument("--autorefine")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--most", type=int, default=0)
    parser.add_argument("--only", default="*")
    parser.add_argument("--report-only", action="store_true")
    parser.add_argument("--without-others", action="store_true", help="our program alone")
    parser.add_argument("--test", type=int, default=0, metavar="N",
                        help="only about N surfaces, evenly over all sizes, without the others' programs; exit 1 unless 97 %% are "
                             "repaired and hold by our own check, 77 where there are none")
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()
    rows_file = Path(arguments.rows)
    rows_file.parent.mkdir(parents=True, exist_ok=True)
    bench = Bench(arguments)
    known = {}
    if rows_file.exists():
        for line in rows_file.read_text().splitlines():
            row = json.loads(line)
            known[row["group"], row["name"]] = row
    wanted = [(p, g) for p, g in surfaces(folders_of(arguments)) if fnmatch.fnmatch(p.stem, arguments.only) and
              (arguments.most == 0 or counts(p)[1] <= arguments.most)]
    if arguments.test or arguments.without_others:
        bench.admesh = bench.autorefine = None
    if arguments.test:
        wanted = wanted[::max(1, len(wanted) // arguments.test)]
        if not wanted:
            sys.exit(77)
    missing = [] if arguments.report_only else [(p, g) for p, g in wanted
                                                if known.get((g, p.stem), {}).get("stamp") != bench.stamp]

    def measure(task):
        path, group = task
        row = bench.measure(path, group, known.get((group, path.stem), {}).get("others"))
        with open(rows_file, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
            file.flush()
            os.fsync(file.fileno())
        print(f"{'ok ' if is_right(row) else 'BAD'} {group}/{path.stem} exit {row['exit']} {row['seconds']:.1f} s", flush=True)
        return row

    with ThreadPoolExecutor(arguments.jobs) as pool:
        for row in pool.map(measure, missing):
            known[row["group"], row["name"]] = row
    rows = [known[g, p.stem] for p, g in wanted if (g, p.stem) in known]
    s = summary(rows)
    print(json.dumps(s))
    # The independent checker measures distances in floating point, and a valid surface may be hard to mesh: this test
    # is about neither.
    if arguments.test and sum(r["exit"] == 0 and r["own"] for r in rows) < 0.97 * len(rows):
        sys.exit(1)
    if arguments.out:
        Path(arguments.out).write_text(document(rows, arguments, len(wanted)))


if __name__ == "__main__":
    main()
