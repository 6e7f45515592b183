#!/bin/sh
# Builds a C99 program with what pkg-config says of an installed holdfast, and runs it.
#   pkg_config.sh CC SOURCE FOLDER PREFIX
set -eu
compiler=$1 source=$2 folder=$3 prefix=$4
mkdir -p "$folder"
file=$(find "$prefix" -name holdfast.pc)
PKG_CONFIG_PATH=$(dirname "$file")
export PKG_CONFIG_PATH
libraries=$(dirname "$PKG_CONFIG_PATH")
# Words of flags.
# shellcheck disable=SC2046
"$compiler" -std=c99 -Wall -Wextra -Wpedantic -Werror "$source" $(pkg-config --cflags --libs holdfast) -o "$folder/consumer"
LD_LIBRARY_PATH=$libraries "$folder/consumer" "$folder"
test "$("$(dirname "$(find "$prefix" -path '*bin/holdfast')")/holdfast" --version)" = "holdfast $(pkg-config --modversion holdfast)"
