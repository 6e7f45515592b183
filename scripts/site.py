"""Makes the documents a site that can be searched, with five meshes to look at and the page that meshes, where
`make web` has built it: build/site/index.html.

    site.py HOLDFAST FOLDER

Debian's mkdocs does the work; what links lead out of docs/ leads to copies in the site.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"
# Title, file, how the surface is made, how it is meshed.
SHOWN = [
    ("A bearing housing", "housing", ["make_part.py", "@.stl"], []),
    ("The same with no points but those that the surface forces", "housing-filled", ["make_part.py", "@.stl"], ["--fill"]),
    ("Schönhardt's prism", "schonhardt", ["make_hard.py", "schonhardt", "@.off", "--twist", "50"], ["--fill"]),
    ("Chazelle's polyhedron", "chazelle", ["make_hard.py", "chazelle", "@.off", "-n", "3"], ["--fill"]),
    ("Chazelle's polyhedron with field points", "chazelle-graded", ["make_hard.py", "chazelle", "@.off", "-n", "2"], []),
]
CONFIG = """site_name: Holdfast
docs_dir: {source}
site_dir: {site}
use_directory_urls: false
theme:
  name: readthedocs
plugins:
  - search
nav:
{nav}
"""


def relinked(text, here, source):
    """The document with links that are right in the site, where README.md is index.md and docs/ is the top. Files that
    they lead to elsewhere are copied to the top."""
    def new(match):
        label, link = match.groups()
        if re.match(r"[a-z]+:|#", link):
            return match.group()
        where, _, anchor = link.partition("#")
        target = (here / where).resolve()
        if not target.exists():
            return match.group()
        inside = target.is_relative_to(ROOT / "docs")
        if target == ROOT / "README.md":
            path = "index.md"
        elif inside:
            path = target.relative_to(ROOT / "docs").as_posix()
        else:
            path = target.name
            if target.is_file() and target.suffix != ".md":
                shutil.copy(target, source / path)
        depth = len(here.relative_to(ROOT / "docs").parts) if here.is_relative_to(ROOT / "docs") else 0
        return f"[{label}]({'../' * depth}{path}{'#' + anchor if anchor else ''})"
    return re.sub(r"\[([^\]]*)\]\(([^)\s]+)\)", new, text)


def copy_documents(source):
    for path in sorted((ROOT / "docs").glob("**/*")):
        target = source / path.relative_to(ROOT / "docs")
        if path.suffix == ".md":
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(relinked(path.read_text(), path.parent, source))
        elif path.suffix in (".svg", ".png", ".webp"):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
    (source / "index.md").write_text(relinked((ROOT / "README.md").read_text(), ROOT, source))
    for name in ("CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "LICENSE-MIT", "LICENSE-APACHE"):
        text = (ROOT / name).read_text()
        (source / name).write_text(relinked(text, ROOT, source) if name.endswith(".md") else text)


def make_examples(holdfast, source):
    text = "# Meshes to look at\n\nEach is a page of `holdfast mesh --html` ([the viewer](viewer.md)).\n"
    pages = source / "examples"
    pages.mkdir()
    for title, name, made, options in SHOWN:
        words = [word.replace("@", str(pages / name)) for word in made]
        surface = next(word for word in words if word.startswith(str(pages)))
        subprocess.run([sys.executable, EXAMPLES / words[0], *words[1:]], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([holdfast, "mesh", surface, "-o", f"{pages / name}.vtu", "-q", *options,
                        "--html", f"{pages / name}.html"], check=True)
        for left in (surface, f"{pages / name}.vtu"):
            Path(left).unlink()
        state = "cut=true&colour=angle&axis=y" if name.startswith("housing") else "cut=true&colour=angle&added=true"
        text += (f"\n## {title}\n\n<iframe src=\"examples/{name}.html#{state}\" width=\"100%\" height=\"560\" "
                 f"loading=\"lazy\" title=\"{title}\"></iframe>\n\n[Alone](examples/{name}.html)\n")
    (source / "examples.md").write_text(text)


def add_page_that_meshes(page, source):
    """A copy of what `make web` built, with a line that leads there on top of the document about it."""
    if not page.exists():
        print(f"{page} is not built, so that the site is without it: make web")
        return
    shutil.copy(page, source / "mesh.html")
    document = source / "web.md"
    title, rest = document.read_text().split("\n", 1)
    document.write_text(f"{title}\n\n**[Mesh a surface here, in this browser](mesh.html)**\n{rest}")


def title_of(path):
    return re.search(r"^# (.+)$", path.read_text(), re.M).group(1).replace('"', "'").replace("`", "")


def main(holdfast, folder):
    source, site = folder / "site-source", folder / "site"
    shutil.rmtree(source, ignore_errors=True)
    source.mkdir(parents=True)
    copy_documents(source)
    make_examples(holdfast, source)
    add_page_that_meshes(folder / "web" / "index.html", source)
    first = ["index.md", "tutorial.md", "examples.md", "command-line.md", "viewer.md"]
    rest = sorted(p.name for p in source.glob("*.md") if p.name not in first)
    lines = [f'  - "{title_of(source / name)}": {name}' for name in [*first, *rest]]
    lines.append("  - Decisions:")
    lines += [f'    - "{title_of(p)}": decisions/{p.name}' for p in sorted((source / "decisions").glob("*.md"))]
    config = folder / "mkdocs.yml"
    config.write_text(CONFIG.format(source=source, site=site, nav="\n".join(lines)))
    subprocess.run(["/usr/bin/mkdocs", "build", "--quiet", "--strict", "--config-file", config], check=True)
    print(f"{site}/index.html")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
