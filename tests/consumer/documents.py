"""Compiles and runs the programs in the documents, against a shared library.

    documents.py SOURCE CXX CC LIBRARY FOLDER [FLAG...]

Blocks of ```cpp and ```c with a main are programs; each gets the names of a surface and of a volume, and must write the
volume. Flags are for the compilers: a library with sanitizers needs programs with the same ones.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

CUBE = """OFF
8 12 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 0 2 1
3 0 3 2
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7
"""


def main(source, cxx, cc, library, folder, *flags):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    surface = folder / "cube.off"
    surface.write_text(CUBE)
    libraries = Path(library).parent
    programs = []
    for document in ("README.md", "docs/library.md", "docs/tutorial.md"):
        text = (Path(source) / document).read_text()
        found = [(kind, code) for kind, code in re.findall(r"^```(cpp|c)\n(.*?)^```", text, flags=re.S | re.M)
                 if "main(" in code]
        if {kind for kind, _ in found} != {"cpp", "c"}:
            sys.exit(f"{document} has no program in C++ or none in C")
        programs += found
    for number, (kind, code) in enumerate(programs):
        file = folder / f"program{number}.{kind}"
        file.write_text(code)
        program, volume = folder / f"program{number}", folder / f"cube{number}.vtu"
        volume.unlink(missing_ok=True)
        compiler = [cxx, "-std=c++20"] if kind == "cpp" else [cc, "-std=c99"]
        subprocess.run([*compiler, "-Wall", "-Wextra", "-Wpedantic", "-Werror", *flags, f"-I{source}/include",
                        file, library, "-o", program], check=True)
        subprocess.run([program, surface, volume], check=True, env={**os.environ, "LD_LIBRARY_PATH": str(libraries)})
        if not volume.stat().st_size:
            sys.exit(f"{file} has written nothing")


main(*sys.argv[1:])
