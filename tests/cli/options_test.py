"""Options of `holdfast mesh` that make no sense, or have no effect together: exit 2 before any file is read.

    options_test.py PROGRAM [unittest options]
"""
import subprocess

from cli_case import CliTest, main

# The option without effect, as in the message, and the reason.
IDLE = [
    ("--size", ["--fill", "--size", "0.5"]),
    ("--gradation", ["--fill", "--gradation", "0.2"]),
    ("--gradation", ["--fill", "--gradation", "0.3"]),
    ("--size-field", ["--fill", "--size-field", "missing.pos"]),
    ("--no-growth", ["--fill", "--no-growth"]),
    ("--max-volume", ["--fill", "--max-volume", "0.5"]),
    ("--max-ratio", ["--fill", "--max-ratio", "2"]),
    ("--layers", ["--fill", "--layers", "2"]),
    ("--quality", ["--fill", "--quality", "good"]),
    ("--region", ["--fill", "--region", "0.4,0.5,0.6,1,0.2"]),
    ("--quality", ["--without", "optimise", "--quality", "fast"]),
    ("--without points", ["--fill", "--without", "optimise", "--without", "points"]),
    ("--without flips", ["--stop-after", "delaunay", "--without", "flips"]),
    ("--order", ["--stop-after", "flips", "--order", "given"]),
    ("--keep bounded", ["--stop-after", "eliminate", "--keep", "bounded"]),
    ("--hole", ["--stop-after", "flips", "--hole", "0.4,0.5,0.6"]),
    ("--region", ["--stop-after", "flips", "--region", "0.4,0.5,0.6,1"]),
    ("--drop-outside", ["--stop-after", "flips", "--drop-outside"]),
    ("--exact", ["--stop-after", "classify", "--exact", "e.jsonl"]),
    ("--size", ["--stop-after", "suppress", "--size", "0.5"]),
    ("--quality", ["--stop-after", "field_points", "--quality", "fast"]),
    ("--without points", ["--stop-after", "suppress", "--without", "points"]),
    ("--without points does nothing without --fill", ["--without", "points"]),
    ("field_points", ["--stop-after", "field_points", "--fill"]), ("--fill", ["--stop-after", "delaunay", "--fill"]),
]
SENSELESS = [
    ("--size", ["--size", "0"]), ("--size", ["--size", "inf"]), ("--size", ["--size", "nan"]),
    ("--gradation", ["--gradation", "nan"]),
    ("--seed", ["--seed", "-1"]), ("--seed", ["--seed", "1.5"]), ("--seed", ["--seed", "18446744073709551616"]),
    ("--time-limit", ["--time-limit", "0"]), ("--time-limit", ["--time-limit", "nan"]),
    ("--time-limit", ["--time-limit", "inf"]),
    ("--memory-limit", ["--memory-limit", "0"]), ("--memory-limit", ["--memory-limit", "-1"]),
    ("--region", ["--region", "0,0,0,1,0"]), ("2147483647", ["--region", "0,0,0,99999999999"]), ("--order", ["--order", "reverse"]),
    ("--max-volume", ["--max-volume", "0"]), ("--max-volume", ["--max-volume", "core="]),
    ("--max-volume", ["--max-volume", "=1"]), ("--max-volume", ["--max-volume", "2=inf"]),
    ("--max-ratio", ["--max-ratio", "0.5"]), ("--max-ratio", ["--max-ratio", "nan"]),
    ("--layers", ["--layers", "0"]), ("--layers", ["--layers", "-1"]), ("--layers", ["--layers", "1.5"]),
    ("--layers", ["--layers", "101"]),
    ("--size inf", ["--size", "inf"]), ("--size 0", ["--size", "0"]), ("--gradation 1.5", ["--gradation", "1.5"]),
    ("--max-ratio 0.5", ["--max-ratio", "0.5"]), ("--time-limit -1", ["--time-limit", "-1"]), ("--memory-limit inf", ["--memory-limit", "1e400"]),
    ("--keep box=1e300", ["--keep", "box=1e300"]), ("--curved-tolerance inf", ["--order", "2", "--curved", "missing.off", "--curved-tolerance", "inf"]),
]
SENSIBLE = [
    ["--fill", "--without", "points"], ["--without", "optimise", "--size", "0.5"],
    ["--fill", "--without", "optimise"], ["--no-growth", "--gradation", "0.2"],
    ["--stop-after", "flips", "--keep", "box=0.2"], ["--stop-after", "field_points", "--size", "0.5"],
    ["--stop-after", "flips", "--without", "flips"], ["--keep", "box", "--drop-outside", "--hole", "0.4,0.5,0.6"],
    ["--fill", "--region", "0.4,0.5,0.6,1"], ["--fill", "--order", "halving"], ["--stop-after", "partition", "--order", "given"], ["--time-limit", "60", "--memory-limit", "4"],
]


