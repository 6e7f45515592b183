"""`holdfast split`, `join` and `check DIR` from outside.

    divide_test.py PROGRAM [unittest options]
"""
import json
import re
import resource
import shutil
import struct
import subprocess
import zlib

from cli_case import CUBE_FACETS, CUBE_POINTS, CliTest, cube, main, off, shifted


def copy_volume(source, target):
    """With its boundary, in the second file."""
    for end in (".vtu", "_surface.vtu"):
        shutil.copy(source.with_name(source.stem + end), target.with_name(target.stem + end))


SIZES = {"Float64": 8, "Int64": 8, "UInt64": 8, "Int32": 4, "UInt32": 4, "UInt8": 1}


def arrays_of(data):
    """name -> its bytes, of an appended section in zlib blocks with headers of 64 bits."""
    head, appended = data.split(b'<AppendedData encoding="raw">\n_', 1)
    found = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)".* offset="(\d+)" */>', head):
        assert offset == b"%d" % int(offset)
        at = int(offset)
        blocks, size, last = struct.unpack_from("<3Q", appended, at)
        lengths = struct.unpack_from(f"<{blocks}Q", appended, at + 24)
        at += 24 + 8 * blocks
        content = b""
        for k, length in enumerate(lengths):
            block = zlib.decompress(appended[at:at + length])
            assert len(block) == (last or size if k == blocks - 1 else size)
            content, at = content + block, at + length
        assert len(content) % SIZES[kind.decode()] == 0
        found[name.decode()] = content
    return found


