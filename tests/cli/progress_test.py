"""Progress on a terminal: one bar for the whole run that never goes back; lines with --verbose; else nothing.

    progress_test.py PROGRAM [unittest options]
"""
import math
import os
import pty
import re
import subprocess

from cli_case import CliTest, main, off, read_terminal


def torus(n, m):
    points, facets = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * math.pi * i / n, 2 * math.pi * j / m
            points.append(((1 + 0.4 * math.cos(b)) * math.cos(a), (1 + 0.4 * math.cos(b)) * math.sin(a), 0.4 * math.sin(b)))
            p, q, r, s = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
            facets += [(p, q, r), (p, r, s)]
    return off(points, facets)


class ProgressOnATerminal(CliTest):
    def on_terminal(self, *arguments):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([self.program, "mesh", "torus.off", "-o", "out.vtu", *arguments],
                                   cwd=self.folder, stderr=theirs, stdout=subprocess.DEVNULL)
        os.close(theirs)
        shown = b""
        while piece := read_terminal(ours):
            shown += piece
        os.close(ours)
        self.assertEqual(process.wait(60), 0)
        return shown.decode()

    def test_one_bar_that_never_goes_back(self):
        self.write("torus.off", torus(300, 150))
        shown = self.on_terminal()
        bars = re.findall(r"\r(\w+) +\[(=*) *\] +(\d+) %", shown)
        self.assertGreater(len(bars), 5)
        percents = [int(percent) for _, _, percent in bars]
        self.assertEqual(percents, sorted(percents))
        self.assertGreater(percents[-1], 50)
        self.assertGreater(len({stage for stage, _, _ in bars}), 2)
        # It disappears in the end: only the last line remains.
        self.assertRegex(shown, r"\r +\rout\.vtu: ")
        self.assertNotIn("\n", shown[:shown.rindex("\rout.vtu")])

    def test_lines_with_verbose_and_nothing_with_quiet(self):
        self.write("torus.off", torus(30, 20))
        shown = self.on_terminal("--verbose")
        self.assertNotIn(" %", shown.split("input ")[0])
        self.assertRegex(shown, r"\[ +\d+\.\d+ s\] delaunay")
        self.assertEqual(self.on_terminal("--quiet"), "")

    def test_no_bar_without_a_terminal(self):
        self.write("torus.off", torus(60, 30))
        self.assertNotIn("\r", self.run_program("mesh", "torus.off", "-o", "out.vtu").stderr)


if __name__ == "__main__":
    main()
