#!/usr/bin/env bash
# The library as WebAssembly, the page and the npm package, into a folder: web/build.sh build/web
# With --stands it builds nothing and tells whether the folder has what these sources give.
set -euo pipefail
cd "$(dirname "$0")/.."
sources() {
  git ls-files -z src include web viewer/src viewer/dist cmake ":!web/test" | sort -z | xargs -0 sha256sum | sha256sum | cut -c1-64
}
if [ "${1:-}" = --stands ]; then
  [ -f "$2/index.html" ] && [ "$(cat "$2/sources.sha256" 2>/dev/null)" = "$(sources)" ]
  exit
fi
export NODE_PATH=/usr/share/nodejs  # where Debian has the modules that emscripten uses
out=$1
of=$(sources)
mkdir -p "$out/headers" "$out/zlib/lists/partial"
rm -f "$out/sources.sha256"
for headers in boost nlohmann; do ln -sfn /usr/include/$headers "$out/headers/$headers"; done

# The source package of zlib, from where this machine has its packages.
if ! ls -d "$out"/zlib/zlib-*/ >/dev/null 2>&1; then
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    [ -f "$list" ] || continue
    case $list in
      *node* | *cloud*) ;;
      *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" >"$out/zlib/$(basename "$list")" ;;
      *.list) sed -n 's/^deb /deb-src /p' "$list" >"$out/zlib/$(basename "$list")" ;;
    esac
  done
  apt=(-o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$PWD/$out/zlib" -o "Dir::State::Lists=$PWD/$out/zlib/lists" -qq)
  apt-get "${apt[@]}" update
  (cd "$out/zlib" && apt-get "${apt[@]}" source zlib)
fi
zlib=$(ls -d "$PWD/$out"/zlib/zlib-*/)

emcmake cmake -S web -B "$out/wasm" -G Ninja -DCMAKE_BUILD_TYPE=Release -DZLIB_SOURCE="${zlib%/}" \
  -DHEADERS="$PWD/$out/headers" >"$out/cmake.log" 2>&1 || { cat "$out/cmake.log" >&2; exit 1; }
cmake --build "$out/wasm" -j "${JOBS:-$(nproc)}"
node web/build.mjs "$out"
echo "$of" >"$out/sources.sha256"
