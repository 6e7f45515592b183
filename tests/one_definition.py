"""Fails if two headers or sources define different types of one name in one namespace: the linker then silently merges
templates such as std::vector<Element>, and one of them works on the other's memory.

    one_definition.py ROOT
    one_definition.py --selftest
"""
import re
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
TOKEN = re.compile(
    r"namespace\s+([\w:]*)\s*\{|\b(?:struct|class|enum\s+class|enum)\s+(?:HOLDFAST_API\s+)?(\w+)\s*(?:final\s*)?"
    r"(?::(?!:)[^;{}()]*)?\{|\{|\}")


def types_of(text):
    """Names of the types that a text defines with external linkage, so without those in anonymous namespaces."""
    scopes = []
    for match in TOKEN.finditer(NOISE.sub(" ", text)):
        token = match.group()
        if token == "}":
            if scopes:
                scopes.pop()
        elif token.startswith("namespace"):
            scopes.append(match.group(1) or None)
        else:
            if match.group(2) and all(s is not False and s is not None for s in scopes):
                yield "::".join([*scopes, match.group(2)])
            scopes.append(False)


def doubles(root):
    """One line for every name that two files define."""
    files = defaultdict(set)
    for folder in ("src", "include", "python/src"):
        for path in sorted([*(root / folder).rglob("*.h"), *(root / folder).rglob("*.cpp")]):
            for name in types_of(path.read_text()):
                files[name].add(path.relative_to(root).as_posix())
    return [f"{name}: {', '.join(sorted(where))}" for name, where in sorted(files.items()) if len(where) > 1]


def selftest():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "src").mkdir()
        (root / "src/a.h").write_text("namespace h { struct Element { int a; }; class Own { struct Element {}; }; }")
        (root / "src/b.cpp").write_text("namespace h { namespace { struct Own {}; } class Own::Inner { }; // struct Own {\n}")
        assert doubles(root) == [], doubles(root)
        (root / "src/c.h").write_text("namespace h::inner { struct Own {}; }\nnamespace h { class Element final : Base { }; }")
        assert doubles(root) == ["h::Element: src/a.h, src/c.h"], doubles(root)


if __name__ == "__main__":
    if sys.argv[1:] == ["--selftest"]:
        selftest()
    else:
        found = doubles(Path(sys.argv[1]))
        print("\n".join(found))
        sys.exit(1 if found else 0)
