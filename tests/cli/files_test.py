"""No file is lost: which files are written, where, and what remains after a failed run.

    files_test.py PROGRAM [unittest options]
"""
import os
import resource
import signal
import socket
import subprocess
import threading
import time

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, main, off

# A tetrahedron's surface, and the volume in which it is one element, in TetGen's files.
NODE = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"
ELE = "1 4 0\n0 0 1 2 3\n"
TETRAHEDRON = off([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
MEDIT = ("MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         "Tetrahedra 1\n1 2 3 4 0\nEnd\n")
SOL = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices 4\n1 1\n1\n1\n1\n1\nEnd\n"


class NothingIsOverwritten(CliTest):
    """Each command line names one file twice; nothing may change, and no work may be done first."""

    def refuse(self, *arguments, named):
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        said = self.run_program(*arguments, expect=2).stderr
        for word in named:
            self.assertIn(word, said)
        after = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        self.assertEqual(after, before)

    def test_inputs_of_mesh(self):
        self.write("tet.mesh", MEDIT)
        for option in ("--report", "--exact"):
            self.refuse("mesh", "cube.off", "-o", "out.vtu", option, "cube.off", named=[option, "cube.off", "input"])
        self.refuse("mesh", "cube.off", "tet.mesh", "-o", "tet.mesh", named=["-o", "tet.mesh"])
        self.refuse("mesh", "tet.mesh", "cube.off", "-o", "out.vtu", "--report", "cube.off", named=["cube.off"])

    def test_links_and_other_spellings(self):
        (self.folder / "sub").mkdir()
        os.symlink("cube.off", self.folder / "soft.json")
        os.link(self.folder / "cube.off", self.folder / "hard.json")
        os.symlink("..", self.folder / "sub" / "up")
        for name in ("soft.json", "hard.json", "./cube.off", "sub/../cube.off", "sub/up/cube.off",
                     self.folder / "cube.off"):
            with self.subTest(name):
                self.refuse("mesh", "cube.off", "-o", "out.vtu", "--report", name, named=["--report"])
        self.refuse("mesh", "soft.json", "--input-format", "off", "-o", "out.vtu", "--report", "hard.json",
                    named=["--report"])

    def test_two_outputs_that_are_not_there_yet(self):
        (self.folder / "sub").mkdir()
        os.symlink("sub", self.folder / "same")
        os.symlink("later.vtu", self.folder / "dangling.json")
        for output, report in [("a.vtu", "a.vtu"), ("a.vtu", "./a.vtu"), ("sub/a.vtu", "same/a.vtu"),
                               ("later.vtu", "dangling.json"), ("dangling.json", "later.vtu")]:
            with self.subTest(report):
                self.refuse("mesh", "cube.off", "-o", output, "--format", "vtu", "--report", report,
                            named=["-o", "--report"])
        self.refuse("mesh", "cube.off", "-o", "a.vtu", "--report", "b", "--exact", "b", named=["--report", "--exact"])

    def test_files_that_go_together(self):
        for name, text in [("tet.node", NODE), ("tet.ele", ELE), ("tet.edge", "0 0\n"), ("tet.face", "0 0\n")]:
            self.write(name, text)
        # Outputs other than -o.
        for beside in ("new.ele", "new.face", "new.edge"):
            self.refuse("mesh", "cube.off", "-o", "new.node", "--report", beside, named=[beside])
        os.symlink("tet.ele", self.folder / "new.edge")
        self.refuse("untangle", "tet.node", "-o", "new.node", named=["new.edge"])
        os.remove(self.folder / "new.edge")
        # Inputs other than the surface.
        for beside in ("tet.ele", "tet.face", "tet.edge"):
            self.refuse("untangle", "tet.node", "-o", "out.vtu", "--report", beside, named=[beside])
            self.refuse("check", "cube.off", "tet.ele", "--report", beside, named=[beside])
        self.refuse("untangle", "tet.node", "-o", "tet.ele", named=["tet.node"])

    def test_nodes_of_a_poly_file(self):
        facets = "4 0\n" + "".join(f"1\n3 {a} {b} {c}\n" for a, b, c in [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
        self.write("tet.node", NODE)
        self.write("tet.poly", "# the vertices are elsewhere\n\n 0 3 0 0\n" + facets + "0\n0\n")
        self.refuse("mesh", "tet.poly", "-o", "tet.node", named=["tet.node"])
        # With its own vertices it does not read the .node file, and may be meshed twice.
        self.write("own.poly", NODE + facets + "0\n0\n")
        for _ in range(2):
            self.run_program("mesh", "own.poly", "-o", "own.node", "--fill")

    def test_included_files(self):
        self.write("job.inp", "*INCLUDE, INPUT=all.inp\n")
        self.write("all.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n")
        for command in (["mesh", "--surface-of", "job.inp", "-o"], ["convert", "job.inp"]):
            self.assertIn("would overwrite the input", self.run_program(*command, "all.inp", expect=2).stderr)
            self.run_program(*command, "other.inp")
        # A file that an output will replace is not an input.
        self.run_program("convert", "all.inp", "job.inp")

    def test_size_fields(self):
        self.write("background.mesh", MEDIT)
        self.write("background.sol", SOL)
        for name in ("background.mesh", "background.sol"):
            for option in ("--report", "--exact"):
                for field in ("background.mesh", "background.sol"):
                    self.refuse("mesh", "cube.off", "-o", "out.vtu", "--size-field", field, option, name,
                                named=[option, name])
        self.refuse("mesh", "cube.off", "-o", "background.mesh", "--size-field", "background.sol", named=["-o"])
        self.write("tet.node", NODE)
        self.write("tet.ele", ELE)
        self.write("tet.mtr", "4 1\n1\n1\n1\n1\n")
        self.refuse("mesh", "cube.off", "-o", "tet.ele", "--size-field", "tet.mtr", named=["-o"])

    def test_every_command(self):
        self.write("tet.off", TETRAHEDRON)
        self.write("tet.mesh", MEDIT)
        self.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        self.refuse("diagnose", "cube.off", "--report", "cube.off", named=["--report"])
        self.refuse("diagnose", "cube.off", "--marks", "cube.off", named=["--marks"])
        self.refuse("diagnose", "cube.off", "--marks", "m", "--report", "m", named=["--marks", "--report"])
        self.refuse("check", "tet.off", "tet.mesh", "--report", "tet.mesh", named=["--report"])
        self.refuse("check", "tet.off", "tet.mesh", "--report", "tet.off", named=["--report"])
        self.refuse("delaunay", "points.xyz", "-o", "points.xyz", "--format", "vtu", named=["-o"])
        self.refuse("delaunay", "points.xyz", "-o", "d.vtu", "--report", "points.xyz", named=["--report"])
        self.refuse("delaunay", "points.xyz", "-o", "d.vtu", "--report", "d.vtu", named=["-o", "--report"])
        self.refuse("untangle", "tet.mesh", "-o", "tet.mesh", named=["-o"])
        self.refuse("untangle", "tet.mesh", "-o", "u.mesh", "--report", "u.mesh", named=["-o", "--report"])

    def test_nowhere_may_be_named_twice(self):
        self.run_program("mesh", "cube.off", "-o", "/dev/null", "--format", "vtu", "--report", "/dev/null", "--fill")


class StandardStreams(CliTest):
    def pipe(self, *arguments, given=b"", expect=0, stdout=subprocess.PIPE):
        ended = subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, input=given, stdout=stdout,
                               stderr=subprocess.PIPE, timeout=120, check=False)
        self.assertEqual(ended.returncode, expect, ended.stderr)
        return ended

    def test_through_pipes_as_through_files(self):
        surface = (self.folder / "cube.off").read_bytes()
        for kind in ("vtu", "vtk", "mesh", "meshb", "msh"):
            with self.subTest(kind):
                # A pipe has room for one file only.
                self.run_program("mesh", "cube.off", "-o", f"a.{kind}", "--fill", "-q",
                                 *(["--one-file"] if kind == "vtu" else []))
                expected = (self.folder / f"a.{kind}").read_bytes()
                ended = self.pipe("mesh", "-", "-o", "-", "--fill", "--input-format", "off", "--format", kind,
                                  given=surface)
                self.assertEqual(ended.stdout, expected)
                self.assertIn(b"8 vertices", ended.stderr)
                ended = self.pipe("check", "cube.off", "-", "--format", kind, given=expected)
                self.assertEqual(ended.stdout.count(b"holds"), ended.stdout.count(b"\n"))
                self.pipe("untangle", "-", "-o", "-", "--input-format", kind, "--format", kind, given=expected)
        self.pipe("check", "-", "a.vtu", "--input-format", "off", given=surface)
        self.assertIn(b"valid", self.pipe("diagnose", "-", "--input-format", "off", given=surface).stdout)
        points = b"0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        ended = self.pipe("delaunay", "-", "-o", "-", "--input-format", "xyz", "--format", "mesh", given=points)
        self.assertIn(b"Tetrahedra\n1\n", ended.stdout)

    def test_the_report_alone_goes_to_stdout(self):
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--fill", "-q")
        self.write("open.off", off(CUBE_POINTS, CUBE_FACETS[1:] + [(0, 1, 2)]))
        for arguments, code in [(["mesh", "cube.off", "-o", "b.vtu", "--fill"], 0), (["check", "cube.off", "a.vtu"], 0),
                                (["diagnose", "cube.off"], 0), (["diagnose", "open.off"], 4)]:
            with self.subTest(arguments):
                ended = self.pipe(*arguments, "--report", "-", expect=code)
                self.assertTrue(ended.stdout.startswith(b"{") and ended.stdout.endswith(b"}\n"), ended.stdout)
                self.assertNotEqual(ended.stderr, b"")
        marks = self.pipe("diagnose", "open.off", "--marks", "-", expect=4)
        self.assertTrue(marks.stdout.startswith(b"<?xml"), marks.stdout[:40])

    def test_wrong_usage(self):
        for arguments, words in [
            (["mesh", "-", "-o", "a.vtu"], ["standard input", "--input-format"]),
            (["mesh", "cube.off", "-o", "-"], ["standard output", "--format"]),
            (["mesh", "cube.off", "-o", "-", "--format", "vtu", "--report", "-"], ["-o", "--report"]),
            (["mesh", "cube.off", "-o", "-", "--format", "vtu", "--report", "/dev/stdout"], ["-o", "--report"]),
            (["mesh", "cube.off", "-o", "-", "--format", "node"], ["node", "4 files"]),
            (["mesh", "cube.off", "-o", "-", "--format", "openfoam"], ["openfoam", "files", "need a name"]),
            (["mesh", "cube.off", "-o", "a.vtu", "--size-field", "/dev/stdin"], ["--size-field"]),
            (["diagnose", "cube.off", "--json", "--report", "-"], ["--json", "--report"]),
            (["check", "-", "-", "--format", "vtu", "--input-format", "off"], ["once"]),
            (["delaunay", "-", "-o", "a.vtu"], ["--input-format"]),
            (["untangle", "-", "-o", "a.vtu"], ["--input-format"]),
        ]:
            with self.subTest(arguments):
                said = self.pipe(*arguments, expect=2)
                self.assertEqual(said.stdout, b"")
                for word in words:
                    self.assertIn(word, said.stderr.decode())
        self.assertEqual(self.files(), ["cube.off"])

    def test_stdout_is_written_where_it_stands(self):
        """A file to which stdout is redirected is neither replaced nor truncated."""
        path = self.write("log", "before\n")
        with path.open("ab") as log:
            self.pipe("mesh", "cube.off", "-o", "/dev/stdout", "--format", "mesh", "--fill", stdout=log)
            log.write(b"after\n")
        text = path.read_text()
        self.assertTrue(text.startswith("before\nMeshVersion") and text.endswith("\nafter\n"), text[:80])

    def test_stdin_is_read_from_where_it_stands(self):
        path = self.write("two", "a line of another program\n" + off(CUBE_POINTS, CUBE_FACETS))
        with path.open("rb", buffering=0) as file:
            file.seek(len("a line of another program\n"))
            ended = subprocess.run([self.program, "diagnose", "-", "--input-format", "off"], stdin=file,
                                   stdout=subprocess.PIPE, timeout=60, check=False)
        self.assertEqual(ended.returncode, 0)

    def test_sockets(self):
        """As inetd and some runtimes start programs; it cannot be opened by name."""
        ours, theirs = socket.socketpair()
        with theirs:
            process = subprocess.Popen([self.program, "mesh", "-", "-o", "-", "--fill", "--input-format", "off",
                                        "--format", "mesh", "-q"], stdin=theirs, stdout=theirs)
        with ours:
            ours.sendall((self.folder / "cube.off").read_bytes())
            ours.shutdown(socket.SHUT_WR)
            got = b"".join(iter(lambda: ours.recv(65536), b""))
        self.assertEqual(process.wait(60), 0)
        self.assertIn(b"Tetrahedra", got)

    def test_an_input_that_stdout_is_appended_to(self):
        with (self.folder / "cube.off").open("ab") as file:
            self.pipe("mesh", "cube.off", "-o", "-", "--format", "mesh", stdout=file, expect=2)
        self.run_program("diagnose", "cube.off")

    def test_other_descriptors_and_named_pipes(self):
        self.run_program("mesh", "cube.off", "-o", "a.mesh", "--fill", "-q")
        expected = (self.folder / "a.mesh").read_bytes()
        for name in ("fifo", None):
            read_end, write_end = os.pipe()
            if name:
                os.mkfifo(self.folder / name)
            got = []

            def collect():
                with open(self.folder / name if name else read_end, "rb") as stream:
                    got.append(stream.read())

            reader = threading.Thread(target=collect)
            reader.start()
            subprocess.run([self.program, "mesh", "cube.off", "-o", name or f"/dev/fd/{write_end}", "--format", "mesh",
                            "--fill", "-q"], cwd=self.folder, pass_fds=[write_end], timeout=60, check=True)
            os.close(write_end)
            reader.join()
            self.assertEqual(got, [expected], name)
        self.assertTrue((self.folder / "fifo").is_fifo())

    def test_closed_streams_get_no_messages(self):
        """If stderr is closed, for example, a file that is opened must not become stderr."""
        for closed in ([2], [1], [0], [0, 1, 2]):
            with self.subTest(closed):
                def close(descriptors=tuple(closed)):
                    for descriptor in descriptors:
                        os.close(descriptor)

                code = subprocess.run([self.program, "mesh", "cube.off", "-o", "a.mesh", "--fill", "-v", "--report",
                                       "r.json"], cwd=self.folder, stderr=subprocess.DEVNULL, preexec_fn=close,
                                      timeout=60, check=False).returncode
                self.assertEqual(code, 0)
                self.run_program("check", "cube.off", "a.mesh")
                self.assertTrue((self.folder / "r.json").read_text().startswith("{"))
        ended = subprocess.run([self.program, "mesh", "cube.off", "-o", "-", "--format", "mesh"], cwd=self.folder,
                               stderr=subprocess.PIPE, preexec_fn=lambda: os.close(1), timeout=60, check=False)
        self.assertEqual(ended.returncode, 3, ended.stderr)


class FailuresLeaveNothing(CliTest):
    def setUp(self):
        super().setUp()
        # 4,000 triangles: files of more than the 64 KiB that a pipe holds.
        n = 32
        points = [(i, j, k) for k in (0, 1) for j in range(n) for i in range(n)]
        at = lambda i, j, k: (k * n + j) * n + i
        facets = []
        for i in range(n - 1):
            for j in range(n - 1):
                for k, turn in ((0, 1), (1, -1)):
                    a, b, c, d = at(i, j, k), at(i, j + 1, k), at(i + 1, j + 1, k), at(i + 1, j, k)
                    facets += [(a, b, c)[::turn], (a, c, d)[::turn]]
        ring = ([(i, 0) for i in range(n - 1)] + [(n - 1, j) for j in range(n - 1)]
                + [(i, n - 1) for i in range(n - 1, 0, -1)] + [(0, j) for j in range(n - 1, 0, -1)])
        for p, q in zip(ring, ring[1:] + ring[:1]):
            facets += [(at(*p, 0), at(*q, 0), at(*q, 1)), (at(*p, 0), at(*q, 1), at(*p, 1))]
        self.write("slab.off", off(points, facets))

    def test_a_reader_that_goes_away_is_3(self):
        process = subprocess.Popen([self.program, "mesh", "slab.off", "-o", "-", "--format", "mesh", "--fill", "-q"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.read(100)
        process.stdout.close()
        said = process.stderr.read().decode()
        process.stderr.close()
        self.assertEqual(process.wait(60), 3, said)
        self.assertIn("/dev/stdout", said)
        self.assertEqual(said.count("\n"), 1, said)
        self.assertEqual(self.files(), ["cube.off", "slab.off"])

    def test_a_listing_that_nobody_reads_is_3(self):
        # Every vertex lies in a facet of a copy that is shifted within the plane.
        process = subprocess.Popen([self.program, "diagnose", "slab.off", "cube.off"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.close()
        said = process.stderr.read().decode()
        process.stderr.close()
        self.assertEqual(process.wait(60), 3, said)

    def test_messages_that_nobody_reads_do_not_end_the_work(self):
        process = subprocess.Popen([self.program, "mesh", "slab.off", "-o", "a.mesh", "--fill", "-v"], cwd=self.folder,
                                   stderr=subprocess.PIPE)
        process.stderr.close()
        self.assertEqual(process.wait(60), 0)
        self.run_program("check", "slab.off", "a.mesh")

    def test_a_full_disk_is_3(self):
        with open("/dev/full", "wb") as full:
            for arguments in (["mesh", "cube.off", "-o", "-", "--format", "vtu", "--fill"],
                              ["mesh", "cube.off", "-o", "/dev/full", "--format", "vtu", "--fill"],
                              ["mesh", "cube.off", "-o", "a.vtu", "--report", "-", "--fill"],
                              ["diagnose", "cube.off"], ["diagnose", "cube.off", "--json"]):
                with self.subTest(arguments):
                    ended = subprocess.run([self.program, *arguments], cwd=self.folder, stdout=full,
                                           stderr=subprocess.PIPE, timeout=60, check=False)
                    self.assertEqual(ended.returncode, 3, ended.stderr)
                    self.assertIn(b"No space left", ended.stderr)

    def test_a_file_that_may_not_grow_is_3_and_leaves_nothing(self):
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))

        for name, files in (("a.mesh", ["-o", "a.mesh"]), ("a.node", ["-o", "a.node"]),
                            ("e.json", ["-o", "/dev/null", "--format", "mesh", "--report", "e.json"])):
            with self.subTest(name):
                if name.startswith("e"):
                    resource_limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
                else:
                    resource_limit = small_files
                before = self.files()
                ended = subprocess.run([self.program, "mesh", "slab.off", "--fill", *files], cwd=self.folder,
                                       stderr=subprocess.PIPE, preexec_fn=resource_limit, timeout=60, check=False)
                self.assertEqual(ended.returncode, 3, ended.stderr)
                self.assertIn(b"too large", ended.stderr)
                self.assertEqual(self.files(), before)


class Signals(CliTest):
    def busy(self, *arguments, ignored=()):
        """A run, after it has begun, that would take minutes."""
        n = 60
        points = [(x, y, 1e-3 * ((7 * x * y) % 5)) for x in range(n) for y in range(n)]
        facets = [t for x in range(n - 1) for y in range(n - 1)
                  for t in ((n * x + y, n * x + y + 1, n * x + n + y), (n * x + y + 1, n * x + n + y + 1, n * x + n + y))]
        self.write("sheet.off", off(points, facets))

        def ignore():
            for number in ignored:
                signal.signal(number, signal.SIG_IGN)

        process = subprocess.Popen([self.program, "mesh", "sheet.off", "--keep", "box=2", "--size", "0.3", "-v",
                                    *arguments], cwd=self.folder, stderr=subprocess.PIPE, text=True, preexec_fn=ignore)
        process.stderr.readline()
        return process

    def test_all_that_ask_for_an_end_are_5_and_leave_nothing(self):
        for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = self.busy("-o", "a.vtu", "--report", "r.json")
                process.send_signal(number)
                said = process.communicate(timeout=60)[1]
                self.assertEqual(process.returncode, 5, said)
                self.assertIn("cancelled", said)
                self.assertEqual([f for f in self.files() if f.endswith((".vtu", ".tmp", ".part"))], [])

    def test_what_nohup_ignores_stays_ignored(self):
        process = self.busy("-o", "a.vtu", ignored=(signal.SIGHUP,))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 5)

    def test_a_second_request_of_any_kind_ends_the_program_at_once(self):
        # A full pipe that nobody reads: the program waits in the middle of its first message.
        reading, full = os.pipe()
        os.set_blocking(full, False)
        with self.assertRaises(BlockingIOError):
            while True:
                os.write(full, b" " * 512)
        os.set_blocking(full, True)
        for first, second in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGHUP), (signal.SIGHUP, signal.SIGHUP)):
            with self.subTest(f"{first.name}, {second.name}"):
                process = subprocess.Popen([self.program, "mesh", "cube.off", "-o", "a.vtu", "-v"], cwd=self.folder, stderr=full)
                time.sleep(0.3)
                process.send_signal(first)
                time.sleep(0.3)
                self.assertIsNone(process.poll())
                process.send_signal(second)
                try:
                    self.assertEqual(process.wait(10), -second)
                finally:
                    process.kill()
                    process.wait()
        os.close(reading)
        os.close(full)

    def test_a_writer_that_is_hung_up_on_leaves_nothing(self):
        """A second request ends the program at once, also while it writes; here it is blocked by a full pipe."""
        os.mkfifo(self.folder / "fifo")
        process = subprocess.Popen([self.program, "mesh", "cube.off", "-o", "fifo", "--format", "mesh", "--fill"],
                                   cwd=self.folder, stderr=subprocess.PIPE)
        time.sleep(0.3)  # it waits for a reader
        for _ in range(2):
            process.send_signal(signal.SIGHUP)
            time.sleep(0.2)
        process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(self.files(), ["cube.off", "fifo"])


if __name__ == "__main__":
    main()
