"""Limits and signals of every command, while it computes, reads and writes.

    limits_test.py PROGRAM [unittest options]
"""
import random
import signal
import subprocess
import time

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

    def test_a_signal_ends_the_writing(self):
        # A reader that does not read: the program waits in the middle of the file until it is told to end.
        process = subprocess.Popen([self.program, "delaunay", "p.xyz", "-q", "-o", "/dev/stdout", "--format", "mesh"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1].decode()  # reads what was written so far, and more if there was more
        self.assertEqual(process.returncode, 5)
        self.assertIn("cancelled", said)


if __name__ == "__main__":
    main()
