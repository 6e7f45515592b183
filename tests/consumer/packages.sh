#!/bin/sh
# Makes the packages by cpack, unpacks both, and builds a program with what is in the .deb.
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
