"""A program that is killed while it writes: the final name has the complete new file, or the complete old one, or nothing.

    killed_test.py PROGRAM [unittest options]
"""
import os
import random
import signal
import subprocess
import time

from cli_case import CliTest, main

RUNS = 24


class Killed(CliTest):
    def knows_nameless_files(self):
        """Whether the system has files that disappear with the process, so that no temporary file can stay."""
        try:
            os.close(os.open(self.folder, os.O_TMPFILE | os.O_RDWR))
        except (AttributeError, OSError):
            return False
        return os.path.exists("/proc/self/fd")

    def test_no_partial_file_under_the_final_name(self):
        points = random.Random(1)
        rows = [f"{points.random()!r} {points.random()!r} {points.random()!r}" for _ in range(15000)]
        self.write("p.xyz", "\n".join(rows) + "\n")
        command = [self.program, "delaunay", "p.xyz", "-q", "-o", "a.mesh"]
        started = time.monotonic()
        subprocess.run(command, cwd=self.folder, check=True)
        seconds = time.monotonic() - started
        path = self.folder / "a.mesh"
        whole = path.read_bytes()
        for old in (None, b"the old one\n"):
            unfinished = 0
            for run in range(RUNS):
                path.unlink(missing_ok=True)
                if old is not None:
                    path.write_bytes(old)
                process = subprocess.Popen(command, cwd=self.folder)
                time.sleep(seconds * run / RUNS)
                process.send_signal(signal.SIGKILL)
                process.wait()
                found = path.read_bytes() if path.exists() else None
                self.assertIn(found, (whole, old), f"killed after {run} of {RUNS} parts of the time")
                unfinished += found == old
                if self.knows_nameless_files():
                    # A file gets a temporary name before the final one: if the program is killed between the two, it is complete.
                    for left in set(self.files()) - {"a.mesh", "cube.off", "p.xyz"}:
                        self.assertEqual((self.folder / left).read_bytes(), whole)
                        (self.folder / left).unlink()
            self.assertGreater(unfinished, 0)  # otherwise nothing was tested


if __name__ == "__main__":
    main()
