"""Fails if a document names something that does not exist: a path, a link, an anchor, an option, a make target, a header.

    documents.py ROOT [HOLDFAST]     HOLDFAST: the program, for its options
    documents.py --selftest

It also fails if source, tests or documents cite a text outside the repository.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# Measured by programs: these may name paths that are not in the repository.
GENERATED = {"docs/benchmarks.md", "docs/results.md", "docs/field.md", "docs/paper.md"}
OUTSIDE = [re.compile(text, re.I) for text in ("design" + " §", r"\.\." + "/shared", "/work" + "/shared")]
FOLDERS = ("src", "include", "tests", "docs", "examples", "bench", "scripts", "python", "cmake", ".ci")
PATH = re.compile(r"(?<![\w/.~-])((?:%s)/[\w./-]*\w)" % "|".join(re.escape(f) for f in FOLDERS))
HEADER = re.compile(r"(?<![\w/])(holdfast/\w+\.h)\b")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
TARGET = re.compile(r"(?:`|^    |^)make ([a-z][a-z-]*)(?![\w/.])", re.M)
CODE = re.compile(r"```.*?^```|`[^`\n]+`|^    .+$", re.S | re.M)
# Options of other programs that the documents name.
FOREIGN = {"--no-build-isolation", "--no-isolation", "--version", "--help"}


def documents(root):
    return sorted(p for p in [*root.glob("*.md"), *(root / "docs").glob("**/*.md")] if p.name != "CHANGELOG.md")


def anchors(text):
    """The anchors of a document's headings, as GitHub makes them."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    found = set()
    for heading in re.findall(r"^#+ (.+)$", text, flags=re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def broken_links(path, text):
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue
        where, _, anchor = link.partition("#")
        target = (path.parent / where).resolve() if where else path
        if not target.exists():
            yield f"no file {link}"
        elif anchor and anchor not in anchors(target.read_text()):
            yield f"no section {link}"


def broken_names(root, text, targets, options):
    for name in sorted(set(PATH.findall(text))):
        name = name.rstrip(".")
        if not (root / name).exists() and not list((root / name).parent.glob((root / name).name + ".*")):
            yield f"no path {name}"
    for name in sorted(set(HEADER.findall(text))):
        if not (root / "include" / name).exists():
            yield f"no header {name}"
    for code in CODE.findall(text):
        for target in TARGET.findall(code):
            if target not in targets:
                yield f"no target: make {target}"
        for option in OPTION.findall(code):
            if option not in options:
                yield f"no option {option}"


def outside_texts(root):
    for folder in ("src", "include", "tests", "docs", "examples", "python"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in {".h", ".cpp", ".c", ".py", ".md", ".txt", ".cmake", ".sh", ".in"}:
                continue
            text = path.read_text(errors="replace")
            for cited in sorted(set(re.findall(r"(?<![\w/.])docs/[\w/-]+\.md", text))):
                if path.suffix != ".md" and path.name != "documents.py" and not (root / cited).exists():
                    yield f"{path.relative_to(root)}: no document {cited}"
            for pattern in OUTSIDE:
                if pattern.search(text):
                    yield f"{path.relative_to(root)}: cites a text outside of the repository: {pattern.search(text).group()}"


def options_of_scripts(root):
    """The options of the repository's own scripts and of the tools in its Makefile."""
    found = set(FOREIGN)
    for folder in ("examples", "scripts", "bench", "tests", "python"):
        for path in (root / folder).rglob("*.py"):
            found |= set(re.findall(r'add_argument\(\s*(?:"-\w",\s*)?"(--[a-z-]+)"', path.read_text()))
            found |= set(re.findall(r'"(--[a-z][a-z-]*)"', path.read_text())) if folder == "tests" else set()
    for build in ("CMakePresets.json",):
        if (root / build).exists():
            found |= {"--preset", "--build", "--install", "--target", "--cflags", "--libs"}
    return found


def options_of_program(program):
    def help_of(*command):
        return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=False).stdout

    whole = help_of()
    commands = re.findall(r"^  ([a-z]+) ", whole.partition("Subcommands:")[2], flags=re.M)
    return set(OPTION.findall(whole)).union(*(OPTION.findall(help_of(c)) for c in commands))


def faults(root, program=None):
    targets = set(re.findall(r"^([a-z][a-z-]*):", (root / "Makefile").read_text(), flags=re.M))
    options = options_of_scripts(root) | (options_of_program(program) if program else set())
    for path in documents(root):
        text = path.read_text()
        name = path.relative_to(root)
        for fault in broken_links(path, text):
            yield f"{name}: {fault}"
        if str(name) in GENERATED:
            continue
        for fault in broken_names(root, text, targets, options if program else AnyOption()):
            yield f"{name}: {fault}"
    yield from outside_texts(root)


class AnyOption:
    def __contains__(self, _):
        return True


def selftest():
    """Each kind of fault is found, and a correct document has none."""
    right = "# Words\n\n[here](#words), [there](docs/b.md#to-be-had), `src/a.h`, `make test`, `holdfast mesh --fill`\n"
    wrong = {
        "[x](none.md)": "no file", "[x](docs/b.md#none)": "no section", "see `src/none.h`": "no path",
        "`make none`": "no target", "`holdfast mesh --none`": "no option", "`holdfast/none.h`": "no header"}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name in ("docs", "src", "include/holdfast", "examples"):
            (root / name).mkdir(parents=True)
        (root / "Makefile").write_text("test: build  ## all\n")
        (root / "docs/b.md").write_text("## To be `had`\n")
        (root / "src/a.h").write_text("// a\n")
        (root / "examples/a.py").write_text('parser.add_argument("--fill")\n')
        readme = root / "README.md"
        options = {"--fill"}

        def told():
            text = readme.read_text()
            return [*broken_links(readme, text), *broken_names(root, text, {"test"}, options), *outside_texts(root)]

        readme.write_text(right)
        if told():
            sys.exit(f"what is right is refused: {told()}")
        for text, fault in wrong.items():
            readme.write_text(text + "\n")
            if len(told()) != 1 or fault not in told()[0]:
                sys.exit(f"{text}: not told as '{fault}' but {told()}")
        readme.write_text(right)
        (root / "src/a.h").write_text("// docs/none.md\n")
        if len(told()) != 1:
            sys.exit("a document that is not there is not found")
        (root / "src/a.h").write_text("// (design" + " §2)\n")
        if len(told()) != 1:
            sys.exit("a text outside is not found")
    print("documents.py finds every kind of fault")


if __name__ == "__main__":
    if sys.argv[1:] == ["--selftest"]:
        selftest()
        sys.exit()
    found_faults = list(faults(Path(sys.argv[1]).resolve(), *sys.argv[2:3]))
    print("\n".join(found_faults) if found_faults else "the documents name what exists")
    sys.exit(1 if found_faults else 0)
