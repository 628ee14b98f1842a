# shellcheck shell=bash
# To be sourced: installs what is missing and builds the command line and the Python package in build/vtk.
# `what` are packages as .ci/install-dependencies.sh knows them.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit
.ci/install-dependencies.sh "${what:-build}"
if [ -z "${ATRIA_COMPILER_LAUNCHER+set}" ]; then export ATRIA_COMPILER_LAUNCHER=ccache; fi

# The tests are left out: they need packages of their own.
tests=()
[ -e build/vtk/CMakeCache.txt ] || tests=(-DATRIA_BUILD_TESTING=OFF)
cmake --preset vtk "${tests[@]}"
cmake --build --preset vtk
