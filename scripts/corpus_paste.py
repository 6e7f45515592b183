"""Pastes every assembly of the corpus, verifies the surface and its mesh, and tells what became of each.

    corpus_paste.py --holdfast build/release/holdfast [--only PATTERN] [--most BYTES] [--limit SECONDS] [FOLDER...]

An assembly is a surface named *_nofuse: its solids were meshed one by one. The parts are its components. A surface of one part must be
refused with exit 2. Parts whose volumes overlap must be refused with exit 4 that says so; then the first of them gets what is common. What
is pasted is verified by `check --repaired`, filled through `mesh --paste`, and the mesh is verified against the pasted surface; where
nothing overlapped, the volumes of all regions must add up to that of the surface. A surface that is not closed may be refused
by `mesh` with exit 4. Exit 0 if all is so, 1 if not, 77 if there are no such surfaces.
"""
import argparse
import collections
import fnmatch
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

import corpus


def read_off(path):
    words = [w for line in path.read_text(encoding="latin-1").splitlines() for w in line.split("#")[0].replace("OFF", " ").split()]
    n, m, at = int(words[0]), int(words[1]), 3
    points = [tuple(map(float, words[at + 3 * i:at + 3 * i + 3])) for i in range(n)]
    at, triangles = at + 3 * n, []
    for _ in range(m):
        corners = list(map(int, words[at + 1:at + 1 + int(words[at])]))
        triangles += [corners] if len(corners) == 3 else []
        at += 1 + int(words[at])
    return points, triangles


def read_mesh(path):
    """Points and tetrahedra of a Medit file."""
    words, points, tetrahedra = iter(path.read_text().split()), [], []
    for word in words:
        if word == "Vertices":
            points = [[float(next(words)) for _ in range(4)][:3] for _ in range(int(next(words)))]
        elif word == "Tetrahedra":
            tetrahedra = [[int(next(words)) - 1 for _ in range(5)][:4] for _ in range(int(next(words)))]
    return points, tetrahedra


def determinant(a, b, c):
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def volume_of_surface(points, triangles):
    """Six times what it encloses, exact: parts that are turned inside out are cavities."""
    exact = [tuple(map(Fraction, p)) for p in points]
    return sum(determinant(*(exact[v] for v in t)) for t in triangles)


def volume_of_mesh(points, tetrahedra):
    exact = [tuple(map(Fraction, p)) for p in points]
    return sum(determinant(*(tuple(x - y for x, y in zip(exact[v], exact[t[0]])) for v in t[1:])) for t in tetrahedra)


class Assembly:
    def __init__(self, arguments, path, folder):
        self.holdfast, self.limit = arguments.holdfast, arguments.limit
        self.path, self.folder = path, folder

    def run(self, command, *words):
        limits = ["--time-limit", str(self.limit), "-q"] if command != "check" else []
        done = subprocess.run([self.holdfast, command, *map(str, words), *limits], cwd=self.folder, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def judge(self):
        """What became of it, and whether that is as it should be."""
        lists, overlap = ["--parents", "p.txt", "--report", "r.json"], []
        code, said = self.run("paste", self.path, "-o", "o.off", *lists)
        if code == 2 and "is one part" in said:
            return "one part", True
        if code == 4 and " overlap by " in said:
            overlap = ["--overlap", "first"]
            code, said = self.run("paste", self.path, "-o", "o.off", *lists, *overlap)
        kind = "pasted, the first part has what was common" if overlap else "pasted"
        if code == 5:
            return "limit", True
        if code != 0:
            return f"{kind}: exit {code}: {said.strip()[-300:]}", False
        code, said = self.run("check", "--repaired", self.path, "o.off", *lists)
        if code != 0:
            return f"{kind}: not verified: " + "; ".join(line for line in said.splitlines() if line.startswith("BROKEN")), False
        code, said = self.run("mesh", self.path, "-o", "o.mesh", "--paste", "--fill", *overlap)
        if code == 4 and ("encloses nothing" in said or "outside every region" in said) and self.is_open():
            return f"{kind}; open", True
        if code == 5:
            return f"{kind}; mesh: limit", True
        if code != 0:
            return f"{kind}; mesh: exit {code}: {said.strip()[-300:]}", False
        code, said = self.run("check", "o.off", "o.mesh")
        if code != 0:
            return f"{kind}; mesh not verified: {said.strip()[-300:]}", False
        return (f"{kind} and filled", True) if overlap or self.is_open() else self.judge_volume(kind)

    def is_open(self):
        """Whether a side has an odd number of triangles."""
        sides = collections.Counter()
        for t in read_off(self.path)[1]:
            sides.update(tuple(sorted((t[i], t[(i + 1) % 3]))) for i in range(3))
        return any(count % 2 for count in sides.values())

    def judge_volume(self, kind):
        points, triangles = read_off(self.path)
        wanted = abs(volume_of_surface(points, triangles))
        found = volume_of_mesh(*read_mesh(self.folder / "o.mesh"))
        if abs(wanted - found) > wanted / 10**9:
            return f"{kind} and filled, but {float(found / 6)} are not {float(wanted / 6)}", False
        return f"{kind} and filled, and the volumes add up", True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--holdfast", required=True, type=lambda path: Path(path).resolve())
    parser.add_argument("--only", default="*")
    parser.add_argument("--most", type=int, default=2**62, help="bytes of a surface")
    parser.add_argument("--limit", type=int, default=120, help="seconds of the clock, a command")
    parser.add_argument("folders", nargs="*", type=Path)
    arguments = parser.parse_args()
    folders = arguments.folders or [corpus.CACHE / "valid", corpus.CACHE / "invalid"]
    paths = [path.resolve() for folder in folders for path in folder.glob("*_nofuse*.off")
             if fnmatch.fnmatch(path.name, arguments.only) and path.stat().st_size <= arguments.most]
    if not paths:
        sys.exit(77)
    counts, wrong = collections.Counter(), 0
    for path in sorted(paths, key=lambda path: (path.stat().st_size, path.name)):
        with tempfile.TemporaryDirectory() as folder:
            what, is_right = Assembly(arguments, path, Path(folder)).judge()
        print("ok " if is_right else "BAD", path.stem, what, flush=True)
        counts[what if is_right else "not as it should be"] += 1
        wrong += not is_right
    for what, count in counts.most_common():
        print(f"{count:4} {what}")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
