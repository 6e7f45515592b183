"""Limits and signals of every command, while it computes, reads and writes.

    limits_test.py PROGRAM [unittest options]
"""
import json
import os
import random
import re
import resource
import signal
import subprocess
import time
from pathlib import Path

from cli_case import CliTest, main


class Limits(CliTest):
    def setUp(self):
        super().setUp()
        points = random.Random(1)
        rows = [f"{points.random()!r} {points.random()!r} {points.random()!r}" for _ in range(60000)]
        self.write("p.xyz", "\n".join(rows) + "\n")

    def test_time_and_memory_of_every_command(self):
        self.run_program("delaunay", "p.xyz", "-o", "v.mesh")
        before = self.files()
        for command in (["delaunay", "p.xyz", "-o", "a.vtu"], ["check", "cube.off", "v.mesh"],
                        ["diagnose", "p.xyz", "--input-format", "off"], ["untangle", "v.mesh", "-o", "a.vtu"]):
            for option, value in (("--time-limit", "1e-6"), ("--memory-limit", "0.001")):
                told = self.run_program(*command, option, value, expect=5)
                self.assertIn(option, told.stderr)
            self.assertIn("--time-limit", self.run_program(*command, "--time-limit", "-1", expect=2).stderr)
        self.assertEqual(self.files(), before)

    def test_a_diagnosis_without_time_for_cures(self):
        # Separate triangles of a square: cures take about twenty times as long as the diagnosis.
        chance, side, vertices = random.Random(1), 60, []
        for i in range(side):
            for j in range(side):
                for x, y in ((0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)):
                    vertices.append([i + x + chance.uniform(-.1, .1), j + y + chance.uniform(-.1, .1),
                                     chance.uniform(-.1, .1)])
        lines = [" ".join(map(str, v)) for v in vertices]
        lines += [f"3 {v} {v + 1} {v + 2}" for v in range(0, len(vertices), 3)]
        self.write("soup.off", f"OFF\n{len(vertices)} {2 * side * side} 0\n" + "\n".join(lines) + "\n")
        limit, code = 0.01, 5
        while code == 5:
            limit *= 2
            told = subprocess.run([self.program, "diagnose", "soup.off", "--report", "r.json", "--html", "r.html",
                                   "--time-limit", str(limit)], cwd=self.folder, capture_output=True, text=True,
                                  timeout=240, check=False)
            code = told.returncode
        self.assertEqual(code, 4, told.stderr)
        causes = told.stdout[:told.stdout.find("\n\n")]
        self.assertIn("crossings of separate parts", causes)
        self.assertIn("the time limit ended the search for cures", causes)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertFalse(report["in_time"])
        self.assertEqual(report["cures"]["proposals"], [])
        self.assertGreater(len(report["defects"]), 1000)

    def test_a_signal_ends_the_writing(self):
        # A reader that does not read: the program waits in the middle of the file until it gets a signal.
        process = subprocess.Popen([self.program, "delaunay", "p.xyz", "-q", "-o", "/dev/stdout", "--format", "mesh"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1].decode()  # reads everything that was written
        self.assertEqual(process.returncode, 5)
        self.assertIn("cancelled", said)

    COMMANDS = (("mesh", "-o", "v.vtu"), ("mesh", "-o", "v.vtu", "--repair"), ("repair", "-o", "out.off"),
                ("paste", "-o", "out.off"), ("plane", "-o", "out.off"), ("tetgen", "-p"))

    # Their reports have the outcome only if the run did not end normally.
    LOOKING = (("check", "cube.off"), ("diagnose",), ("info",), ("delaunay", "-o", "v.vtu"))

    def test_a_limit_that_ends_the_reading_is_in_the_report(self):
        for command, *options in self.COMMANDS:
            for limit, outcome in (("--time-limit", "1e-6"), "time_limit"), (("--memory-limit", "0.001"), "memory_limit"):
                self.run_program(command, *options, "cube.off", "--report", "r.json", *limit, expect=5)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertEqual(report["outcome"], outcome, command)
                self.assertIn(f"the {outcome.replace('_', ' ')} of ", report["message"])
                self.assertIn("options", report)
                (self.folder / "r.json").unlink()
        self.assertEqual(self.files(), ["cube.off", "p.xyz"])

    def test_a_limit_is_in_the_report_of_what_only_looks(self):
        self.run_program("mesh", "cube.off", "-o", "v.vtu", "-q")
        self.run_program("split", "cube.off", "--parts", "1", "-o", "parts")
        before = self.files()
        for command, *options in self.LOOKING + (("check", "parts"),):
            given = [] if "parts" in options else ["v.vtu" if command == "check" else "cube.off"]
            for limit, outcome in (("--time-limit", "1e-6"), "time_limit"), (("--memory-limit", "0.001"), "memory_limit"):
                self.run_program(command, *options, *given, "--report", "r.json", *limit, expect=5)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertEqual(report["outcome"], outcome, command)
                self.assertIn(f"the {outcome.replace('_', ' ')} of ", report["message"])
                (self.folder / "r.json").unlink()
        for command in "diagnose", "info":
            told = self.run_program(command, "cube.off", "--json", "--time-limit", "1e-6", expect=5)
            self.assertEqual(json.loads(told.stdout)["outcome"], "time_limit")
        self.run_program("repair", "cube.off", "-o", "out.off", "--parents", "p.txt", "--report", "claims.json")
        self.run_program("check", "--repaired", "cube.off", "out.off", "--report", "claims.json", "--verdict", "r.json",
                         "--time-limit", "1e-6", expect=5)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outcome"], "time_limit")
        self.assertEqual(self.files(), sorted(before + ["claims.json", "out.off", "p.txt", "r.json"]))

    # A reader that does not read: the program waits in the middle of the file.
    WRITING = (("mesh", "big.off", "--fill", "--format", "mesh"), ("mesh", "big.off", "--repair", "--fill", "--format", "mesh"),
               ("repair", "big.off", "--format", "off"), ("paste", "big.off", "cube.off", "--format", "off"),
               ("plane", "big.node", "--format", "off"), ("untangle", "big.mesh", "--format", "mesh"),
               ("delaunay", "p.xyz", "--format", "mesh"))

    def write_what_takes_more_than_a_pipe(self):
        n = 40
        square = [[i, j] for i in range(n + 1) for j in range(n + 1)]
        low, high = [p + [5] for p in square], [p + [5 + n] for p in square]
        facets = []
        for i in range(n):
            for j in range(n):
                a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
                facets += [(a, c, b), (a, d, c)]
        top = len(low)
        facets += [(a + top, c + top, b + top) for a, b, c in facets]
        ring = ([i * (n + 1) for i in range(n)] + [n * (n + 1) + j for j in range(n)]
                + [i * (n + 1) + n for i in range(n, 0, -1)] + list(range(n, 0, -1)))
        for a, b in zip(ring, ring[1:] + ring[:1]):
            facets += [(a, b, b + top), (a, b + top, a + top)]
        points = low + high
        self.write("big.off", f"OFF\n{len(points)} {len(facets)} 0\n" + "".join("%d %d %d\n" % tuple(p) for p in points)
                   + "".join("3 %d %d %d\n" % f for f in facets))
        chance = random.Random(2)
        self.write("big.node", "5000 2 0 0\n" + "".join(f"{i} {chance.random()!r} {chance.random()!r}\n" for i in range(5000)))
        self.run_program("mesh", "big.off", "-o", "big.mesh", "--fill")

    def test_what_ends_the_writing_is_in_the_report(self):
        self.write_what_takes_more_than_a_pipe()
        before = self.files()
        for command in self.WRITING:
            for outcome in "time_limit", "cancelled":
                for seconds in "4", "16", "64":  # the first is not enough to begin where other processes take the machine
                    limit = ["--time-limit", seconds] if outcome == "time_limit" else []
                    process = subprocess.Popen([self.program, *command, "-q", "-o", "-", "--report", "r.json", *limit],
                                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    if process.stdout.read(1):
                        break
                    process.communicate(timeout=60)
                else:
                    self.fail(f"{command} wrote nothing")
                if outcome == "cancelled":
                    process.send_signal(signal.SIGINT)
                process.wait(60)
                said = process.communicate()[1].decode()
                self.assertEqual(process.returncode, 5, (command, said))
                report = json.loads((self.folder / "r.json").read_text())
                self.assertEqual(report["outcome"], outcome, command)
                self.assertIn("options", report)
                (self.folder / "r.json").unlink()
        self.assertEqual(self.files(), before)

    def wait_until_caught(self, process, number):
        """Waits until a program has its handler of a signal, and then until it probably reads."""
        status = Path(f"/proc/{process.pid}/status")
        for _ in range(600 if status.exists() else 0):
            caught = re.search(r"^SigCgt:\s*([0-9a-f]+)", status.read_text(), re.M)
            if caught and int(caught[1], 16) >> (number - 1) & 1:
                break
            time.sleep(0.1)
        time.sleep(0.3)

    def test_memory_that_the_system_refuses_is_in_the_report(self):
        def little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (48 << 20, 48 << 20))

        chance = random.Random(3)
        self.write("many.xyz", "".join(f"{chance.random():.6f} {chance.random():.6f} {chance.random():.6f}\n" for _ in range(100000)))
        for command in (["delaunay", "many.xyz"], ["mesh", "cube.off", "--size", "0.02"]):
            ended = subprocess.run([self.program, *command, "-o", "out.mesh", "--report", "r.json"], cwd=self.folder,
                                   stderr=subprocess.PIPE, preexec_fn=little_memory, timeout=240, check=False)
            self.assertEqual(ended.returncode, 5, ended.stderr)
            self.assertIn(b"out of memory", ended.stderr)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual((report["outcome"], report["message"]), ("memory_limit", "out of memory"))
            (self.folder / "r.json").unlink()
            self.assertFalse((self.folder / "out.mesh").exists())

    def test_a_signal_that_ends_the_reading_is_in_the_report(self):
        """A pipe, named or not, to which nobody writes, or only a part of a file."""
        os.mkfifo(self.folder / "pipe.off")
        os.mkfifo(self.folder / "pipe.poly")
        self.run_program("delaunay", "p.xyz", "-o", "v.vtu")
        for command, *options in self.COMMANDS + self.LOOKING:
            for source in "-", "pipe.off", "part":
                if command == "tetgen":
                    if source != "pipe.off":
                        continue
                    given = ["pipe.poly"]
                else:
                    given = [source if source == "pipe.off" else "-"] + (["--input-format", "off"] if source != "pipe.off" else [])
                if command == "check":
                    options, given = [], given[:1] + ["v.vtu"] + given[1:]
                process = subprocess.Popen([self.program, command, *options, *given, "--report", "r.json"], cwd=self.folder,
                                           stdin=subprocess.PIPE, stderr=subprocess.PIPE)
                if source == "part":
                    process.stdin.write(b"OFF\n8 12 0\n0 0 0\n")
                    process.stdin.flush()
                self.wait_until_caught(process, signal.SIGINT)
                self.assertIsNone(process.poll(), (command, source))
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(60), 5, (command, source))
                said = process.stderr.read().decode()
                process.communicate()
                self.assertIn("cancelled", said)
                self.assertEqual(json.loads((self.folder / "r.json").read_text())["outcome"], "cancelled", command)
                (self.folder / "r.json").unlink()

    WITHOUT_REPORT = (("convert", "-o", "out.off"), ("view", "-o", "page.html"), ("view",), ("split", "--parts", "2", "-o", "parts"))

    def test_a_signal_that_ends_the_reading_is_told_in_one_way(self):
        os.mkfifo(self.folder / "pipe.off")
        (self.folder / "tmp").mkdir()
        before = self.files()
        for command in self.WITHOUT_REPORT:
            for sent in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
                process = subprocess.Popen([self.program, *command, "pipe.off"], cwd=self.folder, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, env={**os.environ, "TMPDIR": str(self.folder / "tmp")})
                self.wait_until_caught(process, sent)
                process.send_signal(sent)
                said = process.communicate(timeout=60)[1].decode()
                self.assertEqual((process.returncode, said), (5, "holdfast: cancelled; nothing was written\n"), command)
        self.assertEqual(self.files(), before)
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_a_page_that_cannot_be_written_leaves_no_empty_one(self):
        (self.folder / "tmp").mkdir()
        pages = self.folder / "tmp"
        code = f"ulimit -f 1; exec '{self.program}' view cube.off"
        told = subprocess.run(["bash", "-c", code], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "TMPDIR": str(pages)})
        self.assertEqual(told.returncode, 3, told.stderr)
        self.assertEqual(list(pages.iterdir()), [])

    def test_a_time_limit_holds_while_a_pipe_is_waited_for(self):
        os.mkfifo(self.folder / "pipe.off")
        self.run_program("mesh", "pipe.off", "-o", "v.vtu", "--time-limit", "0.2", "--report", "r.json", expect=5)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outcome"], "time_limit")

    def test_what_comes_through_a_named_pipe(self):
        os.mkfifo(self.folder / "pipe.off")
        process = subprocess.Popen([self.program, "mesh", "pipe.off", "-o", "v.vtu"], cwd=self.folder)
        time.sleep(0.2)
        with open(self.folder / "pipe.off", "w") as pipe:
            for line in (self.folder / "cube.off").read_text().splitlines(keepends=True):
                pipe.write(line)
                pipe.flush()
        self.assertEqual(process.wait(), 0)
        self.run_program("check", "cube.off", "v.vtu")


if __name__ == "__main__":
    main()
