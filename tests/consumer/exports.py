"""Fails unless a shared library exports exactly the public functions of the project, under the SONAME of its version.

    exports.py LIBRARY INCLUDE_FOLDER SOVERSION
"""
import re
import subprocess
import sys
from pathlib import Path


def without_templates(text):
    """Without the text in angle brackets."""
    while (shorter := re.sub(r"<[^<>]*>", "", text)) != text:
        text = shorter
    return text


def declared(include):
    """Names that the headers mark for export: functions, and classes whose members are exported with them."""
    names = set()
    for header in include.glob("holdfast/*.h"):
        text = re.sub(r"//[^\n]*|/\*.*?\*/|^\s*#(?:[^\n]*\\\n)*[^\n]*", "", header.read_text(), flags=re.S | re.M)
        text = without_templates(text)
        names |= set(re.findall(r"class\s+HOLDFAST_API\s+(\w+)", text))
        names |= set(re.findall(r"(?<!class )HOLDFAST_API\s[^;{(]*?(\w+)\(", text))
    return names


def main(library, include, soversion):
    names = declared(Path(include)) | {"from_name", "values_of"}  # declared by a macro
    lines = subprocess.run(["nm", "-D", "-C", "--defined-only", library], check=True, capture_output=True, text=True)
    exported, wrong = set(), []
    for line in lines.stdout.splitlines():
        symbol = line.split(maxsplit=2)[2]
        if "holdfast" not in symbol:
            continue  # templates of the standard library
        match = re.match(r"(?:.* )?(?:holdfast::(\w+)|(holdfast_\w+)$)", without_templates(symbol).split("(")[0])
        name = match and (match.group(1) or match.group(2))
        if name in names:
            exported.add(name)
        else:
            wrong.append(symbol)
    missing = names - exported
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    soname = re.search(r"SONAME.*\[(.*)\]", dynamic).group(1)
    if soname != f"libholdfast.so.{soversion}":
        wrong.append(f"the SONAME is {soname}")
    for text in wrong:
        print("exported, but not public:", text)
    for name in sorted(missing):
        print("public, but not exported:", name)
    if len(exported) < 50:
        sys.exit(f"only {len(exported)} public names are exported")
    sys.exit(1 if wrong or missing else 0)


main(*sys.argv[1:])
