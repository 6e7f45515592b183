"""Fails if docs/paper.md lacks a figure, a table or a section of the paper, or a section's link to its source or test is broken.

    paper.py ROOT
    paper.py --selftest
"""
import re
import sys
import tempfile
from pathlib import Path

HEADINGS = [f"Figure {k}" for k in range(1, 20)] + ["Table I", "Table II"]
SECTIONS = ["2.1", "2.1.1", "2.1.2", "2.1.3", "2.2", "2.3", "2.4", "3", "3.1", "3.2", "3.3", "4", "5", "5.1", "5.2", "5.3", "6.1", "6.2", "6.3.1", "6.3.2",
            "6.4", "6.5", "7", "8", "8.1", "8.2", "9"]
SOURCES, TESTS = ("src/", "include/", "examples/", "bench/"), ("tests/",)
LINK = re.compile(r"\]\(([^)\s#]+)")


def faults(root):
    page = root / "docs" / "paper.md"
    if not page.exists():
        yield "there is no docs/paper.md"
        return
    text = page.read_text(encoding="utf-8")
    headings = re.findall(r"^#+ (.+)$", text, flags=re.M)
    for heading in HEADINGS:
        if headings.count(heading) != 1:
            yield f"{headings.count(heading)} headings '{heading}'"
        elif heading.startswith("Figure") and not re.search(rf"^!\[{heading}\]\(paper/", text, flags=re.M):
            yield f"no picture of {heading}"
    for link in LINK.findall(text):
        if not re.match(r"[a-z]+:", link) and not (page.parent / link).exists():
            yield f"no file {link}"
    rows = {cells[1].strip(): cells[3:5] for cells in (line.split("|") for line in text.split("\n")) if len(cells) == 6}
    for section in SECTIONS:
        if section not in rows:
            yield f"no row for section {section}"
            continue
        for cell, folders in zip(rows[section], (SOURCES, TESTS)):
            links = LINK.findall(cell)
            if not links or not all(link.startswith(tuple(f"../{folder}" for folder in folders)) for link in links):
                yield f"section {section}: no link to {' or '.join(folders)}"


def selftest():
    """A complete page passes; each missing item is found."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name in ("docs/paper", "src", "tests"):
            (root / name).mkdir(parents=True)
        (root / "src/a.cpp").touch()
        (root / "tests/a.py").touch()
        right = "".join(f"| {s} | what | [a](../src/a.cpp) | [a](../tests/a.py) |\n" for s in SECTIONS)
        for heading in HEADINGS:
            right += f"### {heading}\n"
            if heading.startswith("Figure"):
                name = heading.replace(" ", "-")
                (root / f"docs/paper/{name}.svg").touch()
                right += f"![{heading}](paper/{name}.svg)\n"
        page = root / "docs/paper.md"
        page.write_text(right)
        if list(faults(root)):
            sys.exit(f"what is right is refused: {list(faults(root))}")
        for old, new, fault in (("### Figure 7\n", "", "0 headings"), ("| 6.3.2 ", "| 6.3.9 ", "no row for section 6.3.2"),
                                ("](../src/a.cpp)", "](../src/b.cpp)", "no file"), ("](../tests/a.py)", "](../src/a.cpp)", "no link to tests/"),
                                ("![Figure 9]", "![Figure X]", "no picture of Figure 9")):
            page.write_text(right.replace(old, new, 1))
            if not any(fault in told for told in faults(root)):
                sys.exit(f"not found: {fault}")
    print("paper.py finds every kind of fault")


if __name__ == "__main__":
    if sys.argv[1:] == ["--selftest"]:
        selftest()
        sys.exit()
    found = list(faults(Path(sys.argv[1]).resolve()))
    print("\n".join(found) if found else "docs/paper.md has every figure, table and section")
    sys.exit(1 if found else 0)