class Divided(CliTest):
    def split(self, *options, parts=3, surface="cube.off"):
        self.run_program("split", surface, "--parts", parts, "-o", "d", *options)
        self.manifest = json.loads((self.folder / "d" / "manifest.json").read_text())
        return self.manifest["parts"]

    def mesh(self, *which):
        parts = self.manifest["parts"]
        for part in [parts[k] for k in which] or parts:
            self.run_program("mesh", f"d/{part['surface']}", "-o", f"d/{part['volume']}", "-q")

    def test_parts_are_meshed_without_options_checked_and_joined(self):
        self.split("--size", 0.15)
        self.assertEqual(len(self.manifest["parts"]), 3)
        for part in self.manifest["parts"]:
            self.run_program("diagnose", f"d/{part['surface']}")
            self.assertGreater(part["interface_triangles"], 0)
        self.mesh()
        self.assertIn("holds", self.run_program("check", "d").stdout)
        for ending in ("vtu", "mesh", "msh"):
            self.run_program("join", "d", "-o", f"whole.{ending}")
            self.run_program("check", "cube.off", f"whole.{ending}")

    def test_the_joined_file_is_compressed_where_it_is_a_file(self):
        self.split("--size", 0.05, parts=2)
        self.mesh()
        self.run_program("join", "d", "-o", "whole.vtu")
        data = (self.folder / "whole.vtu").read_bytes()
        arrays = arrays_of(data)
        cells, points = (int(re.search(rb'%s="(\d+)"' % of, data)[1]) for of in (b"NumberOfCells", b"NumberOfPoints"))
        self.assertGreater(len(arrays["connectivity"]), 1 << 18)  # several blocks
        self.assertEqual({name: len(array) for name, array in arrays.items() if name != "connectivity"},
                         {"Points": 24 * points, "offsets": 8 * cells, "types": cells, "region": 4 * cells, "marker": 4 * cells,
                          "kind": 4 * cells, "input_vertex": 8 * points})
        # A pipe cannot be written twice, and so holds the arrays as they are.
        piped = subprocess.run([self.program, "join", "d", "-o", "-", "--format", "vtu"], cwd=self.folder, capture_output=True, check=True)
        self.assertNotIn(b"compressor", piped.stdout[:500])
        self.assertLess(2 * len(data), len(piped.stdout))
        (self.folder / "piped.vtu").write_bytes(piped.stdout)
        for name in ("whole", "piped"):
            self.run_program("convert", f"{name}.vtu", "-o", f"{name}.mesh")
        self.assertEqual((self.folder / "whole.mesh").read_bytes(), (self.folder / "piped.mesh").read_bytes())

    def test_sizes_of_regions_go_into_the_parts(self):
        self.split("--region", "0.5,0.5,0.5,8,0.1")
        self.mesh()
        self.run_program("join", "d", "-o", "whole.vtu")
        self.run_program("mesh", "cube.off", "--region", "0.5,0.5,0.5,8,0.1", "-o", "one.vtu", "--report", "r.json")
        one = json.loads((self.folder / "r.json").read_text())["mesh"]["tetrahedra"]
        text = (self.folder / "whole.vtu").read_bytes()[:2000].decode("latin-1")
        cells = int(text.split('NumberOfCells="')[1].split('"')[0]) - 12
        self.assertLess(cells, 1.25 * one)
        self.assertGreater(cells, 0.8 * one)

    def test_markers_and_names_survive(self):
        self.write("cube.obj", "".join("v %r %r %r\n" % p for p in CUBE_POINTS)
                   + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in CUBE_FACETS))
        self.split("--size", 0.3, "--name", "region:1=core", surface="cube.obj")
        self.assertEqual(self.manifest["names"]["regions"]["1"], "core")
        self.mesh()
        self.run_program("check", "d")
        self.run_program("join", "d", "-o", "whole.vtu")
        self.assertIn("core", self.run_program("info", "whole.vtu").stdout)

    def test_what_is_missing_exchanged_or_stale_is_found(self):
        parts = self.split("--size", 0.25)
        self.mesh(0, 1)
        d = self.folder / "d"
        self.assertIn(parts[2]["volume"], self.run_program("check", "d", expect=6).stdout)
        self.run_program("join", "d", "-o", "whole.vtu", expect=3)
        self.assertFalse((self.folder / "whole.vtu").exists())
        self.mesh(2)
        self.run_program("check", "d")
        copy_volume(d / parts[0]["volume"], self.folder / "kept.vtu")
        copy_volume(d / parts[1]["volume"], d / parts[0]["volume"])
        self.run_program("check", "d", expect=6)
        self.run_program("join", "d", "-o", "whole.vtu", expect=6)
        copy_volume(self.folder / "kept.vtu", d / parts[0]["volume"])
        self.run_program("check", "d")
        self.split("--size", 0.2)
        self.run_program("check", "d", expect=6)
        self.mesh()
        (d / parts[1]["surface"]).write_text((d / parts[1]["surface"]).read_text() + "\n")
        self.assertIn("checksum", self.run_program("check", "d", expect=6).stdout)

    def test_volumes_that_are_no_meshes_of_their_parts_are_not_joined(self):
        parts = self.split("--size", 0.3)
        self.mesh()
        first = self.folder / "d" / parts[0]["volume"]
        surface = (self.folder / "d" / parts[0]["surface"]).read_text()
        for spoil, words in [
                (lambda: first.with_name(first.stem + "_surface.vtu").unlink(), "other facets"),
                (lambda: self.run_program("mesh", f"d/{parts[0]['surface']}", "-o", first, "--keep", "box"), "regions are 0, 1"),
                (lambda: self.run_program("mesh", "other.poly", "-o", first), "regions are 33, in place of 1")]:
            self.write("other.poly", re.sub(r" 1( \S+\s*)$", r" 33\1", surface))
            spoil()
            self.assertIn(words, self.run_program("check", "d", expect=6).stdout)
            for ending in ("vtu", "mesh", "pvtu"):
                self.assertIn(words, self.run_program("join", "d", "-o", f"whole.{ending}", expect=6).stderr)
                self.assertFalse((self.folder / f"whole.{ending}").exists())

    def test_nodes_of_second_order_are_told(self):
        parts = self.split("--size", 0.3)
        for part in parts:
            self.run_program("mesh", f"d/{part['surface']}", "-o", f"d/{part['volume']}", "--order", 2)
        self.run_program("check", "d")
        for ending in ("vtu", "mesh", "pvtu"):
            self.assertIn("mid-edge nodes", self.run_program("join", "d", "-o", f"whole.{ending}").stderr)
            self.run_program("check", "cube.off", f"whole.{ending}")

    def test_parts_of_an_earlier_split_are_told(self):
        self.split("--size", 0.3)
        self.assertIn("d/part_3.poly is left", self.run_program("split", "cube.off", "--parts", 2, "-o", "d", "--size", 0.3).stderr)

    def test_no_folder_is_left_where_nothing_is_written(self):
        lines = (self.folder / "cube.off").read_text().splitlines()
        self.write("open.off", "\n".join(["OFF", f"{len(CUBE_POINTS)} {len(CUBE_FACETS) - 1} 0", *lines[2:-1]]) + "\n")
        before = self.files()
        self.run_program("split", "open.off", "--parts", "2", "-o", "new/d", expect=4)
        self.run_program("split", "none.off", "--parts", "2", "-o", "new/d", expect=3)
        self.run_program("split", "cube.off", "--parts", "2", "-o", "cube.off", expect=3)
        self.assertEqual(self.files(), before)
        self.assertFalse((self.folder / "new").exists())

    def test_a_split_that_stops_while_it_writes_leaves_nothing(self):
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000))  # more than the copy of the surface, less than a part

        def stopped():
            ended = subprocess.run([self.program, "split", "cube.off", "--parts", "2", "-o", "new/d", "--size", "0.1"],
                                   cwd=self.folder, stderr=subprocess.PIPE, preexec_fn=small_files, timeout=60, check=False)
            self.assertEqual(ended.returncode, 3, ended.stderr)
            self.assertIn(b"new/d/part_1.poly: cannot be written", ended.stderr)

        stopped()
        self.assertFalse((self.folder / "new").exists())
        self.run_program("split", "cube.off", "--parts", 2, "-o", "new/d", "--size", 0.4)
        before = {path.name: path.read_bytes() for path in (self.folder / "new" / "d").iterdir()}
        stopped()
        self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "new" / "d").iterdir()}, before)

    def test_a_split_does_not_write_over_its_input(self):
        self.split("--size", 0.4)
        for name in "surface.vtu", "part_1.poly":
            before = (self.folder / "d" / name).read_bytes()
            link = self.folder / ("link" + name[name.index("."):])
            link.symlink_to(f"d/{name}")
            for given in f"d/{name}", link.name:
                said = self.run_program("split", given, "--parts", 2, "-o", "d", "--size", 0.4, expect=2).stderr
                self.assertIn(name, said)
            self.assertEqual((self.folder / "d" / name).read_bytes(), before)

    def test_report_of_a_check(self):
        self.split("--size", 0.3, parts=2)
        self.mesh()
        self.run_program("check", "d", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["holds"])
        self.assertEqual(len(report["parts"]), 2)

    def test_invalid_surfaces_and_wrong_usage(self):
        self.write("open.off", off(CUBE_POINTS, CUBE_FACETS[:-1]))
        self.run_program("split", "open.off", "--parts", 2, "-o", "d", expect=4)
        self.assertFalse((self.folder / "d" / "manifest.json").exists())
        self.write("two.off", off(CUBE_POINTS + cube((0.5, 0.5, 0.5)), CUBE_FACETS + shifted(CUBE_FACETS, 8)))
        self.run_program("split", "two.off", "--parts", 2, "-o", "d", expect=4)
        self.run_program("split", "cube.off", "--parts", 0, "-o", "d", expect=2)
        self.run_program("split", "cube.off", "-o", "d", expect=2)
        self.run_program("split", "cube.off", "--parts", 2, "-o", "-", expect=2)
        for size in 1e-300, 1e-5:
            self.assertIn("2^30", self.run_program("split", "cube.off", "--parts", 2, "-o", "d", "--size", size, expect=5).stderr)
        self.run_program("split", "cube.off", "--parts", "2", "-o", "cube.off", expect=3)
        self.run_program("join", "nowhere", "-o", "x.vtu", expect=3)
        self.assertIn("nowhere/manifest.json", self.run_program("check", "nowhere", expect=3).stderr)
        self.run_program("check", "cube.off", expect=2)
        (self.folder / "d").mkdir(exist_ok=True)
        self.write("d/manifest.json", '{"format": "other"}')
        self.run_program("check", "d", expect=3)
        self.write("d/manifest.json", "{")
        self.run_program("check", "d", expect=3)

    def test_what_is_damaged_in_a_manifest_is_named(self):
        self.split("--size", 0.4, parts=2)

        def error(change):
            damaged = json.loads(json.dumps(self.manifest))
            change(damaged)
            self.write("d/manifest.json", json.dumps(damaged))
            said = {self.run_program(*words, expect=3).stderr for words in (("check", "d"), ("join", "d", "-o", "x.vtu"))}
            self.assertEqual(len(said), 1)
            return said.pop().split("manifest.json: ")[1]

        for key in self.manifest:
            if key in ("format", "version", "surface", "interface_marker", "options", "names", "parts"):
                self.assertIn(f'"{key}" is missing or damaged', error(lambda m: m.pop(key)))
        self.assertIn('"interface_marker" is missing or damaged', error(lambda m: m.update(interface_marker="x")))
        self.assertIn('"crc32" is missing or damaged', error(lambda m: m["parts"][1].pop("crc32")))
        self.assertIn('"file" is missing or damaged', error(lambda m: m.update(surface=None)))
        self.assertIn('"facets": x is no id, which is an integer', error(lambda m: m["names"].update(facets={"x": "inlet"})))
        self.write("d/manifest.json", '{"format": "holdfast division",\n"version": }')
        self.assertIn("manifest.json: parse error at line 2, column 12", self.run_program("check", "d", expect=3).stderr)

    def test_a_manifest_leads_nowhere_else(self):
        self.split("--size", 0.4, parts=2)
        self.manifest["parts"][0]["surface"] = "../cube.off"
        self.write("d/manifest.json", json.dumps(self.manifest))
        self.run_program("check", "d", expect=3)


if __name__ == "__main__":
    main()
