#!/usr/bin/env bash
# Installs the Debian packages that a job needs and that are missing; says nothing when none is.
# Usage: scripts/setup.sh [build|test|python|python-test|paper|solvers|slurm|bench|field|fuzz|browser|docs|emscripten|node|lint|libcxx]...
set -euo pipefail

declare -A packages=(
  # libgmp-dev is for the independent checker of `make corpus`, not for the product.
  [build]="cmake ninja-build g++ ccache python3 xz-utils zlib1g-dev libboost-dev libmetis-dev liblzma-dev libcli11-dev libfmt-dev
           nlohmann-json3-dev libgtest-dev libgmp-dev locales pkg-config dpkg-dev"
  [test]="python3-dolfinx python3-scipy python3-meshio python3-h5py"
  [python]="python3-dev pybind11-dev python3-numpy python3-setuptools python3-wheel python3-pip python3-venv"
  [python-test]="python3-pytest mypy python3-build python3-meshio python3-vtk9 python3-distributed python3-tqdm"
  [paper]="python3-numpy"
  [solvers]="calculix-ccx openfoam freefem++ libfreefem++ python3-dolfinx python3-getfem python3-netgen python3-sfepy python3-meshio
             python3-vtk9 python3-gmsh python3-h5py gmsh netgen libmed-tools libdeal.ii-dev python3-dolfin getdp python3-escript
             python3-petsc4py code-saturne-bin rheolef python3-netcdf4"
  [slurm]="slurmctld slurmd slurm-client munge"
  [bench]="admesh tetgen libtet1.5-dev gmsh libcgal-dev libgmp-dev libmpfr-dev libtbb-dev libbenchmark-dev"
  [field]="gmsh tetgen python3-netgen"
  [fuzz]="clang-14 clang libclang-rt-14-dev"
  [browser]="chromium fonts-dejavu-core"
  [docs]="mkdocs"
  [emscripten]="emscripten node-acorn libboost-dev nlohmann-json3-dev dpkg-dev ninja-build cmake"
  [node]="nodejs npm"
  [lint]="clang-format clang-tidy"
  [libcxx]="clang libc++-dev libc++abi-dev"
)
# Programs that often come from elsewhere, where Debian's package would not go with them.
declare -A elsewhere=([nodejs]=node [npm]=npm)

wanted=""
for group in "${@:-build}"; do
  [ -n "${packages[$group]:-}" ] || { echo "setup.sh: no group '$group'; there are: ${!packages[*]}" >&2; exit 2; }
  wanted+=" ${packages[$group]}"
done

if ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: not a Debian system, so nothing is installed; the build needs the likes of:$wanted" >&2
  exit 0
fi
# shellcheck disable=SC2086
installed=$(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' $wanted 2>/dev/null | awk '$1 == "ii" { print $2 }') || true
missing=""
for package in $wanted; do
  command=${elsewhere[$package]:-}
  [ -z "$command" ] || ! command -v "$command" >/dev/null || continue
  grep -qxF "$package" <<<"$installed" || missing+=" $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  as_root="sudo"
  command -v sudo >/dev/null || { echo "setup.sh: as root, run: apt-get install$missing" >&2; exit 1; }
fi
echo "setup.sh: installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() {
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y install --no-install-recommends $missing >"$log" 2>&1
}
# The package lists of a fresh machine are empty or old; refresh them only when they are of no use.
install || { $as_root apt-get -qq update >"$log" 2>&1 && install; } || { cat "$log" >&2; exit 1; }
