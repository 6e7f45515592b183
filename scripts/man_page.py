"""The manual page, out of what the program says of itself: its --help is the one source.

    man_page.py PROGRAM              writes docs/holdfast.1.in
    man_page.py PROGRAM --check      fails if the file is not what it would write
"""
import re
import subprocess
import sys
from pathlib import Path

FILE = Path(__file__).resolve().parent.parent / "docs/holdfast.1.in"

# Handed over to the Python package, whose help is not laid out as that of the others.
EXTERNAL = {"batch": "FILE... -o DIR [OPTIONS] [-- OPTIONS OF mesh]"}

EXAMPLES = """.SH EXAMPLES
.nf
holdfast mesh part.stl \\-o part.vtu
holdfast check part.stl part.vtu
holdfast diagnose broken.stl \\-\\-marks broken.vtu
holdfast mesh a.stl b.stl \\-o ab.msh \\-\\-size 2 \\-\\-time\\-limit 600
.fi
"""


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def section(text, title):
    """The entries under a title of CLI11's help: (what, words)."""
    match = re.search(rf"^{title}:\n((?:  .*\n)+)", text, flags=re.M)
    entries = []
    for line in match.group(1).splitlines() if match else []:
        what, words = re.match(r"  (\S.*?)(?:\s{2,}(\S.*))?$", line).groups() if not line.startswith("   ") else (None, line.strip())
        if what is None:
            entries[-1][1] += words
        else:
            entries.append([re.sub(r" (?:TEXT|REQUIRED|\.\.\.|Excludes: \S+)", "", what), words or ""])
    return entries


def term(what):
    names, _, value = what.partition(" ")
    names = ", ".join(f"\\fB{escaped(name)}\\fR" for name in names.split(","))
    return names + (f" \\fI{escaped(value)}\\fR" if value else "")


def page(program):
    whole = help_of(program)
    tagline = whole.splitlines()[0]
    lines = ['.TH HOLDFAST 1 "" "Holdfast @PROJECT_VERSION@" "User Commands"', ".SH NAME",
             "holdfast \\- fills triangulated surfaces with tetrahedra and keeps every triangle", ".SH SYNOPSIS"]
    commands = section(whole, "Subcommands")
    for command, _ in commands:
        usage = EXTERNAL.get(command) or re.search(r"^Usage: holdfast \S+ (.*)$", help_of(program, command), flags=re.M).group(1)
        lines += [f".B holdfast {command}", escaped(usage), ".br"]
    lines += [".SH DESCRIPTION", escaped(tagline), ".SH COMMANDS"]
    for command, words in commands:
        text = "" if command in EXTERNAL else help_of(program, command)
        lines += [f".SS holdfast {command}", escaped(words) + "."]
        for title in ("Positionals", "Options"):
            for what, description in section(text, title):
                lines += [".TP", term(what), escaped(description) + "."]
    exits = re.search(r"^Exit codes: (.*)\Z", whole, flags=re.M | re.S).group(1)
    lines.append(".SH EXIT STATUS")
    for entry in re.split(r";\s+", " ".join(exits.split()).rstrip(".")):
        code, meaning = entry.split(" ", 1)
        lines += [".TP", f".B {code}", escaped(meaning) + "."]
    return "\n".join(lines) + "\n" + EXAMPLES


def main(program, mode=""):
    text = page(program)
    if text.count(".TP") < 50:
        sys.exit("the help is not understood any more")
    if mode == "--check":
        if FILE.read_text() != text:
            sys.exit("docs/holdfast.1.in is not what --help says; python3 scripts/man_page.py PROGRAM writes it anew")
        return
    FILE.write_text(text)


main(*sys.argv[1:])
