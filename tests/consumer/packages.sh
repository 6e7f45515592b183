#!/bin/sh
# Makes the packages by cpack, unpacks both, and builds programs with what is in them: of C by pkg-config with the .deb, of C++
# by CMake with the .tar.gz, where another minor version is refused. Both stand elsewhere than they were made for.
#   packages.sh BUILD FOLDER PKG_CONFIG_SH CC SOURCE FOLDER_OF_PROGRAM
set -eu
build=$1 folder=$2
shift 2
rm -rf "$folder"
mkdir -p "$folder/deb" "$folder/tgz"
cpack --config "$build/CPackConfig.cmake" -B "$folder"
dpkg-deb -x "$folder"/*.deb "$folder/deb"
dpkg-deb -I "$folder"/*.deb | grep -q 'Package: holdfast'
tar -xzf "$folder"/*.tar.gz -C "$folder/tgz"
for unpacked in "$folder/deb" "$folder/tgz"; do
  for file in bin/holdfast include/holdfast/holdfast.h include/holdfast/c.h pkgconfig/holdfast.pc \
      holdfast-config.cmake man1/holdfast.1 LICENSE-MIT; do
    find "$unpacked" -path "*$file*" | grep -q . || { echo "$file is not in $unpacked"; exit 1; }
  done
done
"$@" "$folder/deb"

here=$(dirname "$0")
prefix=$(dirname "$(dirname "$(find "$folder/tgz" -path '*bin/holdfast')")")
cmake -S "$here/find_package" -B "$folder/cmake" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix"
grep -q "^holdfast_DIR:PATH=$prefix/" "$folder/cmake/CMakeCache.txt"
cmake --build "$folder/cmake"
"$folder/cmake/consumer"
if cmake -S "$here/find_package" -B "$folder/other" -DCMAKE_PREFIX_PATH="$prefix" -DVERSION=0.1 >"$folder/other.log" 2>&1; then
  echo "another minor version is taken"
  exit 1
fi
grep -q 'compatible with requested version "0.1"' "$folder/other.log"
