#!/usr/bin/env bash
# Builds the sdist and the wheel, installs the wheel into a fresh environment that sees the system's packages, and tries it.
# Usage: wheel.sh SOURCE PYTHON OUTPUT [BUILD]
# Without BUILD all is compiled, from a clone of what is committed; with it, the parts compiled there are packed.
set -euo pipefail
source=$(realpath "$1") python=$2
mkdir -p "$3"
output=$(realpath "$3")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -gt 3 ]; then
  HOLDFAST_BUILD_DIR=$(realpath "$4")
  export HOLDFAST_BUILD_DIR
  mkdir "$work/clone"
  (cd "$source" && tar -cf - --exclude=./build --exclude=./.git .) | tar -xf - -C "$work/clone"
else
  git clone -q "$source" "$work/clone"
fi
rm -f "$output"/holdfast-*
(cd "$work/clone" && "$python" -m build --no-isolation --outdir "$output" . >"$work/build.log" 2>&1) || { tail -n 40 "$work/build.log"; exit 1; }
ls "$output"
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install -q --no-index --no-deps "$output"/holdfast-*.whl
cd "$work"
"$work/venv/bin/holdfast" --version
"$work/venv/bin/python" -m holdfast --help >/dev/null
"$work/venv/bin/python" - <<'PY'
import holdfast
points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
mesh = holdfast.mesh(points, triangles, size=0.4)
assert holdfast.check((points, triangles), mesh)
mesh.save("cube.vtu")
print(mesh, "of", holdfast.__file__)
PY
cat >cube.off <<'EOF'
OFF
4 4 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 1 2 3
3 2 0 3
EOF
"$work/venv/bin/holdfast" batch cube.off -o out
test -f out/cube.vtu