class Options(CliTest):
    def test_options_that_do_nothing_together_are_2(self):
        for option, arguments in IDLE:
            with self.subTest(arguments):
                # No file is read: otherwise it would be 3.
                said = self.run_program("mesh", "missing.off", "-o", "out.vtu", *arguments, expect=2).stderr
                self.assertIn(option, said)

    def test_values_that_make_no_sense_are_2(self):
        for option, arguments in SENSELESS:
            with self.subTest(arguments):
                said = self.run_program("mesh", "missing.off", "-o", "out.vtu", *arguments, expect=2).stderr
                self.assertIn(option, said)

    def test_an_empty_value_is_none(self):
        """As `--size "$H"` if H is not set."""
        for option in "--size", "--gradation", "--max-ratio", "--time-limit", "--seed", "--format", "--report", "--quality", "--layers":
            said = self.run_program("mesh", "cube.off", "-o", "a.vtu", option, "", expect=2).stderr
            self.assertIn(option, said)
        self.assertIn("SURFACE", self.run_program("mesh", "", "-o", "a.vtu", expect=2).stderr)
        self.assertIn("--scale", self.run_program("convert", "cube.off", "a.stl", "--scale", "", expect=2).stderr)
        self.assertEqual(self.files(), ["cube.off"])

    def test_help_that_cannot_be_written_is_told(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            for command in ["--help"], ["mesh", "--help"], ["--version"]:
                ended = subprocess.run([self.program, *command], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(ended.returncode, 3)
                self.assertIn("cannot be written", ended.stderr)

    def test_counts_of_other_commands_do_not_wrap(self):
        for arguments in (["split", "cube.off", "--parts", "-3", "-o", "parts"], ["plane", "cube.off", "-o", "out.off", "--max-points", "-1"],
                          ["repair", "cube.off", "-o", "out.off", "--fill-holes", "-1"]):
            with self.subTest(arguments):
                self.assertIn("--", self.run_program(*arguments, expect=2).stderr)

    def test_no_box_beyond_the_largest_double(self):
        most = "1.7976931348623157e308"
        with open(self.folder / "most.off", "w", encoding="ascii") as file:
            file.write(f"OFF\n4 4 0\n0 0 0\n{most} 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        said = self.run_program("mesh", "most.off", "-o", "out.vtu", "--keep", "box", expect=2).stderr
        self.assertIn("largest double", said)

    def test_others_are_accepted(self):
        for arguments in SENSIBLE:
            with self.subTest(arguments):
                self.run_program("mesh", "cube.off", "-o", "out.vtu", *arguments)

    def test_what_files_make_idle(self):
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--keep", "box", "--drop-outside", expect=2)
        self.write("field.pos", 'View "m" {\nTT(-9,-9,-9, 99,-9,-9, -9,99,-9, -9,-9,99){'
                   + ",".join(["4,0,0,0,4,0,0,0,4"] * 4) + "};\n};\n")
        self.run_program("mesh", "cube.off", "-o", "a.vtu", "--size-field", "field.pos")
        said = self.run_program("mesh", "cube.off", "-o", "b.vtu", "--size-field", "field.pos", "--no-growth",
                                expect=2).stderr
        self.assertIn("--no-growth", said)

    def test_untangle_limits(self):
        self.run_program("mesh", "cube.off", "-o", "a.vtu")
        for option in ("--time-limit", "--memory-limit"):
            self.assertIn(option, self.run_program("untangle", "a.vtu", "-o", "b.vtu", option, "0",
                                                   expect=2).stderr)


if __name__ == "__main__":
    main()
