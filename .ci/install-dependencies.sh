#!/usr/bin/env bash
# Installs what Atria is built and tested with on Debian 12.
#
#   install-dependencies.sh build      the compiler, VTK and the libraries: enough for the command line
#   install-dependencies.sh case       what `build` does, and OpenFOAM, which runs cases
#   install-dependencies.sh test       the above, the referees of the tests, and ParaView
#   install-dependencies.sh benchmark  what `build` does, and what the benchmarks measure with and against
#
# Debian's libvtk9-dev and ParaView's development files cannot be installed side by side (their Python
# packages conflict), so ParaView is unpacked into a prefix of its own, ATRIA_PARAVIEW_PREFIX.
set -euo pipefail

what=${1:-build}
prefix=${ATRIA_PARAVIEW_PREFIX:-/opt/atria-paraview}

build_packages=(g++ cmake ninja-build ccache libvtk9-dev libcgal-dev libeigen3-dev zlib1g-dev
  libcli11-dev nlohmann-json3-dev libcgns-dev libmetis-dev libassimp-dev python3-numpy python3-vtk9 xvfb xauth libgl1-mesa-dri)
test_packages=(libgtest-dev libgmock-dev openmpi-bin libcoin-dev openfoam cgns-convert clang-format clang-tidy
  dpkg-dev python3-wheel mmdebstrap python3-sphinx python3-myst-parser furo
  qtbase5-dev qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools libqt5svg5-dev libqt5opengl5-dev python3-pyqt5)
benchmark_packages=(libgtest-dev libgmock-dev libbenchmark-dev libp4est-dev openfoam gmsh)

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

missing() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

update_once() {
  [ -n "${updated:-}" ] || as_root apt-get update -qq
  updated=1
}

install_missing() {
  local wanted
  wanted=$(missing "$@")
  [ -n "$wanted" ] || return 0
  update_once
  # shellcheck disable=SC2086  # one word a package
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $wanted
}

install_paraview() {
  [ -e "$prefix/usr/bin/pvbatch" ] && [ -e "$prefix/.complete" ] && return 0
  update_once
  local folder archive
  folder=$(mktemp -d)
  chmod 755 "$folder"
  (cd "$folder" && apt-get download -qq paraview paraview-dev python3-paraview)
  as_root env DEBIAN_FRONTEND=noninteractive apt-get satisfy -y -qq --no-install-recommends \
    "$(dpkg-deb -f "$folder"/paraview_*.deb Depends)" libopenmpi-dev
  for archive in "$folder"/*.deb; do
    as_root mkdir -p "$prefix"
    as_root dpkg-deb -x "$archive" "$prefix"
  done
  as_root touch "$prefix/.complete"
  rm -rf "$folder"
}

case $what in
  build) install_missing "${build_packages[@]}" ;;
  case) install_missing "${build_packages[@]}" openfoam ;;
  test)
    install_missing "${build_packages[@]}" "${test_packages[@]}"
    install_paraview
    ;;
  benchmark) install_missing "${build_packages[@]}" "${benchmark_packages[@]}" ;;
  *)
    echo "usage: $0 build|case|test|benchmark" >&2
    exit 2
    ;;
esac
