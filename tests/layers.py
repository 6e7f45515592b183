"""Fails if a layer of src/ includes a header of a layer above it, or if library code prints, exits, names options of the
command line, changes the mesh by single steps (mesh/assembly.h), converts numbers by functions that depend on the locale
(use src/text/decimal.h), or uses functions whose results the standard leaves to the implementation, so that meshes would
differ between platforms (use src/numbers). Sources of the package for browsers must not include layers that
web/CMakeLists.txt leaves out: it would not link.

    layers.py ROOT LAYER...      LAYER... from the lowest to the highest (HOLDFAST_LAYERS of CMakeLists.txt)
    layers.py --selftest
"""
import re
import sys
import tempfile
from pathlib import Path

# Layers that may use less than everything below them.
ONLY = {"check": {"text", "numbers", "exact"}, "check_repair": {"text", "numbers", "exact", "check"},
        "io": {"text", "numbers", "metric"}}
# Threads and limits are in the folder of the mesh but independent of it, the tables of places and of isolated vertices
# need only the surface, one header turns polygons into triangles, and exact signs tell how files orient tetrahedra.
BESIDES = {"io": {"exact/predicates.h", "mesh/parallel.h", "mesh/plain_monitor.h", "surface/weld.h",
                 "surface/isolated.h", "plane/facets.h", "second_order/edge_numbers.h", "second_order/edges_of.h", "size/flat_field.h"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.M)
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"', re.S)
FORBIDDEN = re.compile(
    r"std::(?:cout|cerr|clog|terminate|quick_exit)\b|#\s*include\s*<iostream>"
    r"|(?<![\w.>:])(?:std::)?(?:printf|puts|putchar|perror|exit|_exit|abort)\s*\("
    r"|(?<!\w)f(?:printf|puts|putc)\s*\(\s*(?:stdout|stderr)|(?:(?<!\w)std(?:out|err)(?!\w))")
LOCALE = re.compile(
    r"(?<![\w.>])(?:std::)?(?:v?s(?:n?printf|scanf)|ato[fil]|atoll|strto[dfl]|strtold|sto[dfi]|stold|setlocale)\s*\("
    r"|#\s*include\s*<(?:sstream|iomanip)>|std::[io]?stringstream\b")
UNDEFINED = re.compile(
    r"std::(?:shuffle|sample|\w+_distribution|random_device|default_random_engine|random_shuffle|lerp|hash|"
    r"unordered_multi(?:map|set)|"
    r"(?:exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|"
    r"atanh|erf|erfc|tgamma|lgamma|fma)[fl]?\s*\()")
# Only MeshEditor has access to the mutators of TetMesh, and single steps have a separate header, for these.
ASSEMBLY = "mesh/assembly.h"
ASSEMBLERS = {"refine/parts.cpp"}
# Outside the library, on top of the public headers.
OUTSIDE = {"cli", "reports"}
OPTION = re.compile(r"(?<![\w-])--[a-z]")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def broken_rules(root, layers):
    """One line for every broken rule under root/src and root/include."""
    for path in sorted([*root.glob("src/**/*.cpp"), *root.glob("src/**/*.h"), *root.glob("include/**/*.h")]):
        layer = path.relative_to(root).parts[1]
        public = path.is_relative_to(root / "include")
        if not public and layer not in OUTSIDE and layer not in layers:
            yield f"{path}: folder '{layer}' is not in HOLDFAST_LAYERS"
            continue
        text = path.read_text()
        if public or layer in OUTSIDE:
            allowed = set()
        else:
            allowed = ONLY.get(layer, set(layers[: layers.index(layer)])) | {layer}
        for match in INCLUDE.finditer(text):
            used = match.group(1).split("/")[0]
            line = text.count("\n", 0, match.start(1)) + 1
            if match.group(1) == ASSEMBLY and path.relative_to(root / "src").as_posix() not in ASSEMBLERS:
                yield f"{path}:{line}: single steps change the mesh: use MeshEditor"
            if match.group(1) in BESIDES.get(layer, set()):
                continue
            if used in layers and used not in allowed:
                yield f"{path}:{line}: {'a public header' if public else layer} must not include {match.group(1)}"
        if layer != "cli":
            code = COMMENT_OR_STRING.sub(blank, text)
            for match in FORBIDDEN.finditer(code):
                line = code.count("\n", 0, match.start()) + 1
                yield f"{path}:{line}: library code must not print or exit: {match.group().strip()}"
            for match in COMMENT_OR_STRING.finditer(text):
                if not match.group().startswith("/") and OPTION.search(match.group()):
                    line = text.count("\n", 0, match.start()) + 1
                    yield f"{path}:{line}: the library knows no options of the command line: {match.group()}"
            for match in LOCALE.finditer(code):
                line = code.count("\n", 0, match.start()) + 1
                yield f"{path}:{line}: numbers must not depend on the locale: {match.group().strip()}"
            for match in UNDEFINED.finditer(code):
                line = code.count("\n", 0, match.start()) + 1
                yield f"{path}:{line}: not the same on all platforms, see src/numbers: {match.group().strip()}"


def missing_in_web(root, layers):
    """One line for every header of a layer that web/CMakeLists.txt leaves out, in a source that it compiles."""
    recipe = (root / "web/CMakeLists.txt").read_text()
    left_out = set(re.search(r"^list\(REMOVE_ITEM layers (.*)\)$", recipe, re.M).group(1).split())
    sources = re.compile(re.search(r'EXCLUDE REGEX "(/api/.*)"\)$', recipe, re.M).group(1).replace("\\\\", "\\"))
    for path in sorted(root.glob("src/*/*.cpp")):
        layer = path.parent.name
        if layer not in layers or layer in left_out or sources.search(path.as_posix()):
            continue
        text = path.read_text()
        for match in INCLUDE.finditer(text):
            if match.group(1).split("/")[0] in left_out:
                line = text.count("\n", 0, match.start(1)) + 1
                yield f"{path}:{line}: web/CMakeLists.txt leaves out {match.group(1)}"


def selftest():
    layers = ["text", "exact", "mesh", "surface", "refine", "check", "io", "api"]
    cases = [  # file, text, number of broken rules
        ("src/mesh/a.h", '#include "exact/b.h"\n#include <vector>\n#include "mesh/c.h"\n', 0),
        ("src/exact/a.h", '#include "mesh/b.h"\n', 1),
        ("src/check/a.cpp", '#include "mesh/b.h"\n', 1),
        ("src/check/b.cpp", '#include "exact/b.h"\n', 0),
        ("src/io/a.cpp", '#include "exact/b.h"\n', 1),
        ("src/io/stl.cpp", '#include "surface/weld.h"\n#include "surface/places.h"\n', 1),
        ("src/io/parallel.cpp", '#include "mesh/parallel.h"\n', 0),
        ("src/io/b.cpp", '#include "holdfast/io.h"\nint n = std::strlen("exit(1)");  // exit(1)\n', 0),
        ("src/io/c.cpp", '#include "text/b.h"\nauto s = decimal(1.5) + std::to_string(1);\n', 0),
        ("src/io/d.cpp", 'std::snprintf(b, 8, "%g", x);\ndouble y = std::strtod(b, nullptr);\n', 2),
        ("src/io/e.cpp", "#include <sstream>\nstd::ostringstream words;\n", 2),
        ("src/mesh/b.cpp", "void f() { std::exit(1); }\n", 1),
        ("src/mesh/c.cpp", 'void f() { std::fprintf(stderr, "x"); }\n', 1),
        ("src/mesh/d.cpp", "void f() { on_exit(1); q.exit(); std::cout << 1; }\n", 1),
        ("src/mesh/e.cpp", '// --keep\nconst char* s = "give --keep box";  // or --fill\nint n = i--a;\n', 1),
        ("src/cli/a.cpp", '#include "api/b.h"\nint main() { exit(1); }\n', 1),
        ("src/mesh/e.cpp", "std::shuffle(a, b, r);\nstd::normal_distribution<double> d;\ndouble x = std::hypot(1, 2);\n", 3),
        ("src/mesh/f.cpp", "double x = std::sqrt(2.0) + numbers::log(2) + std::logb(3);  // std::log(2)\n", 0),
        ("src/refine/parts.cpp", '#include "mesh/assembly.h"\n', 0),
        ("src/refine/front.cpp", '#include "mesh/assembly.h"\n#include "mesh/editor.h"\n', 1),
        ("src/mesh/g.cpp", '#include "mesh/assembly.h"\n', 1),
        ("src/other/a.cpp", "", 1),
        ("include/holdfast/a.h", '#include "mesh/b.h"\n', 1),
    ]
    for name, text, expected in cases:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(text)
            found = list(broken_rules(Path(folder), layers))
            assert len(found) == expected, (name, text, found)
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in {"web/CMakeLists.txt": 'list(REMOVE_ITEM layers c check)\n  list(FILTER of_layer EXCLUDE REGEX "/api/(a|b)\\\\.cpp$")\n',
                           "src/api/a.cpp": '#include "check/a.h"\n', "src/check/b.cpp": '#include "check/a.h"\n',
                           "src/api/c.cpp": '#include "mesh/a.h"\n#include "check/a.h"\n'}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = list(missing_in_web(root, layers))
        assert len(found) == 1 and "src/api/c.cpp:2" in found[0], found
    print(f"{len(cases) + 1} cases")


if __name__ == "__main__":
    if sys.argv[1:] == ["--selftest"]:
        selftest()
        sys.exit(0)
    root = Path(sys.argv[1]).resolve()
    problems = [*broken_rules(root, sys.argv[2:]), *missing_in_web(root, sys.argv[2:])]
    print("\n".join(problems) or "every layer includes only what lies below it")
    sys.exit(1 if problems else 0)
