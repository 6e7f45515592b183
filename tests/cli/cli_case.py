"""Common code of tests that run the program `holdfast`.

A test file is run as `NAME_test.py PROGRAM [unittest options]`.
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CUBE_POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
CUBE_FACETS = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
               (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


def off(points, facets):
    return (f"OFF\n{len(points)} {len(facets)} 0\n" + "".join("%r %r %r\n" % tuple(p) for p in points)
            + "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in facets))


def cube(corner=(0, 0, 0), size=1):
    return [tuple(c + size * x for c, x in zip(corner, p)) for p in CUBE_POINTS]


def shifted(facets, by):
    return [tuple(v + by for v in f) for f in facets]


def read_terminal(descriptor):
    """The output of a terminal's other side; nothing after that side is closed."""
    try:
        return os.read(descriptor, 65536)
    except OSError:
        return b""


class CliTest(unittest.TestCase):
    program = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("cube.off", off(CUBE_POINTS, CUBE_FACETS))

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)
        return path

    def run_program(self, *arguments, expect=0):
        ended = subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, timeout=240, check=False)
        self.assertEqual(ended.returncode, expect, ended.stdout + ended.stderr)
        return ended

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())


def main():
    CliTest.program = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
